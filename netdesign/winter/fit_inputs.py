"""Inputs of a fit: readings with their noise, parameters with their priors.

Theory: winter/THEORY.md, section 7.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from netdesign.cable.net import LARGEST_FRICTION_ANGLE, LARGEST_SLACK, Net
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError, require_positive, require_within
from netdesign.snowpack.series import HeightSeries
from netdesign.winter.day import HEIGHT_FACTORS, LEAST_DENSITY, RowDay, WinterRow
from netdesign.winter.gauss_newton import Parameter
from netdesign.winter.measured import ASSUMED_AMPLITUDE, MeasuredPulls
from netdesign.words.message import say

DAYS_APART = 5  # readings of neighbouring days are one another's copies: one in so many
MOST_DAYS = 17
LEAST_DAYS = 5  # fewer say nothing of the misfit (assumed)
# Days of thinner snow, over the thickest of them, and weaker readings of a member,
# over its largest, are not taken: small forces are all noise (assumed).
THICK_SHARE = 0.5
STRONG_SHARE = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class Noise:
    """Deviations of a reading from a chain that is right (defaults assumed).

    Attributes
    ----------
    reading : float
        Of each reading on its own, over the force [-].
    cell : float
        Of all readings of one member in common, over the force: its load cell [-].
    rope : float
        Amplitude of the day's wave of rope temperature [K].
    """

    reading: float = 0.05
    cell: float = 0.05
    rope: float = ASSUMED_AMPLITUDE

    def __post_init__(self) -> None:
        """Refuse noise that no load cell has, and none at all.

        Raises
        ------
        ModelError
            If it is so.
        """
        require_positive("noise of a reading", self.reading)
        require_within("noise of a reading", self.reading, 1e-6, 0.5)
        require_within("common error of a cell", self.cell, 0.0, 0.5)
        require_within("wave of rope temperature", self.rope, 0.0, 30.0, "K")


@dataclass(frozen=True, slots=True, kw_only=True)
class FitReading:
    """Force measured at one member on one day.

    Attributes
    ----------
    index : int
        Place of the day in the series of heights.
    member : str
        As in ``RowDay.member_forces``.
    force : float
        Mean of the day, per anchor [N].
    """

    index: int
    member: str
    force: float


def choose_readings(
    measured: Sequence[MeasuredPulls], series: HeightSeries, days: Sequence[RowDay]
) -> tuple[FitReading, ...]:
    """Readings of a few days of one winter, far enough apart to count each for itself.

    Parameters
    ----------
    measured : sequence of MeasuredPulls
        One for each member.
    series : HeightSeries
        Of the station.
    days : sequence of RowDay
        Of the winter, prepared, ascending; those that are not ``open`` are left out.
    """
    strong = _list_strong(measured, series)
    usable = [day for day in days if day.is_open and day.index in strong]
    thickest = max((day.thickness for day in usable), default=0.0)
    thick = [d.index for d in usable if d.thickness >= THICK_SHARE * thickest]
    if not thick:
        return ()
    spacing = max(DAYS_APART, -(-(thick[-1] - thick[0]) // (MOST_DAYS - 1)))
    chosen: list[int] = []
    for index in thick:
        if not chosen or index - chosen[-1] >= spacing:
            chosen.append(index)
    return tuple(reading for index in chosen for reading in strong[index])


def build_covariance(
    readings: Sequence[FitReading], noise: Noise, swings: Mapping[int, float]
) -> Floats:
    """Covariance of the logarithms of readings, eq. (Y11), (n_readings, n_readings).

    Parameters
    ----------
    readings : sequence of FitReading
        At least one.
    noise : Noise
        Its parts.
    swings : mapping of int to float
        Swing of a support's force by the day's rope temperature [N], by day.
    """
    forces = np.array([one.force for one in readings])
    members = np.array([one.member for one in readings])
    swing = np.array([swings[one.index] for one in readings])
    alone = noise.reading**2 + (swing / forces) ** 2 / 2.0  # of a wave, at any hour
    is_same = members[:, None] == members[None, :]
    return np.asarray(np.diag(alone) + noise.cell**2 * is_same)


def _list_strong(
    measured: Sequence[MeasuredPulls], series: HeightSeries
) -> dict[int, list[FitReading]]:
    """Daily means by their day, of each member those that are not small."""
    found: dict[int, list[FitReading]] = {}
    for one in measured:
        means = one.average_days(series)
        least = STRONG_SHARE * max(means.values(), default=0.0)
        for index, force in means.items():
            if force > least:
                reading = FitReading(index=index, member=one.member, force=force)
                found.setdefault(index, []).append(reading)
    return found


ParameterName = Literal[
    "slip_length", "density_factor", "height_factor", "slack", "friction_angle"
]
PARAMETER_NAMES: tuple[ParameterName, ...] = get_args(ParameterName)
LOGARITHMIC = ("slip_length", "density_factor", "height_factor")  # fitted as ln
# Deviations of the priors, those of ln where fitted so (assumed: what a site visit
# and a settling model leave open).
PRIOR_DEVIATIONS: Mapping[str, float] = {
    "slip_length": 1.5,
    "density_factor": 0.10,
    "height_factor": 0.08,
    "slack": 0.015,
    "friction_angle": math.radians(10.0),
}
# Differences of the slopes: small beside the priors, large beside the solver's noise.
_STEPS: Mapping[str, float] = {
    "slip_length": 0.2,
    "density_factor": 0.02,
    "height_factor": 0.02,
    "slack": 0.002,
    "friction_angle": math.radians(2.0),
}


def list_parameters(
    row: WinterRow, known: Collection[str], thickest: float
) -> tuple[Parameter, ...]:
    """Parameters of a fit with their priors; the slip length only of sliding ground.

    Parameters
    ----------
    row : WinterRow
        As designed: means of the priors.
    known : collection of str
        Parameters that were surveyed: they stay as they are.
    thickest : float
        Snow of the thickest day of the fit [m]; it stays below the net's head.

    Raises
    ------
    ModelError
        If the row has a wall.
    """
    net = _require_net(row)
    room = math.log(net.height_normal / thickest)
    height = math.log(row.height_factor)
    ends: dict[str, tuple[float, float]] = {
        "height_factor": (math.log(HEIGHT_FACTORS[0]), height + room),
        "slack": (0.0, LARGEST_SLACK),
        "friction_angle": (0.0, LARGEST_FRICTION_ANGLE),
    }
    means: dict[str, float] = {
        "density_factor": 0.0,
        "height_factor": height,
        "slack": net.slack,
        "friction_angle": net.friction_angle,
    }
    if row.scene.ground.kind == "sliding":
        means["slip_length"] = math.log(row.scene.ground.slip_length)
    return tuple(
        Parameter(
            name=name,
            mean=means[name],
            deviation=PRIOR_DEVIATIONS[name],
            low=ends.get(name, (-math.inf, math.inf))[0],
            high=ends.get(name, (-math.inf, math.inf))[1],
            step=_STEPS[name],
        )
        for name in PARAMETER_NAMES
        if name in means and name not in known
    )


def vary_row(row: WinterRow, values: Mapping[str, float]) -> WinterRow:
    """Row with its ground and net as some parameters have them.

    Parameters
    ----------
    row : WinterRow
        As designed.
    values : mapping of str to float
        [-], of slip length ln m, of the friction angle [rad]; what is not named stays.

    Raises
    ------
    ModelError
        If there is no such net.
    """
    scene, net = row.scene, _require_net(row)
    ground = scene.ground
    if "slip_length" in values:
        ground = replace(ground, slip_length=math.exp(values["slip_length"]))
    net = replace(
        net,
        slack=values.get("slack", net.slack),
        friction_angle=values.get("friction_angle", net.friction_angle),
    )
    return replace(row, scene=replace(scene, net=net, ground=ground))


def vary_day(day: RowDay, row: WinterRow, values: Mapping[str, float]) -> RowDay:
    """Day with its snow scaled, eq. (Y10): no layers are joined anew.

    Parameters
    ----------
    day : RowDay
        As prepared for the row as designed.
    row : WinterRow
        That row.
    values : mapping of str to float
        Logarithms of the factors [-].
    """
    height = values.get("height_factor", math.log(row.height_factor))
    taller = math.exp(height) / row.height_factor
    denser = math.exp(values.get("density_factor", 0.0))
    return replace(
        day,
        thickness=day.thickness * taller,
        density=_scale_density(day.density, denser),
        layers=tuple(
            replace(
                layer,
                thickness=layer.thickness * taller,
                density=_scale_density(layer.density, denser),
            )
            for layer in day.layers
        ),
    )


def _scale_density(density: float, factor: float) -> float:
    """Density no fit makes lighter than the law knows; what was lighter stays so."""
    return max(min(density, LEAST_DENSITY), density * factor)


def show_value(name: str, value: float) -> float:
    """Value of a parameter in SI units, from the unit it is fitted in.

    Parameters
    ----------
    name : str
        Of the parameter.
    value : float
        As fitted [-], of slip length ln m, of the friction angle [rad].
    """
    return math.exp(value) if name in LOGARITHMIC else value


def _require_net(row: WinterRow) -> Net:
    if not isinstance(row.scene.net, Net):
        raise ModelError(say("steady.needs_net"))
    return row.scene.net
