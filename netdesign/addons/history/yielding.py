"""The net on snow that yields to it: forces, friction and positions found together.

The snow's nodes go where its own flow and the net's forces carry them, linearly in
the forces; the net slides through the nodes as far as friction lets it. Each Newton
step linearises all but the choice between sticking and sliding, which is made exactly
for the linear problem. If it were made for nodes at rest, it would
change from one iteration to the next wherever the snow is softer than the net.
Theory: cable/THEORY.md, eqs (C22) to (C26).
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from netdesign.addons.history.net_pulls import (
    LARGEST_BEND,
    NetResponse,
    average_at_segments,
    bend_segments,
    join_points,
    pull_nodes,
)
from netdesign.core.arguments import YieldingArgument, locate_all, to_floats
from netdesign.core.library import find_core, require_sound
from netdesign.numerics.arrays import Floats, Ints, Mask, Signs, freeze
from netdesign.outcome import Outcome, SolveError
from netdesign.words.message import say

_MOST_ITERATIONS = 40
# Over the chord: Newton's method is quadratic, the next step would be its square.
_LAST_WAY = 1e-9
_LEAST_SHARE = 0.1  # of a tension, that one step must leave
_SHORTEST_PART = 1e-3
# Rounds in which every node may change between sticking and sliding; then one at a
# time (Murty's rule).
_FREE_ROUNDS, _MOST_ROUNDS = 12, 4000
_BREACH = 1e-9  # of a tension, that counts as none
_BACKWARD = 1e-14  # slide against its direction that is rounding
_LEAST_WAY, _BISECTIONS = -30.0, 30  # logarithm of a share of a way
# Ends of the compiled core, as in yielding.c: a segment would push; failures.
_LOOSE = 1
_FAULTS = {
    2: (Outcome.MAX_ITERATIONS, "cable.friction"),
    3: (Outcome.NONFINITE, "cable.friction_singular"),
    4: (Outcome.NONFINITE, "cable.nodes_at_one_place"),
}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class YieldingNodes:
    """The snow's nodes as they yield to the net's forces.

    Attributes
    ----------
    positions : ndarray, shape (2, n)
        Under the forces below [m, or any unit].
    forces : ndarray, shape (2, n)
        Of the net on the nodes [N/m, or any unit of force per width].
    compliance : ndarray, shape (2 n, 2 n)
        Displacement per force, both ordered x0, x1, .. y0, y1 ..
    """

    positions: Floats
    forces: Floats
    compliance: Floats

    def place(self, forces: Floats) -> Floats:
        """Positions under other forces.

        Parameters
        ----------
        forces : ndarray, shape (2, n)
            Of the net on the nodes [unit of ``YieldingNodes.forces``].

        Returns
        -------
        ndarray, shape (2, n)
            Positions [unit of ``YieldingNodes.positions``].
        """
        more = self.compliance @ (forces - self.forces).ravel()
        return np.asarray(self.positions + more.reshape(2, -1))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NetGuess:
    """State of the net where an iteration starts or ends.

    Attributes
    ----------
    place : ndarray, shape (2, n)
        Nodes.
    slides : ndarray, shape (n,)
        Net that has slid through each node since the step's start, S_i - S_i_old.
    slide_signs : ndarray of int, shape (n,)
        1 where the net slides to the foot, -1 to the head, 0 where it sticks.
    """

    place: Floats
    slides: Floats
    slide_signs: Signs

    @classmethod
    def at_rest(cls, place: Floats, signs: Signs) -> NetGuess:
        """Guess in which nothing has slid yet.

        Parameters
        ----------
        place : ndarray, shape (2, n)
            Nodes, any unit of length.
        signs : ndarray of int, shape (n,)
            1, -1 or 0 as in ``slide_signs``.
        """
        return cls(place=place, slides=np.zeros(signs.size), slide_signs=signs)


class _Problem(NamedTuple):
    """Data that stay the same in one solve."""

    nodes: YieldingNodes
    head: Floats
    old_lengths: Floats
    friction: float
    stiffness: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Net:
    """The net on given nodes after given slides."""

    points: Floats
    chords: Floats
    directions: Floats
    arcs: Floats
    bends: Floats
    angles: Floats
    lengths: Floats
    tensions: Floats
    share: Floats  # exp(-kappa): least ratio of neighbouring tensions

    @property
    def place(self) -> Floats:
        return self.points[:, 1:-1]

    @property
    def forces(self) -> Floats:
        return np.diff(self.tensions * self.directions)


class _Linear(NamedTuple):
    """The linearised net, its nodes' way included: functions of the slides."""

    way: Floats  # (2 n, 1 + n): without more sliding, and per slide
    spare: Floats  # (2, n): tension above what lets the net slide to foot, to head
    per_slide: Floats  # (2, n, n)


