"""The net against snow that moves its nodes: forces, and how they change.

The snow prescribes the nodes; the net slides through them as far as friction lets
it (``sliding``) and pushes back. Theory: cable/THEORY.md, eqs (C10) to (C14), (C21)
to (C23).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from netdesign.cable.sliding import SlidingStep, solve_sliding
from netdesign.cable.tension import (
    compute_ratio_bounds,
    compute_segment_lengths,
    compute_tensions,
    compute_turning_angles,
)
from netdesign.errors import SolveError
from netdesign.outcome import Outcome

Floats = NDArray[np.float64]

# A segment that bends more than this between its ends is no arc of a smooth curve.
_LARGEST_BEND = 1.0
_SMALLEST_HOLD = 1e-12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NetResponse:
    """Net on given nodes, and its tangent.

    Attributes
    ----------
    forces : ndarray, shape (2, n)
        Of the net on the snow at the nodes [N/m].
    stiffness : ndarray, shape (2 n, 2 n)
        Minus the derivative of the forces by the positions, both ordered
        x0, y0, x1, y1 .. [N/m per m].
    foot_pull, head_pull : ndarray, shape (2,)
        Pulls of the first and the last segment on their ends [N/m].
    sliding : SlidingStep
        Tensions, unstressed lengths, and which nodes glide.
    """

    forces: Floats
    stiffness: Floats
    foot_pull: Floats
    head_pull: Floats
    sliding: SlidingStep


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Polygon:
    """Geometry of the net and its derivatives by the points, (.., 2, n + 2)."""

    lengths: Floats  # of arcs through the points
    angles: Floats
    directions: Floats
    normals: Floats
    d_lengths: Floats
    d_angles: Floats
    d_headings: Floats


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
    tests/cable/test_response.py
    """
    polygon = measure_polygon(points)
    bounds = compute_ratio_bounds(polygon.angles, friction)
    sliding = solve_sliding(polygon.lengths, old_lengths, bounds, stiffness=stiffness)
    if sliding.outcome is not Outcome.CONVERGED:
        raise SolveError(sliding.outcome, "friction of the net on the snow")
    pulls = sliding.tensions * polygon.directions
    d_tensions = _differentiate_tensions(polygon, sliding, friction)
    return NetResponse(
        forces=np.diff(pulls),
        stiffness=turn_pulls(polygon, sliding.tensions, d_tensions),
        foot_pull=pulls[:, 0],
        head_pull=-pulls[:, -1],
        sliding=sliding,
    )


def hold_net(points, lengths, stiffness):
    polygon = measure_polygon(points)
    tensions = compute_tensions(polygon.lengths, lengths, stiffness)
    pulls = tensions * polygon.directions
    return NetForces(np.diff(pulls), pulls[:, 0], -pulls[:, -1], tensions)


class NetForces(NamedTuple):
    forces: Floats
    foot_pull: Floats
    head_pull: Floats
    tensions: Floats


def turn_pulls(polygon: Polygon, tensions: Floats, d_tensions: Floats) -> Floats:
    """Minus the derivative of the nodal forces by the positions, (2 n, 2 n).

    ``d_tensions`` are the derivatives of the tensions by the points, (n + 1, 2, n + 2).
    """
    d_pulls = (
        polygon.directions.T[:, :, None, None] * d_tensions[:, None]
        + (tensions * polygon.normals).T[:, :, None, None] * polygon.d_headings[:, None]
    )
    d_forces = np.diff(d_pulls, axis=0)[..., 1:-1]
    size = 2 * d_forces.shape[0]
    return np.asarray(-d_forces.transpose(0, 1, 3, 2).reshape(size, size))


def measure_arcs(points: Floats) -> Floats:
    """Lengths of the arcs of a smooth curve through points (2, n + 2), eq. (C21)."""
    return measure_polygon(points).lengths


def measure_polygon(points: Floats) -> Polygon:
    chords = compute_segment_lengths(points)
    angles = compute_turning_angles(points)
    directions = np.diff(points) / chords
    normals = np.array([-directions[1], directions[0]])
    segments = np.arange(chords.size)
    d_chords = np.zeros((chords.size, 2, points.shape[1]))
    d_chords[segments, :, segments] = -directions.T
    d_chords[segments, :, segments + 1] = directions.T
    d_headings = np.zeros_like(d_chords)
    d_headings[segments, :, segments] = -(normals / chords).T
    d_headings[segments, :, segments + 1] = (normals / chords).T
    d_angles = np.diff(d_headings, axis=0)
    per_length = 2.0 / (chords[:-1] + chords[1:])
    curvature = _average_at_segments(angles * per_length)
    bends = np.clip(curvature * chords, -_LARGEST_BEND, _LARGEST_BEND)
    d_curvature = _average_at_segments(d_angles * per_length[:, None, None])
    longer = (1.0 + bends**2 / 24.0)[:, None, None]
    d_bends = (chords**2 * bends / 12.0)[:, None, None] * d_curvature
    return Polygon(
        lengths=chords * longer[:, 0, 0],
        angles=angles,
        directions=directions,
        normals=normals,
        d_lengths=longer * d_chords + d_bends,
        d_angles=d_angles,
        d_headings=d_headings,
    )


def _average_at_segments(at_nodes: Floats) -> Floats:
    """Mean of the two nodes of each segment; of the one node at either end."""
    inner = (at_nodes[1:] + at_nodes[:-1]) / 2.0
    return np.concatenate([at_nodes[:1], inner, at_nodes[-1:]])


def _differentiate_tensions(
    polygon: Polygon, sliding: SlidingStep, friction: float
) -> Floats:
    """Derivatives of the tensions by the points, (n + 1, 2, n + 2), eq. (C23)."""
    half = np.maximum(polygon.angles, 0.0) / 2.0
    hold = np.maximum(1.0 - (friction * np.tan(half)) ** 2, _SMALLEST_HOLD)
    rise = np.where(polygon.angles > 0.0, friction / np.cos(half) ** 2 / hold, 0.0)
    jumps = -(sliding.glide * rise)[:, None, None] * polygon.d_angles
    derivatives = np.zeros_like(polygon.d_lengths)
    # without friction nothing sticks, also where by chance nothing has slid
    cuts = np.flatnonzero((sliding.glide == 0) & (rise > 0.0)) + 1
    for part in np.split(np.arange(polygon.lengths.size), cuts):
        tensions, lengths = sliding.tensions[part], polygon.lengths[part]
        if not tensions.min() > 0.0:
            continue
        ratio = sliding.lengths[part] / lengths
        compliance = ratio * (lengths - sliding.lengths[part])
        climb = np.zeros_like(polygon.d_lengths[part])
        climb[1:] = np.cumsum(jumps[part[:-1]], axis=0)
        stretch = np.tensordot(ratio, polygon.d_lengths[part], 1)
        first = (stretch - np.tensordot(compliance, climb, 1)) / compliance.sum()
        derivatives[part] = tensions[:, None, None] * (first + climb)
    return derivatives
