"""Parameters of a fit: what it may change of a row and its snow, with priors.

Theory: winter/THEORY.md, section 7.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import Literal, get_args

from netdesign.cable.net import LARGEST_FRICTION_ANGLE, LARGEST_SLACK, Net
from netdesign.outcome import ModelError
from netdesign.winter.day import HEIGHT_FACTORS, RowDay, WinterRow
from netdesign.winter.gauss_newton import Parameter
from netdesign.winter.layers import LEAST_DENSITY
from netdesign.words.message import say

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
