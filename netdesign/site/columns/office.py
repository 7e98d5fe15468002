"""The input workbook that ``init`` writes: its sheets and columns, `office.toml`.

A column takes units, bounds, words and usual numbers from the quantity of
`all_tables` that it stands for. The reader joins its lines to lines of quantities.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product

from netdesign.site.columns.all_tables import (
    SHEETS,
    Data,
    build_field,
    list_names,
    load_file,
)
from netdesign.site.columns.fields import (
    Field,
    SheetPlan,
    normalise,
    split_heading,
)
from netdesign.words.catalogue import LANGUAGES, Language, render
from netdesign.words.message import say

# Keys of a column that only the template needs.
_PLAIN = ("need", "has", "choice", "group", "assumed", "said", "width")
_TEXTS = ("why", "note", "divided")
PROJECT_HEADS = ("item", "value", "unit", "empty", "source", "has", "meaning")


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """A column as the template shows it.

    Attributes
    ----------
    field : Field
        What its cells hold.
    need : str
        ``yes``, ``row`` (a check is not proven without it) or empty.
    has : str
        Who has it: ``office``, ``survey``, ``supplier`` or ``ground``.
    like : str
        Column of `all_tables` that it stands for, as ``Nets.slack``; empty of none.
    was : sequence of str
        Columns of version 0.1 from which it is rewritten, the first that is filled.
    unit, choice : str
        Unit that is shown; of several measures the name of their list.
    group : str
        Heading above the headings.
    assumed : sequence of float or str
        What is assumed of an empty cell: one value, or both ends of a range.
    said : str
        What is said of an empty cell instead.
    width : float
        Of the column; 0 where its heading decides.
    texts : mapping of str to mapping of str to str
        ``why``, ``note``, ``divided`` by language.
    measured : mapping of str to str
        Column of `all_tables` that its number is, by what its unit cell says.
    """

    field: Field
    need: str = ""
    has: str = ""
    like: str = ""
    was: Sequence[str] = ()
    unit: str = ""
    choice: str = ""
    group: str = ""
    assumed: Sequence[float | str] = ()
    said: str = ""
    width: float = 0.0
    texts: Mapping[str, Mapping[Language, str]]
    measured: Mapping[str, str]

    @property
    def is_percent(self) -> bool:
        """The template shows its shares in percent."""
        is_shown = self.unit == "%" or self.choice == "sag_unit"
        return is_shown and self.field.unit == "-"

    def show(self, number: float) -> float:
        """Number of the field's first unit, as the template shows it."""
        return round(100.0 * number, 8) if self.is_percent else number


@cache
def load_columns(table: str) -> tuple[Column, ...]:
    """Columns of a sheet or block, in the order of the template."""
    data = load_file("office")
    quantities = data["sheets"][table]["of"]
    return tuple(_read_column(table, key, quantities) for key in data[table])


def _read_column(table: str, key: str, quantities: str) -> Column:
    own = load_file("office")[table][key]
    stands_for = own.get("like", f"{quantities}.{key}")
    place, _, name = stands_for.rpartition(".")
    like = load_file("columns").get(place, {}).get(name, {})
    shown = {"like", "was", "measured", "unit", *_PLAIN, *_TEXTS}
    entry = like | {
        attribute: own[attribute] for attribute in own if attribute not in shown
    }
    field = build_field(table, key, entry | {"required": own.get("need") == "yes"})
    return Column(
        field=field,
        like=stands_for,
        was=own.get("was", (stands_for,)),
        unit=own.get("unit", field.unit),
        texts={text: own.get(text, {}) for text in _TEXTS},
        measured=own.get("measured", {}),
        **{attribute: own[attribute] for attribute in _PLAIN if attribute in own},
    )


@cache
def load_plan(table: str) -> SheetPlan:
    """Plan of a sheet, or of a block of sheet Parts."""
    sheet = load_file("office")["sheets"][table].get("sheet", table)
    fields = tuple(column.field for column in load_columns(table))
    names = list_names(f"sheet.{sheet}")
    if table == "project":
        heads = tuple(
            build_field("project_heads", key, {"kind": "text"}) for key in PROJECT_HEADS
        )
        return SheetPlan(name=table, fields=heads, names=names, items=fields)
    is_needed = table in ("rows", "net_types")
    return SheetPlan(name=table, fields=fields, names=names, required=is_needed)


def is_heading(text: str) -> bool:
    """A text is a heading of some sheet."""
    return split_heading(text)[0] in _list_headings()


@cache
def _list_headings() -> frozenset[str]:
    plans = (*SHEETS, *map(load_plan, TABLES))
    fields = (field for plan in plans for field in plan.fields)
    return frozenset(name for field in fields for name in field.names)


PARTS = ("ropes", "posts", "links", "soils")  # blocks of sheet Parts
TABLES: tuple[str, ...] = tuple(load_file("office")["sheets"])


def load_text(key: str, language: Language, area: str = "text") -> str:
    """Text of the template."""
    text: str = load_file("office")[area][key][language]
    return text


@cache
def list_texts(*keys: str) -> frozenset[str]:
    """Texts in all languages, normalised."""
    texts: Data = load_file("office")["text"]
    return frozenset(
        normalise(texts[key][language]) for key in keys for language in LANGUAGES
    )


# Units in which an office's own list may have what is shown in metres.
_UNITS_BESIDE = {"m": ("m", "cm", "mm")}


@cache
def list_choices() -> Mapping[str, tuple[str, str]]:
    """Unit and measure by the normalised text of a unit cell: "m vertical"."""
    choices: dict[str, tuple[str, str]] = {}
    for choice, language in product(load_file("office")["choices"], LANGUAGES):
        for measure in list_measures(choice):
            text = name_measure(choice, measure, language)
            first, _, word = text.partition(" ")
            for unit in _UNITS_BESIDE.get(first, (first,)):
                choices[normalise(f"{unit} {word}")] = (unit, measure)
    return choices


def name_measure(choice: str, measure: str, language: Language) -> str:
    """Unit cell of a measure in a language."""
    return render(say(f"choice.{choice}.{measure}"), language)


def list_measures(choice: str) -> Sequence[str]:
    """Measures of one quantity, from which a unit cell chooses."""
    measures: Sequence[str] = load_file("office")["choices"][choice]
    return measures
