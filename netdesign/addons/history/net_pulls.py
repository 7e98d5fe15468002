"""The net on given nodes: the forces that it does to them, friction solved exactly.

The snow prescribes the nodes; the net slides through them as far as friction lets
it (``sliding``) and pushes back. Nodes that yield to these forces: ``yielding``.
Theory: cable/THEORY.md, eqs (C10) to (C14), (C21).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.addons.history.sliding import (
    SlidingStep,
    compute_segment_lengths,
    compute_tensions,
    solve_sliding,
)
from netdesign.cable.net import compute_ratio_bounds, compute_turning_angles
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome, SolveError
from netdesign.words.message import say

# A segment that bends more than this between its ends is no arc of a smooth curve.
LARGEST_BEND = 1.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NetResponse:
    """Net on given nodes.

    Attributes
    ----------
    forces : ndarray, shape (2, n)
        Of the net on the snow at the nodes [N/m].
    foot_pull, head_pull : ndarray, shape (2,)
        Pulls of the first and the last segment on their ends [N/m].
    sliding : SlidingStep
        Tensions, unstressed lengths, and which nodes slide.
    """

    forces: Floats
    foot_pull: Floats
    head_pull: Floats
    sliding: SlidingStep


def respond(
    points: Floats, old_lengths: Floats, *, friction: float, stiffness: float
) -> NetResponse:
    """Net forces on nodes that the snow has moved.

    Parameters
    ----------
    points : ndarray, shape (2, n + 2)
        Foot, nodes and head [m, or any unit].
    old_lengths : ndarray, shape (n + 1,)
        Unstressed lengths of the segments before the step [same unit].
    friction : float
        Tan phi [-].
    stiffness : float
        ES [N/m, or any unit of force per width].

    Returns
    -------
    NetResponse
        Forces in the unit of ``stiffness``.

    Raises
    ------
    SolveError
        If the friction problem has not converged.

    Verified by
    -----------
    tests/addons/history/test_net_pulls.py
    """
    bounds = compute_ratio_bounds(compute_turning_angles(points), friction)
    sliding = solve_sliding(
        measure_arcs(points), old_lengths, bounds, stiffness=stiffness
    )
    if sliding.outcome is not Outcome.CONVERGED:
        raise SolveError(sliding.outcome, say("cable.friction"))
    return pull_nodes(points, sliding)


def hold_net(points: Floats, lengths: Floats, *, stiffness: float) -> NetResponse:
    """Net forces on nodes through which nothing slides.

    Parameters
    ----------
    points : ndarray, shape (2, n + 2)
        Foot, nodes and head [m, or any unit].
    lengths : ndarray, shape (n + 1,)
        Unstressed lengths of the segments [same unit].
    stiffness : float
        ES [N/m, or any unit of force per width].

    Raises
    ------
    ModelError
        If a length is not above 0.
    """
    tensions = compute_tensions(measure_arcs(points), lengths, stiffness)
    return pull_nodes(points, keep_lengths(lengths, tensions))


def keep_lengths(lengths: Floats, tensions: Floats) -> SlidingStep:
    """A step in which nothing slides.

    Parameters
    ----------
    lengths, tensions : ndarray, shape (n + 1,)
        Unstressed lengths and tensions of the segments, any unit.
    """
    return SlidingStep(
        outcome=Outcome.CONVERGED,
        lengths=lengths,
        tensions=tensions,
        slides=np.zeros(lengths.size - 1),
    )


def pull_nodes(points: Floats, sliding: SlidingStep) -> NetResponse:
    """Forces of the net's tensions on its nodes and ends.

    Parameters
    ----------
    points : ndarray, shape (2, n + 2)
        Foot, nodes and head [m, or any unit].
    sliding : SlidingStep
        Tensions of the segments.
    """
    pulls = sliding.tensions * np.diff(points) / compute_segment_lengths(points)
    return NetResponse(
        forces=np.diff(pulls),
        foot_pull=pulls[:, 0],
        head_pull=-pulls[:, -1],
        sliding=sliding,
    )


def measure_arcs(points: Floats) -> Floats:
    """Lengths of the arcs of a smooth curve through points, (C21).

    Parameters
    ----------
    points : ndarray, shape (2, n + 2)
        Foot, nodes and head [m, or any unit].

    Returns
    -------
    ndarray, shape (n + 1,)
        In the unit of the points.
    """
    chords = compute_segment_lengths(points)
    return chords * (1.0 + bend_segments(chords, compute_turning_angles(points)) / 24.0)


def bend_segments(chords: Floats, angles: Floats) -> Floats:
    """(k chord)^2 of each segment, k the mean curvature of its nodes.

    Parameters
    ----------
    chords : ndarray, shape (n + 1,)
        Any unit of length.
    angles : ndarray, shape (n,)
        beta_i [rad].

    Returns
    -------
    ndarray, shape (n + 1,)
        [rad^2], at most ``LARGEST_BEND`` squared.
    """
    curvature = average_at_segments(2.0 * angles / (chords[:-1] + chords[1:]))
    return np.minimum((curvature * chords) ** 2, LARGEST_BEND**2)


def average_at_segments(at_nodes: Floats) -> Floats:
    """Mean of the two nodes of each segment; of the one node at either end.

    Parameters
    ----------
    at_nodes : ndarray, shape (n, ..)
        Any unit.

    Returns
    -------
    ndarray, shape (n + 1, ..)
        In that unit.
    """
    inner = (at_nodes[1:] + at_nodes[:-1]) / 2.0
    return np.concatenate([at_nodes[:1], inner, at_nodes[-1:]])
