"""Finished cases and net rows on disk, for every later run.

One SQLite file. The key of a case is its scene, its settings and the solver's code,
that of a net row all that decides its record: another version never reads them. Each is
one transaction in a write-ahead log, so a killed run loses only the cases in its
workers.

First: names of solver and program. The solver's name is the digest of its
code without docstrings, comments and blank lines; a changed constant changes it.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import sqlite3
import zlib
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import is_dataclass
from datetime import date
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

from netdesign import __version__
from netdesign.core.library import name_core
from netdesign.edge.input_files import explain, find_resource
from netdesign.edge.json_text import MAX_JSON_BYTES
from netdesign.outcome import NetDesignError, Outcome
from netdesign.solving.solve import CaseEnd, decode_end, encode_end
from netdesign.words.message import Message, say

_PACKAGE = Path(__file__).resolve().parent.parent
_SOLVER_PARTS = (
    *("outcome.py", "units.py"),
    *("numerics", "core", "snow", "cable", "coupling", "solving"),
    "addons/history",
)
_WHOLE_PROGRAM = (".",)  # no list from which a part of it could be missing
_LONG = r'"""[^"\\]*(?:(?:\\.|"(?!""))[^"\\]*)*"""'
_SHORT = (
    r"'[^'\\\n]*(?:\\.[^'\\\n]*)*'",
    r'"[^"\\\n]*(?:\\.[^"\\\n]*)*"',
)
_VARIABLES = ("BLIS_", "MKL_", "NPY_", "OMP_", "OPENBLAS_", "VECLIB_")  # by beginnings
# Strings are found so that what looks like a comment inside them is kept.
_STRINGS = re.compile("|".join((_LONG, *_SHORT, r"#[^\n]*")), re.DOTALL)
_DOCSTRING = re.compile(rf":[ \t]*\n\s*r?{_LONG}", re.DOTALL)
_FIRST = re.compile(rf"\s*r?{_LONG}", re.DOTALL)


def take_code(text: str) -> str:
    """Python or TOML text without docstrings, comments and blank lines.

    A docstring stands first or behind a colon at a line's end. Of text as it is
    formatted here nothing else is taken away, which the tests hold for every module.
    """
    text = _STRINGS.sub(lambda hit: "" if hit[0].startswith("#") else hit[0], text)
    first = _FIRST.match(text)
    code = _DOCSTRING.sub(":", text[first.end() if first else 0 :])
    return "\n".join(line.rstrip() for line in code.split("\n") if line.strip())


def identify_solver(package: Path = _PACKAGE) -> str:
    """Version of the solver: its code, and libraries and core that decide digits."""
    return _identify(_SOLVER_PARTS, package, name_core(), take_code)


def identify_program(package: Path = _PACKAGE) -> str:
    """Digest of the whole program, by all its text, and of the profiles beside it.

    Variables of the environment that move last digits are in it, too: with another
    digit a search takes another case.
    """
    whole = _identify(_WHOLE_PROGRAM, package, name_core(), str)
    digest = hashlib.sha256(whole.encode())
    folder = find_resource("standards")
    for path in sorted(filter(Path.is_file, folder.rglob("*"))):
        digest.update(path.relative_to(folder).as_posix().encode())
        digest.update(path.read_bytes())
    variables = [each for each in os.environ.items() if each[0].startswith(_VARIABLES)]
    digest.update(json.dumps(sorted(variables)).encode())
    return digest.hexdigest()


@lru_cache
def _identify(
    parts: tuple[str, ...], package: Path, core: str, take: Callable[[str], str]
) -> str:
    import numpy
    import scipy

    digest = hashlib.sha256()
    for path in _list_files(parts, package):
        digest.update(path.name.encode())
        digest.update(take(path.read_text(encoding="utf-8")).encode())
    libraries = f"numpy {numpy.__version__}, scipy {scipy.__version__}, core {core}"
    digest.update(libraries.encode())
    return f"{__version__}+{digest.hexdigest()[:16]}"


def _list_files(parts: tuple[str, ...], package: Path) -> Iterator[Path]:
    for part in parts:
        place = package / part
        files = [place] if place.is_file() else sorted(place.rglob("*"))
        yield from (file for file in files if file.suffix in (".py", ".toml"))


_LAYOUT = 8  # of the tables
_BUSY_S = 30.0  # how long another run may hold the file
_LOOKED_UP = 500  # keys in one query
_MOST_BYTES = 2**27  # of all net rows, compressed: 1,000 rows take some 80 MB
_QUICK = 1  # level: 1.9 MB of seven rows in 0.01 s to 0.29 MB
_SQLITE, _SUFFIXES = b"SQLite format 3\0", (".sqlite", ".sqlite3", ".db")
# Net rows for which there is no room behind the newer ones.
_FORGET_OLDEST = """
DELETE FROM rows WHERE number IN (
  SELECT number FROM (
    SELECT number, sum(length(packed)) OVER (ORDER BY number DESC) AS filled FROM rows
  ) WHERE filled > ?
)"""
# They say nothing about the case itself.
FORGOTTEN = (Outcome.WORKER_FAILED, Outcome.PROGRAM_FAULT)


class StoreError(NetDesignError):
    """The store cannot be used; the run can go on without it."""


def find_store() -> Path:
    """File of the finished cases: ``NETDESIGN_STORE``, or one in the user's cache."""
    folder = os.environ.get("NETDESIGN_STORE")
    if folder:
        return Path(folder)
    from platformdirs import user_cache_path

    # without an author's folder, or one named Cache, on Windows
    cache = user_cache_path("netdesign", appauthor=False, opinion=False)
    return cache / "cases.sqlite"


def name_case(scene: object, settings: Hashable) -> str:
    """Key of a case under this version of the solver: equal for equal inputs.

    Two versions may have one file open.
    """
    solver = identify_solver()
    text = f"[{solver!r}, {write_parts(scene)}, {_write_settings(settings)}]"
    return hashlib.sha256(text.encode()).hexdigest()


@lru_cache(maxsize=32)
def _write_settings(settings: Hashable) -> str:
    """Text of settings; it is kept, since all cases of a search share it."""
    return write_parts(settings)


def write_parts(value: object) -> str:
    """Text of plain values, and of dataclasses with all their fields; equal for equal.

    Raises
    ------
    TypeError
        For anything else: it cannot be told from its like.
    """
    return json.dumps(value, sort_keys=True, default=_describe)


def _describe(value: Any) -> Any:
    """Plain values of one that is no plain value itself; ``json`` asks for its parts.

    Raises
    ------
    TypeError
        If it cannot be told from its like.
    """
    if is_dataclass(value) and not isinstance(value, type):
        fields = {key: getattr(value, key) for key in value.__dataclass_fields__}
        return [type(value).__name__, fields]
    if hasattr(value, "model_dump"):  # of a profile, read by pydantic
        return [type(value).__name__, value.model_dump()]
    if isinstance(value, MappingProxyType):
        return dict(value)
    if isinstance(value, date):  # a datetime is one, too
        return [type(value).__name__, value.isoformat()]
    if isinstance(value, bytes):
        return ["bytes", hashlib.sha256(value).hexdigest()]
    raise TypeError(f"{value!r:.60}: no part of a name")


class CaseStore:
    """Finished cases in one file; use it in a ``with``."""

    def __init__(
        self, path: Path, tell: Callable[[Message], None], *, is_open: bool = False
    ) -> None:
        """Open or build the file.

        Parameters
        ----------
        path : Path
            The file; its folder is made.
        tell : callable
            Takes what the user should know: a store that had to be set aside.
        is_open : bool
            Another process of this run has opened it, and found it sound.

        Raises
        ------
        StoreError
            If there can be no file at that place.
        """
        self.path, self._tell, self._is_sound = path, tell, is_open
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            fault = self._open()
            if fault and not _may_be_ours(path):
                cause = say("store.other_file")
                raise StoreError(say("store.unusable", path=str(path), cause=cause))
            if fault:
                aside = _set_aside(path)
                warning = say(
                    "store.set_aside", path=str(path), fault=fault, aside=aside.name
                )
                tell(warning)
                fault = self._open()
        except (OSError, sqlite3.Error) as error:
            raise StoreError(
                say("store.unusable", path=str(path), cause=explain(error))
            ) from None
        if fault:
            raise StoreError(say("store.unusable", path=str(path), cause=fault))

    def __enter__(self) -> CaseStore:
        """Return the open store."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close the file."""
        self._base.close()

    def _open(self) -> Message | None:
        """Connect; why the file there cannot be used, or None."""
        self._base = sqlite3.connect(self.path, timeout=_BUSY_S, isolation_level=None)
        try:
            self._base.execute("PRAGMA journal_mode = WAL")
            self._base.execute("PRAGMA synchronous = NORMAL")
            fault = None if self._is_sound else self._prepare()
        except sqlite3.OperationalError:
            self._base.close()
            raise  # locked, read-only, full: the file itself may be sound
        except sqlite3.DatabaseError as error:
            fault = say("store.damaged", cause=str(error))
        if fault:
            self._base.close()
        return fault

    def _prepare(self) -> Message | None:
        base, version = self._base, identify_solver()
        if base.execute("PRAGMA quick_check").fetchone() != ("ok",):
            return say("store.is_damaged")
        base.execute("BEGIN IMMEDIATE")
        tables = {name for (name,) in base.execute("SELECT name FROM sqlite_master")}
        if not tables:
            base.execute("CREATE TABLE origin (layout INTEGER, solver TEXT)")
            base.execute("INSERT INTO origin VALUES (?, ?)", (_LAYOUT, version))
            # entries are long: they stay in the order in which they come
            base.execute(
                "CREATE TABLE cases (name TEXT PRIMARY KEY, numbers TEXT NOT NULL, "
                "seal TEXT NOT NULL)"
            )
            base.execute(
                "CREATE TABLE rows (number INTEGER PRIMARY KEY, "
                "name TEXT UNIQUE NOT NULL, packed BLOB NOT NULL, seal TEXT NOT NULL)"
            )
        base.execute("COMMIT")
        if tables and not {"origin", "cases"} <= tables:
            return say("store.not_a_store")
        origin = base.execute("SELECT layout, solver FROM origin").fetchone()
        if origin != (_LAYOUT, version):
            solver = origin[1] if origin else "?"
            return say("store.other_version", theirs=solver, ours=version)
        return None

    def find(self, names: Iterable[str]) -> dict[str, CaseEnd]:
        """Known cases among the names; a damaged entry is told and left out."""
        wanted = list(dict.fromkeys(names))
        ends: dict[str, CaseEnd] = {}
        for start in range(0, len(wanted), _LOOKED_UP):
            part = wanted[start : start + _LOOKED_UP]
            marks = ", ".join("?" * len(part))
            query = f"SELECT name, numbers, seal FROM cases WHERE name IN ({marks})"
            for name, numbers, seal in self._base.execute(query, part):
                end = _unseal(name, numbers, seal)
                if end is None:
                    self._describe_damaged("store.case_damaged", name)
                    self._base.execute("DELETE FROM cases WHERE name = ?", (name,))
                else:
                    ends[name] = end
        return ends

    def _describe_damaged(self, key: str, name: str) -> None:
        self._tell(say(key, path=str(self.path), name=name[:12]))

    def keep(self, name: str, end: CaseEnd) -> None:
        """Store one finished case, in a transaction of its own."""
        if end.outcome in FORGOTTEN:
            return
        numbers = encode_end(end)
        self._base.execute(
            "INSERT OR REPLACE INTO cases VALUES (?, ?, ?)",
            (name, numbers, seal_entry(name, numbers.encode())),
        )

    def find_row(self, name: str) -> list[str] | None:
        """JSON texts of a known net row; a damaged entry is told and left out."""
        query = "SELECT packed, seal FROM rows WHERE name = ?"
        for packed, seal in self._base.execute(query, (name,)).fetchall():
            texts = _unpack(name, packed, seal)
            if texts is not None:
                return texts
            self._describe_damaged("store.row_damaged", name)
        return None

    def keep_row(self, name: str, texts: Sequence[str]) -> None:
        """Store JSON texts of a finished net row, and let go of the oldest rows."""
        packed = zlib.compress(json.dumps(list(texts)).encode(), _QUICK)
        self._base.execute("BEGIN IMMEDIATE")
        self._base.execute(
            "INSERT OR REPLACE INTO rows (name, packed, seal) VALUES (?, ?, ?)",
            (name, packed, seal_entry(name, packed)),
        )
        self._base.execute(_FORGET_OLDEST, (_MOST_BYTES,))
        self._base.execute("COMMIT")


def seal_entry(name: str, content: bytes) -> str:
    """Digest of an entry, by which a change of any part of it is seen."""
    return hashlib.sha256(f"{name} ".encode() + content).hexdigest()


def _unseal(name: str, numbers: str, seal: str) -> CaseEnd | None:
    """Case of an entry; None if anything in it was changed."""
    with suppress(ValueError, KeyError, TypeError, AttributeError):
        if seal_entry(name, numbers.encode()) == seal:
            return decode_end(numbers)
    return None


def _unpack(name: str, packed: bytes, seal: str) -> list[str] | None:
    """Texts of a net row; None if anything in the entry was changed."""
    with suppress(ValueError, TypeError, zlib.error):
        if seal_entry(name, packed) != seal:
            return None
        # never more than a study may have, whatever was packed there
        text = zlib.decompressobj().decompress(packed, MAX_JSON_BYTES)
        texts = json.loads(text)
        if isinstance(texts, list) and all(isinstance(text, str) for text in texts):
            return texts
    return None


def _may_be_ours(path: Path) -> bool:
    """Whether a file is a database by its name or its first bytes."""
    with path.open("rb") as file:
        begins = file.read(len(_SQLITE)) == _SQLITE
    return begins or path.suffix in _SUFFIXES


def _set_aside(path: Path) -> Path:
    """Move a file and its log out of the way, under a name that is free."""
    number = 1
    while (aside := path.with_name(f"{path.name}.aside-{number}")).exists():
        number += 1
    path.replace(aside)
    for end in ("-wal", "-shm"):
        beside = path.with_name(path.name + end)
        if beside.exists():
            beside.replace(aside.with_name(aside.name + end))
    return aside
