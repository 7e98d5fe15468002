"""Whole runs in the store: what one told and wrote, for the next that is its like.

They are a table of their own in the file of the cases, and sealed as those are: a JSON
text, and the contents of files. The newest few are kept. To find one, the file need not
be inspected: the seal says whether the run is whole.
"""

from __future__ import annotations

import hashlib
import json
import os
import sqlite3
import sys
import zlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from netdesign.edge.given_files import find_resource
from netdesign.solving.identity import identify_program
from netdesign.solving.store import BUSY_S, seal_entry, write_parts
from netdesign.words.message import Message, say

_MOST_RUNS = 10
_MOST_BYTES = 64 * 2**20  # of all runs, compressed
_MOST_UNPACKED = 512 * 2**20  # of one run
_QUICK = 1  # level: 7.7 MB in 0.04 s to 1.7 MB; level 6 in 0.09 s to 1.5 MB
_RESOURCES = ("standards", "templates")  # beside the package
# Variables by their beginnings: of libraries that compute, and of Python itself.
_VARIABLES = ("BLIS_", "MKL_", "NPY_", "OMP_", "OPENBLAS_", "PYTHON", "VECLIB_")
_TABLE = (
    "CREATE TABLE IF NOT EXISTS runs (number INTEGER PRIMARY KEY, "
    "name TEXT UNIQUE NOT NULL, text TEXT NOT NULL, files BLOB NOT NULL, "
    "seal TEXT NOT NULL)"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class FinishedRun:
    """A run as it is kept.

    Attributes
    ----------
    text : str
        JSON of what it told.
    files : mapping of str to bytes
        What it wrote, by names of the caller's.
    """

    text: str
    files: Mapping[str, bytes]


def name_run(decides: object) -> str:
    """Key of a run: of all that decides its bytes, and of this installation.

    Raises
    ------
    TypeError
        If a part of it is no plain value, for instance a function.
    """
    text = write_parts([identify_installation(), decides])
    return hashlib.sha256(text.encode()).hexdigest()


def identify_installation() -> str:
    """Digest of all that is the same for every run here.

    The program and its libraries, profiles and templates beside it, Python, and those
    variables of the environment that could move a last digit.
    """
    digest = hashlib.sha256(identify_program().encode())
    for folder in map(find_resource, _RESOURCES):
        for path in sorted(one for one in folder.rglob("*") if one.is_file()):
            digest.update(path.relative_to(folder).as_posix().encode())
            digest.update(path.read_bytes())
    variables = {
        name: text for name, text in os.environ.items() if name.startswith(_VARIABLES)
    }
    place = [sys.version, sys.platform, *_list_installed()]
    digest.update(json.dumps([place, sorted(variables.items())]).encode())
    return digest.hexdigest()


def _list_installed() -> list[str]:
    """Folders of all that is installed, which name versions: ``rich-15.0.0.dist-info``.

    To ask for single versions takes longer, and forgets what those packages need.
    """
    folders = (Path(place) for place in sys.path)
    return sorted({one.name for folder in folders for one in folder.glob("*-info")})


def find_run(
    path: Path, name: str, tell: Callable[[Message], None]
) -> FinishedRun | None:
    """Run of that name; None if it is not known, and for a store that cannot be read.

    Parameters
    ----------
    path : Path
        File of the store; there need not be one.
    name : str
        As `name_run` gives it.
    tell : callable
        Told of a run that is damaged.
    """
    query = "SELECT text, files, seal FROM runs WHERE name = ?"
    try:
        with _open(path) as base:
            entry = base.execute(query, (name,)).fetchone()
    except (OSError, sqlite3.Error):
        return None  # whoever opens the store for cases says what is wrong with it
    if entry is None:
        return None
    found = _unseal(name, *entry)
    if found is None:
        tell(say("store.run_damaged", path=str(path), name=name[:12]))
    return found


def keep_run(path: Path, name: str, run: FinishedRun) -> None:
    """Store a run in one transaction, and let go of the oldest that are too many.

    A run that alone is too large is not kept.

    Raises
    ------
    sqlite3.Error
        If the store cannot take it.
    """
    sizes = {key: len(content) for key, content in run.files.items()}
    text = json.dumps({"text": run.text, "sizes": sizes})
    packed = zlib.compress(b"".join(run.files.values()), _QUICK)
    if len(packed) > _MOST_BYTES or sum(sizes.values()) > _MOST_UNPACKED:
        return
    with _open(path) as base:
        base.execute("BEGIN IMMEDIATE")
        base.execute("SELECT 1 FROM origin")  # else it is no store, or none yet
        base.execute(_TABLE)
        base.execute(
            "INSERT OR REPLACE INTO runs (name, text, files, seal) VALUES (?, ?, ?, ?)",
            (name, text, packed, seal_entry(name, text, packed)),
        )
        base.executemany("DELETE FROM runs WHERE number = ?", _list_oldest(base))
        base.execute("COMMIT")


@contextmanager
def _open(path: Path) -> Iterator[sqlite3.Connection]:
    """Store that is there already, until the end of a ``with``."""
    if not path.is_file():
        raise FileNotFoundError(path)
    with closing(sqlite3.connect(path, timeout=BUSY_S, isolation_level=None)) as base:
        yield base


def _list_oldest(base: sqlite3.Connection) -> list[tuple[int]]:
    """Numbers of the runs for which there is no room behind the newer ones."""
    query = "SELECT number, length(files) FROM runs ORDER BY number DESC"
    oldest, filled = [], 0
    for place, (number, size) in enumerate(base.execute(query).fetchall()):
        filled += size
        if place >= _MOST_RUNS or filled > _MOST_BYTES:
            oldest.append((number,))
    return oldest


def _unseal(name: str, text: str, packed: bytes, mark: str) -> FinishedRun | None:
    """Run of an entry; None if anything in it was changed."""
    with suppress(ValueError, KeyError, TypeError, AttributeError, zlib.error):
        if seal_entry(name, text, packed) != mark:
            return None
        kept = json.loads(text)
        sizes: dict[str, int] = kept["sizes"]
        if min(sizes.values(), default=0) < 0 or sum(sizes.values()) > _MOST_UNPACKED:
            return None
        # never more than the sizes say, whatever was packed there
        contents = zlib.decompressobj().decompress(packed, sum(sizes.values()) + 1)
        return FinishedRun(text=kept["text"], files=_cut(contents, sizes))
    return None


def _cut(contents: bytes, sizes: Mapping[str, int]) -> dict[str, bytes]:
    """Files by their names.

    Raises
    ------
    ValueError
        If the sizes are not those of the contents.
    """
    if sum(sizes.values()) != len(contents):
        raise ValueError("sizes are not those of the contents")
    files: dict[str, bytes] = {}
    start = 0
    for name, size in sizes.items():
        files[name] = contents[start : start + size]
        start += size
    return files
