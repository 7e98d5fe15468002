"""The guideline's load as the floor of a row's demands, with what it follows from."""

from __future__ import annotations

from itertools import product

from netdesign.checks import Standard
from netdesign.envelope.ranges import USUAL, Case, Interval, Ranges
from netdesign.guideline.comparison import NetGeometry
from netdesign.guideline.floor import Floor, FloorForce, LoadedNet, find_floor
from netdesign.guideline.load_model import read_load_model
from netdesign.site.model import NetRow
from netdesign.study.effects import find_row_glide_factor, load_guideline
from netdesign.study.records import FloorForceRecord, FloorRecord
from netdesign.units import given_degree_from_radian, kilonewton_from_newton


def find_row_floor(row: NetRow, ranges: Ranges, standard: Standard) -> Floor | None:
    """Forces that no demand of a row may lie below; None where a profile has no floor.

    The load model is the guideline's own, whatever the profile.
    """
    if standard.floor == "none":
        return None
    span: Interval = ranges["inclination"]
    return find_floor(
        read_load_model(load_guideline()),
        [
            LoadedNet(
                net=build_geometry(one, span.low),
                glide_factor=find_row_glide_factor(one),
            )
            for one in list_corners(row, ranges)
        ],
        inclinations=(span.low, span.high),
        altitude=row.altitude,
    )


def list_corners(row: NetRow, ranges: Ranges) -> list[NetRow]:
    """Rows at all ends of what ranges beside the usual three and is in the load.

    The load knows no length of the snowpack.
    """
    names = [name for name in ranges.further if name != "upslope_length"]
    usual = {name: ranges[name].low for name in USUAL}
    ends = product(*({ranges[name].low, ranges[name].high} for name in names))
    return [
        row.at(Case.of({**usual, **dict(zip(names, one, strict=True))})) for one in ends
    ]


def build_geometry(row: NetRow, inclination: float) -> NetGeometry:
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


def record_floor(floor: Floor | None) -> FloorRecord | None:
    """Floor in engineer's units, each force with the load that it follows from."""
    if floor is None:
        return None
    standard = load_guideline()
    return FloorRecord(
        profile=standard.id,
        sha256=standard.sha256,
        forces=[_record_force(one) for one in floor.forces],
        reason=floor.reason,
    )


def _record_force(one: FloorForce) -> FloorForceRecord:
    along, across = one.load.resultant
    return FloorForceRecord(
        member=one.member,
        force_kN=kilonewton_from_newton(one.force),
        load_case=one.case.name,
        inclination_deg=given_degree_from_radian(one.at.net.inclination),
        density_kg_m3=one.case.density,
        height_vertical_m=one.case.height_vertical,
        creep_factor=one.load.creep_factor,
        glide_factor=one.load.glide_factor,
        load_along_kN_per_m=kilonewton_from_newton(along),
        load_across_kN_per_m=kilonewton_from_newton(across),
        chord_tension_kN_per_m=kilonewton_from_newton(one.pull.chord_tension),
    )
