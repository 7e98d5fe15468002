"""Snow pressure of a guideline, and the pulls of a net under it on its two ends.

Closed forms with the numbers of a profile. The guideline gives the load; the pulls
follow from stiffness and slack of the net as a shallow elastic cable.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Generic

from netdesign.checks.loader import Standard, load_standard
from netdesign.numerics.arrays import (
    Number,
    find_cosine,
    find_cube_root,
    find_root,
    find_sine,
    find_tangent,
    measure_length,
    require_all_positive,
    require_all_within,
    take_larger,
    take_smaller,
)
from netdesign.outcome import StandardError, require_positive, require_within
from netdesign.structure.row_position import EndEffectRule
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadModel:
    """Numbers of the load model; SI but for the creep polynomial in t/m3.

    Attributes
    ----------
    gravity : float
        Of the guideline [m/s2].
    creep : tuple of float, shape (4,)
        Coefficients of K / sin 2 psi in powers 0 to 3 of the density in t/m3.
    density : float
        Mean density up to the base altitude [kg/m3].
    altitude_base, altitude_top : float
        Between them the altitude factor grows [m].
    altitude_rate : float
        Growth of the altitude factor for each metre [1/m].
    case_2_height : float
        Snow height of load case 2 over that of load case 1 [-].
    flexible : float
        f_s on the pressure for nets [-].
    normal, normal_loose, normal_dense : float
        a in S'_Q = S'_N a / (N tan psi): usual, of loose and of dense snow [-].
    dimensioning : float or None
        c in S'_N = c N f_c H_K^2 f_s, by which a structure is dimensioned besides
        [N/m3]; None where it is not.
    """

    gravity: float
    creep: tuple[float, float, float, float]
    density: float
    altitude_base: float
    altitude_top: float
    altitude_rate: float
    case_2_height: float
    flexible: float
    normal: float
    normal_loose: float
    normal_dense: float
    dimensioning: float | None = None

    @property
    def dimensioning_creep(self) -> float | None:
        """K by which (G1) is the dimensioning form, whatever the slope; (G3a) [-]."""
        if self.dimensioning is None:
            return None
        return 2.0 * self.dimensioning / (self.gravity * self.density)


@dataclass(frozen=True, slots=True, kw_only=True)
class SnowLoad(Generic[Number]):
    """Load on a net, or on each of many, for each metre of width, and its parts.

    Attributes
    ----------
    creep_factor, glide_factor : float or ndarray
        K, N [-].
    rigid : float or ndarray
        S'_N on a rigid wall normal to the slope [N/m].
    parallel, normal : float or ndarray
        S'_N and S'_Q on the net, the latter towards the ground [N/m].
    resultant : tuple of float or ndarray, shape (2,)
        On the net, X downslope and Y out of the ground [N/m].
    """

    creep_factor: Number
    glide_factor: Number
    rigid: Number
    parallel: Number
    normal: Number
    resultant: tuple[Number, Number]


@lru_cache(maxsize=1)
def load_guideline() -> Standard:
    """Load the guideline's profile that comes with the program, once."""
    return load_standard("swiss-guideline-2007")


def read_load_model(standard: Standard, dimensioning: float | None = None) -> LoadModel:
    """Load model of a profile.

    Parameters
    ----------
    standard : Standard
        The profile.
    dimensioning : float or None
        c of the dimensioning form [N/m3]; None where it does not count.

    Raises
    ------
    StandardError
        If the profile has none.
    """
    values = _read_group(standard, "snow.")
    if not values:
        value = "snow.gravity"
        raise StandardError(say("standard.no_value", profile=standard.id, value=value))
    powers = ("constant", "linear", "square", "cube")
    c0, c1, c2, c3 = (values.pop(f"creep_{power}") for power in powers)
    values["density"] *= 1e3
    values["altitude_rate"] /= 100.0
    return LoadModel(creep=(c0, c1, c2, c3), dimensioning=dimensioning, **values)


