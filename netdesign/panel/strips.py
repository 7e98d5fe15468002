"""Strips of the net, hung again between two ropes under the forces that they had.

Nodal forces stay vectors at their material points, so that foot and head together
keep their sum. Strips stand at stations along half a panel: the load on a rope is a
polynomial in xi = 1 - 2 z / a through its values at Gauss points, so that the ropes'
integrals of it are exact. Theory: panel/THEORY.md, section 1, (P1) and (P5).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from netdesign.cable.funicular import (
    AlikeCables,
    build_alike,
    draw_curves,
    find_bends,
    tension_offsets,
)
from netdesign.cable.net import Net
from netdesign.coupling.solution import EndPull, Solution
from netdesign.numerics.arrays import Floats, Ints
from netdesign.outcome import ModelError
from netdesign.panel.inputs import Panel
from netdesign.words.message import say


def _place_gauss_points(count: int) -> tuple[Floats, Floats]:
    """Gauss points and weights on 0 to 1."""
    points, weights = np.polynomial.legendre.leggauss(count)
    return (1.0 + points) / 2.0, weights / 2.0


# Points of the integral over a rope's length: exact to rounding up to steep slopes.
ROPE_POINTS, ROPE_WEIGHTS = _place_gauss_points(24)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Span:
    """A rope over half a panel as linear maps of the load at the stations.

    Attributes
    ----------
    deflection : ndarray, shape (K + 1, K)
        u H / (a/2)^2 at the stations and in mid-panel, per load at each station [-].
    shear : ndarray, shape (24, K)
        V / (a/2) at the points of integration [-].
    end_shear : ndarray, shape (2, K)
        The same at the post and in mid-panel.
    drape : ndarray, shape (K + 1,)
        As-built sag there, over s_b a [-].
    """

    deflection: Floats
    shear: Floats
    end_shear: Floats
    drape: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stations:
    """Places of the strips on half a panel.

    Attributes
    ----------
    xi : ndarray, shape (K,)
        1 at the post, 0 in mid-panel [-].
    weights : ndarray, shape (K,)
        Of the mean over the half panel [-].
    lower, upper : Span
        Of the two ropes.
    """

    xi: Floats
    weights: Floats
    lower: Span
    upper: Span


@lru_cache(maxsize=4)
def build_stations(count: int, *, has_mid_anchors: bool) -> Stations:
    """Stations and spans of a panel.

    Without anchors in mid-panel all is even in xi there, and twice as many Gauss points
    over the whole panel serve: their positive half. With them the lower rope has a
    kink there, and half the panel stands alone.

    Parameters
    ----------
    count : int
        K, number of stations [-].
    has_mid_anchors : bool
        The lower rope is held in mid-panel too.
    """
    if has_mid_anchors:
        xi, weights = _place_gauss_points(count)
        powers = np.arange(count)
    else:
        points, doubled = np.polynomial.legendre.leggauss(2 * count)
        xi, weights = points[count:], doubled[count:]
        powers = 2 * np.arange(count)
    fit = np.asarray(np.linalg.inv(xi[:, None] ** powers), dtype=float)
    return Stations(
        xi=xi,
        weights=weights,
        lower=_build_span(xi, powers, fit, is_held=has_mid_anchors),
        upper=_build_span(xi, powers, fit, is_held=False),
    )


def _build_span(xi: Floats, powers: Ints, fit: Floats, *, is_held: bool) -> Span:
    """Rope that is held in mid-panel too, or is level there."""
    places = np.append(xi, 0.0)

    def deflect(at: Floats) -> Floats:
        """Zero at xi = 1; (P5)."""
        held = at[:, None] if is_held else 1.0
        bent = held - at[:, None] ** (powers + 2)
        return np.asarray(bent / ((powers + 1) * (powers + 2)) @ fit)

    def shear(at: Floats) -> Floats:
        """The deflection's slope towards mid-panel."""
        held = 1.0 / (powers + 2) if is_held else 0.0
        return np.asarray((at[:, None] ** (powers + 1) - held) / (powers + 1) @ fit)

    return Span(
        deflection=deflect(places),
        shear=shear(ROPE_POINTS),
        end_shear=shear(np.array([1.0, 0.0])),
        drape=2.0 * places * (1.0 - places) if is_held else 1.0 - places**2,
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Strip:
    """A metre of net as the section at the post has it.

    Attributes
    ----------
    forces : ndarray, shape (2, 2 n + 1)
        Of the snow on its nodes, foot to head [N/m].
    shares : ndarray, shape (n,)
        Unstressed lengths of its elements over that of the whole [-].
    stiffness : float
        ES [N/m].
    head : ndarray, shape (2,)
        Position of the post's head [m].
    slack : float
        Of the net, over its chord [-].
    foot_pull : ndarray, shape (2,)
        On its foot [N/m].
    alike : AlikeCables
        What it has in common with the strips between posts [N/m].
    """

    forces: Floats
    shares: Floats
    stiffness: float
    head: Floats
    slack: float
    foot_pull: Floats
    alike: AlikeCables

    @property
    def load(self) -> Floats:
        """Sum of the forces, shape (2,) [N/m]."""
        return self.alike.load

    @property
    def chord(self) -> float:
        """Distance of foot and head [m]."""
        return float(np.hypot(*self.head))


def take_strip(solution: Solution) -> Strip:
    """Metre of net of a section that has been solved.

    Parameters
    ----------
    solution : Solution
        A steady state: of a history no instant has both the forces and the curve.

    Raises
    ------
    ModelError
        If the solution is no steady state of a net.
    """
    if solution.method != "steady":
        raise ModelError(say("panel.steady_only"))
    net = solution.scene.net
    return build_strip(net, solution.net_curve, solution.net_forces, solution.foot)


def build_strip(net: Net, curve: Floats, forces: Floats, foot: EndPull) -> Strip:
    """Metre of a net at rest, with the forces that the snow leaves on it.

    The unstressed lengths follow from the curve: each element is as long as it would
    be without the tension that the forces leave in it.

    Parameters
    ----------
    net : Net
        Its stiffness and slack.
    curve, forces : ndarray, shape (2, 2 n + 1) and (2, m)
        Its nodes [m], and the forces on those that the snow reaches [N/m].
    foot : EndPull
        Its pull on the foot [N/m].
    """
    above = np.zeros((2, curve.shape[1] - forces.shape[1]))  # of a free end
    forces = np.concatenate([forces, above], axis=1)
    foot_pull = np.array([foot.x, foot.y])
    pull = foot_pull + 2.0 / 3.0 * find_bends(forces)[:, 0] - forces[:, 0]  # (C5)
    tension = pull[:, None, None] + tension_offsets(forces)
    give = 1.0 / np.hypot(*tension) + 1.0 / net.stiffness_per_m
    reach = (tension * give).mean(axis=1)  # of an element, over its length
    lengths = np.hypot(*np.diff(curve[:, ::2])) / np.hypot(*reach)
    shares = lengths / lengths.sum()
    return Strip(
        forces=forces,
        shares=shares,
        stiffness=net.stiffness_per_m,
        head=net.head,
        slack=net.slack,
        foot_pull=foot_pull,
        alike=build_alike(forces, shares, net.stiffness_per_m),
    )


def cut_strips(panel: Panel, stations: Stations) -> Floats:
    """What the cut takes off the strip at each station and in mid-panel, (P4).

    Parameters
    ----------
    panel : Panel
        Its cut, and the ropes that it may follow.
    stations : Stations
        Places of the strips.

    Returns
    -------
    ndarray, shape (K + 1,)
        Of the chord [m].
    """
    lowered = np.zeros(stations.xi.size + 1)
    if panel.cut in ("upper", "fitted"):
        lowered += panel.upper.sag * stations.upper.drape
    if panel.cut == "fitted":
        lowered += panel.lower.sag * stations.lower.drape
    return np.asarray(panel.post_spacing * lowered)


def draw_strips(
    strip: Strip, lengths: Floats, displacements: Floats, foot_pulls: Floats
) -> Floats:
    """Curves of strips in the section's axes.

    Parameters
    ----------
    strip : Strip
        Forces and shares of the length.
    lengths : ndarray, shape (K,)
        Unstressed [m].
    displacements : ndarray, shape (2, 2, K)
        Of the lower and the upper rope [m].
    foot_pulls : ndarray, shape (2, K)
        What each pulls with on the lower rope [N/m].

    Returns
    -------
    ndarray, shape (K, 2, 2 n + 1)
        Nodes, foot to head [m].
    """
    cables = strip.alike
    curves = draw_curves(cables, lengths, foot_pulls - cables.to_foot[:, None])
    return np.asarray(curves + displacements[0].T[:, :, None])
