"""Panels between posts: a prototype's forces, a net in space, straight ropes.

The net in space is half a panel of bars that only pull, at its least energy. It is
independent of ``netdesign.panel``: other unknowns (nodes in space, which may move along
the row), other discretisation (bars, loads lumped on levels), other solver (proximal
Newton on a convex energy). Bars run up the net and along its two ropes, none across.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.integrate import quad
from scipy.sparse import coo_matrix, identity
from scipy.sparse.linalg import spsolve

from netdesign.addons.evidence.scene import build_scene, solve
from netdesign.addons.evidence.verification.case import Found, VerificationCase, judge
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.numerics.arrays import Floats, Ints, Mask
from netdesign.outcome import Outcome, SolveError
from netdesign.panel.inputs import Cut, Panel, Rope
from netdesign.panel.solve import FailedPanel, PanelSolution, solve_panel
from netdesign.panel.strips import Strip, take_strip
from netdesign.snow.ground import GroundLaw

_HEIGHT = 3.0  # [m]
_SLIP_RATIO = 2.4147  # N 1.8 as the prototype had it
_ROPE = Rope(stiffness=18e6, sag=0.05)
_PANEL = Panel(post_spacing=4.0, lower=_ROPE, upper=_ROPE, cut="upper")
# Of foot, head, H and T of the lower, then of the upper rope.
_NAMES = ("foot", "head", "lower-H", "lower-T", "upper-H", "upper-T")
_STRAIGHT = Rope(stiffness=1e40, sag=0.0)  # [N]


def list_panels() -> list[VerificationCase]:
    """One section, its panel by a prototype, in space, and on straight ropes."""
    section = _solve_section()
    cuts: tuple[Cut, ...] = ("uniform", "upper")
    results: dict[str, float | Found] = {
        f"panel-{cut}-{name}": got / 1e3
        for cut in cuts
        for name, got in zip(_NAMES, _list_forces(_solve(section, cut)), strict=True)
    }
    straight = replace(_PANEL, lower=_STRAIGHT, upper=_STRAIGHT, cut="uniform")
    foot = math.hypot(*_require(solve_panel(section, straight)).foot)
    expected = section.foot.size * straight.post_spacing
    results |= _list_in_space(section)
    return judge({**results, "panel-straight-ropes": Found(foot / 1e3, expected / 1e3)})


def _list_in_space(section: Solution) -> dict[str, Found]:
    panel = _solve(section, "upper")
    net = solve_net_in_space(take_strip(section), panel.panel)
    pairs = {
        "foot": (math.hypot(*panel.foot), math.hypot(*net.foot)),
        "head": (math.hypot(*panel.head), math.hypot(*net.head)),
        "lower-H": (panel.lower.along, net.lower_along),
        "upper-H": (panel.upper.along, net.upper_along),
    }
    return {
        f"panel-in-space-{name}": Found(got / 1e3, expected / 1e3)
        for name, (got, expected) in pairs.items()
    }


def _solve_section() -> Solution:
    ground = GroundLaw(kind="sliding", slip_length=_SLIP_RATIO * _HEIGHT)
    scene = build_scene(
        (_HEIGHT, 400.0), slope=40.0, length=20.0, ground=ground, slack=0.04
    )
    return solve(scene, SolverSettings(accuracy=1e-3))


def _solve(section: Solution, cut: Cut) -> PanelSolution:
    return _require(solve_panel(section, replace(_PANEL, cut=cut)))


def _require(solved: PanelSolution | FailedPanel) -> PanelSolution:
    if isinstance(solved, FailedPanel):
        raise SolveError(solved.outcome, solved.reason)
    return solved


def _list_forces(solved: PanelSolution) -> tuple[float, ...]:
    lower, upper = solved.lower, solved.upper
    return (
        *(math.hypot(*solved.foot), math.hypot(*solved.head)),
        *(lower.along, lower.tension, upper.along, upper.tension),
    )


_STRIPS, _LEVELS = 24, 16
_RESIDUAL = 1e-7  # of the load
_MOST_STEPS = 400


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Bars:
    ends: Ints  # (n, 2) node numbers
    lengths: Floats  # unstressed [m]
    stiffness: Floats  # force at unit strain [N]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NetInSpace:
    """Forces of a panel between equal ones.

    Attributes
    ----------
    foot, head : ndarray, shape (2,)
        On a foot anchor and a post head, of a whole bay [N].
    lower_along, upper_along : float
        Pull of the ropes along the row at the post [N].
    """

    foot: Floats
    head: Floats
    lower_along: float
    upper_along: float


def solve_net_in_space(strip: Strip, panel: Panel) -> NetInSpace:
    """Net of bars under the strip's forces, from post to mid-panel.

    Parameters
    ----------
    strip : Strip
        The net at the post.
    panel : Panel
        Spacing, ropes and cut; without anchors in mid-panel.

    Raises
    ------
    SolveError
        If the steps do not end.
    """
    z = np.linspace(0.0, panel.post_spacing / 2.0, _STRIPS + 1)
    number = np.arange((_STRIPS + 1) * (_LEVELS + 1)).reshape(_STRIPS + 1, -1)
    bars = _build_bars(strip, panel, z, number)
    loads = _lump_loads(strip, z).reshape(-1, 3)
    free = np.ones((*number.shape, 3), dtype=bool)
    free[0, 0] = free[0, -1] = False
    free[-1, :, 2] = False  # mirror
    start = _place_start(strip, panel, z).reshape(-1, 3)
    nodes = _minimise(start, bars, loads, free.ravel())
    on_supports = loads - _pull_nodes(nodes, bars)[0]
    foot, head = on_supports[number[0, 0]], on_supports[number[0, -1]]
    return NetInSpace(
        foot=2.0 * foot[:2],
        head=2.0 * head[:2],
        lower_along=float(foot[2]),
        upper_along=float(head[2]),
    )


def _build_bars(strip: Strip, panel: Panel, z: Floats, number: Ints) -> _Bars:
    """Bars of the strips, then of the lower and the upper rope."""
    half = z[-1]
    depth = 1.0 - (1.0 - z / half) ** 2  # of a parabola over its sag
    lowered = {
        "uniform": 0.0,
        "upper": panel.upper.sag,
        "fitted": panel.upper.sag + panel.lower.sag,
    }[panel.cut]
    cut = (1.0 + strip.slack) * (strip.chord - 2.0 * half * lowered * depth)
    ends = [np.column_stack([row[:-1], row[1:]]) for row in number]
    lengths = [np.repeat(cut / _LEVELS, _LEVELS)]
    stiffness = [np.repeat(strip.stiffness * _share_width(z), _LEVELS)]
    for rope, column in ((panel.lower, 0), (panel.upper, -1)):
        row = number[:, column]
        ends.append(np.column_stack([row[:-1], row[1:]]))
        lengths.append(np.array([_as_built(rope, half, *pair) for pair in pairwise(z)]))
        stiffness.append(np.full(_STRIPS, rope.stiffness))
    return _Bars(
        ends=np.concatenate(ends),
        lengths=np.concatenate(lengths),
        stiffness=np.concatenate(stiffness),
    )


def _as_built(rope: Rope, half: float, low: float, high: float) -> float:
    """Length of a parabola of the rope's sag between two z."""
    steepest = 4.0 * rope.sag
    return float(
        quad(lambda z: np.hypot(1.0, steepest * (1.0 - z / half)), low, high)[0]
    )


