"""The net on snow that yields to it: forces and friction found together.

The snow's nodes go where its own flow and the net's forces carry them, linearly in
the forces; the net slides through the nodes as far as friction lets it. Which nodes
glide is decided together with where they go: decided for nodes at rest, as in
``response``, it would change from one iteration to the next wherever snow is softer
than the net. Theory: cable/THEORY.md, eqs (C24) to (C26).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from netdesign.cable.response import (
    NetResponse,
    Polygon,
    measure_polygon,
    turn_pulls,
)
from netdesign.cable.sliding import NetState, SlidingStep
from netdesign.cable.tension import compute_ratio_bounds
from netdesign.errors import SolveError
from netdesign.outcome import Outcome

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Signs = NDArray[np.int8]
Mask = NDArray[np.bool_]

_ROUNDING = float(np.finfo(float).eps)
_TENSION_STEPS = 40
# Iterations in which every node may change between sticking and gliding; then one at
# a time, and only from a solution of the net as it is (Murty's rule).
_FREE_ITERATIONS = 12
_SHORTEST_PART = 1e-4
_RATIO_TOLERANCE = 1e-9  # breach of (C14) that counts as none
_SMALLEST_HOLD = 1e-12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class YieldingNodes:
    """Where the snow's nodes go under the net's forces.

    Attributes
    ----------
    positions : ndarray, shape (2, n)
        Under the forces below [m, or any unit].
    forces : ndarray, shape (2, n)
        Of the net on the nodes [N/m, or any unit of force per width].
    compliance : ndarray, shape (2 n, 2 n)
        Displacement per force, both ordered x0, y0, x1, y1 ..
    """

    positions: Floats
    forces: Floats
    compliance: Floats

    def place(self, forces: Floats) -> Floats:
        """Positions (2, n) under other forces (2, n)."""
        more = (forces - self.forces).T.ravel()
        return self.positions + (self.compliance @ more).reshape(-1, 2).T


class _Friction(NamedTuple):
    """What stays the same in one solve."""

    head: Floats
    old_lengths: Floats
    friction: float
    stiffness: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Net:
    """The net on given points, each node sticking or gliding as its sign says."""

    polygon: Polygon
    bounds: Floats
    glide: Signs
    tensions: Floats
    lengths: Floats
    forces: Floats

    @property
    def slides(self) -> Floats:
        return np.cumsum(self.lengths - self.polygon.lengths)[:-1]


def settle_net(
    nodes: YieldingNodes,
    guess: Floats,
    head: Floats,
    old_lengths: Floats,
    *,
    friction: float,
    stiffness: float,
    glide: Signs,
    tolerance: float,
    max_iterations: int = 60,
) -> tuple[NetResponse, Floats]:
    """Net and nodes in equilibrium.

    Parameters
    ----------
    nodes : YieldingNodes
        The snow's side.
    guess : ndarray, shape (2, n)
        Positions to start from.
    head : ndarray, shape (2,)
        End of the net; its foot is the origin.
    old_lengths : ndarray, shape (n + 1,)
        Unstressed lengths before the step.
    friction : float
        Tan phi [-].
    stiffness : float
        ES.
    glide : ndarray of int, shape (n,)
        Guess of the direction in which the net slides through each node: 1 to the
        foot, -1 to the head, 0 sticks.
    tolerance : float
        Force that may be missing between net and snow.
    max_iterations : int
        Newton steps allowed.

    Returns
    -------
    NetResponse, ndarray of shape (2, n)
        The net, and the positions of the nodes.

    Raises
    ------
    SolveError
        If there is no convergence.

    Verified by
    -----------
    tests/cable/test_yielding.py
    """
    given = _Friction(head, old_lengths, friction, stiffness)
    place, pattern = guess, glide
    net = _place_net(given, place, pattern)
    for iteration in range(max_iterations):
        tangent = _differentiate(given, net)
        jacobian = nodes.compliance @ tangent
        jacobian[np.diag_indices_from(jacobian)] += 1.0
        missing = _miss(nodes, net, place)
        way = np.linalg.solve(jacobian, missing)
        unbalanced = float(np.linalg.norm(tangent @ way))
        is_settled = unbalanced <= tolerance
        wanted = _update_glide(given, net)
        changes = wanted != net.glide
        if is_settled and not changes.any():
            return _respond(given, net, tangent), place
        if changes.any() and (is_settled or iteration < _FREE_ITERATIONS):
            if iteration >= _FREE_ITERATIONS:
                first = int(np.flatnonzero(changes)[0])
                changes[:first], changes[first + 1 :] = False, False
            pattern = np.where(changes, wanted, net.glide)
        if is_settled:
            net = _place_net(given, place, pattern)
            continue
        place, net = _go(given, nodes, jacobian, net, place, way, pattern)
    raise SolveError(Outcome.MAX_ITERATIONS, "friction of the net on the snow")


def _go(
    given: _Friction,
    nodes: YieldingNodes,
    jacobian: Floats,
    net: _Net,
    place: Floats,
    way: Floats,
    pattern: Signs,
) -> tuple[Floats, _Net]:
    """Part of the Newton step after which the next one is shorter."""
    step = way.reshape(-1, 2).T
    size, part = float(np.linalg.norm(way)), 1.0
    while True:
        there = place + part * step
        following = _place_net(given, there, net.glide)
        left = np.linalg.solve(jacobian, _miss(nodes, following, there))
        if np.linalg.norm(left) <= (1.0 - part / 4.0) * size or part < _SHORTEST_PART:
            break
        part /= 2.0
    if (pattern != net.glide).any():
        following = _place_net(given, there, pattern)
    return there, following


def _miss(nodes: YieldingNodes, net: _Net, place: Floats) -> Floats:
    return (nodes.place(net.forces) - place).T.ravel()


def _place_net(given: _Friction, place: Floats, glide: Signs) -> _Net:
    """Tensions of the net on nodes (2, n) with the nodes that glide given."""
    points = np.zeros((2, place.shape[1] + 2))
    points[:, 1:-1], points[:, -1] = place, given.head
    polygon = measure_polygon(points)
    bounds = compute_ratio_bounds(polygon.angles, given.friction)
    glide = np.where(np.isinf(bounds), np.int8(0), glide)
    parts, starts = _split(bounds, glide)
    climb = np.append(0.0, np.cumsum(-glide * np.where(glide != 0, bounds, 0.0)))
    ratio = np.exp(climb - climb[starts][parts])
    old = np.add.reduceat(given.old_lengths, starts)
    gap = np.add.reduceat(polygon.lengths, starts) - old
    tight = gap > 0.0
    level = np.zeros(starts.size)
    for _ in range(_TENSION_STEPS):
        pull = level[parts] * ratio
        per_length = polygon.lengths / (1.0 + pull)
        missing = gap - np.add.reduceat(per_length * pull, starts)
        rise = missing / np.add.reduceat(per_length * ratio / (1.0 + pull), starts)
        rise[~tight] = 0.0
        level = np.maximum(level + rise, 0.0)
        if (np.abs(rise) <= 4.0 * _ROUNDING * level).all():
            break
    pull = level[parts] * ratio
    lengths = polygon.lengths / (1.0 + pull)
    for part in np.flatnonzero(~tight):
        inside = parts == part
        lengths[inside] = _slacken(polygon.lengths[inside], given.old_lengths[inside])
    tensions = given.stiffness * pull
    return _Net(
        polygon=polygon,
        bounds=bounds,
        glide=glide,
        tensions=tensions,
        lengths=lengths,
        forces=np.diff(tensions * polygon.directions),
    )


def _split(bounds: Floats, glide: Signs) -> tuple[Ints, Ints]:
    """Part of each segment, and first segment of each part, between sticking nodes."""
    sticks = (glide == 0) & (bounds > 0.0)
    parts = np.append(0, np.cumsum(sticks))
    return parts, np.append(0, np.flatnonzero(sticks) + 1)


def _slacken(final: Floats, old: Floats) -> Floats:
    """Lengths without tension; what segments lack comes from the others' surplus."""
    surplus, lack = np.maximum(old - final, 0.0), np.maximum(final - old, 0.0)
    drawn = float(lack.sum() / surplus.sum()) if lack.any() else 0.0
    return np.maximum(old + lack - drawn * surplus, final)


