"""Reads a profile folder into a frozen ``Standard``."""

from __future__ import annotations

import difflib
import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

from netdesign.checks.schema import (
    ChoiceEntry,
    ChoicesFile,
    DocumentFile,
    Entry,
    FactorEntry,
    FactorsFile,
    FileT,
    Floor,
    LimitsFile,
    LoadTable,
    ModelFile,
    SharedSum,
    TableEntry,
    TablesFile,
    check_table,
    find_bounds,
)
from netdesign.edge.input_files import (
    MAX_TOML_BYTES,
    explain,
    find_resource,
    is_there,
    parse_toml,
    read_bounded,
)
from netdesign.outcome import StandardError
from netdesign.units import radian_from_degree
from netdesign.words.message import Message, say

EntryT = TypeVar("EntryT", FactorEntry, TableEntry)

_FILES = ("document.toml", "limits.toml", "factors.toml")
_OPTIONAL = ("model.toml", "tables.toml", "choices.toml")
_HASHED_SUFFIXES = (".toml", ".md")


@dataclass(frozen=True, slots=True, kw_only=True)
class StandardValue:
    """One value of a profile.

    Attributes
    ----------
    id, clause, text, source : str
        What it is and where it comes from; clause "-" where there is none.
    value : float
        As printed, in ``unit``.
    unit : str
        Such as "deg", "m" or "-".
    status : str
        "read" in the document, from a "secondary" source, "assumed", or "user".
    reason_beyond : str
        Why it may lie beyond what any document has, as a factor below 1; else "".
    """

    id: str
    clause: str
    text: str
    value: float
    unit: str
    status: str
    source: str
    reason_beyond: str = ""

    @property
    def value_si(self) -> float:
        """The value with degrees as radians; all else as printed."""
        return radian_from_degree(self.value) if self.unit == "deg" else self.value


