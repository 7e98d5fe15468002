"""Lists the columns that a heading of an office's own list may mean."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache

from netdesign.site.columns.all_tables import (
    IGNORE,
    UNANSWERED,
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

# Tables that a sheet of a list may become, with the sheets that its columns go to.
GROUPS: Mapping[str, tuple[str, ...]] = {
    "rows": ("rows", "net_types"),
    "net_types": ("net_types",),
    "anchor_types": ("anchor_types",),
    "tests": ("tests",),
}
# Columns of earlier workbooks whose names say what a column with a choice measures.
_MEASURED: Mapping[tuple[str, str], Mapping[str, str]] = {
    ("rows", "snow"): {"vertical": "snow_height", "normal": "snow_thickness"},
    ("net_types", "slack"): {"slack": "slack", "sag": ""},
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """A column that a heading may mean, with one of its measures.

    Attributes
    ----------
    table, key : str
        Sheet and column of the input workbook.
    measure : str
        ``vertical``, ``normal``, ``sag`` or ``slack``; empty of any other column.
    choice : str
        List that the measure is of.
    field : Field
        Of the column, with the names that it had in earlier workbooks, too.
    """

    table: str
    key: str
    measure: str = ""
    choice: str = ""
    field: Field

    @property
    def place(self) -> tuple[str, str]:
        """Table and key of the column."""
        return self.table, self.key

    def label(self, language: Language) -> str:
        """Name of sheet and column, as the file of answers has it."""
        sheet = load_plan(self.table).name_in(language)
        return f"{sheet}: {self.field.label_in(language)}"

    def title(self, language: Language, unit: str = "") -> str:
        """Label with the measure in brackets, in a unit of the list."""
        label = self.label(language)
        return f"{label} [{self.measure_in(language, unit)}]" if self.measure else label

    def measure_in(self, language: Language, unit: str = "") -> str:
        """Measure with its unit, in a language: "cm vertical"."""
        shown = name_measure(self.choice, self.measure, language)
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

    A row names its net type: its list has no other column for that.
    """
    return tuple(
        target
        for table in GROUPS[becomes]
        for column in load_columns(table)
        if (becomes, table, column.field.key) != ("rows", "net_types", "id")
        for target in _split(table, column)
    )


def _split(table: str, column: Column) -> Iterator[Target]:
    """Target of a column; a column with several measures has a target for each."""
    key = column.field.key
    if not column.choice:
        field = _add_names(column.field, _find_old(*column.like.rsplit(".", 1)))
        field = _add_symbol(field) if (table, key) in _SYMBOLS else field
        yield Target(table=table, key=key, field=field)
        return
    for measure in list_measures(column.choice):
        of_old = _MEASURED.get((table, key), {})
        old = _find_old("Nets", of_old.get(measure, ""))
        field = _add_names(column.field, old)
        # a name that says nothing of the measure is that of both
        named = replace(field, key=f"{key}.{measure}")
        choice = column.choice
        yield Target(table=table, key=key, measure=measure, choice=choice, field=named)


# Columns whose symbol, the last word of their name, stands for nothing else.
_SYMBOLS = (
    *(("rows", key) for key in ("slope_angle", "glide_factor", "upslope_length")),
    ("net_types", "net_height"),
)


def _add_symbol(field: Field) -> Field:
    """Field that is known by its symbol, too: N of "glide factor N"."""
    symbol = field.label_in("en").split()[-1]
    named = {language: (*names, symbol) for language, names in field.headings.items()}
    return replace(field, headings=named)


def _find_old(sheet: str, key: str) -> Field | None:
    plan = load_old_plans().get(sheet)
    fields = plan.fields if plan else ()
    return next((field for field in fields if field.key == key), None)


def _add_names(field: Field, old: Field | None) -> Field:
    """Field that is known by the names of an earlier field, too."""
    if old is None:
        return field
    names = {
        language: tuple(dict.fromkeys((*field.headings.get(language, ()), *old_names)))
        for language, old_names in old.headings.items()
    }
    return replace(field, headings={**field.headings, **names})


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
