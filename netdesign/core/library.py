"""The compiled library: whether there is one, what made it, and its functions.

``NETDESIGN_CORE=numpy`` switches it off. A source checkout compiles it again after a
change of the C text. Theory: core/THEORY.md.
"""

from __future__ import annotations

import ctypes
import logging
from functools import lru_cache
from pathlib import Path

from netdesign.core.sources import (
    CHECKOUT,
    LIBRARY,
    SWITCHED_OFF,
    compile_core,
    digest_sources,
    find_compiler,
    read_switch,
)
from netdesign.words.message import Message, say

_LOG = logging.getLogger(__name__)

_FUNCTIONS = (
    *("nd_plan", "nd_round", "nd_hang", "nd_root", "nd_panels"),
    *("nd_place", "nd_room", "nd_condense", "nd_answer", "nd_settle"),
)

# What functions give back, as in core.h.
_NO_MEMORY, SINGULAR, TOO_LARGE = -1, -3, -4


def find_core() -> ctypes.PyDLL | None:
    """The library; None where there is none, or where it is switched off.

    Functions of a ``PyDLL`` keep the interpreter's lock: they are short.
    """
    return None if is_switched_off() else _find(LIBRARY)


def is_switched_off() -> bool:
    """True where ``NETDESIGN_CORE`` switches the core off, in any case."""
    return read_switch() == SWITCHED_OFF


def name_core() -> str:
    """Name of the core that solves here: ``numpy``, or ``C`` and its digest."""
    return "numpy" if find_core() is None else f"C {digest_sources()}"


@lru_cache
def _find(path: Path) -> ctypes.PyDLL | None:
    if CHECKOUT.exists() and path.exists() and not _knows_its_text(path):
        from multiprocessing import parent_process

        fault = _compile_again(path)
        if fault and parent_process() is None:  # a worker does not say it, too
            _LOG.warning(fault)
    return _load(path)


def _knows_its_text(path: Path) -> bool:
    """True for a library that has the digest of the C text beside it.

    It is read, not loaded: a process that has loaded it would get the same one again.
    """
    try:
        return digest_sources().encode() in path.read_bytes()
    except OSError:
        return False


def _compile_again(path: Path) -> Message | None:
    """Compile a library that is out of date; why it still is."""
    compiler = find_compiler()
    if compiler is None:
        return say("core.stale", reason=say("core.no_compiler"))
    lines = compile_core(compiler, path).splitlines()
    if not lines:
        return None
    first = next((line for line in lines if "error" in line), lines[0])
    return say("core.stale", reason=first)


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
