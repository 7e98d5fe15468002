"""From the lines of sheet Ranges to the ranges of the uncertain quantities."""

from __future__ import annotations

from dataclasses import dataclass, replace

from netdesign.envelope.grid import Interval, Ranges
from netdesign.site.cells.findings import Finding, Refusal, quote
from netdesign.site.columns.all_tables import (
    DEFAULT_INCLINATION_DEG,
    RANGE_QUANTITIES,
    SEARCHED,
)
from netdesign.site.columns.fields import Field, split_heading
from netdesign.site.columns.unit_names import UNCLEAR_UNITS, normalise_unit
from netdesign.site.headings import name_units, quote_title
from netdesign.site.items import match_item
from netdesign.site.model import InputEcho
from netdesign.site.readings import Reading, read_cell, refuse
from netdesign.site.tables import Table, read_field
from netdesign.words.message import say

_Line = tuple[Reading, Reading, Reading]  # low, high, samples


@dataclass(frozen=True, slots=True, kw_only=True)
class _Range:
    interval: Interval
    inputs: tuple[InputEcho, ...]


def build_ranges(
    table: Table, findings: list[Finding]
) -> tuple[Ranges, tuple[InputEcho, ...]] | None:
    """Build the three ranges, or None where a fault went to ``findings``.

    Parameters
    ----------
    table : Table
        Sheet Ranges, one quantity a line.
    findings : list of Finding
        Appended to.

    Returns
    -------
    tuple of Ranges and tuple of InputEcho, or None
        SI units in the ranges, units of the edge in the inputs.
    """
    found: dict[str, _Range | None] = {}
    for row in table.rows:
        _read_line(table, row, found, findings)
    for field in RANGE_QUANTITIES:
        if field.key in found:
            continue
        if field.required:
            rule = say("range.lacks", heading=field.title)
            findings.append(table.sheet.finding(Refusal(rule, field.accepted)))
        else:
            found[field.key] = _default_inclination(field)
    complete = {key: value for key, value in found.items() if value is not None}
    if len(complete) < len(RANGE_QUANTITIES):
        return None
    ranges = Ranges(**{key: value.interval for key, value in complete.items()})
    inputs = [complete[field.key].inputs for field in RANGE_QUANTITIES]
    return ranges, tuple(echo for echoes in inputs for echo in echoes)


def _read_line(
    table: Table, row: int, found: dict[str, _Range | None], findings: list[Finding]
) -> None:
    name = read_field(table, "quantity", row, findings)
    unit = read_field(table, "unit", row, findings)
    samples = read_field(table, "samples", row, findings)
    if name.state != "given":
        return
    field = match_item(name, table, "quantity", findings)
    if field is None:
        return
    if field.key in found:
        refuse(name, say("range.twice"), say("range.one_line"), findings)
    else:
        found[field.key] = None
        settled = _settle_unit(name, unit, field, findings)
        if settled:
            low, high = (
                _read_end(table, row, key, field, settled, findings)
                for key in ("low", "high")
            )
            found[field.key] = _read_range(field, low, high, samples, findings)


def _settle_unit(
    name: Reading, unit: Reading, field: Field, findings: list[Finding]
) -> str:
    """Unit of a line, in brackets or in a column; empty if a finding refused it."""
    _, in_brackets = split_heading(name.word)
    in_column = normalise_unit(unit.word.strip(" []()"))
    given, place = (in_column, unit) if in_column else (in_brackets, name)
    accepted = name_units(field)
    if in_column and in_brackets and in_column != in_brackets:
        rule = say("range.other_unit", name=quote(name.word))
        refuse(unit, rule, say("accepted.one_unit"), findings)
    elif not given:
        refuse(name, say("heading.no_unit"), quote_title(field), findings)
    elif given in UNCLEAR_UNITS:
        rule = say("heading.unclear_unit", readings=UNCLEAR_UNITS[given])
        refuse(place, rule, accepted, findings)
    elif given not in field.units:
        refuse(place, say("heading.unknown_unit"), accepted, findings)
    else:
        return given
    return ""


def _read_range(
    field: Field,
    low: Reading | None,
    high: Reading | None,
    samples: Reading,
    findings: list[Finding],
) -> _Range | None:
    if (
        low is None
        or high is None
        or "faulty" in (low.state, high.state, samples.state)
    ):
        return None
    if low.state == high.state == "blank":
        return _default_inclination(field)
    for reading, other in ((low, high), (high, low)):
        if reading.state == "blank":
            rule = say("range.empty_beside", place=other.place)
            refuse(reading, rule, say("range.both_ends"), findings)
            return None
    samples = _settle_samples(low, high, samples, findings)
    if samples.state == "faulty":
        return None
    return _build_range(field, (low, high, samples))


def _read_end(
    table: Table,
    row: int,
    key: str,
    field: Field,
    unit: str,
    findings: list[Finding],
) -> Reading | None:
    cell = table.cell(row, key)
    if cell is None:  # the missing heading is a finding already
        return None
    end = _name_end(field, key)
    return read_cell(cell, end, unit, findings)


def _name_end(field: Field, key: str) -> Field:
    """The low or the high end of a range, as a field of its own name."""
    return replace(field, named=say(f"column.{key}_end", name=field.name))


def _settle_samples(
    low: Reading, high: Reading, samples: Reading, findings: list[Finding]
) -> Reading:
    """Check order and count of a range; an empty count means a search."""
    is_single = low.number == high.number
    if low.number > high.number:
        rule = say("range.below_low", place=low.place)
        refuse(high, rule, say("range.low_to_high"), findings)
    elif samples.state == "blank":
        value = 1.0 if is_single else SEARCHED
        return replace(samples, state="default", value=value)
    elif is_single and samples.number != 1:
        refuse(samples, say("range.many_for_single"), "1", findings)
    elif samples.number == 1 and not is_single:
        refuse(samples, say("range.few"), say("range.two_or_more"), findings)
    else:
        return samples
    return replace(samples, state="faulty")


def _default_inclination(field: Field) -> _Range:
    low, high = (
        Reading(
            field=_name_end(field, key),
            state="default",
            value=value,
        )
        for key, value in zip(("low", "high"), DEFAULT_INCLINATION_DEG, strict=True)
    )
    samples_field = Field(key="samples", kind="count", table="Ranges")
    samples = Reading(field=samples_field, state="default", value=SEARCHED)
    return _build_range(field, (low, high, samples))


def _build_range(field: Field, line: _Line) -> _Range:
    low, high, samples = line
    count = None if samples.value == SEARCHED else int(samples.number)
    interval = Interval(low=low.si, high=high.si, count=count)
    named = say("column.samples_of", name=field.name)
    labelled = replace(samples, field=replace(samples.field, named=named))
    return _Range(interval=interval, inputs=(low.echo(), high.echo(), labelled.echo()))
