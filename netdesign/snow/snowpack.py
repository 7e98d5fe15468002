"""The snowpack that hangs on a net: geometry, density, gravity."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import (
    ModelError,
    name_quantity,
    require_one_of,
    require_positive,
    require_within,
)
from netdesign.snow.creep_law import DENSEST_SNOW, ICE_DENSITY
from netdesign.words.message import say

GRAVITY = 9.81  # [m/s2]
LIGHTEST_SNOW = 10.0  # new and dry; a number of g/cm3 falls below [kg/m3]
STEEPEST_SLOPE = math.radians(80.0)  # beyond it no snowpack of this shape stands

GravityMode = Literal["full", "parallel"]


_LAYER_SUM_TOLERANCE = 1e-6
THINNEST_LAYER = 0.02  # over the thickness of the snowpack


@dataclass(frozen=True, slots=True, kw_only=True)
class Layer:
    """One layer of snow, parallel to the slope.

    Attributes
    ----------
    thickness : float
        Normal to the slope [m].
    density : float
        rho [kg/m3].
    temperature : float or None
        [K]; None where the scene's fluidity holds.
    """

    thickness: float
    density: float
    temperature: float | None = None

    def __post_init__(self) -> None:
        """Refuse values that no layer has."""
        require_positive("layer thickness", self.thickness, "m")
        _require_snow_density("layer density", self.density)


@dataclass(frozen=True, slots=True, kw_only=True)
class Snowpack:
    """Snowpack of uniform or layered density on a plane slope.

    Attributes
    ----------
    slope_angle : float
        psi [rad].
    thickness : float
        d, normal to the slope [m].
    upslope_length : float
        L, snowpack carried by the net, measured on the ground [m].
    density : float
        rho [kg/m3]; of layered snow the mean.
    layers : tuple of Layer
        From the ground up; empty for uniform snow. ``build_layered_snowpack`` makes
        thickness and mean density from them.
    gravity : str
        ``full``, or ``parallel``: only the component along the slope.
    """

    slope_angle: float
    thickness: float
    upslope_length: float
    density: float
    layers: tuple[Layer, ...] = ()
    gravity: GravityMode = "full"

    def __post_init__(self) -> None:
        """Refuse values that no snowpack has."""
        require_within("slope angle", self.slope_angle, 0.0, STEEPEST_SLOPE, "rad")
        require_positive("snow thickness", self.thickness, "m")
        require_positive("upslope length", self.upslope_length, "m")
        require_one_of("gravity mode", self.gravity, ("full", "parallel"))
        _require_snow_density("snow density", self.density)
        if self.layers:
            self._require_layers_add_up()

    def _require_layers_add_up(self) -> None:
        thickness = _sum_thickness(self.layers)
        density = compute_mean_density(self.layers)
        for name, total, stated, unit in (
            ("layer thicknesses", thickness, self.thickness, "m"),
            ("mean layer density", density, self.density, "kg/m3"),
        ):
            if not abs(total - stated) <= _LAYER_SUM_TOLERANCE * stated:
                raise ModelError(
                    say(
                        "snow.layers_add_up",
                        name=name_quantity(name),
                        total=total,
                        given=stated,
                        unit=unit,
                    )
                )
        thinnest = min(layer.thickness for layer in self.layers)
        require_within(
            "layer thickness over snow thickness",
            thinnest / self.thickness,
            THINNEST_LAYER,
            1.0,
        )

    @property
    def aspect(self) -> float:
        """Upslope length over thickness [-]."""
        return self.upslope_length / self.thickness

    @property
    def relative_density(self) -> float:
        """D, density against ice [-]."""
        return self.density / ICE_DENSITY

    @property
    def gravity_direction(self) -> tuple[float, float]:
        """Gravity over g in the slope's axes [-]."""
        normal = -math.cos(self.slope_angle) if self.gravity == "full" else 0.0
        return math.sin(self.slope_angle), normal

    @property
    def stress_scale(self) -> float:
        """Rho g d [Pa], the scale of every stress in the snowpack."""
        return self.density * GRAVITY * self.thickness


