"""Locks of folders between runs, and files that another program holds open."""

from __future__ import annotations

import errno
import os
import sys
import time
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Any

from netdesign.edge.given_files import is_there

LOCK_FILE = ".netdesign.lock"
_TAKEN = (errno.EACCES, errno.EDEADLK)  # what Windows says of a lock in other hands
_PAUSE_S = 0.05


def lock_folder(folder: Path, held: ExitStack) -> bool:
    """Lock a folder until the stack closes, or the process ends however it does.

    Returns
    -------
    bool
        False where no lock is to be had, as on some file systems of networks.
    """
    try:
        import fcntl
    except ImportError:  # Windows, where no folder can be opened
        return _lock_file(folder / LOCK_FILE, held)
    handle = os.open(folder, os.O_RDONLY)
    held.callback(os.close, handle)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX)
    except OSError:
        return False
    return True


def _lock_file(path: Path, held: ExitStack) -> bool:
    """Lock a file of a folder in the way of Windows; it is removed afterwards."""
    import msvcrt

    windows: Any = msvcrt  # whose names a checker knows on Windows only
    try:
        handle = os.open(path, os.O_RDWR | os.O_CREAT)
    except OSError:
        return False
    held.callback(_remove, path)  # the stack closes the file before
    held.callback(os.close, handle)
    while True:
        try:
            windows.locking(handle, windows.LK_NBLCK, 1)
        except OSError as error:
            if error.errno not in _TAKEN:
                return False
            time.sleep(_PAUSE_S)
        else:
            return True


def _remove(path: Path) -> None:
    """Remove a lock file; Windows keeps it while another run waits for it."""
    with suppress(OSError):
        path.unlink(missing_ok=True)


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


def is_open_in_program(path: Path) -> bool:
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
    return next(filter(is_there, map(path.with_name, names)), None)


def _holds_open_files() -> bool:
    return sys.platform == "win32"
