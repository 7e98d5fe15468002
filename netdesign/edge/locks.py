"""Locks of folders between runs, and files that another program holds open."""

from __future__ import annotations

import os
import sys
from contextlib import ExitStack, suppress
from pathlib import Path

from netdesign.edge.given_files import is_there

LOCK_FILE = ".netdesign.lock"


def lock_folder(folder: Path, held: ExitStack) -> bool:
    """Lock a folder until the stack closes, or the process ends however it does.

    The lock is a file in the folder, which is removed afterwards.

    Returns
    -------
    bool
        False where no lock is to be had, as on some file systems of networks.
    """
    from filelock import FileLock  # who writes nothing needs no lock

    path = folder / LOCK_FILE
    lock = FileLock(path, fallback_to_soft=False, on_acquired=_require_there)
    while True:
        try:
            lock.acquire()
        except _RemovedError:
            continue
        except (OSError, NotImplementedError):
            return False
        held.callback(lock.release)
        held.callback(_remove, path)  # the stack releases the lock afterwards
        return True


class _RemovedError(Exception):
    """The file of a lock was removed while it was waited for."""


def _require_there(handle: int) -> None:
    if os.fstat(handle).st_nlink == 0:
        raise _RemovedError


def _remove(path: Path) -> None:
    """Remove a lock file; Windows keeps it while a run has it open."""
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
