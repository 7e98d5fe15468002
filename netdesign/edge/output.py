"""Writes output files whole or not at all, and replaces only files of earlier runs.

Then: standard output and standard error that outlive a closed pipe or a full disk. A
reader may stop (``netdesign check site.xlsx | head``), a code page lack the signs of a
table. The run goes on to its end; ``fault`` holds why the output is incomplete.
"""

from __future__ import annotations

import codecs
import hashlib
import io
import json
import os
import re
import sys
import tempfile
import textwrap
import tomllib
import unicodedata
from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from functools import cache
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from netdesign.edge.input_files import (
    explain,
    explain_with_file,
    is_open_in_program,
    lock_folder,
)
from netdesign.outcome import OutputError
from netdesign.words.message import say

if TYPE_CHECKING:
    from rich.console import Console

# Names of outputs, for those who plan files and for those who write them.
STUDY_FILE = "study.json"
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
            say("text.at_place", place=str(error.filename), text=explain(error))
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
    """Hashes of the files that an earlier run wrote there, unchanged since."""
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
        Whether the next run may replace these files as long as they are unchanged.

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
    """Delete temporary files of runs that were killed; the folder is locked."""
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


_PLAIN = "netdesign.plain"  # the handler of signs that a code page lacks


class _Lasting(io.RawIOBase):
    """A stream that goes on in silence once it can no longer be written to.

    ``fault`` is the reason why it is not complete; a reader who stopped is none.
    """

    def __init__(self, raw: io.RawIOBase) -> None:
        self._raw = raw
        self._is_lost = False
        self.fault: OSError | None = None

    def write(self, data: object, /) -> int | None:
        """Write the text, or drop it once a write has failed."""
        if not self._is_lost:
            try:
                return self._raw.write(data)  # type: ignore[arg-type]
            except BrokenPipeError:
                self._is_lost = True  # whoever read has seen enough
            except OSError as error:
                self._is_lost, self.fault = True, error
        return memoryview(data).nbytes  # type: ignore[arg-type]

    def writable(self) -> bool:
        """True, as for every output."""
        return True

    def fileno(self) -> int:
        """Descriptor of the stream below."""
        return self._raw.fileno()

    def isatty(self) -> bool:
        """True where the stream below is a terminal."""
        return self._raw.isatty()


def guard_streams() -> _Lasting | None:
    """Put lasting streams in the place of this process's own.

    Returns
    -------
    _Lasting or None
        Standard output; None where the caller made the stream.
    """
    codecs.register_error(_PLAIN, _spell)
    _guard("stderr")
    return _guard("stdout")


def flush_streams() -> None:
    """Flush both streams; a fault of standard output is known afterwards."""
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.flush()


def _guard(name: str) -> _Lasting | None:
    stream = getattr(sys, name)
    if stream is not getattr(sys, f"__{name}__") or not isinstance(
        stream, io.TextIOWrapper
    ):
        return None
    buffer = stream.buffer
    raw: io.RawIOBase = getattr(buffer, "raw", buffer)  # type: ignore[assignment]
    lasting = _Lasting(raw)
    guarded = io.TextIOWrapper(
        io.BufferedWriter(lasting),
        encoding=stream.encoding,
        errors=_PLAIN,
        line_buffering=stream.line_buffering or name == "stderr",
        write_through=stream.write_through,
    )
    setattr(sys, name, guarded)
    return lasting


def spell(text: str, encoding: str) -> str:
    """Text as an output in an encoding shows it, so that its width is known.

    >>> spell("✗ 1.48 ≥ 1", "ascii")
    'x 1.48 >= 1'
    """
    codecs.register_error(_PLAIN, _spell)
    return text.encode(encoding, _PLAIN).decode(encoding)


def _spell(error: UnicodeError) -> tuple[str, int]:
    """Spell in ASCII what an encoding lacks: ``φ`` as phi, ``é`` as e."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    text = error.object[error.start : error.end]
    return "".join(map(_spell_sign, text)), error.end


@cache
def _load_signs() -> Mapping[str, str]:
    file = files(__package__) / "signs.toml"
    return MappingProxyType(tomllib.loads(file.read_text(encoding="utf-8")))


def _spell_sign(sign: str) -> str:
    if sign in _load_signs():
        return _load_signs()[sign]
    decomposed = unicodedata.normalize("NFKD", sign)
    return "".join(letter for letter in decomposed if letter.isascii()) or "?"


def print_json(text: str) -> None:
    """Print a document in UTF-8, whatever the code page: its texts are data."""
    stream = sys.stdout
    if stream is None:
        return
    stream.flush()
    buffer = getattr(stream, "buffer", None)
    if buffer is None:
        stream.write(f"{text}\n")
    else:
        buffer.write(f"{text}\n".encode())
    stream.flush()


_PIPE = 160  # columns of an output that is no terminal, where no line is folded


def open_console(*, err: bool = False) -> Console:
    """Standard output or error, as wide as the terminal; wide in a pipe or a file."""
    from rich.console import Console

    console = Console(stderr=err)
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width, console.soft_wrap = _PIPE, True
    return console


def print_lines(lines: Iterable[str], console: Console, indent: int = 0) -> None:
    """Print sentences; on a terminal each is folded between words.

    Parameters
    ----------
    lines : iterable of str
        Sentences, without line ends.
    console : rich.console.Console
        Where they are printed.
    indent : int
        Blanks before the second and each later line of a sentence.
    """
    from rich.text import Text

    width = max(console.width, 2 * indent + 1)
    for line in lines:
        text = spell(line, console.encoding)
        folded = [text]
        if not console.soft_wrap:
            folded = textwrap.wrap(
                text,
                width,
                subsequent_indent=" " * indent,
                break_on_hyphens=False,
            ) or [""]
        for part in folded:
            console.print(Text(part), soft_wrap=True)
