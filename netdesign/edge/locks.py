"""Locks of folders between runs: whoever has one writes there alone."""

from __future__ import annotations

import errno
import os
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

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
    try:
        path.unlink(missing_ok=True)
    except OSError:
        return
