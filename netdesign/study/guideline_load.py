"""The guideline's load on a net row, and its forces beside those of the coupled solve.

Its glide factor, the widths that load each support, the floor of every demand.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import Literal

from netdesign.checks import Check, OpenKind, Standard
from netdesign.checks.comparison import leave_open
from netdesign.checks.schema import DIMENSIONING, GLIDE_FACTORS, LATERAL_SHARE
from netdesign.coupling.interface import NetState, find_net_face
from netdesign.envelope.extremes import Extreme
from netdesign.envelope.ranges import USUAL, Case, Ranges
from netdesign.guideline.floor import (
    Floor,
    FloorForce,
    NetRanges,
    find_floors,
)
from netdesign.guideline.load_cases import (
    GuidelineResult,
    NetGeometry,
    compare_with_guideline,
    find_glide_factor,
)
from netdesign.guideline.load_model import (
    LoadModel,
    compute_altitude_factor,
    load_guideline,
    read_end_effect,
    read_load_model,
)
from netdesign.numerics.arrays import Number
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CreepLaw
from netdesign.snow.ground import (
    DEFAULT_CREEP_LAW,
    LARGEST_GLIDE_FACTOR,
    GroundLaw,
    compute_slip_length,
    load_glide_tables,
)
from netdesign.snow.snowpack import GRAVITY
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import Member
from netdesign.structure.row_position import (
    LoadedWidth,
    compute_edge_width,
    list_supports,
)
from netdesign.study.case_records import (
    FloorForceRecord,
    FloorRecord,
    GuidelineCase,
    GuidelineRecord,
    record_point,
)
from netdesign.units import (
    given_degree_from_radian,
    kilonewton_from_newton,
    kilonewton_if_known,
)
from netdesign.words.catalogue import name
from netdesign.words.message import Message, say


def list_corners(row: NetRow, ranges: Ranges) -> list[NetRow]:
    """Rows at all ends of what ranges beside the usual three and is in the load.

    The load knows no length of the snowpack.
    """
    names = [name for name in ranges.further if name != "upslope_length"]
    usual = {name: ranges[name].low for name in USUAL}
    ends = product(*({ranges[name].low, ranges[name].high} for name in names))
    return [
        row.at(Case.of({**usual, **dict(zip(names, end, strict=True))})) for end in ends
    ]


@dataclass(frozen=True, slots=True, kw_only=True)
class RowEffects:
    """Loaded widths and lateral load of the supports of a row.

    Attributes
    ----------
    supports : tuple of LoadedWidth
        One inside the row, and where the row has an end the one beside it and its
        first or last one.
    lateral_share : float
        Share of the load along the row [-].
    missing : tuple of Message
        What the profile does not say.
    open_end : Message or None
        Why nothing is known of the forces at an end that the row has.
    """

    supports: tuple[LoadedWidth, ...]
    lateral_share: float
    missing: tuple[Message, ...]
    open_end: Message | None = None

    def find_support(self, position: str) -> LoadedWidth:
        """Support at a position; the one inside the row where it has no other."""
        there = [support for support in self.supports if support.position == position]
        return (there or self.supports)[0]


def find_row_glide_factor(row: NetRow) -> float:
    """Glide factor by which the guideline loads a row; THEORY of the guideline.

    As typed [-], or that of its ground; never less than the least of the
    guideline's tables.
    """
    return find_glide_factors(row, row.snow_thickness)


def find_glide_factors(row: NetRow, snow_thickness: Number) -> Number:
    """Glide factor of a row under snow of another thickness, or of many [-]."""
    limits = load_glide_limits()
    if row.glide_factor is not None:
        return 0.0 * snow_thickness + max(row.glide_factor, limits[0])
    return find_glide_factor(row.ground, snow_thickness, limits)


def find_solved_ground(row: NetRow, law: CreepLaw) -> GroundLaw:
    """Ground that a row's forces are solved with; THEORY of the guideline, (G11).

    It slips at least as far as the least glide factor of the guideline's tables says,
    by the table of the creep law, or of the usual one where that has none.
    """
    if row.ground.kind == "free":
        return row.ground
    table = law.name if law.name in load_glide_tables() else DEFAULT_CREEP_LAW
    least = compute_slip_length(load_glide_limits()[0], row.snow_thickness, table)
    return GroundLaw(kind="sliding", slip_length=max(row.ground.slip_length, least))


def find_altitude_factor(row: NetRow) -> float:
    """Factor on the density of load case 1 at a row [-]; the largest if not known."""
    return compute_altitude_factor(read_load_model(load_guideline()), row.altitude)


def list_assumed(row: NetRow) -> list[Message]:
    """List the assumptions of the guideline's load about a row."""
    messages = []
    if row.altitude is None:
        messages.append(say("row.altitude_assumed", factor=find_altitude_factor(row)))
    glide = row.glide_factor
    if glide is None:
        anything = (1.0, LARGEST_GLIDE_FACTOR)
        glide = find_glide_factor(row.ground, row.snow_thickness, anything)
    least = load_glide_limits()[0]
    if glide < least:
        messages.append(say("row.glide_assumed", glide=glide, least=least))
    return messages


