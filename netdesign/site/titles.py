"""Headings and names of sheets: their units, what they are near to."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Literal

from netdesign.site.cells.cells import Cell, Sheet, Workbook
from netdesign.site.cells.findings import Refusal
from netdesign.site.cells.numbers import parse_number, read_grade
from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    Field,
    SheetPlan,
    normalise,
    normalise_unit,
    split_heading,
)
from netdesign.site.columns.office import list_choices
from netdesign.words.message import Message, say

# Least likeness to a missing heading or sheet that makes a name a misspelling of it.
_MISSPELT = 0.8
MARKS: dict[str, Literal["", ",", "."]] = {"": "", "comma": ",", "point": "."}


def name_map(site_file: Path) -> Path:
    """Place of the answers to a list.

    >>> name_map(Path("site.xlsx")).name
    'site.map.toml'
    """
    return site_file.with_name(f"{site_file.stem}.map.toml")


_IN_BRACKETS = re.compile(r"[\[(](.*)[\])]")


def find_heading_unit(cell: Cell) -> tuple[str, str]:
    """Unit in the brackets of a heading, and what it measures; empty without them."""
    return _split_measure(split_heading(str(cell.value))[1])


def read_unit(cell: Cell) -> tuple[str, str]:
    """Unit in a cell of its own, and what it measures: "m" and "vertical"."""
    text = str(cell.value).strip()
    bracketed = _IN_BRACKETS.fullmatch(text)
    return _split_measure(normalise_unit(bracketed[1] if bracketed else text))


def _split_measure(unit: str) -> tuple[str, str]:
    return list_choices().get(normalise(unit), (unit, ""))


def is_unit(cell: Cell, field: Field) -> bool:
    """A cell holds a unit; a 1 is a unit only where the field may have none."""
    unit, _ = read_unit(cell)
    is_known = unit in KNOWN_UNITS and (unit != "-" or unit in field.units)
    return is_known or _IN_BRACKETS.fullmatch(str(cell.value).strip()) is not None


def is_number(cell: Cell, field: Field) -> bool:
    """A cell holds a number, and no unit."""
    number = parse_number(cell.value, cell.decimal_mark)
    return not isinstance(number, Refusal) and not is_unit(cell, field)


def find_own_unit(cells: list[Cell], field: Field) -> str:
    """Unit of a column whose heading has none: of all its cells, or of their grades."""
    units = {normalise_unit(cell.own_unit) for cell in cells}
    if units and all(read_grade(cell.value) is not None for cell in cells):
        return field.unit if field.is_grade else ""
    return next(iter(units.intersection(field.units)), "") if len(units) == 1 else ""


def find_near(text: str, fields: Iterable[Field]) -> list[Field]:
    """Fields with a heading so like a text that the text may be that, misspelt."""
    names = {name: field for field in fields for name in field.names}
    own = split_heading(text)[0]
    close = difflib.get_close_matches(own, names, n=2, cutoff=_MISSPELT)
    return list({names[name].key: names[name] for name in close}.values())


def quote_title(field: Field) -> Message:
    """Heading of a field in quotes."""
    return say("finding.in_quotes", text=field.title)


def list_meant(workbook: Workbook, plan: SheetPlan) -> list[Sheet]:
    """Sheets of a workbook that are the planned one."""
    return [sheet for sheet in workbook.sheets if plan.matches(sheet.name)]


def list_near(workbook: Workbook, plan: SheetPlan) -> list[str]:
    """Names of sheets that are not read, near to the planned one's."""
    names = [normalise(name) for name in plan.raw_names]
    return [
        name
        for name in workbook.unread
        if difflib.get_close_matches(normalise(name), names, n=1, cutoff=_MISSPELT)
    ]
