"""The quantities of a site as one table: their units, bounds, words, what is usual.

``columns.toml`` says what each quantity is. The input workbook (`office`) takes its
columns from there; sheets of add-ons are read as they stand there. Names of sheets and
columns, and words of cells, stand in ``netdesign/words``. Spellings of headings in
offices stand in ``headings/``, for guesses of ``netdesign map``. A heading is
recognised by its whole name, in which case, accents and punctuation do not count.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from functools import lru_cache
from importlib.resources import files
from typing import Any

from netdesign.site.columns.fields import (
    Field,
    SheetPlan,
    Usual,
    name_word,
    normalise,
)
from netdesign.words.catalogue import LANGUAGES, render
from netdesign.words.message import say

Data = Mapping[str, Any]

READ_LANGUAGES = (*LANGUAGES, "it")  # Italian is read, though not spoken


@lru_cache
def load_file(name: str) -> Data:
    """Tables of a file of this folder: ``columns``, ``headings/en`` and others."""
    file = files(__package__).joinpath(f"{name}.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def _read_plan(name: str) -> SheetPlan:
    """Sheet with its columns, of an add-on or of a workbook of version 0.1."""
    entry = dict(load_file("columns")["sheets"][name])
    items = entry.pop("items", "")
    return SheetPlan(
        name=name,
        fields=_read_fields(name),
        names=list_names(f"sheet.{name}", "sheets", name),
        items=_read_fields(items) if items else (),
        **{key: _freeze(value) for key, value in entry.items()},
    )


def _read_fields(table: str) -> tuple[Field, ...]:
    """Columns of a sheet, or what its lines may name, in the order of the file."""
    entries: Data = load_file("columns")[table]
    return tuple(build_field(table, key, entry) for key, entry in entries.items())


def build_field(table: str, key: str, entry: Data) -> Field:
    """Field of a column by its entry in a file of columns.

    Parameters
    ----------
    table, key : str
        Sheet or list, and name in it.
    entry : mapping
        Its keys, as the file says.
    """
    values = {name: _READ.get(name, _freeze)(value) for name, value in entry.items()}
    return Field(
        key=key,
        table=table,
        headings=list_names(f"column.{table}.{key}", table, key),
        spellings=_list_spellings(key, entry.get("words", ())),
        **values,
    )


def _freeze(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value


# Reader of a key's value, where it is not taken as it is.
_READ: Mapping[str, Any] = {
    "units": lambda name: tuple(load_file("columns")["units"][name]),
    "bounds": lambda span: tuple(map(float, span)),
    "usual": lambda usual: Usual(float(usual[0]), float(usual[1]), usual[2]),
    "beside": lambda values: tuple(
        Usual(float(low), float(high), powers=powers) for low, high, powers in values
    ),
}


def list_names(name: str, table: str = "", key: str = "") -> dict[str, tuple[str, ...]]:
    """Headings of a field, or names of a sheet, by language: that of the key first."""
    names: dict[str, tuple[str, ...]] = {}
    for language in READ_LANGUAGES:
        own = (render(say(name), spoken) for spoken in LANGUAGES if spoken == language)
        names[language] = (*own, *_load_headings(language).get(table, {}).get(key, ()))
    return names


def _list_spellings(key: str, words: Iterable[str]) -> dict[str, str]:
    """Word of a field by each of its spellings."""
    spellings = {word: word for word in words}
    for word in words:
        spellings |= {
            render(name_word(key, word), language): word for language in LANGUAGES
        }
    for language in READ_LANGUAGES:
        for word, names in _load_headings(language)["words"].get(key, {}).items():
            spellings |= dict.fromkeys(names, word)
    return spellings


def list_unclear(table: str) -> frozenset[str]:
    """Headings, normalised, that may mean several columns of a table."""
    by_language = (
        _load_headings(language)["unclear"].get(table, {})
        for language in READ_LANGUAGES
    )
    lists = (names for headings in by_language for names in headings.values())
    return frozenset(normalise(name) for names in lists for name in names)


def _load_headings(language: str) -> Data:
    return load_file(f"headings/{language}")


SHEETS = tuple(_read_plan(name) for name in load_file("columns")["sheets"])
_PLANS = {plan.name: plan for plan in SHEETS}
MONITORING, WINTER = _PLANS["Monitoring"], _PLANS["Winter"]
UNCERTAINTY = _PLANS["Uncertainty"]
FURTHER = (MONITORING, WINTER, UNCERTAINTY)  # sheets of add-ons


def find_quantity(sheet: str, key: str) -> Field:
    """What a number is that stands in no cell, or has another column."""
    return next(field for field in _PLANS[sheet].fields if field.key == key)


def load_old_plans() -> Mapping[str, SheetPlan]:
    """Sheets of a workbook of version 0.1, by name."""
    return _PLANS


# Sheets of the program's own that hold nothing to read.
QUIET_SHEETS = ("Notes", "Notice", "Hinweise")

# Answers to a heading: it is not to be read; it is not yet answered.
IGNORE, UNANSWERED = "ignore", "?"


def has_no_part(text: str) -> bool:
    """A heading is of a column that no check needs.

    >>> has_no_part("Remarques :"), has_no_part("Remarques N")
    (True, False)
    """
    words = load_file("heading_words")["no_part"]["words"]
    return normalise(text) in set(map(normalise, words))


def is_allowable(text: str) -> bool:
    """A heading speaks of an allowable value, which is no resistance.

    >>> is_allowable("zul. Ankerkraft [kN]"), is_allowable("Ankerkraft [kN]")
    (True, False)
    """
    stems = tuple(load_file("heading_words")["allowable"]["stems"])
    return any(normalise(word).startswith(stems) for word in text.split())