def build_layered_snowpack(
    layers: tuple[Layer, ...],
    *,
    slope_angle: float,
    upslope_length: float,
    gravity: GravityMode = "full",
) -> Snowpack:
    """Snowpack of given layers.

    Parameters
    ----------
    layers : tuple of Layer
        From the ground up; at least one.
    slope_angle : float
        psi [rad].
    upslope_length : float
        L [m].
    gravity : str
        ``full`` or ``parallel``.

    Raises
    ------
    ModelError
        If there is no layer, or a number is out of its range.
    """
    if not layers:
        raise ModelError(say("snow.no_layer"))
    return Snowpack(
        slope_angle=slope_angle,
        thickness=_sum_thickness(layers),
        upslope_length=upslope_length,
        density=compute_mean_density(layers),
        layers=layers,
        gravity=gravity,
    )


def scale_layers(
    layers: tuple[Layer, ...], thickness: float, mean_density: float
) -> tuple[Layer, ...]:
    """Layers of another total thickness and mean density, in their proportions.

    Parameters
    ----------
    layers : tuple of Layer
        From the ground up; at least one.
    thickness : float
        Of all layers together, normal to the slope [m].
    mean_density : float
        [kg/m3].
    """
    denser = mean_density / compute_mean_density(layers)
    thicker = thickness / _sum_thickness(layers)
    return tuple(
        replace(
            layer,
            thickness=layer.thickness * thicker,
            density=layer.density * denser,
        )
        for layer in layers
    )


def _sum_thickness(layers: tuple[Layer, ...]) -> float:
    return sum(layer.thickness for layer in layers)


def compute_mean_density(layers: tuple[Layer, ...]) -> float:
    """Mean density over the thickness of the layers.

    Parameters
    ----------
    layers : tuple of Layer
        At least one.

    Returns
    -------
    float
        [kg/m3].
    """
    mass = sum(layer.density * layer.thickness for layer in layers)
    return mass / _sum_thickness(layers)


def _require_snow_density(name: str, density: float) -> None:
    densest = DENSEST_SNOW * ICE_DENSITY
    if not LIGHTEST_SNOW <= density <= densest:
        raise ModelError(
            say(
                "snow.density_limit",
                name=name_quantity(name),
                density=density,
                lightest=LIGHTEST_SNOW,
                densest=densest,
                ice=ICE_DENSITY,
            )
        )


def compute_thickness(vertical_height: float, slope_angle: float) -> float:
    """Thickness, normal to the slope, of snow of a vertical height.

    Parameters
    ----------
    vertical_height : float
        H [m].
    slope_angle : float
        psi [rad].

    Returns
    -------
    float
        d [m].

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_positive("vertical snow height", vertical_height, "m")
    require_within("slope angle", slope_angle, 0.0, STEEPEST_SLOPE, "rad")
    return vertical_height * math.cos(slope_angle)


# JCSS Probabilistic Model Code, Part 2.12 (secondary).
_SETTLED, _FRESH = 5000.0, 1700.0  # unit weights [N/m3]
_DEPTH = 0.85  # [m]


def find_model_code_density(height: float) -> float:
    """Mean density of snow of some height [kg/m3], eq. (Y13).

    Parameters
    ----------
    height : float
        Vertical, above 0 [m].

    Raises
    ------
    ModelError
        If the height is not positive.
    """
    require_positive("snow height", height, "m")
    return _SETTLED / GRAVITY * float(_find_settled(np.array(height)))


def compare_densities(heights: Floats, height: float) -> Floats:
    """Mean densities of snow of some heights over that of one height [-], eq. (Y13).

    Parameters
    ----------
    heights : ndarray, shape (n,)
        Vertical, above 0 [m].
    height : float
        The one that they are compared with [m].

    Returns
    -------
    ndarray, shape (n,)
        One of each height [-].

    Raises
    ------
    ModelError
        If ``height`` is not positive.
    """
    require_positive("snow height", height, "m")
    result: Floats = _find_settled(heights) / _find_settled(np.array(height))
    return result


def _find_settled(heights: Floats) -> Floats:
    """Mean unit weight over that of settled snow [-]."""
    depth = heights / _DEPTH
    # ln(1 + c (exp(x) - 1)), without a large exponential
    rest = np.log(_FRESH / _SETTLED + (1.0 - _FRESH / _SETTLED) * np.exp(-depth))
    result: Floats = (depth + rest) / depth
    return result
