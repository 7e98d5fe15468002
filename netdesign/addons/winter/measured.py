"""Measured forces beside the computed ones of a winter, with the ropes' thermal swing.

Theory: addons/winter/THEORY.md, section 6.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from netdesign.addons.winter.day import RowDay, WinterRow, build_day_scene
from netdesign.addons.winter.heights import HeightSeries, name_winter
from netdesign.addons.winter.monitoring_sheet import (
    MonitoringSeries,
    Readings,
    list_monitoring,
)
from netdesign.addons.winter.season import RowWinters, Season
from netdesign.checks.inputs import Band
from netdesign.coupling.scene import Scene
from netdesign.site.model import Site
from netdesign.words.message import Message, say

EXPANSION = 1.2e-5  # of steel [1/K]
ASSUMED_AMPLITUDE = 5.0  # [K]; a clear day in spring, where no temperature is known
_DAY_RATE = 2.0 * math.pi / 86400.0  # [1/s]
_WINDOW = 1.0  # days before and after, whose temperatures count
# Fits of (Y8) to histories of uniform snow, 0.3 and more of D* / d as measured.
_HALVING, _BY_SLIP, _FREE_HALVING = 10.0, 2.0, 0.1


def find_half_time(scene: Scene) -> float:
    """Time in which snow takes back half of a sudden pull [s], eq. (Y8).

    Parameters
    ----------
    scene : Scene
        Net with the snow of a day.
    """
    ground, pack = scene.ground, scene.snowpack
    if ground.kind == "free":
        factor = _FREE_HALVING
    else:
        slip = ground.slip_length / pack.thickness
        factor = _HALVING / (1.0 + _BY_SLIP * math.sqrt(slip))
    return factor * scene.force_scale / scene.net.stiffness_per_m * scene.time_scale


def find_swing(scene: Scene, amplitude: float) -> float:
    """Amplitude of the pull on a net's ends through a day [N/m], eq. (Y9).

    Parameters
    ----------
    scene : Scene
        Net with the snow of a day.
    amplitude : float
        Of the day's wave of temperature [K].
    """
    turns = _DAY_RATE * find_half_time(scene) / math.log(2.0)
    at_once = scene.net.stiffness_per_m * EXPANSION * amplitude
    return at_once * turns / math.hypot(1.0, turns)


def find_amplitude(
    temperatures: Sequence[tuple[float, float]], day: float
) -> float | None:
    """Half the range of the temperatures near a day [K]; None of fewer than two.

    Parameters
    ----------
    temperatures : sequence of (float, float)
        Time [d] and temperature [K], in any order.
    day : float
        [d].
    """
    near = [kelvin for time, kelvin in temperatures if abs(time - day) <= _WINDOW]
    return (max(near) - min(near)) / 2.0 if len(near) > 1 else None


_NOON = 0.5  # time of a day's own value [d]


@dataclass(frozen=True, slots=True, kw_only=True)
class ComputedForce:
    """Force of a member on one day of the chain, with the swing by temperature.

    Attributes
    ----------
    index : int
        Day in the series of heights.
    force : Band
        Of the steady state, with its numerical band [N].
    swing : float
        Amplitude by which the ropes' temperature moves it [N].
    is_assumed : bool
        No temperature is known near that day.
    """

    index: int
    force: Band
    swing: float
    is_assumed: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Comparison:
    """Measured and computed force of one member through one winter.

    Attributes
    ----------
    winter : str
        Which.
    series : MonitoringSeries
        All that was measured at the member.
    pulls, air : list of (datetime, float)
        Its readings in this winter [N], [K].
    computed : tuple of ComputedForce
        Of the days of the curve that have a force, ascending.
    """

    winter: str
    series: MonitoringSeries
    pulls: Readings
    air: Readings
    computed: tuple[ComputedForce, ...]


def compare_season(
    measured: MonitoringSeries, season: Season, row: WinterRow, series: HeightSeries
) -> Comparison | None:
    """Readings of a member beside the season's curve; None without any in its days.

    Parameters
    ----------
    measured : MonitoringSeries
        At one member.
    season : Season
        With its curve.
    row : WinterRow
        Of both.
    series : HeightSeries
        Of the station, with its air temperatures.
    """
    pulls, air = (
        [
            (moment, value)
            for moment, value in readings
            if season.days.start <= series.place(moment) < season.days.stop
        ]
        for readings in (measured.pulls, measured.air)
    )
    if not pulls:
        return None
    warmth = [
        (place + _NOON, kelvin)
        for place, kelvin in enumerate(series.air_temperatures)
        if kelvin is not None
    ]
    warmth += [(series.place(moment), kelvin) for moment, kelvin in air]
    computed = tuple(
        force
        for day in season.curve
        if (force := _compute(day, measured.member, row, warmth)) is not None
    )
    return Comparison(
        winter=season.name, series=measured, pulls=pulls, air=air, computed=computed
    )


def _compute(
    day: RowDay, member: str, row: WinterRow, warmth: Sequence[tuple[float, float]]
) -> ComputedForce | None:
    """Force of a member, and its swing in proportion to the pull that it follows."""
    if day.ending in ("bare", "thin"):
        nothing = Band(low=0.0, value=0.0, high=0.0)
        return ComputedForce(
            index=day.index, force=nothing, swing=0.0, is_assumed=False
        )
    force, pull = day.member_forces.get(member), day.head
    if member == "foot_anchor":
        pull = day.foot
    if force is None or pull is None:
        return None
    half_range = find_amplitude(warmth, day.index + _NOON)
    amplitude = ASSUMED_AMPLITUDE if half_range is None else half_range
    scene = build_day_scene(row.scene, replace(day, layers=()))
    share = find_swing(scene, amplitude) / pull.value if pull.value else 0.0
    return ComputedForce(
        index=day.index,
        force=force,
        swing=share * force.value,
        is_assumed=half_range is None,
    )


def list_measured_pulls(site: Site, row_id: str) -> tuple[MonitoringSeries, ...]:
    """Forces measured on a row, one value for each member.

    Readings without a date, and series of air temperature alone, are left out.

    Parameters
    ----------
    site : Site
        Whose sheet Monitoring was read.
    row_id : str
        Of the row.
    """
    return tuple(series for series in list_monitoring(site, row_id) if series.pulls)


def name_measured_winters(measured: Sequence[MonitoringSeries]) -> frozenset[str]:
    """Winters with readings, as "1999/2000".

    Parameters
    ----------
    measured : sequence of MonitoringSeries
        Of a row.
    """
    return frozenset(
        name_winter(moment) for series in measured for moment, _ in series.pulls
    )


def compare_row(
    site: Site, winters: RowWinters, series: HeightSeries
) -> tuple[Comparison, ...]:
    """Readings of a row beside its curves, winter by winter and member by member.

    Parameters
    ----------
    site : Site
        With what was measured.
    winters : RowWinters
        Of the row, with the curves of the measured winters.
    series : HeightSeries
        Of the station.
    """
    comparisons = [
        compare_season(measured, season, winters.row, series)
        for season in winters.seasons
        for measured in list_measured_pulls(site, winters.row.id)
    ]
    return tuple(pair for pair in comparisons if pair is not None)


def explain_unused(
    site: Site, row_id: str, compared: Sequence[Comparison]
) -> tuple[Message, ...]:
    """Reasons why measured forces of a row stand beside no curve.

    Parameters
    ----------
    site : Site
        With what was measured.
    row_id : str
        Of the row.
    compared : sequence of Comparison
        What stands beside a curve.
    """
    used = {comparison.series.source for comparison in compared if comparison.computed}
    keys = {
        series.source: "monitoring.outside" if series.start else "monitoring.undated"
        for series in list_monitoring(site, row_id)
        if any(force is not None for force in series.tensions)
    }
    return tuple(
        say(key, place=place) for place, key in keys.items() if place not in used
    )
