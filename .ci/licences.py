"""Prints .ci/licences.md from the metadata of what is installed here.

Run it in an environment with netdesign and nothing missing:
``python .ci/licences.py > .ci/licences.md``.
"""

import re
from importlib.metadata import distribution

from packaging.requirements import Requirement

HEAD = """# Licences

netdesign itself: MIT. What it needs at run time, and what those need in turn, as
stated in the metadata of each (`python .ci/licences.py` writes this file):

| package | licence |
|---|---|
"""


def find_needed(name="netdesign"):
    """Names of all packages that a plain install brings, without itself."""
    found, waiting = set(), [name]
    while waiting:
        for text in distribution(waiting.pop()).requires or ():
            one = Requirement(text)
            own = re.sub(r"[-_.]+", "-", one.name).lower()
            is_wanted = one.marker is None or one.marker.evaluate({"extra": ""})
            if is_wanted and own not in found:
                found.add(own)
                waiting.append(own)
    return sorted(found)


def name_licence(name):
    """Licence of a package; of a long text its classifier, or its first line."""
    told = distribution(name).metadata
    expression = told.get("License-Expression", "")
    text = told.get("License", "") or ""
    classifiers = [
        one.split(" :: ")[-1]
        for one in told.get_all("Classifier", ())
        if one.startswith("License :: ") and one != "License :: OSI Approved"
    ]
    short = text if text and len(text) < 40 else ""
    return expression or short or ", ".join(classifiers) or text.partition("\n")[0]


def main():
    rows = [f"| {name} | {name_licence(name)} |\n" for name in find_needed()]
    print(HEAD + "".join(rows), end="")


if __name__ == "__main__":
    main()
