"""Names of the solver, the program and the installation: they tell kept results apart.

The solver is named by what it computes with: its text without docstrings, comments and
blank lines. Editing these leaves the store in use; a changed constant never does.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import sys
from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path

from netdesign import __version__
from netdesign.core.library import name_core
from netdesign.edge.given_files import find_resource

_PACKAGE = Path(__file__).resolve().parent.parent
_SOLVER_PARTS = (
    *("outcome.py", "units.py"),
    *("numerics", "core", "snow", "cable", "coupling", "solving"),
    "addons/history",
)
_WHOLE_PROGRAM = (".",)  # no list from which a part of it could be missing
_RESOURCES = ("standards", "templates")  # beside the package
# Variables by their beginnings: of libraries that compute, and of Python itself.
_VARIABLES = ("BLIS_", "MKL_", "NPY_", "OMP_", "OPENBLAS_", "PYTHON", "VECLIB_")
_LONG = r'"""[^"\\]*(?:(?:\\.|"(?!""))[^"\\]*)*"""'
_SHORT = (
    r"'[^'\\\n]*(?:\\.[^'\\\n]*)*'",
    r'"[^"\\\n]*(?:\\.[^"\\\n]*)*"',
)
# Strings are found so that what looks like a comment inside them is kept.
_STRINGS = re.compile("|".join((_LONG, *_SHORT, r"#[^\n]*")), re.DOTALL)
_DOCSTRING = re.compile(rf":[ \t]*\n\s*r?{_LONG}", re.DOTALL)
_FIRST = re.compile(rf"\s*r?{_LONG}", re.DOTALL)


def take_code(text: str) -> str:
    """Python or TOML text without docstrings, comments and blank lines.

    A docstring stands first or behind a colon at a line's end. Of text as it is
    formatted here nothing else is taken away, which the tests hold for every module.
    """
    text = _STRINGS.sub(lambda hit: "" if hit[0].startswith("#") else hit[0], text)
    first = _FIRST.match(text)
    code = _DOCSTRING.sub(":", text[first.end() if first else 0 :])
    return "\n".join(line.rstrip() for line in code.split("\n") if line.strip())


def identify_solver(package: Path = _PACKAGE) -> str:
    """Version of the solver: its code, and libraries and core that decide digits."""
    return _identify(_SOLVER_PARTS, package, name_core(), take_code)


def identify_program(package: Path = _PACKAGE) -> str:
    """Version of the whole program, by all its text, as ``identify_solver``."""
    return _identify(_WHOLE_PROGRAM, package, name_core(), str)


def identify_installation() -> str:
    """Digest of all that is the same for every run here.

    The program and its libraries, profiles and templates beside it, Python, and those
    variables of the environment that could move a last digit.
    """
    digest = hashlib.sha256(identify_program().encode())
    for folder in map(find_resource, _RESOURCES):
        for path in sorted(filter(Path.is_file, folder.rglob("*"))):
            digest.update(path.relative_to(folder).as_posix().encode())
            digest.update(path.read_bytes())
    variables = {
        name: text for name, text in os.environ.items() if name.startswith(_VARIABLES)
    }
    place = [sys.version, sys.platform, *_list_installed()]
    digest.update(json.dumps([place, sorted(variables.items())]).encode())
    return digest.hexdigest()


def _list_installed() -> list[str]:
    """Folders of all that is installed, which name versions: ``rich-15.0.0.dist-info``.

    To ask for single versions takes longer, and forgets what those packages need.
    """
    folders = (Path(place) for place in sys.path)
    return sorted({path.name for folder in folders for path in folder.glob("*-info")})


@lru_cache
def _identify(
    parts: tuple[str, ...], package: Path, core: str, take: Callable[[str], str]
) -> str:
    import numpy
    import scipy

    digest = hashlib.sha256()
    for path in _list_files(parts, package):
        digest.update(path.name.encode())
        digest.update(take(path.read_text(encoding="utf-8")).encode())
    libraries = f"numpy {numpy.__version__}, scipy {scipy.__version__}, core {core}"
    digest.update(libraries.encode())
    return f"{__version__}+{digest.hexdigest()[:16]}"


def _list_files(parts: tuple[str, ...], package: Path) -> Iterator[Path]:
    for part in parts:
        place = package / part
        files = [place] if place.is_file() else sorted(place.rglob("*"))
        yield from (file for file in files if file.suffix in (".py", ".toml"))