@lru_cache(maxsize=1)
def load_glide_limits() -> tuple[float, float]:
    """Least and largest glide factor of the guideline's tables [-]."""
    tables = [table for table in load_guideline().tables if table.id in GLIDE_FACTORS]
    factors = [row.value for table in tables for row in table.rows]
    return min(factors), max(factors)


def find_effects(row: NetRow, standard: Standard, ranges: Ranges) -> RowEffects:
    """Effects of the row's ends and of the load along the row, by the profile.

    At an end the largest N of all ranges counts; on ground of one slip length that is
    the N of the thinnest snow.
    """
    spacing = row.layout.post_spacing
    rule, share = read_end_effect(standard), standard.find(LATERAL_SHARE)
    edge = None
    if rule is not None and row.has_end:
        edge = compute_edge_width(
            rule,
            post_spacing=spacing,
            net_height=row.net_height,
            gap=row.gap,
            glide_factor=max(map(find_row_glide_factor, list_corners(row, ranges))),
        )
    lacks = [say("ends.no_end_effect")] if rule is None else []
    open_end = lacks[0] if lacks and row.has_end else None
    if share is None:
        lacks.append(say("ends.no_lateral_load", value=LATERAL_SHARE))
    return RowEffects(
        supports=list_supports(spacing, edge, row.post_count),
        lateral_share=share.value if share else 0.0,
        missing=tuple(lacks),
        open_end=open_end,
    )


def check_ends(effects: RowEffects) -> Check | None:
    """Leave the ends of a row open where the profile has no rule for their load."""
    if not effects.missing:
        return None
    return leave_open("ends", OpenKind.RESISTANCE_MISSING, *effects.missing)


def find_row_floors(
    row: NetRow, ranges: Ranges, standard: Standard, layouts: Sequence[SupportLayout]
) -> dict[SupportLayout, Floor | None]:
    """Forces that no demand of a row may lie below, on each of several layouts.

    None where a profile has no floor. The load model is the guideline's own, whatever
    the profile; that may add the dimensioning form.
    """
    if standard.floor == "none":
        return dict.fromkeys(layouts)
    model, nets = read_floor_model(standard), _list_nets(row, ranges)
    floors = find_floors(model, nets, row.altitude, layouts)
    return dict(zip(layouts, floors, strict=True))


def read_floor_model(standard: Standard) -> LoadModel:
    """Load model of the guideline, with the dimensioning form of a profile."""
    form = standard.find(DIMENSIONING)
    return read_load_model(load_guideline(), 1e3 * form.value if form else None)


def _list_nets(row: NetRow, ranges: Ranges) -> NetRanges:
    low, high = (_place_at(row, ranges, end) for end in ("low", "high"))
    span = ranges["inclination"]
    return NetRanges(
        net=build_geometry(row, span.low),
        inclinations=(span.low, span.high),
        thicknesses=(low.held_thickness, row.net_height),
        stiffnesses=(low.net_stiffness_per_m, high.net_stiffness_per_m),
        slacks=(low.slack, high.slack),
        find_glide_factors=lambda thickness: (
            find_glide_factors(low, thickness),
            find_glide_factors(high, thickness),
        ),
    )


def _place_at(row: NetRow, ranges: Ranges, end: Literal["low", "high"]) -> NetRow:
    """Row at one end of all ranges: the load is monotone in each."""
    values = {name: getattr(span, end) for name, span in ranges.intervals}
    return row.at(Case.of(values))


def build_geometry(row: NetRow, inclination: float) -> NetGeometry[float]:
    """Build the geometry of a net row for the guideline, at an inclination [rad]."""
    return NetGeometry(
        slope_angle=row.slope_angle,
        snow_thickness=row.held_thickness,
        net_height=row.net_height,
        inclination=inclination,
        stiffness=row.net_stiffness_per_m,
        slack=row.slack,
        layout=row.layout,
    )


def record_floor(
    floor: Floor | None, factors: tuple[float, float] = (1.0, 1.0)
) -> FloorRecord | None:
    """Floor of a row in engineer's units; factors on lower and ridge rope."""
    if floor is None:
        return None
    return FloorRecord(
        profile=load_guideline().id,
        forces=[_record_force(force) for force in floor.forces],
        reason=floor.reason,
        lower_rope=factors[0],
        ridge_rope=factors[1],
    )


