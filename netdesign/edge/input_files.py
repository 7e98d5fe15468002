"""Reads files of the user within a bound of size, and shows them without control signs.

Then: locks of folders between runs, files that another program holds open, and the
reasons that the system, pydantic and the parser of TOML give.
"""

from __future__ import annotations

import os
import sys
import tomllib
from collections.abc import Mapping, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Any

from netdesign.outcome import ContentError, NetDesignError
from netdesign.words.message import Message, say

# A scene, a profile's file and a set of defaults have a few kilobytes.
MAX_TOML_BYTES = 256 * 2**10
# The parser keeps every part of a dotted key: its memory grows with their square.
_MOST_POINTS = 200

_MOST_FAULTS = 50


def is_there(path: Path) -> bool:
    """A file or folder can be seen there; nothing can at an impossible name."""
    try:
        return path.exists()
    except OSError:
        return False


def read_bounded(path: Path, most: int) -> bytes:
    """Content of a file of at most ``most`` bytes; devices without end are files too.

    Raises
    ------
    OSError
        If it cannot be opened or read.
    ValueError
        If it is larger.
    """
    with path.open("rb") as file:
        content = file.read(most + 1)
    if len(content) > most:
        raise ContentError(say("file.too_large", most=most / 2**10))
    return content


def parse_toml(content: bytes) -> dict[str, Any]:
    """Tables of a TOML file.

    Raises
    ------
    ValueError
        If it is no TOML in UTF-8, or nested beyond reason.
    """
    if max((line.count(b".") for line in content.splitlines()), default=0) > (
        _MOST_POINTS
    ):
        raise ContentError(say("file.many_points", most=_MOST_POINTS))
    text = decode_utf8(content)
    try:
        return tomllib.loads(text)
    except ValueError as error:
        raise ContentError(say("file.no_value", fault=str(error))) from None
    except RecursionError:
        raise ContentError(say("file.nested")) from None


def decode_utf8(content: bytes) -> str:
    """Text of a file in UTF-8, without its byte order mark.

    Raises
    ------
    ContentError
        If it is not in UTF-8.
    """
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1  # without the mark
        raise ContentError(say("file.no_utf8", line=line)) from None


def read_toml(path: Path) -> dict[str, Any]:
    """Tables of a TOML file; errors as of `read_bounded` and `parse_toml`."""
    return parse_toml(read_bounded(path, MAX_TOML_BYTES))


def make_printable(text: str) -> str:
    """Text that a terminal only shows: a blank for each sign that would steer it.

    Lines stay, and blanks that hold words together. Escape sequences, marks that
    turn the direction of writing, and halves of characters lose their sign and with
    it their effect.

    >>> make_printable("a\\x1b[31mb")
    'a [31mb'
    """
    kept = "\n\u00a0"  # French sets a no-break space before some marks
    if text.replace(kept[0], "").replace(kept[1], "").isprintable():
        return text
    return "".join(sign if sign.isprintable() or sign in kept else " " for sign in text)


def list_faults(faults: Sequence[Message]) -> Message:
    """One fault a line; of very many the first ones and their number."""
    if len(faults) <= _MOST_FAULTS:
        return say("text.lines", lines=tuple(faults))
    left = say("text.more_faults", count=len(faults) - _MOST_FAULTS)
    return say("text.lines", lines=(*faults[:_MOST_FAULTS], left))


_PACKAGE = Path(__file__).resolve().parent.parent


def find_resource(name: str, package: Path = _PACKAGE) -> Path:
    """Folder ``name`` of the installed package or of the checkout around it.

    A wheel carries the two folders as ``netdesign/_data/<name>``; a checkout
    and an editable install have them beside the package.
    """
    for candidate in (package / "_data" / name, package.parent / name):
        if candidate.is_dir():
            return candidate
    raise NetDesignError(say("program.folder_missing", name=name))


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
        The file, which another program may hold open.
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


def explain(error: BaseException) -> Message | str:
    """Cause of a failure: the program's message, or the text of system or library."""
    if isinstance(error, NetDesignError | ContentError):
        return error.message
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    return str(error)


def explain_with_file(error: OSError) -> Message | str:
    """Cause of a failure, with the file that the system names."""
    if error.filename is None:
        return explain(error)
    path = Path(os.fsdecode(error.filename))
    if is_held(error, path):
        return say("os_error.open_in_program", file=repr(str(path)))
    return say("os_error.at_file", cause=explain(error), file=repr(error.filename))


def explain_shape(fault: Mapping[str, Any]) -> Message | str:
    """Fault of a value, in our words where we found it, else in those of pydantic."""
    error = fault.get("ctx", {}).get("error")
    if isinstance(error, ContentError):
        return error.message
    return str(fault["msg"]).removeprefix("Value error, ")