def read_end_effect(standard: Standard) -> EndEffectRule | None:
    """End effect of a profile; None if it has none."""
    values = _read_group(standard, "end.")
    return EndEffectRule(**values) if values else None


def _read_group(standard: Standard, group: str) -> dict[str, float]:
    """Values whose ids start alike, which a profile has all or none, by their names."""
    return {
        value.id.removeprefix(group).replace(".", "_"): value.value
        for value in standard.values
        if value.id.startswith(group)
    }


def compute_creep_factor(
    model: LoadModel, density: Number, slope_angle: float
) -> Number:
    """Creep factor; guideline/THEORY.md, (G2).

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    density : float or ndarray
        [kg/m3].
    slope_angle : float
        psi [rad].

    Returns
    -------
    float or ndarray
        K [-].

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_all_within("density", density, 100.0, 700.0, "kg/m3")
    require_within("slope angle", slope_angle, 0.0, 0.5 * math.pi, "rad")
    rho = density / 1e3
    c0, c1, c2, c3 = model.creep
    return (c0 + rho * (c1 + rho * (c2 + rho * c3))) * math.sin(2.0 * slope_angle)


def compute_altitude_factor(model: LoadModel, altitude: float | None) -> float:
    """Factor on the density at an altitude; guideline/THEORY.md, (G3).

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    altitude : float or None
        [m]; None is not known, and gets the largest factor.

    Returns
    -------
    float
        f_c [-].

    Raises
    ------
    ModelError
        If the altitude is out of its range.
    """
    if altitude is None:
        altitude = model.altitude_top
    require_within("altitude", altitude, 0.0, 9000.0, "m")
    top = min(altitude, model.altitude_top)
    return 1.0 + model.altitude_rate * max(top - model.altitude_base, 0.0)


def compute_snow_load(
    model: LoadModel,
    *,
    density: Number,
    height_vertical: Number,
    slope_angle: float,
    glide_factor: Number,
    net_height: float,
    inclination: Number,
    normal_share: Number | None = None,
    creep_factor: Number | None = None,
) -> SnowLoad[Number]:
    """Load of the guideline on a net; guideline/THEORY.md, eqs. (G1) to (G6).

    Of many nets at once where arrays are given, of shapes that go together.

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    density : float or ndarray
        Mean density of the snow [kg/m3].
    height_vertical : float or ndarray
        H [m].
    slope_angle : float
        psi [rad].
    glide_factor : float or ndarray
        N [-].
    net_height : float
        D_K, normal to the slope [m].
    inclination : float or ndarray
        Of the net from the slope normal, downslope positive [rad].
    normal_share : float, ndarray or None
        a [-]; None is the usual one.
    creep_factor : float, ndarray or None
        K in the place of (G2) [-]; None is (G2).

    Returns
    -------
    SnowLoad
        For each metre of width [N/m].

    Raises
    ------
    ModelError
        If a number is out of its range.

    Verified by
    -----------
    checks/test_hand_calculations.py, guideline/test_load_model.py
    """
    require_all_positive("snow height", height_vertical, "m")
    require_positive("net height", net_height, "m")
    require_within("slope angle", slope_angle, 0.05, 1.5, "rad")
    require_all_within("glide factor", glide_factor, 1.0, 20.0)
    creep = creep_factor
    if creep is None:
        creep = compute_creep_factor(model, density, slope_angle)
    share = model.normal if normal_share is None else normal_share
    weight = density * model.gravity
    rigid = 0.5 * weight * height_vertical**2 * creep * glide_factor
    parallel = model.flexible * rigid
    normal = parallel * share / (glide_factor * math.tan(slope_angle))
    filled = take_smaller(height_vertical * math.cos(slope_angle), net_height)
    prism = 0.5 * weight * filled**2 * find_tangent(take_larger(inclination, 0.0))
    return SnowLoad(
        creep_factor=creep,
        glide_factor=glide_factor,
        rigid=rigid,
        parallel=parallel,
        normal=normal,
        resultant=(
            parallel + prism * math.sin(slope_angle),
            -normal - prism * math.cos(slope_angle),
        ),
    )


# Of Newton's method, from at most a third above the root; each doubles the digits.
_ROUNDS = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class NetPull(Generic[Number]):
    """Pulls of the net, or of each of many, on its ends for each metre of width.

    Attributes
    ----------
    foot, head : tuple of float or ndarray, shape (2,)
        On the foot anchor and on the post head [N/m].
    chord_tension : float or ndarray
        Part of the tension along the chord, the same at both ends [N/m].
    """

    foot: tuple[Number, Number]
    head: tuple[Number, Number]
    chord_tension: Number

    @property
    def largest_tension(self) -> Number:
        """Largest tension of the net, at one of its ends [N/m]."""
        return take_larger(measure_length(*self.foot), measure_length(*self.head))


def compute_net_pull(
    resultant: tuple[Number, Number],
    *,
    inclination: Number,
    chord: Number,
    loaded_share: Number,
    stiffness: Number,
    slack: Number,
) -> NetPull[Number]:
    """End pulls of a shallow cable under a load spread evenly from the foot.

    Of many nets at once where arrays are given, of shapes that go together. Theory:
    guideline/THEORY.md, eqs. (G7) to (G9).

    Parameters
    ----------
    resultant : tuple of float or ndarray, shape (2,)
        Load on the net [N/m].
    inclination : float or ndarray
        Of the chord from the slope normal [rad].
    chord : float or ndarray
        Foot to head [m].
    loaded_share : float or ndarray
        Part of the chord that carries the load, from the foot [-].
    stiffness : float or ndarray
        ES [N/m].
    slack : float or ndarray
        Unstressed length over chord, less 1 [-].

    Returns
    -------
    NetPull
        Their sum is the load [N/m].

    Raises
    ------
    ModelError
        If the load does not press the net, or a number is out of its range.

    Verified by
    -----------
    tests/guideline/test_net_pull.py
    """
    require_all_positive("chord", chord, "m")
    require_all_within("loaded share", loaded_share, 0.05, 1.0)
    require_all_positive("stiffness", stiffness, "N/m")
    require_all_within("slack", slack, 0.0, 0.5)
    along = (find_sine(inclination), find_cosine(inclination))
    across = resultant[0] * along[1] - resultant[1] * along[0]
    require_all_positive("load across the net", across, "N/m")
    head_share = 0.5 * loaded_share
    tension = _find_chord_tension(across, loaded_share, stiffness, slack)
    return NetPull(
        foot=_combine(resultant, 1.0 - head_share, along, tension),
        head=_combine(resultant, head_share, along, -tension),
        chord_tension=tension,
    )


def _find_chord_tension(
    across: Number, loaded: Number, stiffness: Number, slack: Number
) -> Number:
    """Root of (G8): the length that the sag needs is slack and stretch.

    Times T^2 it is s T^2 + (1 + s) T^3 / ES = C, which rises and is convex: Newton's
    method falls onto the root from where one of the two parts alone is C.
    """
    head, foot = 0.5 * loaded, 1.0 - 0.5 * loaded
    # mean square of the shear force over the chord, in units of the load
    square = loaded * (foot**2 - foot * head + head**2) / 3.0 + (1 - loaded) * head**2
    needed = 0.5 * square * across**2
    stretch = (1.0 + slack) / stiffness
    tension = 1.0 / take_larger(
        find_root(slack / needed), find_cube_root(stretch / needed)
    )
    for _ in range(_ROUNDS):
        excess = tension**2 * (slack + stretch * tension) - needed
        slope = tension * (2.0 * slack + 3.0 * stretch * tension)
        tension = tension - excess / slope
    return tension


def _combine(
    load: tuple[Number, Number],
    share: Number,
    along: tuple[Number, Number],
    tension: Number,
) -> tuple[Number, Number]:
    return (load[0] * share + tension * along[0], load[1] * share + tension * along[1])
