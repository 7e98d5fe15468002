"""Writes outputs whole or not at all, and over no file but its own unasked."""

from __future__ import annotations

import hashlib
import json
import os
import re
import tempfile
from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from pathlib import Path

from netdesign.edge.input_files import (
    explain_system,
    explain_with_file,
    is_open_in_program,
    lock_folder,
)
from netdesign.outcome import OutputError
from netdesign.words.message import say

# Names of outputs, for those who plan files and for those who write them.
STUDY_FILE = "study.json"
PROFILES_FILE = "profiles.html"  # the page that compares several profiles
PART_MARK = "part-"  # before the name of every file of some net rows
WHAT_IF_MARK = "what-if-"  # before the name of every file of a what-if

# What a folder of reports remembers of the files that were written there: their hashes.
RECORD_FILE = ".netdesign.json"

_OLD = ".old"
_RANDOM_END = re.compile(r"\.[a-z0-9_]{8}(\.old)?")  # what mkstemp adds to a name


def require_free(paths: list[Path], *, overwrite: bool, may_force: bool = True) -> None:
    """Refuse before any work if an output exists or its folder is unfit.

    Parameters
    ----------
    paths : list of Path
        Outputs.
    overwrite : bool
        Whether files may be there.
    may_force : bool
        Whether the command has ``--force``: no option is advised that it lacks.

    Raises
    ------
    OutputError
        Naming every path that is in the way, or that no file can have.
    """
    try:
        _require_free(paths, overwrite=overwrite, may_force=may_force)
    except OSError as error:
        raise OutputError(
            say("text.at_place", place=str(error.filename), text=explain_system(error))
        ) from error


def _require_free(paths: list[Path], *, overwrite: bool, may_force: bool) -> None:
    for path in paths:
        # to put a file in the place of a folder, a device, a pipe would take it away
        if path.exists() and not path.is_file():
            raise OutputError(say("output.not_a_file", path=str(path)))
    own = {folder: _read_own(folder) for folder in {path.parent for path in paths}}
    there = [path for path in paths if path.exists()]
    taken = tuple(str(path) for path in there if path.name not in own[path.parent])
    if taken and not overwrite and may_force:
        raise OutputError(say("output.exists_force", paths=taken))
    if taken and not overwrite:
        raise OutputError(say("output.exists", paths=taken))
    busy = tuple(str(path) for path in there if is_open_in_program(path))
    if busy:
        raise OutputError(say("output.open_in_program", paths=busy))
    for folder in own:
        nearest = next(p for p in (folder, *folder.absolute().parents) if p.exists())
        if not nearest.is_dir():
            raise OutputError(say("output.no_folder", path=str(nearest)))
        if not os.access(nearest, os.W_OK):
            raise OutputError(say("output.not_writable", path=str(nearest)))


def _read_own(folder: Path) -> dict[str, str]:
    """Hashes of the files that an earlier run wrote there, and nobody changed since."""
    try:
        record = json.loads((folder / RECORD_FILE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    if not isinstance(record, dict):
        return {}
    return {
        name: digest
        for name, digest in record.items()
        if _hash_file(folder / name) == digest
    }


def _hash_file(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""


def _write_records(contents: Mapping[Path, bytes]) -> dict[Path, bytes]:
    """Record of each folder, with these files in the place of older ones."""
    records: dict[Path, bytes] = {}
    for folder in {path.parent for path in contents}:
        written = {
            path.name: hashlib.sha256(content).hexdigest()
            for path, content in contents.items()
            if path.parent == folder
        }
        text = json.dumps(_read_own(folder) | written, indent=1, sort_keys=True)
        records[folder / RECORD_FILE] = text.encode()
    return records


def write_files(
    contents: Mapping[Path, bytes], *, overwrite: bool, is_recorded: bool = False
) -> None:
    """Write all files under temporary names, then put them all in place.

    Of two runs that write to one folder at once, one waits for the other. Old files
    leave before the first new one comes: whenever a run is killed, the files that are
    there are whole, and of one run. What a killed run left is removed by the next.

    Parameters
    ----------
    contents : mapping of Path to bytes
        By their places.
    overwrite : bool
        Whether files of others may be replaced.
    is_recorded : bool
        Whether the next run may replace these files, as long as nobody changes them.

    Raises
    ------
    OutputError
        If a file appeared since ``require_free`` and may not be replaced, or the
        place is full or unfit; the old files are then as they were.
    """
    folders = {path.parent for path in contents}
    try:
        for folder in folders:
            folder.mkdir(parents=True, exist_ok=True)
        with ExitStack() as held:
            # other runs that write there wait, where a lock is to be had
            is_alone = all([lock_folder(folder, held) for folder in sorted(folders)])
            require_free(list(contents), overwrite=overwrite)
            if is_alone:
                records = {folder / RECORD_FILE for folder in folders}
                _remove_leftovers({*contents, *records})
            digests = _write_records(contents) if is_recorded else {}
            _exchange({**contents, **digests})
    except OSError as error:
        raise OutputError(
            say("output.cannot_write", cause=explain_with_file(error))
        ) from error


def _remove_leftovers(paths: Iterable[Path]) -> None:
    """Delete temporary files of runs that were killed; nobody else writes now."""
    for path in paths:
        start = f".{path.name}"
        for sibling in path.parent.iterdir():
            if sibling.name.startswith(start) and _RANDOM_END.fullmatch(
                sibling.name.removeprefix(start)
            ):
                sibling.unlink(missing_ok=True)


def _exchange(contents: Mapping[Path, bytes]) -> None:
    """Replace old files by new ones; if that fails, the old ones come back."""
    new: dict[Path, Path] = {}
    old: dict[Path, Path] = {}
    try:
        for path, content in contents.items():
            handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
            new[path] = Path(name)
            with os.fdopen(handle, "wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            new[path].chmod(_usual_mode())
        for path, temporary in new.items():
            if path.exists():
                old[path] = temporary.with_name(temporary.name + _OLD)
                path.replace(old[path])
        for path, temporary in new.items():
            temporary.replace(path)
    except BaseException:
        _undo(new, old)
        raise
    finally:
        for temporary in new.values():
            temporary.unlink(missing_ok=True)
    for aside in old.values():
        aside.unlink(missing_ok=True)


def _undo(new: Mapping[Path, Path], old: Mapping[Path, Path]) -> None:
    for path, temporary in new.items():
        if not temporary.exists():
            path.unlink(missing_ok=True)  # it is in place already
    for path, aside in old.items():
        if aside.exists():  # else it never left
            aside.replace(path)


def _usual_mode() -> int:
    """Mode of a new file under the user's umask, which can only be read by setting."""
    umask = os.umask(0o077)
    os.umask(umask)
    return 0o666 & ~umask