def settle_net(
    nodes: YieldingNodes,
    guess: NetGuess,
    head: Floats,
    old_lengths: Floats,
    *,
    friction: float,
    stiffness: float,
) -> tuple[NetResponse, NetGuess]:
    """Net and nodes in equilibrium.

    Parameters
    ----------
    nodes : YieldingNodes
        The snow's side.
    guess : NetGuess
        Where to start.
    head : ndarray, shape (2,)
        End of the net; its foot is the origin [m, or any unit].
    old_lengths : ndarray, shape (n + 1,)
        Unstressed lengths before the step [same unit].
    friction : float
        Tan phi [-].
    stiffness : float
        ES [N/m, or the unit of the forces].

    Returns
    -------
    NetResponse, NetGuess
        The net, and its state to start the next solve from.

    Raises
    ------
    SolveError
        If there is no convergence.

    Verified by
    -----------
    tests/addons/history/test_yielding.py
    """
    problem = _Problem(nodes, head, old_lengths, friction, stiffness)
    if not nodes.forces.any():
        net = _place_net(problem, guess.place, guess.slides)
        guess = replace(guess, place=_take_up(problem, net, guess.slides).place)
    end, lengths, tensions = _settle(problem, guess)
    points = join_points(end.place, head)
    # what has slid is exactly 0 where the net sticks
    signs = np.sign(end.slides).astype(np.int8)
    return pull_nodes(points, lengths, tensions, signs), end


# Net and nodes in equilibrium: state to go on from, lengths and tensions of segments.
_Settled = tuple[NetGuess, Floats, Floats]


def _settle(problem: _Problem, guess: NetGuess, *, may_push: bool = False) -> _Settled:
    """Equilibrium of net and nodes; ``may_push``: segments, at the start."""
    if (library := find_core()) is not None:
        return _settle_compiled(library, problem, guess, may_push=may_push)
    net = _place_net(problem, guess.place, guess.slides)
    if net.tensions.min() < 0.0 and not may_push:
        return _settle(problem, _loosen(problem, guess), may_push=True)
    slides, signs = guess.slides, guess.slide_signs
    chord = float(np.hypot(*problem.head))
    for _ in range(_MOST_ITERATIONS):
        linear = _linearise(problem, net)
        wanted, signs = _choose(net, linear, slides, signs)
        way = linear.way[:, 0] + linear.way[:, 1:] @ (wanted - slides)
        part, net = _go(problem, net, way.reshape(2, -1), slides, wanted)
        moved = max(np.linalg.norm(way), np.linalg.norm(wanted - slides))
        slides = wanted if part == 1.0 else slides + part * (wanted - slides)
        is_last = part == 1.0 and moved <= _LAST_WAY * chord
        if is_last and net.tensions.min() >= 0.0:
            end = NetGuess(place=net.place, slides=slides, slide_signs=signs)
            return end, net.lengths, net.tensions
    raise SolveError(Outcome.MAX_ITERATIONS, say("cable.friction"))


def _settle_compiled(
    library: ctypes.PyDLL, problem: _Problem, guess: NetGuess, *, may_push: bool
) -> _Settled:
    nodes, count = problem.nodes, guess.slides.size
    shapes = ((2, count), (2, count), (2 * count, 2 * count), (count + 1,))
    arrays = (nodes.positions, nodes.forces, nodes.compliance, problem.old_lengths)
    read = [
        to_floats(array, shape) for array, shape in zip(arrays, shapes, strict=True)
    ]
    end = NetGuess(
        place=to_floats(guess.place.copy(), (2, count)),
        slides=guess.slides.copy(),
        slide_signs=guess.slide_signs.astype(np.int8),
    )
    lengths, tensions = np.empty((2, count + 1))
    argument = YieldingArgument(
        *(count, problem.friction, problem.stiffness, tuple(problem.head)),
        *locate_all(*read),
        *(_LAST_WAY, _LEAST_SHARE, _SHORTEST_PART, _BREACH, _BACKWARD, LARGEST_BEND),
        *(_MOST_ITERATIONS, _FREE_ROUNDS, _MOST_ROUNDS),
        *locate_all(end.place, end.slides, end.slide_signs, lengths, tensions),
    )
    code = require_sound(library.nd_settle(ctypes.byref(argument), int(may_push)))
    if code == _LOOSE:
        return _settle(problem, _loosen(problem, guess), may_push=True)
    if code in _FAULTS:
        outcome, key = _FAULTS[code]
        raise SolveError(outcome, say(key))
    return end, lengths, tensions


