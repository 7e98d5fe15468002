"""The compiled library: whether there is one, what made it, and its functions.

``NETDESIGN_CORE=numpy`` switches it off. Theory: core/THEORY.md.
"""

from __future__ import annotations

import ctypes
from functools import lru_cache
from pathlib import Path

from netdesign.core.sources import (
    LIBRARY,
    SWITCHED_OFF,
    digest_sources,
    read_switch,
)

_FUNCTIONS = (
    *("nd_plan", "nd_step", "nd_flow", "nd_residual"),
    *("nd_place", "nd_hang", "nd_part", "nd_round", "nd_panel"),
)

# What functions give back, as in core.h.
_NO_MEMORY, SINGULAR, TOO_LARGE = -1, -3, -4


def find_core() -> ctypes.PyDLL | None:
    """The library; None where there is none, or where it is switched off.

    Functions of a ``PyDLL`` keep the interpreter's lock: they are short.
    """
    return None if is_switched_off() else _load(LIBRARY)


def is_switched_off() -> bool:
    """True where ``NETDESIGN_CORE`` switches the core off, in any case."""
    return read_switch() == SWITCHED_OFF


def name_core() -> str:
    """Name of the core that solves here: ``numpy``, or ``C`` and its digest."""
    return "numpy" if find_core() is None else f"C {digest_sources()}"


@lru_cache
def _load(path: Path) -> ctypes.PyDLL | None:
    try:
        library = ctypes.PyDLL(str(path))
        library.nd_version.restype = ctypes.c_char_p
        if library.nd_version() != digest_sources().encode():
            return None
    except (OSError, AttributeError):  # not built, or for another machine
        return None
    for name in _FUNCTIONS:
        getattr(library, name).restype = ctypes.c_int32
    return library


def require_sound(code: int) -> int:
    """The code of a function that ended as it should.

    Raises
    ------
    MemoryError
        If there was no room.
    ValueError
        If what it was given is not sound: a fault of the program, not of its user.
    """
    if code == _NO_MEMORY:
        raise MemoryError
    if code < 0:
        raise ValueError(f"the compiled core refuses its arrays: {code}")
    return code
