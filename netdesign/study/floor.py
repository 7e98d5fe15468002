"""The guideline's load as the floor of a row's demands, with what it follows from."""

from __future__ import annotations

from typing import Literal

from netdesign.checks import Standard
from netdesign.envelope.ranges import Case, Ranges
from netdesign.guideline.comparison import NetGeometry
from netdesign.guideline.floor import (
    Floor,
    FloorEnd,
    FloorForce,
    NetRanges,
    bound_floor,
    find_floor,
)
from netdesign.guideline.load_model import read_load_model
from netdesign.site.model import NetRow
from netdesign.study.effects import (
    find_altitude_factor,
    find_glide_factors,
    list_assumed,
    load_guideline,
)
from netdesign.study.guideline_records import FloorForceRecord, FloorRecord
from netdesign.units import given_degree_from_radian, kilonewton_from_newton


def find_row_floor(row: NetRow, ranges: Ranges, standard: Standard) -> Floor | None:
    """Forces that no demand of a row may lie below; None where a profile has no floor.

    The load model is the guideline's own, whatever the profile.
    """
    if standard.floor == "none":
        return None
    model = read_load_model(load_guideline())
    return find_floor(model, _list_nets(row, ranges), row.altitude)


def bound_row_floor(
    row: NetRow, ranges: Ranges, standard: Standard
) -> tuple[FloorEnd, FloorEnd] | None:
    """Ends between which the forces of `find_row_floor` lie; None where not known."""
    if standard.floor == "none":
        return None
    model = read_load_model(load_guideline())
    return bound_floor(model, _list_nets(row, ranges), row.altitude)


def _list_nets(row: NetRow, ranges: Ranges) -> NetRanges:
    low, high = (_place_at(row, ranges, end) for end in ("low", "high"))
    span = ranges["inclination"]
    return NetRanges(
        net=build_geometry(row, span.low),
        inclinations=(span.low, span.high),
        thicknesses=(low.snow_thickness, high.snow_thickness),
        stiffnesses=(low.net_stiffness_per_m, high.net_stiffness_per_m),
        slacks=(low.slack, high.slack),
        find_glide_factors=lambda thickness: (
            find_glide_factors(low, thickness),
            find_glide_factors(high, thickness),
        ),
    )


def _place_at(row: NetRow, ranges: Ranges, end: Literal["low", "high"]) -> NetRow:
    """Row at one end of all ranges; the load rises with each, or falls."""
    values = {name: getattr(span, end) for name, span in ranges.intervals}
    return row.at(Case.of(values))


def build_geometry(row: NetRow, inclination: float) -> NetGeometry[float]:
    """Net row as the guideline needs it, at an inclination [rad]."""
    return NetGeometry(
        slope_angle=row.slope_angle,
        snow_thickness=row.held_thickness,
        net_height=row.net_height,
        inclination=inclination,
        stiffness=row.net_stiffness_per_m,
        slack=row.slack,
        layout=row.layout,
    )


def record_floor(floor: Floor | None, row: NetRow) -> FloorRecord | None:
    """Floor of a row in engineer's units, each force with what it follows from."""
    if floor is None:
        return None
    standard = load_guideline()
    return FloorRecord(
        profile=standard.id,
        sha256=standard.sha256,
        forces=[_record_force(one) for one in floor.forces],
        altitude_factor=find_altitude_factor(row),
        assumed=list_assumed(row),
        reason=floor.reason,
    )


def _record_force(one: FloorForce) -> FloorForceRecord:
    along, across = one.load.resultant
    return FloorForceRecord(
        member=one.member,
        force_kN=kilonewton_from_newton(one.force),
        load_case=one.case.name,
        inclination_deg=given_degree_from_radian(one.at.net.inclination),
        snow_thickness_m=one.at.net.snow_thickness,
        slack=one.at.net.slack,
        stiffness_kN_per_m=kilonewton_from_newton(one.at.net.stiffness),
        density_kg_m3=one.case.density,
        height_vertical_m=one.case.height_vertical,
        creep_factor=one.load.creep_factor,
        glide_factor=one.load.glide_factor,
        load_along_kN_per_m=kilonewton_from_newton(along),
        load_across_kN_per_m=kilonewton_from_newton(across),
        chord_tension_kN_per_m=kilonewton_from_newton(one.pull.chord_tension),
    )