def _update_glide(given: _Friction, net: _Net) -> Signs:
    """Nodes that glide, as the tensions and slides ask, (C14)."""
    below, above = net.tensions[:-1], net.tensions[1:]
    slides = np.cumsum(net.lengths - given.old_lengths)[:-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        jump = np.where(above == below, 0.0, np.log(above) - np.log(below))
    limit = net.bounds * (1.0 + _RATIO_TOLERANCE) + _RATIO_TOLERANCE
    released = np.where(jump < -limit, 1, np.where(jump > limit, -1, 0))
    rounding = 4.0 * _ROUNDING * given.old_lengths.sum()
    goes_on = net.glide * slides > -rounding
    loose = net.bounds == 0.0
    kept = np.where(goes_on | loose, net.glide, 0)
    wanted = np.where(net.glide == 0, np.where(loose, 0, released), kept)
    slack = (below == 0.0) & (above == 0.0)
    return np.where(slack, net.glide, wanted).astype(np.int8)


def _differentiate(given: _Friction, net: _Net) -> Floats:
    """Minus the derivative of the forces by the positions, (2 n, 2 n), (C22), (C23)."""
    polygon = net.polygon
    half = np.maximum(polygon.angles, 0.0) / 2.0
    hold = np.maximum(1.0 - (given.friction * np.tan(half)) ** 2, _SMALLEST_HOLD)
    rise = np.where(polygon.angles > 0.0, given.friction / np.cos(half) ** 2 / hold, 0)
    width = polygon.d_lengths[0].size
    d_lengths = polygon.d_lengths.reshape(-1, width)
    jumps = -(net.glide * rise)[:, None] * polygon.d_angles.reshape(-1, width)
    climb = np.concatenate([np.zeros((1, width)), np.cumsum(jumps, axis=0)])
    parts, starts = _split(net.bounds, net.glide)
    climb -= climb[starts][parts]
    ratio = net.lengths / polygon.lengths
    compliance = ratio * (polygon.lengths - net.lengths)
    stretch = ratio[:, None] * d_lengths - compliance[:, None] * climb
    total = np.add.reduceat(compliance, starts)
    total[total <= 0.0] = np.inf
    first = np.add.reduceat(stretch, starts) / total[:, None]
    d_tensions = net.tensions[:, None] * (first[parts] + climb)
    return turn_pulls(polygon, net.tensions, d_tensions.reshape(polygon.d_lengths.shape))


def _respond(given: _Friction, net: _Net, tangent: Floats) -> NetResponse:
    pulls = net.tensions * net.polygon.directions
    slides = np.where(
        net.glide == 0, 0.0, np.cumsum(net.lengths - given.old_lengths)[:-1]
    )
    slack = net.tensions == 0.0
    some = NetState.PARTLY_SLACK if slack.any() else NetState.TIGHT
    return NetResponse(
        forces=net.forces,
        stiffness=tangent,
        foot_pull=pulls[:, 0],
        head_pull=-pulls[:, -1],
        sliding=SlidingStep(
            outcome=Outcome.CONVERGED,
            state=NetState.SLACK if slack.all() else some,
            lengths=net.lengths,
            tensions=net.tensions,
            slides=slides,
            residual=0.0,
            iterations=0,
        ),
    )
