"""From lines of net rows to net rows: the rules between several cells."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from netdesign.coupling.scene import is_overtopped
from netdesign.outcome import ModelError
from netdesign.site.assumed import assume
from netdesign.site.cells.cells import MAX_NET_ROWS
from netdesign.site.cells.findings import Finding, Refusal
from netdesign.site.empty_cells import Snow, fill_in, find_own_ranges
from netdesign.site.lines import (
    Lines,
    Neighbours,
    Types,
    find_neighbour_cell,
    find_neighbours,
    index_lines,
    refuse_unknown_types,
)
from netdesign.site.model import (
    InputEcho,
    NetRow,
)
from netdesign.site.office.rows import read_approval
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.snow_sheets import (
    build_layers,
    echo_layers,
    measure_normal,
    resolve_thickness,
)
from netdesign.site.support_types import (
    TYPE_COLUMNS,
    build_panels,
    build_row_end,
    find_net_parts,
    find_resistances,
    read_guys,
)
from netdesign.site.type_resistances import ANCHORS, read_anchors, read_axes
from netdesign.snow.ground import (
    DEFAULT_CREEP_LAW,
    GroundLaw,
    build_ground_from_glide_factor,
    find_glide_step,
)
from netdesign.snow.snowpack import Layer
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import Member, NetPart
from netdesign.words.message import Message, say

_ROUNDING = 0.005  # between heights of snow and net that are equal on the plan [m]
_ALIKE = 0.1  # numbers of rows that are alike differ by a tenth at most
_OF_NET = (
    *(Member.POST, Member.UPHILL_GUY, Member.DOWNHILL_GUY),
    *(NetPart.RIDGE_ROPE, NetPart.LOWER_ROPE),
)


def build_net_rows(lines: Lines, findings: list[Finding]) -> tuple[NetRow, ...]:
    """Build every net row without a fault; the faults go to ``findings``.

    Parameters
    ----------
    lines : Lines
        Of all sheets.
    findings : list of Finding
        Appended to.

    Returns
    -------
    tuple of NetRow
        In the order of the sheet.
    """
    if lines.table is None:
        return ()
    if refusal := _judge_count(len(lines.rows)):
        findings.append(lines.table.sheet.finding(*refusal))
    index_lines(lines.rows, "id", say("nets.ids_once"), findings)
    beside = find_neighbours(lines.rows, findings)
    built = [
        _build_net_row(_resolve_gap(row, beside), lines, findings) for row in lines.rows
    ]
    built = _separate_unlike(built, beside, lines, findings)
    return tuple(net_row for net_row in built if net_row is not None)


def _resolve_gap(row: Row, beside: Neighbours) -> Row:
    """Line whose gap holds for both ends: 0 where its nets go on at both."""
    gap, neighbours = row["gap"], beside.get(row["id"].word)
    if neighbours:
        how = say("office.goes_on", ids=neighbours)
        gap = replace(gap, state="given", value=0.0, derivation=how)
    elif gap.word:
        gap = replace(gap, state="blank", value=None)
    return {**row, "gap": gap}


def _separate_unlike(
    built: Sequence[NetRow | None],
    beside: Neighbours,
    lines: Lines,
    findings: list[Finding],
) -> list[NetRow | None]:
    """Net rows; a row whose nets go on into an unlike row gets an end of its own."""
    by_id = {row.id: row for row in built if row}
    kept: list[NetRow | None] = []
    for line, row in zip(lines.rows, built, strict=True):
        if row and row.id in beside:
            neighbours = [
                by_id[row_id] for row_id in sorted(beside[row.id]) if row_id in by_id
            ]
            unlike = (
                (other.id, key)
                for other in neighbours
                for key in list_differences(row, other)
            )
            if difference := next(unlike, None):
                name = say(f"column.{difference[1]}")
                how = say("nets.unlike", id=difference[0], name=name)
                refuse(find_neighbour_cell(line), how, "", findings, severity="note")
                gap = replace(line["gap"], state="blank", value=None, derivation=how)
                row = _build_net_row({**line, "gap": gap}, lines, [])
        kept.append(row)
    return kept


def list_differences(row: NetRow, other: NetRow) -> Iterator[str]:
    """Columns in which two rows are not loaded and built alike.

    Only rows without a difference load each other's ends as if the nets went on.
    """
    others = _list_compared(other)
    for key, value in _list_compared(row).items():
        other_value = others[key]
        if isinstance(value, float) and isinstance(other_value, float):
            is_alike = math.isclose(value, other_value, rel_tol=_ALIKE)
        else:
            is_alike = value == other_value
        if not is_alike:
            yield key


def _list_compared(row: NetRow) -> dict[str, float | int | str]:
    """Values by which two rows are compared, by their columns."""
    layout, ground = row.layout, row.ground
    types = {
        resistance.member: resistance.type_id
        for resistance in (*row.resistances, *row.net_parts)
    }
    is_sliding = ground.kind == "sliding"
    glide = row.glide_factor or ground.slip_length
    return {
        "rows.slope_angle": row.slope_angle,
        "rows.snow": row.snow_thickness,
        "net_types.net_height": row.net_height,
        "rows.post_spacing": layout.post_spacing,
        "rows.glide_factor": glide if is_sliding else ground.kind,
        "net_types.net_stiffness": row.net_stiffness_per_m,
        "net_types.slack": row.slack,
        "net_types.post_tilt": layout.post_tilt,
        "net_types.guy_count": row.guys.count,
        **{f"net_types.{member}": types.get(member, "") for member in _OF_NET},
    }


def _judge_count(count: int) -> Refusal | None:
    """Reason to refuse the number of net rows; None if it is accepted."""
    if not count:
        return Refusal(say("nets.no_row"), say("nets.one_line"))
    if count > MAX_NET_ROWS:
        accepted = say("nets.most_rows", most=MAX_NET_ROWS)
        return Refusal(say("nets.many_rows", count=count), accepted)
    return None


def _build_net_row(line: Row, lines: Lines, findings: list[Finding]) -> NetRow | None:
    count_before = len(findings)
    has_end = line["gap"].given_si != 0.0
    layer_lines = lines.snow.get(line["id"].word, ())
    end = lines.ends[line["id"].word] if has_end else {}
    layers = build_layers(layer_lines, line["slope_angle"], findings)
    thickness = _understand_thickness(line, layer_lines, layers, findings)
    ground = _understand_ground(line["glide_factor"], thickness, findings)
    _ask_for_length(line, findings)
    for cells in (line, end):
        refuse_unknown_types(cells, lines, findings)
    is_refused = any(finding.severity == "error" for finding in findings[count_before:])
    if is_refused or _is_faulty((line, end)):
        return None
    if thickness is None or ground is None:
        return None
    snow = (thickness, layers, ground)
    row, assumed = fill_in(line, end, snow, lines)
    rounded = _round_net_height(line["net_height"], thickness, findings)
    if is_overtopped(rounded.si, thickness):
        rule = say("nets.overtopped", thickness=thickness)
        refuse(rounded, rule, "", findings, severity="note")
    line, row = ({**readings, "net_height": rounded} for readings in (line, row))
    echoes = _echo_inputs(line, thickness, ground)
    at_end = (
        reading.echo(say(f"column.Ends.{key}"))
        for key, reading in end.items()
        if key != "ground"
    )
    inputs = (*echoes, *echo_layers(layer_lines), *at_end)
    built = _compose_net_row(row, end, lines.types, snow, inputs)
    return replace(built, assumed=assumed, ranges=find_own_ranges(assumed, row))


def _round_net_height(
    height: Reading, thickness: float, findings: list[Finding]
) -> Reading:
    """Height of a net; that of the snow, with a note, where it is a rounding less."""
    if not 0.0 < thickness - height.si <= _ROUNDING:
        return height
    how = say("nets.rounded", typed=height.si, thickness=thickness)
    refuse(height, how, "", findings, severity="note")
    return replace(height, value=thickness, derivation=how)


def _is_faulty(lines: Sequence[Row]) -> bool:
    return any(
        reading.state == "faulty" for cells in lines for reading in cells.values()
    )


def _compose_net_row(
    row: Row, end: Row, types: Types, snow: Snow, inputs: tuple[InputEcho, ...]
) -> NetRow:
    """Net row of a line without a fault, whose end may have other types."""
    thickness, layers, ground = snow
    gap, at_end = row["gap"].given_si, {**row, **end}
    is_other = any(at_end[key].word != row[key].word for key in TYPE_COLUMNS)
    return NetRow(
        id=row["id"].word,
        slope_angle=row["slope_angle"].si,
        snow_thickness=thickness,
        layers=layers,
        upslope_length=row["upslope_length"].si,
        ground=ground,
        net_height=row["net_height"].si,
        net_stiffness_per_m=row["net_stiffness"].si,
        slack=row["slack"].si,
        layout=_build_layout(row),
        resistances=find_resistances(row, types),
        end_resistances=find_resistances(at_end, types) if is_other else None,
        end_anchors=read_anchors(at_end, ANCHORS, types) if is_other else None,
        inputs=inputs,
        post_count=row["post_count"].given_count,
        gap=math.inf if gap is None else gap,
        altitude=row["altitude"].given_si,
        ground_type=row["ground"].word,
        design_life=row["design_life"].given_count or int(assume("design_life").high),
        glide_factor=None if ground.kind == "free" else row["glide_factor"].known_si,
        guys=read_guys(row),
        axes=read_axes(row, ANCHORS, types),
        anchors=read_anchors(row, ANCHORS, types),
        panels=build_panels(row, types["ropes"]),
        row_end=None if gap == 0.0 else build_row_end(at_end, types),
        net_parts=find_net_parts(row, types),
        approval=read_approval(row),
    )


def _understand_thickness(
    row: Row,
    lines: Sequence[Row],
    layers: tuple[Layer, ...],
    findings: list[Finding],
) -> float | None:
    """Snow thickness normal to the slope [m], which its layers add up to."""
    snow, slope = row["snow"], row["slope_angle"]
    if snow.state != "given" or (lines and not layers):  # a finding already
        return None
    if lines:
        return resolve_thickness(layers, snow, slope, findings)
    return measure_normal(snow, slope)


def _understand_ground(
    glide: Reading, thickness: float | None, findings: list[Finding]
) -> GroundLaw | None:
    """Ground of a glide factor, the largest where it is not given."""
    if glide.word:
        return GroundLaw(kind="free")
    if glide.state == "faulty" or thickness is None:
        return None
    factor = glide.known_si or assume("glide_factor").high
    try:
        return build_ground_from_glide_factor(factor, thickness)
    except ModelError as error:  # between 1 and the least factor above it
        refuse(glide, say("nets.no_slip_length"), error.message, findings)
        return None


def _ask_for_length(row: Row, findings: list[Finding]) -> None:
    """Refuse a line without an upslope length on ground that holds none of its snow."""
    glide, length = row["glide_factor"], row["upslope_length"]
    if glide.word and length.state == "blank":
        rule = say("nets.free_without_length", name=length.field.name)
        cell = glide if length.cell is None else length
        refuse(cell, rule, say("nets.other_law_or_length"), findings)


def _build_layout(row: Row) -> SupportLayout:
    return SupportLayout(
        post_spacing=row["post_spacing"].si,
        post_tilt=row["post_tilt"].si,
        uphill_anchor_distance=row["uphill_anchor_distance"].si,
        downhill_anchor_distance=row["downhill_anchor_distance"].si,
    )


def _echo_inputs(
    row: Row, thickness: float, ground: GroundLaw
) -> tuple[InputEcho, ...]:
    """Every input of the row, each followed by what is derived from it."""
    echoes: list[InputEcho] = []
    for key, reading in row.items():
        measured = say(f"column.Nets.{reading.field.key}")
        echoes.append(reading.echo(measured if key == "snow" else None))
        if reading.field.key == "snow_height":
            slope = row["slope_angle"].number
            how = say("column.thickness_of_height", height=reading.si, slope=slope)
            name = say("column.Nets.snow_thickness")
            echoes.append(_echo_derived(name, thickness, reading, how))
        if key == "glide_factor" and reading.state == "given" and not reading.word:
            table = _derive_slip(reading.number, thickness)
            slip = ground.slip_length
            name = say("column.Nets.slip_length")
            echoes.append(_echo_derived(name, slip, reading, table))
    return tuple(echoes)


def _derive_slip(glide_factor: float, thickness: float) -> Message | None:
    """Formula of a slip length from the table; None of ground without slip."""
    if glide_factor == 1.0:
        return None
    step = find_glide_step(glide_factor)
    return say(
        "column.slip_of_table",
        thickness=thickness,
        glide=glide_factor,
        low=step.glide_factors[0],
        high=step.glide_factors[1],
        start=step.slip_ratios[0],
        end=step.slip_ratios[1],
        law=DEFAULT_CREEP_LAW,
    )


def _echo_derived(
    name: Message, value: float, reading: Reading, how: Message | None
) -> InputEcho:
    label = say("column.derived_from", name=name, given=reading.field.name)
    return InputEcho(
        label=label,
        unit="m",
        text=reading.text,
        value=value,
        cell=reading.place,
        derivation=how,
    )
