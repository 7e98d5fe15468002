"""Names of the solver and of the whole program, by which kept results are told apart.

The solver is named by what it computes with: its text without docstrings, comments and
blank lines. Editing these leaves the store in use; a changed constant never does.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path

from netdesign import __version__
from netdesign.core.library import name_core

_PACKAGE = Path(__file__).resolve().parent.parent
_SOLVER_PARTS = (
    *("guards.py", "outcome.py", "units.py"),
    *("numerics", "core", "snow", "cable", "coupling", "solving"),
)
_WHOLE_PROGRAM = (".",)  # no list from which a part of it could be missing
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
    text = _STRINGS.sub(lambda one: "" if one[0].startswith("#") else one[0], text)
    first = _FIRST.match(text)
    code = _DOCSTRING.sub(":", text[first.end() if first else 0 :])
    return "\n".join(line.rstrip() for line in code.split("\n") if line.strip())


def identify_solver(package: Path = _PACKAGE) -> str:
    """Version of the solver: its code, and libraries and core that decide digits."""
    return _identify(_SOLVER_PARTS, package, name_core(), take_code)


def identify_program(package: Path = _PACKAGE) -> str:
    """Version of the whole program, by all its text, as ``identify_solver``."""
    return _identify(_WHOLE_PROGRAM, package, name_core(), str)


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
        yield from (one for one in files if one.suffix in (".py", ".toml"))
