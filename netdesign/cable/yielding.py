"""The net on snow that yields to it: forces and friction found together.

The snow's nodes go where its own flow and the net's forces carry them, linearly in
the forces; the net slides through the nodes as far as friction lets it. Each Newton
step linearises everything but the choice between sticking and gliding, which is made
exactly for the linear problem: decided for nodes at rest instead, as in ``response``,
it changes from one iteration to the next wherever the snow is softer than the net.
Theory: cable/THEORY.md, eqs (C24) to (C27).
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
from netdesign.cable.sliding import NetState, SlidingStep, solve_sliding
from netdesign.cable.tension import compute_ratio_bounds
from netdesign.errors import SolveError
from netdesign.outcome import Outcome

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Signs = NDArray[np.int8]
Mask = NDArray[np.bool_]

LOG = None
_ROUNDING = float(np.finfo(float).eps)
# Rounds in which every node may change between sticking and gliding; then one at a
# time (Murty's rule).
_FREE_ROUNDS = 12
_MOST_ROUNDS = 400
_LEAST_WAY, _BISECTIONS = -30.0, 30
_SHORTEST_PART = 1e-3
_LEAST_SHARE = 0.1


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
        return np.asarray(self.positions + (self.compliance @ more).reshape(-1, 2).T)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NetGuess:
    """Where the iteration starts.

    Attributes
    ----------
    place : ndarray, shape (2, n)
        Nodes.
    slides : ndarray, shape (n,)
        S_i - S_old_i.
    glide : ndarray of int, shape (n,)
        1 where the net glides to the foot, -1 to the head, 0 where it sticks.
    """

    place: Floats
    slides: Floats
    glide: Signs


class _Given(NamedTuple):
    """What stays the same in one solve."""

    head: Floats
    old_lengths: Floats
    friction: float
    stiffness: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Net:
    """The net on given nodes after given slides."""

    polygon: Polygon
    lengths: Floats
    tensions: Floats
    forces: Floats
    share: Floats  # exp(-kappa), least ratio of tensions
    d_share: Floats  # by the turning angle


def settle_net(
    nodes: YieldingNodes,
    guess: NetGuess,
    head: Floats,
    old_lengths: Floats,
    *,
    friction: float,
    stiffness: float,
    tolerance: float,
    max_iterations: int = 40,
) -> tuple[NetResponse, NetGuess]:
    given = _Given(head, old_lengths, friction, stiffness)
    place, slides, glide = guess.place, guess.slides, guess.glide
    net = _place_net(given, place, slides)
    if not nodes.forces.any():
        place, net = _take_up(given, nodes, place, slides)
    if net.tensions.min() < 0.0:
        loose = solve_sliding(
            net.polygon.lengths,
            old_lengths,
            compute_ratio_bounds(net.polygon.angles, friction),
            stiffness=stiffness,
        )
        slides, glide = loose.slides, loose.glide
        net = _place_net(given, place, slides)
    trace = []
    for _ in range(max_iterations):
        missing = (nodes.place(net.forces) - place).T.ravel()
        way, slides_next, glide, stiff = _solve_linear(
            given, nodes, net, slides, missing, glide
        )
        unbalanced = float(np.linalg.norm(stiff @ missing))
        moved = np.linalg.norm(way)
        trace.append((unbalanced, float(moved), "".join(".+-"[k] for k in glide), ""))
        part = 1.0
        while True:
            following = _place_net(
                given,
                place + part * way.reshape(-1, 2).T,
                slides + part * (slides_next - slides),
            )
            if part < _SHORTEST_PART or (
                following.tensions >= _LEAST_SHARE * net.tensions
            ).all():
                break
            part /= 2.0
        place = place + part * way.reshape(-1, 2).T
        slides = slides_next if part == 1.0 else slides + part * (slides_next - slides)
        net = following
        if moved <= tolerance and part == 1.0:
            return _respond(given, net, slides, stiff), NetGuess(
                place=place, slides=slides, glide=glide
            )
    if LOG is not None:
        LOG.append(trace)
    raise SolveError(Outcome.MAX_ITERATIONS, "friction of the net on the snow")


def _take_up(
    given: _Given, nodes: YieldingNodes, start: Floats, slides: Floats
) -> tuple[Floats, _Net]:
    """Where a net without tension first holds the snow: part of the way it is pushed.

    A straight net has no stiffness across itself, so Newton's method has no direction
    there.
    """
    way = nodes.positions - start
    low, high = _LEAST_WAY, 0.0
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2.0
        place = start + np.exp(middle) * way
        net = _place_net(given, place, slides)
        pushed = nodes.place(net.forces) - place
        if (pushed * way).sum() > 0.0:
            low = middle
        else:
            high = middle
    return place, net


def _place_net(given: _Given, place: Floats, slides: Floats) -> _Net:
    points = np.zeros((2, place.shape[1] + 2))
    points[:, 1:-1], points[:, -1] = place, given.head
    polygon = measure_polygon(points)
    lengths = given.old_lengths + np.diff(slides, prepend=0.0, append=0.0)
    hold = given.friction * np.tan(np.maximum(polygon.angles, 0.0) / 2.0)
    share = np.maximum(1.0 - hold, 0.0) / (1.0 + hold)
    tensions = given.stiffness * (polygon.lengths - lengths) / lengths
    tensions[_find_slack(polygon.lengths - lengths, share)] = 0.0
    half = np.cos(polygon.angles / 2.0)
    d_share = np.where(
        (polygon.angles > 0.0) & (hold < 1.0),
        -given.friction / (half * (1.0 + hold)) ** 2,
        0.0,
    )
    return _Net(
        polygon=polygon,
        lengths=lengths,
        tensions=tensions,
        forces=np.diff(tensions * polygon.directions),
        share=share,
        d_share=d_share,
    )


def _find_slack(stretch: Floats, share: Floats) -> Mask:
    """Segments of the parts, between nodes where nothing can slide, that are loose."""
    parts = np.append(0, np.cumsum(share == 0.0))
    return np.asarray((np.bincount(parts, stretch) <= 0.0)[parts])


def _solve_linear(given, nodes, net, slides, missing, glide):
    polygon, count = net.polygon, slides.size
    per_length = np.where(net.tensions != 0.0, given.stiffness / net.lengths, 0.0)
    per_slide = -per_length * polygon.lengths / net.lengths
    d_tensions = per_length[:, None, None] * polygon.d_lengths
    stiff = turn_pulls(polygon, net.tensions, d_tensions)
    # segment i loses length where its lower node slides up: d lo_i = ds_{i+1} - ds_i
    by_slides = np.zeros((count + 1, count))
    rows = np.arange(count)
    by_slides[rows, rows] = per_slide[:-1]
    by_slides[rows + 1, rows] = -per_slide[1:]
    pulls = polygon.directions[:, :, None] * by_slides
    force_by_slides = np.diff(pulls, axis=1).transpose(1, 0, 2).reshape(2 * count, count)
    jacobian = nodes.compliance @ stiff
    jacobian[np.diag_indices_from(jacobian)] += 1.0
    right = np.column_stack([missing, nodes.compliance @ force_by_slides])
    ways = np.linalg.solve(jacobian, right)
    inner = d_tensions[..., 1:-1].transpose(0, 2, 1).reshape(count + 1, 2 * count)
    tensions = by_slides + inner @ ways[:, 1:]
    start = net.tensions + inner @ ways[:, 0]
    turns = polygon.d_angles[..., 1:-1].transpose(0, 2, 1).reshape(count, 2 * count)
    shares = net.d_share[:, None] * (turns @ ways)
    below, above = net.tensions[:-1], net.tensions[1:]
    share = net.share
    up = start[1:] - share * start[:-1] - below * shares[:, 0]
    down = start[:-1] - share * start[1:] - above * shares[:, 0]
    up_by = tensions[1:] - share[:, None] * tensions[:-1] - below[:, None] * shares[:, 1:]
    down_by = tensions[:-1] - share[:, None] * tensions[1:] - above[:, None] * shares[:, 1:]
    new, glide = _choose(
        up - up_by @ slides, up_by, down - down_by @ slides, down_by, glide, net
    )
    return ways[:, 0] + ways[:, 1:] @ (new - slides), new, glide, stiff


def _choose(up, up_by, down, down_by, glide, net):
    """Slides of the linear problem."""
    count = up.size
    loose = net.share == 1.0
    idle = net.tensions == 0.0
    fixed = (net.share == 0.0) | (idle[:-1] & idle[1:])
    loose &= ~fixed
    glide = np.where(loose, np.int8(1), np.where(fixed, np.int8(0), glide))
    slack = 1e-9 * max(float(net.tensions.max()), 1e-30)
    for round_ in range(_MOST_ROUNDS):
        slides = np.zeros(count)
        active = np.flatnonzero(glide)
        if active.size:
            plus = glide[active] > 0
            rows = np.where(plus[:, None], up_by[active], down_by[active])
            load = np.where(plus, up[active], down[active])
            try:
                slides[active] = np.linalg.solve(rows[:, active], -load)
            except np.linalg.LinAlgError:
                raise SolveError(Outcome.NONFINITE, "friction of the net: singular") from None
        held = glide == 0
        to_foot = up + up_by @ slides < -slack
        to_head = down + down_by @ slides < -slack
        wanted = np.where(held, np.where(to_foot, 1, np.where(to_head, -1, 0)), glide)
        wanted = np.where(~held & (glide * slides < -1e-14) & ~loose, 0, wanted)
        wanted = np.where(fixed, 0, wanted).astype(np.int8)
        changes = np.flatnonzero(wanted != glide)
        if changes.size == 0:
            return slides, glide
        if round_ < _FREE_ROUNDS:
            glide = wanted
        else:
            glide = glide.copy()
            glide[changes[0]] = wanted[changes[0]]
    if LOG is not None:
        LOG.append([(0,0,'choose','')]); import pickle; pickle.dump((up,up_by,down,down_by,net.share,net.tensions,net.polygon.angles),open('/tmp/hw/lcp%d.pkl'%len(LOG),'wb'))
    raise SolveError(Outcome.MAX_ITERATIONS, "friction of the net on the snow")


def _respond(given: _Given, net: _Net, slides: Floats, stiff: Floats) -> NetResponse:
    pulls = net.tensions * net.polygon.directions
    slack = net.tensions == 0.0
    some = NetState.PARTLY_SLACK if slack.any() else NetState.TIGHT
    return NetResponse(
        forces=net.forces,
        stiffness=stiff,
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
