"""Lists the columns that a heading of an office's own list may mean."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache

from netdesign.site.columns.all_tables import (
    IGNORE,
    UNANSWERED,
    find_quantity,
    load_old_plans,
)
from netdesign.site.columns.fields import Field, normalise, normalise_unit
from netdesign.site.columns.office import (
    Column,
    list_measures,
    load_columns,
    load_plan,
    name_measure,
)
from netdesign.words.catalogue import LANGUAGES, Language
from netdesign.words.message import say

# Tables that a sheet of a list may become, with the sheets that its columns go to.
GROUPS: Mapping[str, tuple[str, ...]] = {
    "rows": ("rows", "net_types"),
    "net_types": ("net_types",),
    "anchor_types": ("anchor_types",),
    "tests": ("tests",),
}
# Columns whose symbol, the last word of their name, stands for nothing else.
_SYMBOLS = (
    *("rows.slope_angle", "rows.glide_factor", "rows.upslope_length"),
    "net_types.net_height",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """A column that a heading may mean, with one of its measures.

    Attributes
    ----------
    column : Column
        Of the input workbook.
    field : Field
        Of the column, with the names that it had in earlier workbooks, too.
    measure : str
        ``vertical``, ``normal``, ``sag`` or ``slack``; empty of any other column.
    """

    column: Column
    field: Field
    measure: str = ""

    @property
    def name(self) -> str:
        """Key of the column, with its measure: ``snow.vertical``."""
        return f"{self.field.key}.{self.measure}".rstrip(".")

    def label(self, language: Language) -> str:
        """Name of sheet and column, as the file of answers has it."""
        sheet = load_plan(self.field.table).name_in(language)
        return f"{sheet}: {self.field.label_in(language)}"

    def title(self, language: Language, unit: str = "") -> str:
        """Label with the measure in brackets, in a unit of the list."""
        label = self.label(language)
        return f"{label} [{self.measure_in(language, unit)}]" if self.measure else label

    def measure_in(self, language: Language, unit: str = "") -> str:
        """Measure with its unit, in a language: "cm vertical"."""
        shown = name_measure(self.column.choice, self.measure, language)
        first, _, word = shown.partition(" ")
        return f"{unit or first} {word}"

    def has_unit(self, unit: str) -> bool:
        """Whether a unit, or its absence, fits the numbers of the column."""
        return not unit or unit in (self.field.units or ("-",))

    def unit(self, typed: str) -> str:
        """Unit of the numbers, that of the measure where a list has none."""
        return typed or (
            self.measure_in("en").partition(" ")[0] if self.measure else ""
        )

    def heading(self, unit: str) -> str:
        """Heading of the column in the input workbook."""
        bracket = self.measure_in("en", unit) if self.measure else unit
        own = self.field.label_in("en")
        return f"{own} [{bracket}]" if bracket else own


@cache
def list_targets(becomes: str) -> tuple[Target, ...]:
    """Columns that the headings of a sheet may mean, by the table that it becomes.

    A row names its net type: its list has no other column for that. Of its length
    its posts are counted.
    """
    columns = tuple(
        Target(column=column, field=_add_names(column, measure), measure=measure)
        for table in GROUPS[becomes]
        for column in load_columns(table)
        if (becomes, table, column.field.key) != ("rows", "net_types", "id")
        for measure in (list_measures(column.choice) if column.choice else ("",))
    )
    length = find_row_length()
    of_length = Target(column=length, field=length.field)
    return (*columns, of_length) if becomes == "rows" else columns


@cache
def find_row_length() -> Column:
    """Length of a row, which lists have and the input workbook has not."""
    name = say("column.Nets.row_length")
    field = replace(find_quantity("Nets", "row_length"), table="rows", named=name)
    return Column(field=field, has="office", texts={}, measured={})


def _add_names(column: Column, measure: str) -> Field:
    """Field that is known by its names in earlier workbooks, and by its symbol.

    A name that says nothing of the measure is that of both.
    """
    own = column.field
    earlier = column.measured.get(measure, "" if measure == "sag" else column.like)
    sheet, _, key = earlier.partition(".")
    plan = load_old_plans().get(sheet)
    olds = [field for field in plan.fields if field.key == key] if plan else []
    is_known = f"{own.table}.{own.key}" in _SYMBOLS
    symbols = own.label_in("en").split()[-1:] if is_known else []
    names = {
        language: (*names, *(n for x in olds for n in x.headings[language]), *symbols)
        for language, names in own.headings.items()
    }
    return replace(own, headings=names)


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """Answer to a heading: a column, ``ignore``, or none yet.

    Attributes
    ----------
    target : Target or None
        The column; None where it is to be ignored, or is not answered.
    unit : str
        Of its numbers, where the answer gives it.
    fault : bool
        The answer names no column, or leaves its measure open.
    """

    target: Target | None = None
    unit: str = ""
    fault: bool = False


def read_answer(text: str, becomes: str) -> Answer:
    """Meaning of an answer, in any language.

    Parameters
    ----------
    text : str
        ``sheet: column [unit]``, ``ignore`` or a question mark.
    becomes : str
        Table that the sheet of the list becomes.
    """
    plain = " ".join(text.split())
    if plain.casefold() == IGNORE or is_unanswered(plain):
        return Answer()
    label, _, bracket = plain.partition("[")
    bracket = bracket.rstrip("] ")
    named = [target for target in list_targets(becomes) if _is_named(target, label)]
    for target in named:
        if not target.measure:
            return Answer(target=target, unit=normalise_unit(bracket))
        unit, _, word = bracket.partition(" ")
        words = {
            normalise(target.measure_in(language).partition(" ")[2])
            for language in LANGUAGES
        }
        if normalise(word) in words:
            return Answer(target=target, unit=normalise_unit(unit))
    return Answer(fault=True)


def is_unanswered(text: str) -> bool:
    """An answer is a question mark, has one for its unit, or is empty."""
    return UNANSWERED in text or not text.strip()


def _is_named(target: Target, label: str) -> bool:
    return any(
        normalise(target.label(language)) == normalise(label) for language in LANGUAGES
    )


def find_table(text: str) -> str | None:
    """Table that a sheet becomes, by its name in any language; "" of none."""
    if text.strip().casefold() == IGNORE:
        return ""
    return next((table for table in GROUPS if load_plan(table).matches(text)), None)