def _loosen(problem: _Problem, guess: NetGuess) -> NetGuess:
    """The net as it slides on nodes that stay, where a segment would push.

    It starts under one strain in each part, between nodes where nothing can slide.
    """
    net, old = _place_net(problem, guess.place, guess.slides), problem.old_lengths
    parts = _number_parts(net.share)
    shrunk = np.bincount(parts, old) / np.bincount(parts, net.arcs)
    slides = np.cumsum(net.arcs * shrunk[parts] - old)[:-1]
    slides[net.share == 0.0] = 0.0
    signs = np.sign(slides).astype(np.int8)
    even = replace(guess, slides=slides, slide_signs=signs)
    nothing = np.zeros_like(guess.place)
    stiff = YieldingNodes(
        positions=guess.place,
        forces=nothing,
        compliance=np.zeros((nothing.size, nothing.size)),
    )
    end, _, _ = _settle(problem._replace(nodes=stiff), even, may_push=True)
    return replace(guess, slides=end.slides, slide_signs=end.slide_signs)


def _place_net(problem: _Problem, place: Floats, slides: Floats) -> _Net:
    points = join_points(place, problem.head)
    steps = np.diff(points)
    chords = np.hypot(*steps)
    if not chords.min() > 0.0:
        raise SolveError(Outcome.NONFINITE, say("cable.nodes_at_one_place"))
    directions = steps / chords
    (ax, ay), (bx, by) = directions[:, :-1], directions[:, 1:]
    angles = np.arctan2(ax * by - ay * bx, ax * bx + ay * by)
    bends = bend_segments(chords, angles)
    arcs = chords * (1.0 + bends / 24.0)
    lengths = problem.old_lengths + _difference(slides.size) @ slides
    hold = problem.friction * np.tan(np.maximum(angles, 0.0) / 2.0)
    share = np.maximum(1.0 - hold, 0.0) / (1.0 + hold)
    tensions = problem.stiffness * (arcs - lengths) / lengths
    tensions[_find_slack(arcs - lengths, share)] = 0.0
    return _Net(
        points=points,
        chords=chords,
        directions=directions,
        arcs=arcs,
        bends=bends,
        angles=angles,
        lengths=lengths,
        tensions=tensions,
        share=share,
    )


@lru_cache(maxsize=64)
def _difference(count: int) -> Floats:
    """Differences (count + 1, count) over segments of what foot and head do not do."""
    return freeze(np.eye(count + 1, count) - np.eye(count + 1, count, -1))


def _find_slack(stretch: Floats, share: Floats) -> Mask:
    """Segments of parts, between nodes where nothing can slide, that are too long."""
    parts = _number_parts(share)
    return np.asarray((np.bincount(parts, stretch) <= 0.0)[parts])


def _number_parts(share: Floats) -> Ints:
    """Number of the part that each segment is in."""
    return np.append(0, np.cumsum(share == 0.0))


def _take_up(problem: _Problem, net: _Net, slides: Floats) -> _Net:
    """Place where a net without tension first holds the snow: part of its way.

    A straight net has no stiffness across itself, so Newton's method has no direction
    there.
    """
    way = problem.nodes.positions - net.place
    low, high = _LEAST_WAY, 0.0
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2.0
        there = _place_net(problem, net.place + np.exp(middle) * way, slides)
        onward = problem.nodes.place(there.forces) - there.place
        if (onward * way).sum() > 0.0:
            low = middle
        else:
            high = middle
    return there


