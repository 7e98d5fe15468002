"""The net as a polygon: its lengths and tensions, and the forces that it does.

Theory: cable/THEORY.md, eqs (C10), (C11) and (C21).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.cable.net import compute_turning_angles
from netdesign.numerics.arrays import Floats, Signs

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
    lengths, tensions : ndarray, shape (n + 1,)
        Unstressed lengths lo_i [m] and tensions T_i [N/m] of the segments.
    slide_signs : ndarray of int, shape (n,)
        1 where the net slides to the foot, -1 to the head, 0 where it sticks.
    """

    forces: Floats
    foot_pull: Floats
    head_pull: Floats
    lengths: Floats
    tensions: Floats
    slide_signs: Signs


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
    """
    tensions = compute_tensions(measure_arcs(points), lengths, stiffness)
    return pull_nodes(points, lengths, tensions)


def pull_nodes(
    points: Floats,
    lengths: Floats,
    tensions: Floats,
    slide_signs: Signs | None = None,
) -> NetResponse:
    """Forces of the net's tensions on its nodes and ends.

    Parameters
    ----------
    points : ndarray, shape (2, n + 2)
        Foot, nodes and head [m, or any unit].
    lengths, tensions : ndarray, shape (n + 1,)
        Of the segments; lengths unstressed [same unit], tensions in any unit.
    slide_signs : ndarray of int, shape (n,), optional
        As of ``NetResponse``; without, nothing slides.
    """
    steps = np.diff(points)
    pulls = tensions * steps / np.hypot(*steps)
    if slide_signs is None:
        slide_signs = np.zeros(lengths.size - 1, dtype=np.int8)
    return NetResponse(
        forces=np.diff(pulls),
        foot_pull=pulls[:, 0],
        head_pull=-pulls[:, -1],
        lengths=lengths,
        tensions=tensions,
        slide_signs=slide_signs,
    )


def join_points(nodes: Floats, head: Floats) -> Floats:
    """Points of a net: its foot at the origin, its nodes, its head.

    Parameters
    ----------
    nodes : ndarray, shape (2, n)
        Foot and head left out [m, or any unit].
    head : ndarray, shape (2,)
        In that unit.

    Returns
    -------
    ndarray, shape (2, n + 2)
        In that unit.
    """
    points = np.zeros((2, nodes.shape[1] + 2))
    points[:, 1:-1], points[:, -1] = nodes, head
    return points


def compute_tensions(
    final_lengths: Floats, unstressed_lengths: Floats, stiffness: float
) -> Floats:
    """Tensions of elastic segments, eq. (C10); a slack segment has none.

    Parameters
    ----------
    final_lengths, unstressed_lengths : ndarray, shape (n + 1,)
        l_i and lo_i, above 0 [m, or any unit].
    stiffness : float
        ES, force per width at unit strain [N/m].

    Returns
    -------
    ndarray, shape (n + 1,)
        T_i, at least 0 [N/m].
    """
    strains = (final_lengths - unstressed_lengths) / unstressed_lengths
    return np.asarray(stiffness * np.maximum(strains, 0.0))


def compute_node_forces(points: Floats, tensions: Floats) -> tuple[Floats, Floats]:
    """Components of the net's forces on the snow at its nodes, eq. (C11).

    Parameters
    ----------
    points : ndarray, shape (2, n + 2)
        Foot, nodes and head [m].
    tensions : ndarray, shape (n + 1,)
        T_i [N/m].

    Returns
    -------
    tuple of ndarray, shape (n,)
        R_n along the bisector of the node, positive where the net presses, and R_t
        across it, positive towards the head [N/m].

    Source
    ------
    The paper's Eq. 11, whose angle theta_{i-1} - theta_i is beta_i here.
    """
    half = compute_turning_angles(points) / 2.0
    normal = (tensions[1:] + tensions[:-1]) * np.sin(half)
    return normal, (tensions[1:] - tensions[:-1]) * np.cos(half)


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
    chords = np.asarray(np.hypot(*np.diff(points)))
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
