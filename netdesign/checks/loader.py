"""Reads a profile folder into a frozen ``Standard``."""

from __future__ import annotations

import difflib
import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from typing import TypeVar

from netdesign.checks.schema import (
    ChoicesFile,
    ChoiceTable,
    DocumentFile,
    FactorsFile,
    FileT,
    Floor,
    LimitsFile,
    ModelFile,
    SharedSum,
    StandardTable,
    StandardValue,
    TablesFile,
    check_table,
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
from netdesign.words.message import Message, say

EntryT = TypeVar("EntryT", StandardValue, StandardTable)

_FILES = ("document.toml", "limits.toml", "factors.toml")
_ACCEPTED = (*_FILES, "model.toml", "tables.toml", "choices.toml")
_HASHED_SUFFIXES = (".toml", ".md")


@dataclass(frozen=True, kw_only=True)
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

    def find(self, value_id: str) -> StandardValue | None:
        """Value of that id, or None if the profile has none."""
        return self._by_id.get(value_id)

    @cached_property
    def _by_id(self) -> Mapping[str, StandardValue]:
        return {value.id: value for value in self.values}

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
    own = str(id_or_path).casefold()
    if own in list_standards():
        return _load_own(own)
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
    limits = read(LimitsFile, "limits.toml")
    factors = read(FactorsFile, "factors.toml").factor
    model = read(ModelFile, "model.toml").value if "model.toml" in contents else []
    tables = read(TablesFile, "tables.toml").table if "tables.toml" in contents else []
    choice_text = ""
    if "choices.toml" in contents:
        choice = _find_choice(document, read(ChoicesFile, "choices.toml"), folder)
        factors = _take_from_choice(factors, choice.factor, choice.without)
        tables = _take_from_choice(tables, choice.table)
        choice_text = choice.text
    elif document.choice:
        raise StandardError(
            say("standard.lacks_choices", folder=str(folder), choice=document.choice)
        )
    scope = document.scope.model_dump().items()
    left_out = {"load", "scope", "anchors", "language", "transcribed_by", "checked_by"}
    return Standard(
        **document.model_dump(exclude=left_out),
        choice_text=choice_text,
        floor=document.load.floor,
        has_maker_floor=document.load.maker == "floor",
        is_by_guideline=document.load.governs == "guideline",
        shared_sum=document.anchors.sum,
        not_checked=tuple(topic for topic, said in scope if said == "not checked"),
        values=(*limits.limit, *factors, *model),
        tables=tuple(tables),
        sha256=_hash(contents),
    )


def _find_choice(
    document: DocumentFile, choices: ChoicesFile, folder: Path
) -> ChoiceTable:
    options = {choice.name: choice for choice in choices.choice}
    if document.choice not in options:
        file, choice = str(folder / "document.toml"), document.choice
        key, known = "standard.unknown_choice", tuple(options)
        raise StandardError(say(key, file=file, choice=choice, known=known))
    return options[document.choice]


def _take_from_choice(
    entries: list[EntryT], chosen: list[EntryT], without: Sequence[str] = ()
) -> list[EntryT]:
    """Entries with those of the chosen set in place of their namesakes."""
    replaced = {entry.id for entry in chosen} | set(without)
    kept = [entry for entry in entries if entry.id not in replaced]
    return kept + chosen


def _read_files(folder: Path) -> dict[str, bytes]:
    """Files of the folder by name, with line ends as on Unix."""
    try:
        paths = [path for path in sorted(folder.iterdir()) if path.is_file()]
        named = [path.name for path in paths if path.suffix == ".toml"]
        missing = tuple(name for name in _FILES if name not in named)
        foreign = tuple(name for name in named if name not in _ACCEPTED)
        if missing or foreign:
            key = "standard.lacks_files" if missing else "standard.foreign_files"
            wrong = {"names": missing or foreign}
            wrong["accepted"] = _FILES if missing else _ACCEPTED
            raise StandardError(say(key, folder=str(folder), **wrong))
        return {
            path.name: read_bounded(path, MAX_TOML_BYTES)
            .replace(b"\r\n", b"\n")
            .replace(b"\r", b"\n")
            for path in paths
            if path.suffix in _HASHED_SUFFIXES
        }
    except (OSError, ValueError) as error:
        raise StandardError(
            say("standard.unreadable", folder=str(folder), cause=explain(error))
        ) from error


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
