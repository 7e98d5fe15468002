"""Values for all net rows that stand once: on a cover sheet, or above a table."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from netdesign.site.cells.cells import Cell, Sheet
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import RANGES
from netdesign.site.columns.lexicon import Meaning
from netdesign.site.columns.unit_names import KNOWN_UNITS, normalise_unit
from netdesign.site.headings import Table
from netdesign.site.ranges import settle_unit
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.tables import read_answered
from netdesign.words.message import say

SiteWide = Mapping[str, Reading]  # by key of a column of sheet Nets

_GROUND = ("ground_law", "slip_length", "glide_factor")  # one of them says it all


def read_once(
    sheet: Sheet,
    name: Cell,
    value: Cell,
    beside: Cell | None,
    meaning: Meaning,
    findings: list[Finding],
) -> Reading:
    """Value of a column that stands once.

    Parameters
    ----------
    sheet : Sheet
        Has the answers to words.
    name, value : Cell
        What it is, perhaps with its unit in brackets, and its value.
    beside : Cell or None
        The cell behind the value, which may hold the unit.
    meaning : Meaning
        Of the name; its field is the column.
    findings : list of Finding
        Appended to: a value that cannot be read, or that has no unit.

    Raises
    ------
    ValueError
        If the name means no column: a fault of the program.
    """
    field = meaning.field
    if field is None:
        raise ValueError(f"{name.place} names no column")
    unit = _find_unit(name, value, beside, meaning, findings) if field.units else ""
    if field.units and not unit:
        return Reading(field=field, state="faulty", text=value.text, cell=value)
    return read_answered(sheet, value, field, unit, findings)


def _find_unit(
    name: Cell,
    value: Cell,
    beside: Cell | None,
    meaning: Meaning,
    findings: list[Finding],
) -> str:
    column = next(one for one in RANGES.fields if one.key == "unit")
    text = beside.text if beside and normalise_unit(beside.text) in KNOWN_UNITS else ""
    typed = meaning.unit or normalise_unit(value.own_unit)
    return settle_unit(
        Reading(field=column, state="given", value=str(name.value), cell=name),
        Reading(field=column, state="blank", value=text, cell=beside),
        meaning.field or column,
        typed,
        findings,
    )


def read_above(table: Table, findings: list[Finding]) -> dict[str, Reading]:
    """Values that stand in lines above the headings of a table."""
    found: dict[str, Reading] = {}
    for name, value, meaning in table.above:
        reading = read_once(table.sheet, name, value, None, meaning, findings)
        if reading.field.key in found:
            rule = say("item.twice", place=found[reading.field.key].place)
            findings.append(name.finding(rule, say("item.one_line")))
        else:
            found[reading.field.key] = reading
    return found


def fill_in_site_wide(
    rows: Iterable[Row], given: SiteWide, findings: list[Finding]
) -> list[Row]:
    """Lines whose empty cells have what stands once; what they say themselves stays.

    A line with another value than the one that stands once is told.
    """
    return [_fill_in(row, given, findings) for row in rows]


def _fill_in(row: Row, given: SiteWide, findings: list[Finding]) -> Row:
    filled = dict(row)
    for key, reading in given.items():
        own = row[key]
        if own.state in ("blank", "default") and _may_stand(row, key):
            filled[key] = reading
        elif own.state == reading.state == "given" and own.value != reading.value:
            rule = say("item.own_value", place=reading.place)
            refuse(own, rule, "", findings, severity="note")
    return filled


def _may_stand(row: Row, key: str) -> bool:
    """The line says nothing else of the same: of the ground, or of the post's tilt."""
    if key in _GROUND:
        law = row["ground_law"]
        others = [row[one] for one in _GROUND if one not in (key, "ground_law")]
        is_open = law.state == "blank" or (
            law.word == "sliding" and key != "ground_law"
        )
        return is_open and all(one.state == "blank" for one in others)
    if key == "post_tilt":
        return row["post_base_distance"].state == "blank"
    return True
