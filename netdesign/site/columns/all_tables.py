"""The site workbook as one table: sheets, headings, units, bounds, defaults.

What a column is: ``columns.toml``. Names of sheets and columns, and words of cells,
stand in ``netdesign/words``; notes on headings in ``words/``. How offices write them
stands in ``headings/``; a test says where one heading would stand for two fields.
A heading is known by its whole name, in which case, accents and punctuation do not
count. Nothing is made of its words: what is no name is asked for by ``netdesign map``.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Any

from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    LONGEST_HEADING,
    Field,
    SheetPlan,
    Usual,
    name_word,
    normalise,
    split_heading,
)
from netdesign.words.catalogue import LANGUAGES, Language, render
from netdesign.words.message import say

Data = Mapping[str, Any]

READ_LANGUAGES = (*LANGUAGES, "it")  # Italian is read, though not spoken

_OF_COLUMN = ("units", "bounds", "usual", "zero_says_none")  # a range has them too


@lru_cache
def load_file(name: str) -> Data:
    """Tables of a file of this folder: ``columns``, ``words/LANGUAGE`` and others."""
    file = files(__package__).joinpath(f"{name}.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def _read_plan(name: str) -> SheetPlan:
    """Sheet with its columns, also those that the template does not offer."""
    entry = dict(load_file("columns")["sheets"][name])
    items = _read_fields(entry.pop("items")) if "items" in entry else ()
    return SheetPlan(
        name=name,
        fields=_read_fields(name),
        unclear=_list_unclear(name),
        names=list_names(f"sheet.{name}", "sheets", name),
        items=items,
        **{key: _freeze(value) for key, value in entry.items()},
    )


def _read_fields(table: str) -> tuple[Field, ...]:
    """Columns of a sheet, or what its lines may name, in the order of the file."""
    return tuple(_read_field(table, key) for key in load_file("columns")[table])


def _read_field(table: str, key: str) -> Field:
    data = load_file("columns")
    entry = data[table][key]
    if "column" in entry:
        column = data["Nets"][entry["column"]]
        entry = {**{one: column[one] for one in _OF_COLUMN if one in column}, **entry}
    return build_field(table, key, entry)


def build_field(table: str, key: str, entry: Data) -> Field:
    """Field of a column by its entry in a file of columns.

    Parameters
    ----------
    table, key : str
        Sheet or list, and name in it.
    entry : mapping
        Its keys, as the file says.
    """
    values = {one: _READ.get(one, _freeze)(value) for one, value in entry.items()}
    return Field(
        key=key,
        table=table,
        headings=list_names(f"column.{table}.{key}", table, key),
        notes={
            one: load_file(f"words/{one}").get(table, {}).get(key, "")
            for one in LANGUAGES
        },
        spellings=_list_spellings(key, entry.get("words", ())),
        **values,
    )


def _freeze(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value


# Reader of a key's value, where it is not taken as it is.
_READ: Mapping[str, Any] = {
    "units": lambda name: tuple(load_file("columns")["units"][name]),
    "empty": lambda name: load_file("columns")["empty"][name],
    "bounds": lambda span: tuple(map(float, span)),
    "usual": lambda usual: Usual(float(usual[0]), float(usual[1]), usual[2]),
    "beside": lambda values: tuple(
        Usual(float(low), float(high), powers=powers) for low, high, powers in values
    ),
}


def load_text(language: Language) -> Mapping[str, str]:
    """General texts of the workbook."""
    texts: Mapping[str, str] = load_file(f"words/{language}")["text"]
    return texts


def list_names(name: str, table: str = "", key: str = "") -> dict[str, tuple[str, ...]]:
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


_PLANS = {name: _read_plan(name) for name in load_file("columns")["sheets"]}
NETS, RANGES, SNOW = _PLANS["Nets"], _PLANS["Ranges"], _PLANS["Snow"]
# The keys of the resistances are the modes of `model.MEMBER_MODES`.
ANCHORS, ROPES, POSTS = _PLANS["Anchors"], _PLANS["Ropes"], _PLANS["Posts"]
TESTS, LINKS, ENDS = _PLANS["Tests"], _PLANS["Links"], _PLANS["Ends"]
MONITORING, DECLARED = _PLANS["Monitoring"], _PLANS["Declared"]
WINTER, UNCERTAINTY = _PLANS["Winter"], _PLANS["Uncertainty"]
PROJECT = _PLANS["Project"]
PROJECT_ITEMS = PROJECT.items
SHEETS: tuple[SheetPlan, ...] = tuple(_PLANS.values())
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


_NUMBER_SIGN = re.compile("[Nn][°º]|#")  # names the ids; a plain N is a glide factor

# Answers to a heading: it is not to be read; it is not yet answered.
IGNORE, UNANSWERED = "ignore", "?"


def has_no_part(text: str) -> bool:
    """A heading stands for what no check needs.

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


