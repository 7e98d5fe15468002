"""From the lines of sheet Ranges to the ranges of the uncertain quantities.

A workbook without that sheet may have its ranges answered.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from dataclasses import field as of_dataclass

from netdesign.envelope.ranges import ONE_QUANTITY, Interval, Ranges
from netdesign.search.maxima import MOST_PARAMETERS
from netdesign.site.assumed import Assumed, assume
from netdesign.site.cells.cells import Cell, Sheet, Workbook
from netdesign.site.cells.findings import Finding, quote
from netdesign.site.cells.numbers import split_range
from netdesign.site.columns.all_tables import (
    FURTHER_QUANTITIES,
    NETS,
    RANGES,
    UNANSWERED,
    USUAL_QUANTITIES,
    Meaning,
)
from netdesign.site.columns.fields import (
    UNCLEAR_UNITS,
    Field,
    SheetPlan,
    normalise_unit,
    split_heading,
)
from netdesign.site.headings import Table, refuse_unused_answers
from netdesign.site.model import InputEcho
from netdesign.site.readings import Reading, Row, explain_unit, read_cell, refuse
from netdesign.site.tables import match_item, read_field
from netdesign.site.titles import list_meant
from netdesign.words.message import say

_Ends = tuple[Cell | None, Cell | None]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Range:
    interval: Interval
    inputs: tuple[InputEcho, ...]
    low: Reading
    high: Reading


@dataclass(frozen=True, slots=True, kw_only=True)
class RangesSheet:
    """Sheet Ranges as far as it could be understood.

    Attributes
    ----------
    ranges : Ranges or None
        SI units; None where a line has a fault.
    inputs : tuple of InputEcho
        Both ends of each range, in the units of the edge.
    ends : mapping of str to tuple of Reading, or None
        Low and high end of what ranges beside the usual three; None where its line
        has a fault.
    assumed : tuple of Assumed
        Of the usual three those that have no line.
    lines : tuple of Row
        Both ends of each range, one a line.
    findings : sequence of Finding
        About the sheet; they are told behind those of sheet Nets.
    """

    ranges: Ranges | None = None
    inputs: tuple[InputEcho, ...] = ()
    assumed: tuple[Assumed, ...] = ()
    lines: tuple[Row, ...] = ()
    findings: Sequence[Finding] = ()
    ends: Mapping[str, tuple[Reading, Reading] | None] = of_dataclass(
        default_factory=dict
    )


def build_ranges(table: Table | None, findings: list[Finding]) -> RangesSheet:
    """Build the usual three ranges and those of further quantities.

    Parameters
    ----------
    table : Table or None
        Sheet Ranges, one quantity a line, if it was found.
    findings : list of Finding
        Appended to.

    Returns
    -------
    RangesSheet
        Without ranges where a fault went to ``findings``.
    """
    found: dict[str, _Range | None] = {}
    names: dict[str, Reading] = {}
    if table:
        for row in table.rows:
            read_line(table, row, found, names, findings)
        refuse_unused_answers(table, findings)
    for name in _refuse_doubles(names, findings):
        found[name] = None
    complete = {key: value for key, value in found.items() if value is not None}
    is_crowded = _refuse_crowd(names, complete, findings)
    ends = {
        one.key: (value.low, value.high) if (value := found[one.key]) else None
        for one in FURTHER_QUANTITIES
        if one.key in found
    }
    if len(complete) < len(found) or is_crowded:
        return RangesSheet(ends=ends)
    return replace(collect_ranges(complete), ends=ends)


def _refuse_doubles(names: Mapping[str, Reading], findings: list[Finding]) -> list[str]:
    """Names of lines that give one quantity twice; the later of two is refused."""
    order = list(names)
    doubles: list[str] = []
    for pair in ONE_QUANTITY:
        if all(one in names for one in pair):
            first, second = sorted(pair, key=order.index)
            rule = say("range.one_quantity", place=names[first].place)
            refuse(names[second], rule, say("range.one_of_two"), findings)
            doubles += pair
    return doubles


def _refuse_crowd(
    names: Mapping[str, Reading],
    complete: Mapping[str, _Range],
    findings: list[Finding],
) -> bool:
    """Refuse the first range that is too many for a search; whether there is one."""
    wide = [
        key
        for key, one in complete.items()
        if one.interval.low < one.interval.high and key in names
    ]
    # what has no line of the usual three ranges, too; so may slack and stiffness
    lacking = (*(one.key for one in USUAL_QUANTITIES), "slack", "net_stiffness")
    most = MOST_PARAMETERS - sum(key not in names for key in lacking)
    if len(wide) <= most:
        return False
    accepted = say("range.at_most", most=MOST_PARAMETERS)
    refuse(names[wide[most]], say("range.too_many"), accepted, findings)
    return True


def read_line(
    table: Table,
    row: int,
    found: dict[str, _Range | None],
    names: dict[str, Reading],
    findings: list[Finding],
) -> None:
    """Read one line of sheet Ranges into the ranges and names found so far."""
    name = read_field(table, "quantity", row, findings)
    unit = read_field(table, "unit", row, findings)
    counted = read_field(table, "samples", row, findings)
    if counted.state == "given":  # a grid of cases, once
        refuse(counted, say("range.samples"), say("range.left_empty"), findings)
    why = read_field(table, "justification", row, findings)
    if name.state != "given":
        return
    meaning = match_item(name, table, "quantity", findings)
    field = meaning.field
    if field is None:
        return
    if field.key in names:
        refuse(name, say("range.twice"), say("range.one_line"), findings)
        return
    names[field.key], found[field.key] = name, None
    ends = _find_ends(table, row, findings)
    settled = _settle_unit(name, unit, field, _find_typed(ends, meaning), findings)
    if not settled or ends is None:
        return
    span = table.cell(row, "span")
    low, high = (
        _read_end(cell, key, field, settled, findings, span)
        for key, cell in zip(("low", "high"), ends, strict=True)
    )
    if low is None or high is None:  # the missing heading is a finding already
        return
    if low.state == high.state == "blank":
        del names[field.key], found[field.key]  # a line of a form, not filled in
    else:
        built = _read_range(low, high, settled, findings)
        if built and why.state == "given":
            named = say("column.justification_of", name=field.name)
            built = replace(built, inputs=(*built.inputs, why.echo(named)))
        found[field.key] = built


def _find_ends(table: Table, row: int, findings: list[Finding]) -> _Ends | None:
    """Cells of both ends of a line, or one cut in two; None if that is refused."""
    low, high, span = (table.cell(row, key) for key in ("low", "high", "span"))
    if span is None or span.is_blank:
        return low or span, high or span
    beside = next((one for one in (low, high) if one and not one.is_blank), None)
    if beside is not None:
        rule = say("range.twice_in_line", place=beside.place)
        findings.append(span.finding(rule, say("range.one_or_both")))
        return None
    if not isinstance(span.value, str):
        return span, span  # a single number, or what is refused as none
    cut = split_range(span.value)
    if cut is None:
        return span, span
    return tuple(replace(span, value=f"{end} {cut[2]}".rstrip()) for end in cut[:2])  # type: ignore[return-value]


def _find_typed(ends: _Ends | None, meaning: Meaning) -> str:
    """Unit that both ends have in their cells, or that was answered; else none."""
    filled = [one for one in ends or () if one and not one.is_blank]
    units = {normalise_unit(one.own_unit) for one in filled}
    return meaning.unit or (units.pop() if len(units) == 1 else "")


def _settle_unit(
    name: Reading, unit: Reading, field: Field, typed: str, findings: list[Finding]
) -> str:
    """Unit of a line, in brackets or in a column; empty if a finding refused it.

    ``typed`` is what the cells of its ends have, or what was answered; it decides where
    nothing else is clear.
    """
    in_brackets = split_heading(name.word)[1]
    in_column = normalise_unit(unit.word.strip(" []()"))
    given, place = (in_column, unit) if in_column else (in_brackets, name)
    if typed in field.units and given in ("", *UNCLEAR_UNITS):
        return typed
    if in_column and in_brackets and in_column != in_brackets:
        rule = say("range.other_unit", name=quote(name.word))
        refuse(unit, rule, say("accepted.one_unit"), findings)
    elif not given and field.units == ("-",):
        return "-"
    elif given not in field.units:
        refuse(place, *explain_unit(given, field), findings)
    else:
        return given
    return ""


def _read_range(
    low: Reading,
    high: Reading,
    unit: str,
    findings: list[Finding],
) -> _Range | None:
    if "faulty" in (low.state, high.state):
        return None
    for reading, other in ((low, high), (high, low)):
        if reading.state == "blank":
            rule = say("range.empty_beside", place=other.place)
            refuse(reading, rule, say("range.both_ends"), findings, unit=unit)
            return None
    if low.number > high.number:
        rule = say("range.below_low", place=low.place)
        refuse(high, rule, say("range.low_to_high"), findings, unit=unit)
        return None
    return _build_range(low, high)


def _read_end(
    cell: Cell | None,
    key: str,
    field: Field,
    unit: str,
    findings: list[Finding],
    span: Cell | None,
) -> Reading | None:
    """Reading of one end; where one cell holds both, it shows that cell."""
    if cell is None:
        return None
    count = len(findings)
    reading = read_cell(cell, _name_end(field, key), unit, findings)
    if span is None or span.is_blank:
        return reading
    findings[count:] = [replace(one, text=span.text) for one in findings[count:]]
    return replace(reading, text=span.text, cell=span)


def _name_end(field: Field, key: str) -> Field:
    """The low or the high end of a range, as a field of its own name."""
    return replace(field, named=say(f"column.{key}_end", name=field.name))


def split_reading(field: Field, reading: Reading) -> _Range:
    """Range of a quantity that one cell holds, or a single value."""
    ends = reading.span or (reading.number, reading.number)
    low, high = (
        replace(reading, field=_name_end(field, key), value=end, span=None)
        for key, end in zip(("low", "high"), ends, strict=True)
    )
    return _build_range(low, high)


def collect_ranges(found: Mapping[str, _Range]) -> RangesSheet:
    """Ranges of some quantities; those of the usual three that lack are assumed."""
    assumed = tuple(assume(x.key) for x in USUAL_QUANTITIES if x.key not in found)
    order = (*USUAL_QUANTITIES, *FURTHER_QUANTITIES)
    inputs = (found[one.key].inputs for one in order if one.key in found)
    return RangesSheet(
        ranges=Ranges.of(
            **{one.key: Interval(low=one.low, high=one.high) for one in assumed},
            **{key: one.interval for key, one in found.items()},
        ),
        inputs=tuple(echo for echoes in inputs for echo in echoes),
        assumed=assumed,
        lines=tuple(
            {end.field.key: end}
            for one in found.values()
            for end in (one.low, one.high)
        ),
    )


def _build_range(low: Reading, high: Reading) -> _Range:
    return _Range(
        interval=Interval(low=low.si, high=high.si),
        inputs=(low.echo(), high.echo()),
        low=low,
        high=high,
    )


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
    is_sized = given.isdisjoint(_SNOW)
    return replace(plan.free(given), one_of=plan.one_of if is_sized else ())


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


_HEADINGS = ("quantity", "range")


def add_answered_ranges(workbook: Workbook) -> Workbook:
    """Workbook with a sheet Ranges of what was answered, where it has none."""
    lines = list(_list_answered(workbook))
    if list_meant(workbook, RANGES) or not lines:
        return workbook
    sheet, file = RANGES.name, lines[0][0].file
    head = {
        n: Cell(file=file, sheet=sheet, row=1, column=n, value=value)
        for n, value in enumerate(_HEADINGS, 1)
    }
    rows = {number: dict(enumerate(cells, 1)) for number, cells in enumerate(lines, 2)}
    made = Sheet(file=file, name=sheet, rows={1: head, **rows})
    return replace(workbook, sheets=(*workbook.sheets, made))


def _list_answered(workbook: Workbook) -> Iterator[tuple[Cell, Cell]]:
    """Ranges of the file of answers, each name and value; an open one is none."""
    answers = workbook.answers
    for row, (name, answer) in enumerate(answers.ranges.items(), 1):
        if UNANSWERED in answer:
            continue
        made = Cell(file=answers.file, sheet="ranges", row=row, column=1, value=name)
        yield made, replace(made, column=2, value=answer)
