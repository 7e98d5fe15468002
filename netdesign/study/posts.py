"""Posts of a row: compression beside the snow that presses on them, and the ground.

Theory: resistance/THEORY.md, (R5) and (R10) to (R11b).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from netdesign.checks import Standard
from netdesign.checks.comparison import lack_factor
from netdesign.checks.schema import (
    ACTION_FACTOR,
    POST_EFFICIENCY,
    POST_EFFICIENCY_GROWTH,
)
from netdesign.envelope.ranges import Ranges
from netdesign.guideline.load_cases import LoadCase, list_cases
from netdesign.guideline.load_model import (
    SnowLoad,
    compute_snow_load,
    load_guideline,
    read_load_model,
)
from netdesign.outcome import ModelError
from netdesign.resistance.post import (
    PostSection,
    compute_bent_post_resistance,
    compute_post_moment,
)
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.guideline_load import (
    build_geometry,
    find_glide_factors,
    list_corners,
    load_glide_limits,
)
from netdesign.study.load_along_row import place_row
from netdesign.study.row_to_check import Basis
from netdesign.units import degree_from_radian, kilonewton_from_newton
from netdesign.words.message import Message, say

# Share of a post that the buckling length of its type may lack: lengths are rounded.
_ROUNDED = 0.01


def find_short_post(resistance: Resistance, basis: Basis) -> Message | None:
    """Reason why the resistance of a post does not hold: the row's post is longer.

    Theory: resistance/THEORY.md, (R5). The post is longest at one end of the net's
    inclinations.
    """
    if resistance.buckling_length is None:
        return None
    span = basis.site.ranges["inclination"]
    places = (
        place_row(basis.row, inclination) for inclination in (span.low, span.high)
    )
    longest = max(place.post_length for place in places)
    if resistance.buckling_length >= (1.0 - _ROUNDED) * longest:
        return None
    return say(
        "check.short_buckling",
        type=resistance.type_id,
        length=resistance.buckling_length,
        post=longest,
    )


def find_post_resistance(
    resistance: Resistance, section: PostSection, basis: Basis, width: LoadedWidth
) -> Resistance:
    """Compression that a post bears beside the snow on it; (R10) to (R11b).

    The value is that of the largest eta, and ``best`` that of the least.
    """
    standard, row = basis.standard, basis.row
    on_action = standard.find(ACTION_FACTOR)
    on_post = standard.find_resistance_factor(resistance.mode, resistance.basis)
    spacing = row.layout.post_spacing
    efficiencies = _list_efficiencies(standard, width, spacing)
    if isinstance(efficiencies, Message):
        return replace(resistance, lack=efficiencies)
    if on_action is None or on_post is None:
        return resistance
    factors = (on_action.value, on_post.value)
    try:
        least, most = (
            _load_post(section, row, basis.site.ranges, eta, factors)
            for eta in efficiencies
        )
    except ModelError as error:  # outside the guideline's closed forms
        return replace(resistance, lack=error.message)
    if least.value is None:
        return replace(resistance, lack=say("post_bending.too_much", **most.numbers))
    borne = least if most.value is None else most  # none is left at the worse end
    derivation = say("post_bending.beside", **borne.numbers)
    bent = replace(resistance, value=borne.value, derivation=derivation)
    low, high = (post.numbers["efficiency"] for post in (least, most))
    if low == high:
        return bent
    if most.value is None:
        return replace(
            bent, open=say("post_bending.too_much_at_most", low=low, high=high)
        )
    open_point = say("post_bending.assumed", low=low, high=high)
    return replace(bent, best=least.value, open=open_point)


@dataclass(frozen=True, slots=True)
class _Efficiency:
    """Factor of the line load on a post, by the glide factor; (R10a).

    Snow that presses round the edge of a net, 1 + f_R, is the same snow as that which
    presses round a member: the larger one counts, not their product.
    """

    least: float = 1.0
    growth: float = 0.0
    at_edge: float = 0.0

    def at(self, glide: float) -> float:
        """Factor eta at a glide factor [-]."""
        beyond = max(0.0, glide - load_glide_limits()[0])
        return max(self.least + self.growth * beyond, self.at_edge)


def _list_efficiencies(
    standard: Standard, width: LoadedWidth, spacing: float
) -> tuple[_Efficiency, _Efficiency] | Message:
    """Least and largest factor of the line load on a post; or what is lacking."""
    is_second = width.position == "second" and width.end_length >= spacing
    is_pressed = width.position == "edge" or is_second
    at_edge = 1.0 + width.end_factor if is_pressed else 0.0
    least, growth = map(standard.find, (POST_EFFICIENCY, POST_EFFICIENCY_GROWTH))
    if least is None or growth is None:
        return lack_factor(POST_EFFICIENCY_GROWTH if least else POST_EFFICIENCY)
    low = _Efficiency(least.value, at_edge=at_edge)
    return low, replace(low, growth=growth.value)


@dataclass(frozen=True, slots=True, kw_only=True)
class _LoadedPost:
    """Compression that a post bears under one line load [N], and what it follows from.

    None where the snow's moment alone is too much.
    """

    value: float | None
    numbers: Mapping[str, float | Message | str]


def _load_post(
    section: PostSection,
    row: NetRow,
    ranges: Ranges,
    efficiency: _Efficiency,
    factors: tuple[float, float],
) -> _LoadedPost:
    on_action, on_post = factors
    pressure, case, load = find_snow_pressure(row, ranges, efficiency)
    eta = efficiency.at(load.glide_factor)
    moment = compute_post_moment(section, pressure=pressure, efficiency=eta)
    value = compute_bent_post_resistance(
        section, moment=on_action * moment, partial_factor=on_post
    )
    return _LoadedPost(
        value=value,
        numbers={
            "efficiency": eta,
            "pressure": pressure / 1e3,
            "density": case.density,
            "gravity": read_load_model(load_guideline()).gravity,
            "height": case.height_vertical,
            "creep": load.creep_factor,
            "glide": load.glide_factor,
            "settled": case.settled,
            "slope": degree_from_radian(row.slope_angle),
            "modulus": 1e6 * section.modulus,
            "strength": section.strength / 1e6,
            "width": 1e3 * section.width,
            "length": section.length,
            "head": 1e3 * section.at_head,
            "foot": 1e3 * section.at_foot,
            "assumed": _name_assumed(section),
            "moment": moment / 1e3,
            "resistance": section.moment_resistance / 1e3,
            "buckling": kilonewton_from_newton(section.buckling),
            "critical": kilonewton_from_newton(section.critical),
            "action": on_action,
            "factor": on_post,
        },
    )


def _name_assumed(section: PostSection) -> Message | str:
    """Name the assumed inputs of a post; "" where all are given."""
    names = tuple(say(f"column.Posts.{key}") for key in section.assumed)
    return say("post_bending.not_given", names=names) if names else ""


# Mean pressure of snow on a plane across the slope [Pa], and the load it is of.
SnowPressure = tuple[float, LoadCase[float], SnowLoad[float]]


def find_snow_pressure(
    row: NetRow, ranges: Ranges, efficiency: _Efficiency = _Efficiency()
) -> SnowPressure:
    """Mean pressure of the snow on a plane across the slope, where it is largest.

    The guideline's S'_N over the height on which it acts: of its two load cases for the
    net's height, and of the densest snow, over the ranges of height and glide factor.
    Theory: resistance/THEORY.md, (R10).

    Parameters
    ----------
    row : NetRow
        Whose snow it is.
    ranges : Ranges
        Of the site.
    efficiency : _Efficiency
        Factor with which the pressure is largest; 1 unless told otherwise.
    """
    pressures = (
        _press(corner, case)
        for corner in list_corners(row, ranges)
        for case in list_cases(
            read_load_model(load_guideline()),
            build_geometry(corner, 0.0),
            density=ranges["density"].high,
            altitude=corner.altitude,
        )
    )
    return max(
        pressures,
        key=lambda pressure: efficiency.at(pressure[2].glide_factor) * pressure[0],
    )


def _press(row: NetRow, case: LoadCase[float]) -> SnowPressure:
    thickness = case.height_vertical * math.cos(row.slope_angle)
    load = compute_snow_load(
        read_load_model(load_guideline()),
        density=case.density,
        height_vertical=case.height_vertical,
        slope_angle=row.slope_angle,
        glide_factor=find_glide_factors(row, thickness),
        net_height=row.net_height,
        inclination=0.0,
    )
    return load.rigid / (case.settled * thickness), case, load
