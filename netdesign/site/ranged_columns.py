"""Columns of sheet Nets that stay empty, since sheet Ranges gives their quantity.

A line that gives it too is refused. Where a row needs one value of it, that is the
severe end: more snow, a stiffer and tauter net, more glide.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import FURTHER_QUANTITIES, NETS
from netdesign.site.columns.fields import SheetPlan
from netdesign.site.readings import Reading, Row, refuse
from netdesign.words.message import say

Ends = Mapping[str, tuple[Reading, Reading] | None]  # as `ranges.RangesSheet` has them

_SNOW = ("snow_thickness", "snow_height")
_GLIDE = ("slip_length", "glide_factor")


def _list_columns(own: str) -> tuple[str, ...]:
    """Column of sheet Nets, then the one that gives the same otherwise, if any."""
    beside = [
        one.key if one.alternative_to == own else one.alternative_to
        for one in NETS.fields
        if one.alternative_to and own in (one.key, one.alternative_to)
    ]
    return (own, *beside)


# Columns by the quantity that ranges, its own first; none of them may be filled in.
_COLUMNS: Mapping[str, tuple[str, ...]] = {
    one.key: _list_columns(one.column) for one in FURTHER_QUANTITIES
}
_SEVERE_IS_LOW = ("slack",)


def free_columns(plan: SheetPlan, ends: Ends) -> SheetPlan:
    """Plan of sheet Nets without the need for columns that sheet Ranges gives."""
    given = {column for name in ends for column in _COLUMNS[name]}
    fields = tuple(
        replace(one, required=False, default=None) if one.key in given else one
        for one in plan.fields
    )
    is_sized = given.isdisjoint(_SNOW)
    return replace(plan, fields=fields, one_of=plan.one_of if is_sized else ())


def fill_in_ranges(row: Row, ends: Ends, findings: list[Finding]) -> Row:
    """Line of sheet Nets with the severe end of every range.

    Parameters
    ----------
    row : Row
        Line as read.
    ends : mapping of str to tuple of Reading, or None
        Of the quantities that range; None where the range has a fault.
    findings : list of Finding
        Appended to, where the line gives what ranges, or where glide ranges and its
        ground does not slide.
    """
    filled = dict(row)
    for name, pair in ends.items():
        own, *_ = columns = _COLUMNS[name]
        given = [row[column] for column in columns if row[column].state == "given"]
        for reading in given:
            place = pair[0].place if pair else say("sheet.Ranges")
            rule = say("range.beside", place=place)
            refuse(reading, rule, say("range.empty_or_no_range"), findings)
        if pair is None or given or not _can_glide(row, name, pair, findings):
            filled[own] = replace(row[own], state="faulty")
            continue
        severe = pair[0 if name in _SEVERE_IS_LOW else 1]
        filled[own] = replace(severe, field=row[own].field, state="given")
    return filled


def _can_glide(
    row: Row, name: str, pair: tuple[Reading, Reading], findings: list[Finding]
) -> bool:
    """True if the ground slides, or its glide does not range."""
    own, ground = _COLUMNS[name][0], row["ground_law"]
    if own not in _GLIDE or ground.word in ("sliding", ""):
        return True
    rule = say("range.not_sliding", place=pair[0].place, name=row[own].field.name)
    refuse(ground, rule, say("range.sliding_or_none"), findings)
    return False
