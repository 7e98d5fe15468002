"""Files that another program holds: nobody else may write what Excel has open."""

from __future__ import annotations

import sys
from pathlib import Path

_SHARING = (32, 33)  # how Windows numbers a file, or a part of one, in other hands


def is_held(error: OSError, path: Path) -> bool:
    """A file could not be opened or replaced because another program has it open.

    Parameters
    ----------
    error : OSError
        As the system raised it.
    path : Path
        The file that somebody may have open.
    """
    if getattr(error, "winerror", None) in _SHARING:
        return True
    return isinstance(error, PermissionError) and find_lock(path) is not None


def is_open_elsewhere(path: Path) -> bool:
    """A file cannot be replaced now, since another program has it open.

    Only Windows refuses that; elsewhere the old file stays with whoever reads it.
    """
    if not _holds_open_files():
        return False
    try:
        with path.open("r+b"):
            return False
    except OSError as error:
        return is_held(error, path)


def find_lock(path: Path) -> Path | None:
    """File that Excel, Word or LibreOffice lays beside one that is open."""
    names = (f"~${path.name}", f"~${path.name[2:]}", f".~lock.{path.name}#")
    for name in names:
        lock = path.with_name(name)
        try:
            if lock.exists():
                return lock
        except OSError:  # no file can have that name
            continue
    return None


def _holds_open_files() -> bool:
    return sys.platform == "win32"