def _share_width(z: Floats) -> Floats:
    """Width of net that each strip stands for."""
    width = np.full(z.size, z[1] - z[0])
    width[[0, -1]] /= 2.0
    return width


def _lump_loads(strip: Strip, z: Floats) -> Floats:
    """Nodal forces of the section on levels of equal unstressed length."""
    ends = np.append(0.0, np.cumsum(strip.shares))
    places = np.empty(strip.forces.shape[1])
    places[::2] = ends
    places[1::2] = (ends[1:] + ends[:-1]) / 2.0
    level = np.clip(places * _LEVELS, 0.0, _LEVELS)
    below = np.minimum(level.astype(int), _LEVELS - 1)
    above = level - below
    levels = np.zeros((_LEVELS + 1, 3))
    np.add.at(levels[:, :2], below, ((1.0 - above) * strip.forces).T)
    np.add.at(levels[:, :2], below + 1, (above * strip.forces).T)
    return np.asarray(_share_width(z)[:, None, None] * levels)


def _place_start(strip: Strip, panel: Panel, z: Floats) -> Floats:
    """Net bulged across its chord between ropes that hang."""
    chord = strip.chord
    along = strip.head / chord
    outward = np.array([along[1], -along[0]])
    hung = 0.1 * panel.post_spacing * (1.0 - (1.0 - z / z[-1]) ** 2)
    share = np.linspace(0.0, 1.0, _LEVELS + 1)
    height = hung[:, None] + (chord - 2.0 * hung[:, None]) * share
    bulge = chord * share * (1.0 - share)
    start = np.empty((z.size, share.size, 3))
    start[..., :2] = height[..., None] * along + bulge[:, None] * outward
    start[..., 2] = z[:, None]
    return start