def says_sag(text: str) -> bool:
    """A heading speaks of sag, which is several times the slack.

    >>> says_sag("Flèche du filet"), says_sag("Mou")
    (True, False)
    """
    words = load_file("heading_words")["sag"]["words"]
    return any(normalise(word) in normalise(text) for word in words)


@dataclass(frozen=True, slots=True)
class Meaning:
    """Meaning of a heading, and what it follows from.

    Attributes
    ----------
    field : Field or None
        The one field that it means; None where it is unknown, unclear or ignored.
    readings : tuple of Field
        Where it is unclear, the fields that it may mean.
    answer : str
        Text of the answer to it; empty where none was needed or none is there.
    unit : str
        That of the answer; empty where it gives none.
    """

    field: Field | None = None
    readings: tuple[Field, ...] = ()
    answer: str = ""
    unit: str = ""

    @property
    def is_ignored(self) -> bool:
        """Somebody answered that it is not to be read."""
        return self.answer == IGNORE


UNKNOWN = Meaning()


@dataclass(frozen=True, slots=True)
class Lexicon:
    """Names of the fields of one sheet, or of the quantities that its lines may name.

    Attributes
    ----------
    fields : mapping of str to Field
        By key.
    names : mapping of str to str
        Key of the field by normalised heading.
    unclear : mapping of str to frozenset of str
        Keys of the fields that a normalised heading may mean; it is asked for.
    """

    fields: Mapping[str, Field]
    names: Mapping[str, str]
    unclear: Mapping[str, frozenset[str]]

    @classmethod
    def of(cls, fields: Iterable[Field], plan: SheetPlan) -> Lexicon:
        """Lexicon of some fields of a sheet, or of its items."""
        by_key = {field.key: field for field in fields}
        names = {name: key for key, one in by_key.items() for name in one.names}
        unclear = {
            normalise(heading): frozenset(keys).intersection(by_key)
            for heading, keys in plan.unclear.items()
        }
        return cls(by_key, names, unclear)

    def match(self, text: str) -> Meaning:
        """Meaning of a heading, which may have a unit in brackets behind its name."""
        typed = text.strip()
        if "id" in self.fields and _NUMBER_SIGN.fullmatch(typed):
            return Meaning(self.fields["id"])
        whole = normalise(typed) if len(typed) <= LONGEST_HEADING else ""
        if whole in self.names or whole in self.unclear:
            return self._conclude(whole)
        own, bracket = split_heading(typed)
        found = self._conclude(own)
        # Behind a number a bracket is a unit; an unknown one is told elsewhere.
        is_unit = not bracket or bracket in KNOWN_UNITS
        if found.field and not (is_unit or found.field.units):
            return Meaning(readings=(found.field,))
        return found

    def _conclude(self, name: str) -> Meaning:
        if name in self.names:
            return Meaning(self.fields[self.names[name]])
        keys = self.unclear.get(name, frozenset())
        return Meaning(
            readings=tuple(one for key, one in self.fields.items() if key in keys)
        )
