"""Sheet Project of the input workbook: what holds for the whole site.

Also the ranges of density, friction and inclination, which its rows share.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from netdesign.envelope.ranges import Interval, Ranges
from netdesign.site.assumed import Assumed, assume
from netdesign.site.cells.cells import Cell
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.fields import Field, normalise_unit
from netdesign.site.columns.office import load_plan
from netdesign.site.headings import Table
from netdesign.site.model import InputEcho, Project
from netdesign.site.readings import (
    Reading,
    Row,
    explain_unit,
    read_cell,
    read_nothing,
    refuse,
)
from netdesign.site.tables import match_item
from netdesign.words.message import say

_DOCUMENTS = ("snow_document", "glide_document", "ground_document")
SHARED = ("density", "friction_angle", "inclination")  # ranges of all rows
_TEXTS = ("name", "number", "author", "checker", "standard")


@dataclass(frozen=True, slots=True, kw_only=True)
class SiteRanges:
    """Ranges of a site, as far as they could be understood.

    Attributes
    ----------
    ranges : Ranges or None
        SI units; None where a line has a fault.
    inputs : tuple of InputEcho
        Both ends of each range, in the units of the edge.
    assumed : tuple of Assumed
        Those that have no line.
    lines : tuple of Row
        Both ends of each range, one a line.
    """

    ranges: Ranges | None = None
    inputs: tuple[InputEcho, ...] = ()
    assumed: tuple[Assumed, ...] = ()
    lines: tuple[Row, ...] = ()


def read_lines(table: Table | None, lines: list[Row], findings: list[Finding]) -> Row:
    """Lines of sheet Project by key, each read as its item asks.

    Parameters
    ----------
    table : Table or None
        The sheet; None where it is missing.
    lines : list of Row
        Its lines, as texts.
    findings : list of Finding
        Appended to: a line that is no item, or that stands twice.
    """
    by_key: dict[str, Reading] = {}
    for line in lines if table else ():
        assert table is not None
        item = line["item"]
        if not item.word:
            if table.sheet.is_delimited and line["value"].word:  # cut at a wrong place
                refuse(item, say("cell.empty"), item.field.accepted, findings)
            continue
        field = match_item(item, table.plan.items, findings)
        if field is None:
            continue
        if field.key in by_key:
            rule = say("item.twice", place=by_key[field.key].place)
            refuse(item, rule, say("item.one_line"), findings)
            continue
        cell = line["value"].cell
        by_key[field.key] = (
            read_nothing(field, None)
            if cell is None
            else _read_value(cell, field, line["unit"], findings)
        )
    items = load_plan("project").items
    return {
        field.key: by_key.get(field.key) or read_nothing(field, None) for field in items
    }


def _read_value(
    cell: Cell, field: Field, typed: Reading, findings: list[Finding]
) -> Reading:
    unit = normalise_unit(typed.word.strip(" []()")) if field.units else ""
    unit = unit or field.unit
    if unit not in field.units and field.units:
        refuse(typed, *explain_unit(unit, field), findings)
        return Reading(field=field, state="faulty", text=cell.text, cell=cell)
    return read_cell(cell, field, unit, findings)


def build_project(lines: Row) -> tuple[Project, Mapping[str, str]]:
    """Project of the site, and the cells of its lines."""
    filled_in = {
        key: lines[key] for key in (*_TEXTS, *_DOCUMENTS) if lines[key].state == "given"
    }
    values = {key: reading.word for key, reading in filled_in.items()}
    return Project(**values), {key: reading.place for key, reading in filled_in.items()}


def build_ranges(lines: Mapping[str, Reading]) -> SiteRanges:
    """Ranges of the three quantities; the assumed ones where a line is empty.

    The inputs end with the documents that snow, glide factors and ground come from.

    Parameters
    ----------
    lines : mapping of str to Reading
        Of sheet Project, by key.
    """
    readings = [lines[key] for key in SHARED]
    if any(reading.state == "faulty" for reading in readings):
        return SiteRanges()
    ends = [_split(reading) for reading in readings if reading.state == "given"]
    documents = [lines[key] for key in _DOCUMENTS if lines[key].state == "given"]
    assumed = tuple(
        assume(reading.field.key) for reading in readings if reading.state != "given"
    )
    return SiteRanges(
        ranges=Ranges.of(
            **{
                entry.key: Interval(low=entry.low, high=entry.high) for entry in assumed
            },
            **{low.field.key: Interval(low=low.si, high=high.si) for low, high in ends},
        ),
        inputs=tuple(
            reading.echo()
            for reading in (*(end for pair in ends for end in pair), *documents)
        ),
        assumed=assumed,
        lines=tuple({end.field.key: end} for pair in ends for end in pair),
    )


def _split(reading: Reading) -> tuple[Reading, Reading]:
    """Low and high end of what one cell holds; twice the same of a single value."""
    field = replace(reading.field, may_range=False)
    low, high = reading.span or (reading.number, reading.number)
    names = (say(f"column.{end}_end", name=field.name) for end in ("low", "high"))
    first, second = (
        replace(reading, field=replace(field, named=name), value=end, span=None)
        for name, end in zip(names, (low, high), strict=True)
    )
    return first, second