def _linearise(problem: _Problem, net: _Net) -> _Linear:
    """Equations (C24) and (C25) about the net as it is, the nodes' way eliminated."""
    count = net.angles.size
    (tx, ty), difference = net.directions[:, :, None], _difference(count)
    d_headings = np.hstack([-ty * difference, tx * difference]) / net.chords[:, None]
    d_angles = np.diff(d_headings, axis=0)
    curvature = d_angles * (2.0 / (net.chords[:-1] + net.chords[1:]))[:, None]
    signed = np.sqrt(net.bends) * np.sign(average_at_segments(net.angles))
    d_arcs = (1.0 + net.bends / 24.0)[:, None] * np.hstack(
        [tx * difference, ty * difference]
    ) + (net.chords**2 * signed / 12.0)[:, None] * average_at_segments(curvature)
    per_length = np.where(net.tensions != 0.0, problem.stiffness / net.lengths, 0.0)
    d_tensions = per_length[:, None] * d_arcs
    by_slides = -(per_length * net.arcs / net.lengths)[:, None] * difference
    turn = net.tensions[:, None] * d_headings
    jacobian = -problem.nodes.compliance @ np.vstack(
        [
            np.diff(tx * d_tensions - ty * turn, axis=0),
            np.diff(ty * d_tensions + tx * turn, axis=0),
        ]
    )
    jacobian[np.diag_indices(2 * count)] += 1.0
    missing = (problem.nodes.place(net.forces) - net.place).ravel()
    pushes = np.vstack(
        [np.diff(tx * by_slides, axis=0), np.diff(ty * by_slides, axis=0)]
    )
    rhs = np.column_stack([missing, problem.nodes.compliance @ pushes])
    way = _solve(jacobian, rhs)
    tensions = d_tensions @ way
    tensions[:, 0] += net.tensions
    tensions[:, 1:] += by_slides
    shares = _differentiate_share(problem.friction, net)[:, None] * (d_angles @ way)
    below, above = tensions[:-1], tensions[1:]
    share = net.share[:, None]
    to_foot = above - share * below - net.tensions[:-1, None] * shares
    to_head = below - share * above - net.tensions[1:, None] * shares
    spare = np.array([to_foot[:, 0], to_head[:, 0]])
    return _Linear(way, spare, np.array([to_foot[:, 1:], to_head[:, 1:]]))


def _differentiate_share(friction: float, net: _Net) -> Floats:
    """Derivative of exp(-kappa) by the turning angle."""
    half = net.angles / 2.0
    turned = np.cos(half) + friction * np.sin(half)
    holds = (net.angles > 0.0) & (net.share > 0.0)
    return np.where(holds, -friction / turned**2, 0.0)


def _solve(matrix: Floats, rhs: Floats) -> Floats:
    try:
        return np.asarray(np.linalg.solve(matrix, rhs), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise SolveError(Outcome.NONFINITE, say("cable.friction_singular")) from None


def _choose(
    net: _Net, linear: _Linear, slides: Floats, signs: Signs
) -> tuple[Floats, Signs]:
    """Slides, and which nodes slide, of the linear complementarity problem (C26)."""
    per_slide = linear.per_slide
    spare = linear.spare - per_slide @ slides
    idle = net.tensions == 0.0
    fixed = (net.share == 0.0) | (idle[:-1] & idle[1:])
    loose = (net.share == 1.0) & ~fixed  # no friction: never sticks
    signs = np.where(fixed, 0, np.where(loose, 1, signs)).astype(np.int8)
    least = -_BREACH * float(np.abs(net.tensions).max())
    for number in range(_MOST_ROUNDS):
        slides_of_signs = np.zeros(signs.size)
        active = np.flatnonzero(signs)
        if active.size:
            side = np.where(signs[active] > 0, 0, 1)
            slides_of_signs[active] = _solve(
                per_slide[side[:, None], active[:, None], active], -spare[side, active]
            )
        to_foot, to_head = spare + per_slide @ slides_of_signs < least
        released = np.where(to_foot, 1, np.where(to_head, -1, 0))
        backward = (signs * slides_of_signs < -_BACKWARD) & ~loose
        wanted = np.where(signs == 0, released, np.where(backward, 0, signs))
        changes = np.flatnonzero((wanted != signs) & ~fixed)
        if changes.size == 0:
            return slides_of_signs, signs
        if number >= _FREE_ROUNDS:
            changes = changes[:1]
        signs[changes] = wanted[changes]
    raise SolveError(Outcome.MAX_ITERATIONS, say("cable.friction"))


def _go(
    problem: _Problem, net: _Net, way: Floats, slides: Floats, wanted: Floats
) -> tuple[float, _Net]:
    """The largest part of a step that leaves every segment its tension."""
    part = 1.0
    while True:
        there = _place_net(
            problem, net.place + part * way, slides + part * (wanted - slides)
        )
        left = there.tensions >= _LEAST_SHARE * net.tensions
        if left.all() or part < _SHORTEST_PART:
            return part, there
        part /= 2.0
