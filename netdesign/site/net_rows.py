"""From lines of sheet Nets to net rows: the rules between several cells."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from netdesign.coupling.scene import is_overtopped
from netdesign.outcome import ModelError
from netdesign.site.anchor_types import read_anchor_types, read_axes
from netdesign.site.assumed import assume
from netdesign.site.cells.cells import MAX_NET_ROWS
from netdesign.site.cells.findings import Finding, Refusal
from netdesign.site.empty_cells import (
    GLIDE,
    Snow,
    assume_stiffness,
    fill_in_assumed,
    fill_in_snow,
    find_own_ranges,
    list_typed,
)
from netdesign.site.headings import Table
from netdesign.site.lines import (
    Lines,
    Neighbours,
    Types,
    check_neighbours,
    index_lines,
    list_references,
    refuse_missing_sheets,
    refuse_unknown_types,
)
from netdesign.site.model import (
    InputEcho,
    NetRow,
)
from netdesign.site.ranges import fill_in_ranges
from netdesign.site.readings import Reading, Row, choose_given, refuse
from netdesign.site.snow_sheets import (
    build_layers,
    echo_layers,
    fits_slope,
    measure_normal,
    resolve_thickness,
)
from netdesign.site.statements import (
    build_panels,
    check_statements,
    echo_ends,
    explain_panel_lack,
    has_same_types,
    list_assumed,
    list_fixed,
    replace_types,
)
from netdesign.site.support_types import (
    build_row_end,
    find_net_parts,
    find_resistances,
    read_guys,
)
from netdesign.snow.ground import (
    DEFAULT_CREEP_LAW,
    GROUND_KINDS,
    GroundLaw,
    build_ground_from_glide_factor,
    find_glide_step,
)
from netdesign.snow.snowpack import Layer
from netdesign.structure.layout import DEFAULT_POST_TILT, SupportLayout
from netdesign.structure.members import Member, NetPart
from netdesign.words.message import Message, say

_CLOSE = 0.02  # of a post spacing, by which a length may be longer without one more
_ROUNDING = 0.005  # between heights of snow and net that are one by their plan [m]
_SIZES = ("snow_thickness", "snow_height")
# Columns by which rows are alike, numbers within a tenth.
_ALIKE = 0.1
_OF_NET = (
    *(Member.POST, Member.UPHILL_GUY, Member.DOWNHILL_GUY),
    *(NetPart.RIDGE_ROPE, NetPart.LOWER_ROPE),
)
_COMPARED = (
    *("slope_angle", "snow_thickness", "net_height", "post_spacing", "ground_law"),
    *("glide_factor", "net_stiffness", "slack", "post_tilt", "guy_count", *_OF_NET),
)
_SHARED = ("neighbour", "gap")  # of a row that goes on


def build_net_rows(
    table: Table, lines: Lines, findings: list[Finding]
) -> tuple[NetRow, ...]:
    """Build every net row without a fault; the faults go to ``findings``.

    Parameters
    ----------
    table : Table
        Sheet Nets.
    lines : Lines
        Of all sheets.
    findings : list of Finding
        Appended to.

    Returns
    -------
    tuple of NetRow
        In the order of the sheet.
    """
    if refusal := _judge_count(len(lines.nets)):
        findings.append(table.sheet.finding(*refusal))
    index_lines(lines.nets, "id", say("nets.ids_once"), findings)
    beside = check_neighbours(lines.nets, findings)
    built = [_build_net_row(row, lines, findings) for row in lines.nets]
    built = _separate_unlike(built, beside, lines, findings)
    refuse_missing_sheets(table, lines, findings)
    return tuple(net_row for net_row in built if net_row is not None)


def _separate_unlike(
    built: Sequence[NetRow | None],
    beside: Neighbours,
    lines: Lines,
    findings: list[Finding],
) -> list[NetRow | None]:
    """Rows of which those that go on into an unlike one have an end of their own."""
    by_id = {row.id: row for row in built if row}
    kept: list[NetRow | None] = []
    for line, row in zip(lines.nets, built, strict=True):
        if row and not row.has_end and line["row_end"].word == "continuous":
            others = [by_id[one] for one in sorted(beside[row.id]) if one in by_id]
            unlike = ((one.id, key) for one in others for key in list_unlike(row, one))
            if found := next(unlike, None):
                name = say(f"column.Nets.{found[1]}")
                how = say("nets.unlike", id=found[0], name=name)
                refuse(line["row_end"], how, "", findings, severity="note")
                row = _build_net_row(_free(line, how), lines, [])
        kept.append(row)
    return kept


def list_unlike(one: NetRow, other: NetRow) -> Iterator[str]:
    """Columns of sheet Nets by which two rows are not loaded and built alike.

    Only alike rows load each other's ends as if the nets went on.
    """
    pairs = zip(_list_compared(one), _list_compared(other), strict=True)
    for key, (mine, its) in zip(_COMPARED, pairs, strict=True):
        if isinstance(mine, float) and isinstance(its, float):
            is_alike = math.isclose(mine, its, rel_tol=_ALIKE)
        else:
            is_alike = mine == its
        if not is_alike:
            yield key


def _list_compared(row: NetRow) -> tuple[float | int | str, ...]:
    layout, ground = row.layout, row.ground
    parts = (*row.resistances, *row.net_parts)
    types = {one.member: one.type_id for one in parts}
    return (
        *(row.slope_angle, row.snow_thickness, row.net_height),
        *(layout.post_spacing, ground.kind, row.glide_factor or ground.slip_length),
        *(row.net_stiffness_per_m, row.slack),
        *(layout.post_base_distance or layout.post_tilt, row.guys.count),
        *(types.get(member, "") for member in _OF_NET),
    )


def _free(line: Row, how: Message) -> Row:
    """Line of a row whose ends are free, whatever it says."""
    said = {key: replace(line[key], state="blank", value=None) for key in _SHARED}
    end = replace(line["row_end"], value="free", derivation=how)
    return {**line, **said, "row_end": end}


def _judge_count(count: int) -> Refusal | None:
    """Reason against so many net rows; None if they are a site."""
    if not count:
        return Refusal(say("nets.no_row"), say("nets.one_line"))
    if count > MAX_NET_ROWS:
        accepted = say("nets.most_rows", most=MAX_NET_ROWS)
        return Refusal(say("nets.many_rows", count=count), accepted)
    return None


def _build_net_row(line: Row, lines: Lines, findings: list[Finding]) -> NetRow | None:
    count_before, ranged = len(findings), lines.ranges.ends
    snow, end = lines.snow.get(line["id"].word, ()), lines.ends.get(line["id"].word)
    row = fill_in_ranges(line, ranged, findings)
    law = {"ground_law": _read_ground_law(row)}
    line, row = {**line, **law}, {**row, **law}
    row, assumed = fill_in_assumed(row)
    check_statements(row, snow, end, findings)
    _check_length(row, findings)
    layers = build_layers(snow, row["slope_angle"], findings)
    is_ranged = not ranged.keys().isdisjoint(("thickness", "snow_height"))
    thickness = _understand_thickness(row, snow, layers, findings, is_ranged=is_ranged)
    ground = _understand_ground(row, thickness, findings)
    _ask_for_length(row, findings)
    named: list[Row] = [row, end] if end else [row]
    for one in named:
        refuse_unknown_types(one, lines, findings)
    is_refused = any(one.severity == "error" for one in findings[count_before:])
    if is_refused or _is_faulty(named, lines.unreadable):
        return None
    if thickness is None or ground is None:
        return None
    row = _round_net_height(row, thickness, findings)
    line = {**line, "net_height": row["net_height"]}
    if is_overtopped(row["net_height"].si, thickness):
        rule = say("nets.overtopped", thickness=thickness)
        refuse(row["net_height"], rule, "", findings, severity="note")
    echoes = _echo_inputs(line, thickness, ground)
    inputs = (*echoes, *echo_layers(snow), *echo_ends(end))
    held = (thickness, layers, ground)
    row, further = fill_in_snow(row, held, lines.ranges, snow)
    built = _compose_net_row(row, end, lines.types, held, inputs)
    found = (*assumed, *further, *assume_stiffness(row, lines.types["Ropes"]))
    found = (*found, *built.assumed, *list_typed(row, end))
    own = find_own_ranges(found, row)
    return replace(built, assumed=found, ranges=own)


def _round_net_height(row: Row, thickness: float, findings: list[Finding]) -> Row:
    """Row whose net is as high as snow that is a rounding thicker; that is told."""
    height = row["net_height"]
    if not 0.0 < thickness - height.si <= _ROUNDING:
        return row
    how = say("nets.rounded", typed=height.si, thickness=thickness)
    refuse(height, how, "", findings, severity="note")
    return {**row, "net_height": replace(height, value=thickness, derivation=how)}


def _is_faulty(named: list[Row], unreadable: Iterable[str]) -> bool:
    """A cell is faulty, or names a type of a sheet whose ids cannot be read."""
    readings = (reading for one in named for reading in one.values())
    return any(reading.state == "faulty" for reading in readings) or any(
        list_references(named, sheet) for sheet in unreadable
    )


def _compose_net_row(
    row: Row, end: Row | None, types: Types, snow: Snow, inputs: tuple[InputEcho, ...]
) -> NetRow:
    """Net row of a line without a fault."""
    thickness, layers, ground = snow
    gap = 0.0 if row["row_end"].word == "continuous" else row["gap"].given_si
    has_end = gap is None or gap > 0.0
    at_end = replace_types(row, end) if has_end else row
    is_other = has_end and not has_same_types(at_end, row)
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
        end_anchors=read_anchor_types(at_end, types) if is_other else None,
        inputs=inputs,
        length=_find_length(row),
        post_count=_count_posts(row),
        gap=math.inf if gap is None else gap,
        altitude=row["altitude"].given_si,
        ground_type=row["ground"].word,
        edge_distance=row["edge_distance"].given_si,
        design_life=row["design_life"].given_count or int(assume("design_life").high),
        glide_factor=row["glide_factor"].known_si,
        guys=read_guys(row),
        has_row_above=row["row_above"].word != "none",
        axes=read_axes(row),
        anchors=read_anchor_types(row, types),
        panels=build_panels(row, types["Ropes"]),
        panel_assumed=list_assumed(row, types["Ropes"]),
        assumed=list_fixed(row, end, types),
        row_end=build_row_end(at_end, end, types) if has_end else None,
        net_parts=find_net_parts(row, types),
        panel_lack=explain_panel_lack(row),
    )


def _find_length(row: Row) -> float | None:
    """Length of the row [m]; by its posts where only their number is given."""
    length, count = row["row_length"].given_si, row["post_count"]
    if length is None and count.state == "given":
        return (count.number - 1.0) * row["post_spacing"].si
    return length


def _count_posts(row: Row) -> int | None:
    """Posts of the row; by its length where their number is not given."""
    length, count = row["row_length"].given_si, row["post_count"].given_count
    if count is not None or length is None:
        return count
    return 1 + math.ceil(length / row["post_spacing"].si - _CLOSE)


def _check_length(row: Row, findings: list[Finding]) -> None:
    """Refuse a length that does not have room for the posts, or for more."""
    length, count, spacing = row["row_length"], row["post_count"], row["post_spacing"]
    if any(one.state != "given" for one in (length, count, spacing)):
        return
    fields = count.number - 1.0
    if not fields - 1.0 < length.si / spacing.si < fields + 1.0:
        rule = say(
            "nets.other_length",
            count=int(count.number),
            place=count.place,
            length=fields * spacing.si,
        )
        refuse(length, rule, say("nets.length_of_posts"), findings)


def _understand_thickness(
    row: Row,
    lines: Sequence[Row],
    layers: tuple[Layer, ...],
    findings: list[Finding],
    *,
    is_ranged: bool,
) -> float | None:
    """Snow thickness normal to the slope [m]: of one column, or of the layers.

    Where it ranges, the layers follow the range.
    """
    sizes = [row[key] for key in _SIZES]
    if any(one.state == "faulty" for one in sizes):
        return None
    if lines and not layers:  # a line of sheet Snow is faulty: a finding already
        return None
    is_blank = all(one.state != "given" for one in sizes)
    blank = sizes[0] if lines and not is_ranged and is_blank else None
    is_twice = all(one.state == "given" for one in (*sizes, row["slope_angle"]))
    if is_twice and fits_slope(sizes[0], sizes[1], row["slope_angle"]):
        blank = sizes[0]  # the height says the same
    given = blank or choose_given(row, _SIZES, findings)
    if given is None:
        return None
    if lines and not is_ranged:
        return resolve_thickness(layers, given, row["slope_angle"], findings)
    return measure_normal(given, row["slope_angle"])


def _read_ground_law(row: Row) -> Reading:
    """Ground law as typed; where nobody types one beside a glide, the ground slides."""
    law = row["ground_law"]
    given = [row[key] for key in GLIDE if row[key].state == "given"]
    if law.state != "blank" or len(given) != 1:
        return law
    (glide,) = given
    how = say("column.ground_of_glide", name=glide.field.name, place=glide.place)
    return replace(law, state="given", value="sliding", cell=glide.cell, derivation=how)


def _understand_ground(
    row: Row, thickness: float | None, findings: list[Finding]
) -> GroundLaw | None:
    law, slip, glide = row["ground_law"], row["slip_length"], row["glide_factor"]
    if "faulty" in (law.state, slip.state, glide.state):
        return None
    given = [reading for reading in (slip, glide) if reading.state == "given"]
    if law.state == "blank":  # both are given
        choose_given(row, GLIDE, findings)
        return None
    if law.word != "sliding":
        kind = next(kind for kind in GROUND_KINDS if kind == law.word)
        return None if given else GroundLaw(kind=kind)
    is_assumed = glide.state == "default"
    chosen = glide if is_assumed else choose_given(row, GLIDE, findings)
    if chosen is slip:
        return GroundLaw(kind="sliding", slip_length=slip.si)
    return _build_sliding_ground(glide, thickness, findings) if chosen else None


def _ask_for_length(row: Row, findings: list[Finding]) -> None:
    """Refuse a line without an upslope length on ground that holds none of its snow."""
    law, length = row["ground_law"], row["upslope_length"]
    if law.word == "free" and length.state == "blank":
        rule = say("nets.free_without_length", name=length.field.name)
        at = law if length.cell is None else length
        refuse(at, rule, say("nets.other_law_or_length"), findings)


def _build_sliding_ground(
    glide: Reading, thickness: float | None, findings: list[Finding]
) -> GroundLaw | None:
    if thickness is None:
        return None
    try:
        return build_ground_from_glide_factor(glide.number, thickness)
    except ModelError as error:  # between 1 and the least factor above it
        refuse(glide, say("nets.no_slip_length"), error.message, findings)
        return None


def _build_layout(row: Row) -> SupportLayout:
    tilt = row["post_tilt"].known_si  # of no matter beside a base distance
    return SupportLayout(
        post_spacing=row["post_spacing"].si,
        post_tilt=DEFAULT_POST_TILT if tilt is None else tilt,
        uphill_anchor_distance=row["uphill_anchor_distance"].si,
        downhill_anchor_distance=row["downhill_anchor_distance"].si,
        post_base_distance=row["post_base_distance"].given_si,
    )


def _echo_inputs(
    row: Row, thickness: float, ground: GroundLaw
) -> tuple[InputEcho, ...]:
    """Every input of the row; what was derived from one stands behind it."""
    echoes: list[InputEcho] = []
    for key, reading in row.items():
        echoes.append(reading.echo())
        is_alone = row["snow_thickness"].state != "given"
        if key == "snow_height" and reading.state == "given" and is_alone:
            slope = row["slope_angle"].number
            how = say("column.thickness_of_height", height=reading.si, slope=slope)
            echoes.append(_echo_derived(row["snow_thickness"], thickness, reading, how))
        if key == "glide_factor" and reading.state == "given":
            table = _derive_slip(reading.number, thickness)
            slip = ground.slip_length
            echoes.append(_echo_derived(row["slip_length"], slip, reading, table))
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
    what: Reading, value: float, reading: Reading, how: Message | None
) -> InputEcho:
    name, given = what.field.name, reading.field.name
    label = say("column.derived_from", name=name, given=given)
    return InputEcho(
        label=label,
        unit="m",
        text=reading.text,
        value=value,
        cell=reading.place,
        derivation=how,
    )
