"""The site workbook as one table: sheets, headings, units, bounds, defaults.

What a column is: ``columns.toml``. Names of sheets and columns, and words of cells,
stand in ``netdesign/words``; notes on headings in ``words/``. How offices write them
stands in ``headings/``; a test says where one heading would stand for two fields.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import fields, replace
from functools import lru_cache
from importlib.resources import files
from typing import Any, get_args

from netdesign.site.columns.fields import (
    Field,
    Kind,
    SheetPlan,
    Usual,
    name_word,
    split_heading,
)
from netdesign.words.catalogue import LANGUAGES, Language, render
from netdesign.words.message import say

Data = Mapping[str, Any]

READ_LANGUAGES = (*LANGUAGES, "it")  # Italian is read, though not spoken

# What else a field has stands in other files, or is where its table stands.
_ELSEWHERE = {"key", "table", "headings", "notes", "spellings", "named"}
_KEYS = {one.name for one in fields(Field)} - _ELSEWHERE
_OF_COLUMN = {"units", "bounds", "usual", "zero_says_none"}  # a range has them too
_SHEET_KEYS = {"required", "one_of", "items", "site_wide"}


@lru_cache
def load_file(name: str) -> Data:
    """Tables of ``columns``, ``signs``, ``words/LANGUAGE`` or ``headings/LANGUAGE``."""
    file = files(__package__).joinpath(f"{name}.toml")
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
    for key in (*entry.get("one_of", ()), *entry.get("site_wide", ())):
        _find(data[name], key, f"sheets.{name}")
    return SheetPlan(
        name=name,
        fields=read_fields(data, name),
        required=entry.get("required", False),
        one_of=tuple(entry.get("one_of", ())),
        site_wide=tuple(entry.get("site_wide", ())),
        unclear=_list_unclear(name),
        names=_list_names(f"sheet.{name}", "sheets", name),
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
        values["empty"] = _find(data["empty"], entry["empty"], place)
    return Field(
        key=key,
        table=table,
        headings=_list_names(f"column.{place}", table, key),
        notes={
            one: load_file(f"words/{one}").get(table, {}).get(key, "")
            for one in LANGUAGES
        },
        spellings=_list_spellings(key, entry.get("words", ())),
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


def _read_beside(values: list[Any]) -> tuple[Usual, ...]:
    return tuple(Usual(*_read_span(span), powers=powers) for *span, powers in values)


# Reader of a key's value, where it is not taken as it is.
_READ: Mapping[str, Any] = {
    "bounds": _read_span,
    "usual": _read_usual,
    "beside": _read_beside,
    "default": float,
    **dict.fromkeys(("words", "instead", "of_product"), tuple),
}


def load_text(language: Language) -> Mapping[str, str]:
    """General texts of the workbook."""
    texts: Mapping[str, str] = load_file(f"words/{language}")["text"]
    return texts


def _list_names(name: str, table: str, key: str) -> dict[str, tuple[str, ...]]:
    """Headings of a field, or names of a sheet, by language: that of the key first."""
    names: dict[str, tuple[str, ...]] = {}
    for language in READ_LANGUAGES:
        own = (render(say(name), one) for one in LANGUAGES if one == language)
        names[language] = (*own, *_load_headings(language).get(table, {}).get(key, ()))
    return names


def _list_spellings(key: str, words: Iterable[str]) -> dict[str, str]:
    """Word of a field by each of its spellings."""
    found = {word: word for word in words}
    for word in words:
        found |= {render(name_word(key, word), one): word for one in LANGUAGES}
    for language in READ_LANGUAGES:
        for word, names in _load_headings(language)["words"].get(key, {}).items():
            found |= dict.fromkeys(names, word)
    return found


def _list_unclear(sheet: str) -> Mapping[str, tuple[str, ...]]:
    """Headings that may mean several fields of a sheet, with the keys of these."""
    found: dict[str, tuple[str, ...]] = {}
    for language in READ_LANGUAGES:
        for key, names in _load_headings(language)["unclear"].get(sheet, {}).items():
            for name in names:
                found[name] = (*found.get(name, ()), key)
    return found


def _load_headings(language: str) -> Data:
    return load_file(f"headings/{language}")


NETS = read_plan(load_file("columns"), "Nets")
PROJECT = read_plan(load_file("columns"), "Project")
# As offices type it, also with what holds for all net rows; the template does not offer
# that.
PROJECT_AS_TYPED = replace(PROJECT, items=(*PROJECT.items, *NETS.list_site_wide()))
# As offices type it, also with both ends in one cell; the template does not offer that.
RANGES_AS_TYPED = read_plan(load_file("columns"), "Ranges")
RANGES = replace(
    RANGES_AS_TYPED,
    fields=tuple(one for one in RANGES_AS_TYPED.fields if one.is_offered),
)
# Layers by net row, one a line; a row without lines here is of uniform snow.
SNOW = read_plan(load_file("columns"), "Snow")
# The keys of the resistances are the modes of `model.MEMBER_MODES`.
ANCHORS = read_plan(load_file("columns"), "Anchors")
ROPES = read_plan(load_file("columns"), "Ropes")
POSTS = read_plan(load_file("columns"), "Posts")
# Single pull-out tests, one a line; they count for their type in their ground.
TESTS = read_plan(load_file("columns"), "Tests")
# Links between ropes and anchors, one a line; a chain by type.
LINKS = read_plan(load_file("columns"), "Links")
# Types of the first and last support of a row, where they are not those of the others.
ENDS = read_plan(load_file("columns"), "Ends")
# Measurements, one a line, to stand beside a history; nothing is checked with them.
MONITORING = read_plan(load_file("columns"), "Monitoring")
# Checks that somebody has proven elsewhere, one a line.
DECLARED = read_plan(load_file("columns"), "Declared")
# A station's snow heights, one day a line.
WINTER = read_plan(load_file("columns"), "Winter")

SHEETS: tuple[SheetPlan, ...] = (
    *(PROJECT, NETS, RANGES, SNOW, ANCHORS, ROPES, POSTS, TESTS, LINKS, ENDS),
    *(MONITORING, DECLARED, WINTER),
)
PROJECT_ITEMS = PROJECT.items
RANGE_QUANTITIES = RANGES.items
# What else may range: then no line of sheet Nets gives it. Keys are those of
# `envelope.parameters.PARAMETERS`.
FURTHER_QUANTITIES: tuple[Field, ...] = tuple(
    one for one in RANGE_QUANTITIES if one.column
)
USUAL_QUANTITIES: tuple[Field, ...] = tuple(
    one for one in RANGE_QUANTITIES if not one.column
)
# The sheet that an annotated copy lists its findings on, by language.
FINDINGS_SHEETS: Mapping[Language, str] = {
    language: render(say("annotated.findings_sheet"), language)
    for language in LANGUAGES
}
# Sheets of the program's own that hold nothing to read.
QUIET_SHEETS: tuple[str, ...] = (
    *("Notes", "Notice", "Hinweise"),
    *FINDINGS_SHEETS.values(),
)


def is_heading(text: str) -> bool:
    """A text is a heading of some sheet."""
    return split_heading(text)[0] in _known_headings()


@lru_cache(maxsize=1)
def _known_headings() -> frozenset[str]:
    fields = (field for plan in SHEETS for field in plan.fields)
    return frozenset(name for field in fields for name in field.names)