def _pull_nodes(nodes: Floats, bars: _Bars) -> tuple[Floats, float]:
    """Inner forces at the nodes (n, 3), and the energy; slack bars have none."""
    way, size, stretch = _measure(nodes, bars)
    tension = bars.stiffness * stretch / bars.lengths
    pull = (tension / size)[:, None] * way
    inner = np.zeros_like(nodes)
    np.add.at(inner, bars.ends[:, 1], pull)
    np.add.at(inner, bars.ends[:, 0], -pull)
    return inner, float(tension @ stretch / 2.0)


def _measure(nodes: Floats, bars: _Bars) -> tuple[Floats, Floats, Floats]:
    """Way from end to end of each bar, its size, and by how much it is stretched."""
    way = nodes[bars.ends[:, 1]] - nodes[bars.ends[:, 0]]
    size = np.linalg.norm(way, axis=1)
    return way, size, np.maximum(size - bars.lengths, 0.0)


def _stiffen(nodes: Floats, bars: _Bars) -> Any:
    """Hessian of the energy, sparse."""
    way, size, stretch = _measure(nodes, bars)
    unit = way / size[:, None]
    along = np.einsum("ni,nj->nij", unit, unit)
    stiff = np.where(stretch > 0.0, bars.stiffness / bars.lengths, 0.0)
    across = stiff * stretch / size
    block = stiff[:, None, None] * along + across[:, None, None] * (np.eye(3) - along)
    dofs = 3 * bars.ends[:, :, None] + np.arange(3)
    pairs = [(a, b, block if a == b else -block) for a in (0, 1) for b in (0, 1)]
    rows = np.concatenate(
        [np.repeat(dofs[:, a], 3, axis=1).ravel() for a, _, _ in pairs]
    )
    columns = np.concatenate([np.tile(dofs[:, b], (1, 3)).ravel() for _, b, _ in pairs])
    values = np.concatenate([part.ravel() for _, _, part in pairs])
    return coo_matrix((values, (rows, columns)), (nodes.size, nodes.size)).tocsr()


def _minimise(nodes: Floats, bars: _Bars, loads: Floats, free: Mask) -> Floats:
    """Nodes of the least energy; a proximal term bounds the steps."""
    scale = float(np.abs(loads).sum())
    weight = 1e-3 * float(np.median(bars.stiffness / bars.lengths))

    def evaluate(at: Floats) -> tuple[Floats, float]:
        inner, energy = _pull_nodes(at, bars)
        return (inner - loads).ravel()[free], energy - float((loads * at).sum())

    slope, energy = evaluate(nodes)
    for _ in range(_MOST_STEPS):
        if np.abs(slope).sum() <= _RESIDUAL * scale:
            return nodes
        bent = _stiffen(nodes, bars)[free][:, free]
        step = np.zeros(nodes.size)
        step[free] = -spsolve((bent + weight * identity(slope.size)).tocsc(), slope)
        moved = nodes + step.reshape(-1, 3)
        new_slope, new_energy = evaluate(moved)
        # near the end energies differ by less than their rounding: slopes decide
        if new_energy < energy or np.abs(new_slope).sum() < np.abs(slope).sum():
            nodes, slope, energy = moved, new_slope, new_energy
            weight /= 4.0
        else:
            weight *= 8.0
    raise SolveError(Outcome.MAX_ITERATIONS)
