"""Files of other programs, as GDAL reads them: bounded, local, quiet."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from netdesign.edge.given_files import read_bounded
from netdesign.outcome import TerrainError

# What rasterio and pyogrio raise on a damaged file, faults of their own among it.
DAMAGE = (
    *(ArithmeticError, AttributeError, LookupError, OSError, RuntimeError),
    *(MemoryError, NameError, TypeError, ValueError),
)


def read_file(path: Path, most: int) -> bytes:
    """Content of a file of at most ``most`` bytes.

    Raises
    ------
    TerrainError
        If it cannot be read, or is larger.
    """
    try:
        return read_bounded(path, most)
    except (OSError, ValueError) as error:
        cause = getattr(error, "strerror", None) or error
        raise TerrainError(f"{path.name}: cannot be read: {cause}") from None


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