def _record_force(force: FloorForce) -> FloorForceRecord:
    return FloorForceRecord(
        member=force.member,
        force_kN=kilonewton_from_newton(force.force),
        load_case=force.case.name,
        inclination_deg=given_degree_from_radian(force.net.inclination),
    )


_DECIMALS = 3  # of heights on the net [m]
_OTHER_DENSITY = 0.1  # share from which another density is told as a cause


def record_guideline(
    row: NetRow, foot: Extreme | None, standard: Standard
) -> GuidelineRecord | None:
    """Record the guideline's load cases against the case that loads the foot most.

    None where there is no solution to compare with.
    """
    result = foot.governing if foot else None
    if result is None or result.solution is None or not result.is_converged:
        return None
    row, case, solution = row.at(result.case), result.case, result.solution
    net = build_geometry(row, case.inclination)
    cases = compare_with_guideline(
        read_floor_model(standard),
        net,
        density=case.density,
        altitude=row.altitude,
        glide_factors=(
            find_row_glide_factor(row),
            find_glide_factors(row, row.net_height),
        ),
    )
    force = result.member_forces[Member.FOOT_ANCHOR].value
    heights = solution.net_curve[1].round(_DECIMALS).tolist()
    pairs = zip(heights, _list_pressures(solution), strict=True)
    return GuidelineRecord(
        case=record_point(case),
        solved_load_kN_per_m=kilonewton_from_newton(solution.foot.x + solution.head.x),
        solved_foot_anchor_kN=kilonewton_from_newton(force),
        cases=[_record_case(case, net) for case in cases],
        sentence=_explain_difference(row, case, force, cases),
        along_net=[(y, pressure) for y, pressure in pairs if pressure is not None],
    )


def _explain_difference(
    row: NetRow, case: Case, foot: float, cases: Sequence[GuidelineResult]
) -> Message:
    """Sentence on the larger of the two at the foot, its excess and known cause."""
    same, *governing = cases
    largest = max(governing, key=lambda each: each.foot or 0.0)
    other = largest.foot
    if not other or foot <= 0.0 or same.load is None:
        return _name_cause(row)
    key = "guideline.larger" if other > foot else "guideline.smaller"
    return say(
        key,
        case=name("load_case", largest.case.name),
        guideline=kilonewton_from_newton(other),
        coupled=kilonewton_from_newton(foot),
        percent=100.0 * (max(other, foot) / min(other, foot) - 1.0),
        causes=_list_causes(row, case, same, largest),
    )


def _list_causes(
    row: NetRow, case: Case, same: GuidelineResult, largest: GuidelineResult
) -> tuple[Message, ...]:
    """Causes that the numbers show: density, length; else those of ground and law."""
    causes = []
    density = largest.case.density
    if not math.isclose(density, case.density, rel_tol=_OTHER_DENSITY):
        numbers = {"guideline": density, "coupled": case.density}
        causes.append(say("guideline.other_density", **numbers))
    push = case.density * GRAVITY * row.snow_thickness * math.sin(row.slope_angle)
    weight = push * row.upslope_length
    load = same.load.resultant[0] if same.load else 0.0
    if load > weight:
        length = {
            "length": row.upslope_length,
            "load": kilonewton_from_newton(load),
            "weight": kilonewton_from_newton(weight),
        }
        causes.append(say("guideline.knows_no_length", **length))
    else:
        causes.append(_name_cause(row))
    return tuple(causes)


def _name_cause(row: NetRow) -> Message:
    is_free = row.ground.kind == "free"
    return say("guideline.on_free_ground" if is_free else "guideline.on_sliding_ground")


def _record_case(result: GuidelineResult, net: NetGeometry[float]) -> GuidelineCase:
    snow = result.load
    along = snow.resultant[0] if snow else None
    filled = result.case.height_vertical * math.cos(net.slope_angle) / net.net_height
    return GuidelineCase(
        name=result.case.name,
        density_kg_m3=result.case.density,
        loaded_share=result.case.settled * min(filled, 1.0),
        glide_factor=snow.glide_factor if snow else None,
        reason=result.reason,
        load_kN_per_m=kilonewton_if_known(along),
        foot_anchor_kN=kilonewton_if_known(result.foot),
    )


_PRESSURE_DECIMALS = 3  # [kPa]


def _list_pressures(net: NetState) -> list[float | None]:
    """Pressure of the snow on each net point [kPa]; None where it is not known."""
    face = find_net_face(net)
    values = (face.pressures[face.inner] / 1e3).round(_PRESSURE_DECIMALS).tolist()
    before = face.inner.start
    after = net.net_curve.shape[1] - before - len(values)
    return [*[None] * before, *values, *[None] * after]
