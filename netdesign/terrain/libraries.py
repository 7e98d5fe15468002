"""Libraries of the extra ``terrain``: whether they are there, how they fail."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec

from netdesign.outcome import NetDesignError, TerrainError
from netdesign.words.message import say

_LIBRARIES = ("rasterio", "pyogrio", "ezdxf")
# What rasterio and pyogrio raise on a damaged file, faults of their own among it.
DAMAGE = (
    *(ArithmeticError, AttributeError, LookupError, OSError, RuntimeError),
    *(MemoryError, NameError, TypeError, ValueError),
)


def require_extra(file: str, refusal: type[NetDesignError] = TerrainError) -> None:
    """Refuse a file that needs the extra where it is not installed.

    Parameters
    ----------
    file : str
        Its name.
    refusal : type
        Of an input or of an output.

    Raises
    ------
    NetDesignError
        Of that type.
    """
    if any(find_spec(one) is None for one in _LIBRARIES):
        raise refusal(say("terrain.no_extra", file=file))


@contextmanager
def keep_quiet() -> Iterator[None]:
    """Neither warnings, nor what the libraries print where they cannot raise.

    A message about a damaged file may itself be no text.
    """
    before = sys.excepthook, sys.unraisablehook
    sys.excepthook, sys.unraisablehook = lambda *_: None, lambda _: None
    try:
        with warnings.catch_warnings(action="ignore"):
            yield
    finally:
        sys.excepthook, sys.unraisablehook = before
