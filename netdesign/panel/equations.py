"""Strips and ropes of a panel as one set of equations, with their derivatives.

The unknowns are the pulls of the strips on the lower rope, mid-panel's included, and
the forces of both ropes along the row. A point holds these pulls over the load, (2, K +
1), then log H of the lower and of the upper rope. First: a border rope under the pulls
of the strips that hang on it. Theory: panel/THEORY.md, section 3, (P1) to (P3).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import NamedTuple

import numpy as np

from netdesign.cable.funicular import reach_ends
from netdesign.cable.net import compute_parabola_sag
from netdesign.core.arguments import PanelArgument, point_to, to_floats
from netdesign.numerics.arrays import Floats
from netdesign.panel.inputs import Panel, Rope
from netdesign.panel.strips import (
    ROPE_POINTS,
    ROPE_WEIGHTS,
    Stations,
    Strip,
    build_stations,
    cut_strips,
)


@lru_cache(maxsize=32)
def compute_excess_length(sag: float) -> float:
    """Length of a parabola over its span, less 1: L_r / span - 1 of (P2).

    Its integral is taken, not its closed form: of a flat parabola that keeps no digits.

    Parameters
    ----------
    sag : float
        s_b, over the span [-].

    Returns
    -------
    float
        [-]; from 0, for a straight rope.
    """
    return float(ROPE_WEIGHTS @ _exceed((4.0 * sag * ROPE_POINTS) ** 2))


def estimate_force_along(load: float, span: float, rope: Rope) -> tuple[float, float]:
    """Force along the row and sag of a rope under a uniform load, (P3).

    Parameters
    ----------
    load : float
        q, mean pull of the net [N/m].
    span : float
        Distance of the rope's supports [m].
    rope : Rope
        Its stiffness and as-built sag.

    Returns
    -------
    float, float
        H [N] and f [m].

    Verified by
    -----------
    tests/verification/test_panel.py
    """
    slack = 8.0 / 3.0 * rope.sag**2
    sag = compute_parabola_sag(load, span, rope.stiffness, slack)
    return load * span**2 / (8.0 * sag), sag


class RopeLengths(NamedTuple):
    """Unstressed lengths of ropes over their spans, less 1, and their derivatives.

    Attributes
    ----------
    excess : ndarray, shape (2,)
        Left side of (P2) over the span, less 1 [-].
    by_log_along : ndarray, shape (2,)
        By log H: negative [-].
    by_shear : ndarray, shape (2, 2, 24)
        By V at ``ROPE_POINTS`` [1/N].
    """

    excess: Floats
    by_log_along: Floats
    by_shear: Floats


def measure_lengths(shear: Floats, stiffness: Floats, along: Floats) -> RopeLengths:
    """Lengths that ropes would have without their tension, (P2).

    Parameters
    ----------
    shear : ndarray, shape (2, 2, 24)
        V of each rope, (x, y) at ``ROPE_POINTS`` [N].
    stiffness, along : ndarray, shape (2,)
        EA and H of each [N].

    Verified by
    -----------
    tests/verification/test_panel.py
    """
    square = np.einsum("rcg,rcg->rg", shear, shear) / along[:, None] ** 2
    excess = _exceed(square)  # w - 1
    strain = (along / stiffness)[:, None] * (1.0 + excess)
    give = 1.0 + strain
    slope = (square / (1.0 + excess) + strain * (1.0 + excess)) / give**2
    each = ROPE_WEIGHTS / ((along**2)[:, None] * (1.0 + excess) * give**2)
    return RopeLengths(
        excess=((excess - strain) / give) @ ROPE_WEIGHTS,
        by_log_along=-slope @ ROPE_WEIGHTS,
        by_shear=shear * each[:, None],
    )


def _exceed(ratio: Floats) -> Floats:
    """Length over its projection, less 1, of slopes with these squares."""
    return np.asarray(ratio / (1.0 + np.sqrt(1.0 + ratio)))


_TURNED = np.array([1.0, -1.0])  # what the lower rope gains the upper one loses


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PanelRopes:
    """Border ropes of panels, and what the net's pulls do to them.

    The panels have one spacing and one kind of anchors.

    Attributes
    ----------
    panels : tuple of Panel, shape (n,)
        Ropes and cut.
    stations : Stations
        Places of the strips.
    cut_off : ndarray, shape (n, K + 1)
        Of the strips at the stations and in mid-panel, by the cut [m].
    stiffness, excess : ndarray, shape (n, 2)
        EA [N], and L_r / span - 1 [-], of lower and upper rope.
    deflection : ndarray, shape (2, K + 1, K)
        u H of each rope per load at each station [m2].
    shear : ndarray, shape (2, 24, K)
        V of each at the points of integration, per load at each station [m].
    """

    panels: tuple[Panel, ...]
    stations: Stations
    cut_off: Floats
    stiffness: Floats
    excess: Floats
    deflection: Floats
    shear: Floats


@lru_cache(maxsize=64)  # a row asks for the same ones in every case
def lay_ropes(panels: tuple[Panel, ...], count: int) -> PanelRopes:
    """Ropes of panels that have one spacing and one kind of anchors.

    The net's pulls act at ``count`` stations of half a panel.
    """
    ((spacing, has_mid),) = {(x.post_spacing, x.has_mid_anchors) for x in panels}
    stations = build_stations(count, has_mid_anchors=has_mid)
    half, spans = spacing / 2.0, (stations.lower, stations.upper)
    ropes = [(panel.lower, panel.upper) for panel in panels]
    return PanelRopes(
        panels=panels,
        stations=stations,
        cut_off=np.array([cut_strips(panel, stations) for panel in panels]),
        stiffness=np.array([[rope.stiffness for rope in both] for both in ropes]),
        excess=np.array(
            [[compute_excess_length(rope.sag) for rope in both] for both in ropes]
        ),
        deflection=half**2 * np.array([span.deflection for span in spans]),
        shear=half * np.array([span.shear for span in spans]),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PanelProblem:
    """Equations of panels whose strips are like the net at the post.

    Attributes
    ----------
    ropes : PanelRopes
        Ropes, stations and cut.
    strip : Strip
        The net at the post.
    lengths : ndarray, shape (n, K + 1)
        Unstressed, of the strips at the stations and in mid-panel [m].
    """

    ropes: PanelRopes
    strip: Strip
    lengths: Floats

    @property
    def half(self) -> float:
        """Half the post spacing [m]."""
        return self.ropes.panels[0].post_spacing / 2.0

    @property
    def load_size(self) -> float:
        """Size of the load on a strip [N/m]."""
        return float(np.hypot(*self.strip.load))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RopeLoads:
    """Pulls and ropes at a point; the lower rope is first, vectors are (x, y).

    Attributes
    ----------
    along : ndarray, shape (.., 2)
        H of the ropes [N].
    pulls : ndarray, shape (.., 2, 2, K + 1)
        Of the strips on each rope [N/m].
    displacements : ndarray, shape (.., 2, 2, K + 1)
        Of each rope under these pulls [m].
    """

    along: Floats
    pulls: Floats
    displacements: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PanelState:
    """Pulls and ropes of one panel at a point, and what is missing there.

    Attributes
    ----------
    loads : RopeLoads
        Pulls and ropes.
    missing : ndarray, shape (2 K + 4,)
        Gaps at the strips' heads over their lengths, then excess of the ropes' lengths
        over their spans [-].
    reached : ndarray, shape (2, 2, K + 1)
        Derivative of the strips' ends over their lengths, by their pulls [m/N].
    rope_lengths : RopeLengths
        Of the two ropes, with their derivatives.
    """

    loads: RopeLoads
    missing: Floats
    reached: Floats
    rope_lengths: RopeLengths


def build_problem(strip: Strip, panels: Sequence[Panel], count: int) -> PanelProblem:
    """Equations of panels that have one spacing and one kind of anchors.

    ``strip`` is the net at the post; ``count`` strips hang on half a panel.
    """
    ropes = lay_ropes(tuple(panels), count)
    lengths = (1.0 + strip.slack) * (strip.chord - ropes.cut_off)
    return PanelProblem(ropes=ropes, strip=strip, lengths=lengths)


def describe_panels(
    problem: PanelProblem,
) -> tuple[PanelArgument, tuple[Floats, ...]]:
    """Strips and ropes as the core takes them, and the arrays that have to stay.

    Raises
    ------
    ValueError
        If an array is not of its shape.
    """
    strip, ropes = problem.strip, problem.ropes
    count, strips = problem.lengths.shape
    points, places = strip.alike.weights.size, ROPE_WEIGHTS.size
    arrays = {
        "offsets": to_floats(strip.alike.offsets, (2, points)),
        "weights": to_floats(strip.alike.weights, (points,)),
        "lengths": to_floats(problem.lengths, (count, strips)),
        "deflection": to_floats(ropes.deflection, (2, strips, strips - 1)),
        "shear": to_floats(ropes.shear, (2, places, strips - 1)),
        "rope_weights": ROPE_WEIGHTS,
        "rope_stiffness": to_floats(ropes.stiffness, (count, 2)),
        "excess": to_floats(ropes.excess, (count, 2)),
    }
    argument = PanelArgument(strips, points, places)
    point_to(argument, **arrays)
    argument.stiffness, argument.load_size = strip.alike.stiffness, problem.load_size
    argument.load[:], argument.head[:] = strip.load, strip.head
    argument.to_foot[:] = strip.alike.to_foot
    return argument, tuple(arrays.values())


def guess_points(problem: PanelProblem) -> Floats:
    """First points: strips pull as the net at the post, ropes hang from that, (P3).

    Returns
    -------
    ndarray, shape (n, 2 K + 4)
        [-].
    """
    strip, panels = problem.strip, problem.ropes.panels
    foot = strip.foot_pull
    sizes = math.hypot(*foot), math.hypot(*(strip.load - foot))

    @cache  # panels have ropes in common
    def find_log(load: float, rope: Rope) -> float:
        return math.log(estimate_force_along(load, 2.0 * problem.half, rope)[0])

    points = np.empty((len(panels), 2 * problem.lengths.shape[1] + 2))
    points[:, :-2] = np.repeat(foot / problem.load_size, problem.lengths.shape[1])
    points[:, -2] = [find_log(sizes[0], panel.lower) for panel in panels]
    points[:, -1] = [find_log(sizes[1], panel.upper) for panel in panels]
    return points


def read_loads(problem: PanelProblem, points: Floats) -> RopeLoads:
    """Pulls and ropes at a point, or at those of several panels.

    Parameters
    ----------
    problem : PanelProblem
        Strips and ropes.
    points : ndarray, shape (.., 2 K + 4)
        Pulls over the load, and log H [-].
    """
    foot = problem.load_size * points[..., :-2].reshape(*points.shape[:-1], 2, -1)
    along = np.exp(points[..., -2:])
    pulls = np.stack([foot, problem.strip.load[:, None] - foot], axis=-3)
    # mid-panel's strip shows only where it hangs
    displacements = pulls[..., :-1] @ problem.ropes.deflection.transpose(0, 2, 1)
    displacements /= along[..., None, None]
    return RopeLoads(along=along, pulls=pulls, displacements=displacements)


def read_point(problem: PanelProblem, place: int, point: Floats) -> PanelState:
    """Pulls, ropes and what is missing at a point of one panel.

    Parameters
    ----------
    problem : PanelProblem
        Strips and ropes.
    place : int
        Of the panel.
    point : ndarray, shape (2 K + 4,)
        Pulls over the load, and log H [-].

    Verified by
    -----------
    tests/panel/test_equations.py
    """
    strip, ropes, loads = problem.strip, problem.ropes, read_loads(problem, point)
    shear = loads.pulls[..., :-1] @ ropes.shear.transpose(0, 2, 1)
    lengths = measure_lengths(shear, ropes.stiffness[place], loads.along)
    pulls = loads.pulls[0] - strip.alike.to_foot[:, None]
    ends, reached = reach_ends(strip.alike, pulls)
    moved = loads.displacements[1] - loads.displacements[0]
    wanted = strip.head[:, None] + moved
    gaps = (ends - wanted / problem.lengths[place]).ravel()
    return PanelState(
        loads=loads,
        missing=np.concatenate([gaps, lengths.excess - ropes.excess[place]]),
        reached=reached,
        rope_lengths=lengths,
    )


def derive_missing(problem: PanelProblem, place: int, state: PanelState) -> Floats:
    """Derivative of what is missing by the point, shape (2 K + 4, 2 K + 4)."""
    lengths, size, ropes = problem.lengths[place], problem.load_size, problem.ropes
    strips = lengths.size
    every = np.arange(strips)
    by_pull = np.zeros((2, strips, 2, strips))
    for row, column in np.ndindex(2, 2):
        by_pull[row, every, column, every] = state.reached[row, column]
    moved = np.tensordot(1.0 / state.loads.along, ropes.deflection, 1)
    by_pull[[0, 1], :, [0, 1], :-1] += moved / lengths[:, None]
    by_along = -_TURNED[:, None, None] * state.loads.displacements / lengths
    by_load = np.zeros((2, 2, strips))
    by_load[..., :-1] = state.rope_lengths.by_shear @ ropes.shear
    whole = np.empty((2 * strips + 2, 2 * strips + 2))
    whole[:-2, :-2] = size * by_pull.reshape(2 * strips, 2 * strips)
    whole[:-2, -2:] = by_along.reshape(2, -1).T
    whole[-2:, :-2] = size * (_TURNED[:, None, None] * by_load).reshape(2, -1)
    whole[-2:, -2:] = np.diag(state.rope_lengths.by_log_along)
    return whole
