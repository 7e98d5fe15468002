"""Prints the lowest versions that pyproject.toml accepts, as constraints for pip.

Needs Python 3.11; ``.ci/try_lowest`` installs them and runs the tests.
"""

import re
import tomllib
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent / "pyproject.toml"
EXTRAS = ("dask", "docx", "plot", "terrain", "test")  # what the tests need


def main():
    project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    stated = [*project["dependencies"], *(one for e in EXTRAS for one in extras[e])]
    for one in stated:
        bound = re.fullmatch(r"([\w-]+)>=([\w.]+)", one)
        if bound:
            print("{}=={}".format(*bound.groups()))
        elif not one.startswith("netdesign["):
            raise SystemExit(f"{one}: no lower bound")


if __name__ == "__main__":
    main()
