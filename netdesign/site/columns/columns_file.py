"""Reads ``columns.toml``: what the sheets are, and what a column of them is."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import fields
from functools import lru_cache
from importlib.resources import files
from typing import Any, get_args

from netdesign.site.columns.fields import (
    LANGUAGES,
    Beside,
    Empty,
    Field,
    Kind,
    SheetPlan,
    Usual,
)
from netdesign.site.columns.languages import list_wordings
from netdesign.site.columns.synonyms import (
    find_headings_of,
    find_sheet_names,
    find_unclear_of,
    find_words_of,
)
from netdesign.words.catalogue import render
from netdesign.words.message import say

Data = Mapping[str, Any]

# What else a field has stands in other files, or is where its table stands.
_ELSEWHERE = {"key", "table", "wordings", "named", "synonyms", "further_words"}
_KEYS = {one.name for one in fields(Field)} - _ELSEWHERE
_OF_COLUMN = {"units", "bounds", "usual", "zero_says_none"}  # a range has them too
_SHEET_KEYS = {"required", "one_of", "items"}


@lru_cache(maxsize=1)
def load_data() -> Data:
    """Load the file as it is."""
    file = files(__package__).joinpath("columns.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def read_plan(data: Data, name: str) -> SheetPlan:
    """Sheet with its columns, also those that the template does not offer.

    Raises
    ------
    ValueError
        If the file has a key that is not known, or a name of what it does not hold.
    """
    entry = data["sheets"][name]
    _require_known(entry, _SHEET_KEYS, f"sheets.{name}")
    for key in entry.get("one_of", ()):
        _find(data[name], key, f"sheets.{name}")
    title = say(f"sheet.{name}")
    return SheetPlan(
        name=name,
        aliases=find_sheet_names(name),
        fields=read_fields(data, name),
        required=entry.get("required", False),
        one_of=tuple(entry.get("one_of", ())),
        unclear=find_unclear_of(name),
        names={one: render(title, one) for one in LANGUAGES if one != "en"},
        items=read_fields(data, entry["items"]) if "items" in entry else (),
    )


def read_fields(data: Data, table: str) -> tuple[Field, ...]:
    """Columns of a sheet, or what its lines may name, in the order of the file."""
    return tuple(_read_field(data, table, key) for key in data[table])


def _read_field(data: Data, table: str, key: str) -> Field:
    entry = data[table][key]
    place = f"{table}.{key}"
    _require_known(entry, _KEYS, place)
    if "column" in entry:
        column = _find(data["Nets"], entry["column"], place)
        entry = {**{one: column[one] for one in _OF_COLUMN & column.keys()}, **entry}
    if entry.get("kind", "number") not in get_args(Kind):
        raise ValueError(f"{place}: no kind {entry['kind']}")
    for other in _list_others(entry):
        _find(data[table], other, place)
    if "refers_to" in entry:
        _find(data["sheets"], entry["refers_to"], place)
    values = {one: _read_value(one, entry[one], place) for one in entry}
    if "units" in entry:
        values["units"] = tuple(_find(data["units"], entry["units"], place))
    if "empty" in entry:
        values["empty"] = Empty(**_find(data["empty"], entry["empty"], place))
    return Field(
        key=key,
        table=table,
        wordings=list_wordings(table, key, say(f"column.{place}")),
        synonyms=find_headings_of(table, key),
        further_words=find_words_of(key) if "words" in entry else {},
        **values,
    )


def _list_others(entry: Data) -> list[str]:
    """Other columns of the sheet that a column names."""
    beside = [key for *_, powers in entry.get("beside", ()) for key in powers]
    alternative = [entry["alternative_to"]] if "alternative_to" in entry else []
    return [*entry.get("instead", ()), *beside, *alternative]


def _find(entries: Data, name: str, place: str) -> Any:
    if name not in entries:
        raise ValueError(f"{place}: no {name} among {', '.join(entries)}")
    return entries[name]


def _require_known(entry: Data, known: set[str], place: str) -> None:
    if unknown := entry.keys() - known:
        raise ValueError(f"{place}: unknown {', '.join(sorted(unknown))}")


def _read_value(key: str, value: Any, place: str) -> Any:
    reader = _READ.get(key)
    try:
        return reader(value) if reader else value
    except ValueError as error:
        raise ValueError(f"{place}: {key} {error}") from None


def _read_span(value: list[float]) -> tuple[float, float]:
    low, high = map(float, value)
    if low > high:
        raise ValueError(f"from {low} down to {high}")
    return low, high


def _read_usual(value: list[Any]) -> Usual:
    *span, source = value
    return Usual(*_read_span(span), source)


def _read_beside(values: list[Any]) -> tuple[Beside, ...]:
    return tuple(Beside(*_read_span(span), powers) for *span, powers in values)


# Reader of a key's value, where it is not taken as it is.
_READ: Mapping[str, Any] = {
    "bounds": _read_span,
    "usual": _read_usual,
    "beside": _read_beside,
    "default": float,
    **dict.fromkeys(("words", "instead", "of_product"), tuple),
}