@dataclass(frozen=True, slots=True, kw_only=True)
class StandardTable:
    """Values of a profile by a count, such as the number of tests.

    Attributes
    ----------
    id, clause, text, status, source, reason_beyond : str
        As for a `StandardValue`.
    over : str
        What is counted: "tests".
    rows : tuple of (int, float, float)
        From, to (both included; the last may be infinite), value [-].
    """

    id: str
    clause: str
    text: str
    over: str
    status: str
    source: str
    rows: tuple[tuple[int, float, float], ...]
    reason_beyond: str = ""

    def find(self, count: int) -> float | None:
        """Value at a count [-]; None outside the table: no extrapolation."""
        return next(
            (value for low, high, value in self.rows if low <= count <= high), None
        )

    @property
    def values(self) -> tuple[StandardValue, ...]:
        """Each row as a value of its own, for lists: ``id[from]``."""
        least, most = find_bounds(self.id)
        return tuple(
            StandardValue(
                id=f"{self.id}[{low}]",
                clause=self.clause,
                text=f"{self.text} {self.over.capitalize()}: {low}"
                + (" and more" if high == math.inf else f" to {high:g}")
                * (high != low),
                value=value,
                unit="-",
                status=self.status,
                source=self.source,
                reason_beyond="" if least <= value <= most else self.reason_beyond,
            )
            for low, high, value in self.rows
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Standard:
    """A limit profile: its identity, its values, and the hash of its files.

    ``choice`` names the set of factors taken from ``choices.toml``, ``choice_text`` is
    its description; "" for none.
    ``floor`` names the least demand: the guideline's load, or "none".
    ``is_floor_overruled``: an option of the run replaced the profile's floor.
    ``has_maker_floor``: an anchor's demand is at least what the net's maker states.
    ``is_by_guideline``: the guideline's load decides even where it is the smaller.
    ``shared_sum``: how the pulls of two guys on one anchor are added.
    ``is_default``: the profile was not named, and the default is taken.
    ``not_checked``: topics that others must check.
    """

    id: str
    version: str
    title: str
    edition: str
    language: str
    transcribed_by: str
    checked_by: str
    what_it_is: str
    what_it_is_not: str
    choice: str = ""
    choice_text: str = ""
    floor: Floor = "guideline"
    has_maker_floor: bool = True
    is_by_guideline: bool = False
    shared_sum: SharedSum = "vector"
    is_floor_overruled: bool = False
    is_default: bool = False
    not_checked: tuple[str, ...] = ()
    values: tuple[StandardValue, ...]
    tables: tuple[StandardTable, ...] = ()
    sha256: str

    @property
    def listed(self) -> tuple[StandardValue, ...]:
        """All values, those of the tables included."""
        rows = (value for table in self.tables for value in table.values)
        return (*self.values, *rows)

    def overrule_floor(self, floor: Floor) -> Standard:
        """The profile with that floor, marked where it is not the profile's own."""
        if floor == self.floor:
            return self
        decides = self.is_by_guideline and floor == "guideline"
        return replace(
            self, floor=floor, is_by_guideline=decides, is_floor_overruled=True
        )

    @property
    def assumed(self) -> tuple[StandardValue, ...]:
        """The values that the user must confirm in a copy of the standard."""
        return tuple(value for value in self.listed if value.status == "assumed")

    def find(self, value_id: str) -> StandardValue | None:
        """Value of that id, or None if the profile has none."""
        return next((v for v in self.values if v.id == value_id), None)

    def find_table(self, table_id: str) -> StandardTable | None:
        """Table of that id, or None if the profile has none."""
        return next((t for t in self.tables if t.id == table_id), None)

    def find_resistance_factor(self, mode: str, basis: str) -> StandardValue | None:
        """Factor of a mode on that basis, else of the mode, else None."""
        return self.find(f"resistance.{mode}.{basis}") or self.find(
            f"resistance.{mode}"
        )


def list_standards() -> tuple[str, ...]:
    """Ids of the profiles that come with the program, in alphabetical order."""
    folder = find_resource("standards")
    return tuple(sorted(path.parent.name for path in folder.glob("*/document.toml")))


def load_standard(id_or_path: str | Path) -> Standard:
    """Read and check one limit profile.

    Parameters
    ----------
    id_or_path : str or Path
        Id of a profile that comes with the program, or a profile's folder.

    Returns
    -------
    Standard
        Values as printed, each with its unit and source.

    Raises
    ------
    StandardError
        If there is no such profile, or its files are not as they must be.
    """
    if str(id_or_path) in list_standards():
        return _load_own(str(id_or_path))
    if is_there(Path(id_or_path)) and Path(id_or_path).is_dir():
        return _load_folder(Path(id_or_path))
    raise StandardError(_explain_unknown(str(id_or_path)))


@cache
def _load_own(name: str) -> Standard:
    """Profile that comes with the program; read once."""
    return _load_folder(find_resource("standards") / name)


_DEFAULT = "nf-p-95-304-style"


def load_default() -> Standard:
    """Limit profile of a site that names none."""
    return replace(load_standard(_DEFAULT), is_default=True)


def _explain_unknown(wanted: str) -> Message:
    names = list_standards()
    near = tuple(difflib.get_close_matches(wanted.lower(), names, n=3, cutoff=0.5))
    guess = say("standard.did_you_mean", near=near) if near else ""
    return say("standard.unknown", wanted=wanted, guess=guess, known=names)


def _load_folder(folder: Path) -> Standard:
    contents = _read_files(folder)

    def read(shape: type[FileT], name: str) -> FileT:
        return check_table(shape, *_parse(contents, name, folder))

    document = read(DocumentFile, "document.toml")
    choice: ChoiceEntry | None = None
    limits = read(LimitsFile, "limits.toml")
    factors = read(FactorsFile, "factors.toml").factor
    if document.choice and "choices.toml" not in contents:
        raise StandardError(
            say("standard.lacks_choices", folder=str(folder), choice=document.choice)
        )
    if "choices.toml" in contents:
        choices = read(ChoicesFile, "choices.toml")
        choice = _find_choice(document.choice, choices, folder)
        factors = _take_from_choice(factors, choice.factor, choice.without)
    entries: list[Entry] = [*limits.limit, *factors]
    if "model.toml" in contents:
        entries += read(ModelFile, "model.toml").value
    tables = read(TablesFile, "tables.toml").table if "tables.toml" in contents else []
    if choice is not None:
        tables = _take_from_choice(tables, choice.table)
    return Standard(
        **document.model_dump(exclude={"load", "scope", "anchors"}),
        choice_text=choice.text if choice else "",
        **_read_load(document.load, folder),
        shared_sum=document.anchors.sum,
        not_checked=tuple(
            topic
            for topic, said in document.scope.model_dump().items()
            if said == "not checked"
        ),
        values=tuple(StandardValue(**entry.model_dump()) for entry in entries),
        tables=tuple(
            StandardTable(
                **table.model_dump(exclude={"rows", "unit"}),
                rows=tuple((row.from_, row.to, row.value) for row in table.rows),
            )
            for table in tables
        ),
        sha256=_hash(contents),
    )


def _read_load(load: LoadTable, folder: Path) -> dict[str, Any]:
    """Which load governs, as a profile says it."""
    if (load.floor, load.governs) == ("none", "guideline"):
        raise StandardError(say("standard.nothing_governs", folder=str(folder)))
    return {
        "floor": load.floor,
        "has_maker_floor": load.maker == "floor",
        "is_by_guideline": load.governs == "guideline",
    }


def _find_choice(name: str, choices: ChoicesFile, folder: Path) -> ChoiceEntry:
    options = {choice.name: choice for choice in choices.choice}
    if name not in options:
        raise StandardError(
            say(
                "standard.unknown_choice",
                file=str(folder / "document.toml"),
                choice=name,
                known=tuple(options),
            )
        )
    return options[name]


def _take_from_choice(
    entries: list[EntryT], chosen: list[EntryT], without: Sequence[str] = ()
) -> list[EntryT]:
    """Entries with those of the chosen set in place of their namesakes."""
    replaced = {entry.id for entry in chosen} | set(without)
    kept: list[EntryT] = [entry for entry in entries if entry.id not in replaced]
    kept.extend(chosen)
    return kept


def _read_files(folder: Path) -> dict[str, bytes]:
    """Files of the folder by name, with line ends as on Unix."""
    try:
        _require_known_files(folder)
        return {
            path.name: _read_unix(path)
            for path in sorted(folder.iterdir())
            if path.is_file() and path.suffix in _HASHED_SUFFIXES
        }
    except (OSError, ValueError) as error:
        raise StandardError(
            say("standard.unreadable", folder=str(folder), cause=explain(error))
        ) from error


def _require_known_files(folder: Path) -> None:
    missing = [name for name in _FILES if not (folder / name).is_file()]
    if missing:
        raise StandardError(
            say(
                "standard.lacks_files",
                folder=str(folder),
                missing=tuple(missing),
                needed=_FILES,
            )
        )
    accepted = (*_FILES, *_OPTIONAL)
    foreign = [p.name for p in folder.glob("*.toml") if p.name not in accepted]
    if foreign:
        raise StandardError(
            say(
                "standard.foreign_files",
                folder=str(folder),
                foreign=tuple(sorted(foreign)),
                accepted=accepted,
            )
        )


def _read_unix(path: Path) -> bytes:
    """Content with line ends as on Unix."""
    content = read_bounded(path, MAX_TOML_BYTES)
    return content.replace(b"\r\n", b"\n").replace(b"\r", b"\n")


def _parse(
    contents: dict[str, bytes], name: str, folder: Path
) -> tuple[dict[str, object], str]:
    """Table of one TOML file and its name for messages."""
    label = str(folder / name)
    try:
        return parse_toml(contents[name]), label
    except ValueError as error:
        raise StandardError(
            say("standard.no_toml", file=label, cause=explain(error))
        ) from error


def _hash(contents: dict[str, bytes]) -> str:
    """SHA-256 over names, sizes and contents, in the order of the names."""
    digest = hashlib.sha256()
    for name in sorted(contents):
        digest.update(f"{name}\n{len(contents[name])}\n".encode())
        digest.update(contents[name])
    return digest.hexdigest()
