"""Half a panel as a net of bars in space that only pull: the least energy.

Independent of ``netdesign.panel``: other unknowns (nodes in space, which may move along
the row), other discretisation (bars, loads lumped), other solver (proximal Newton on a
convex energy). Bars run along the net's height only, and along the two ropes.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.integrate import quad
from scipy.sparse import coo_matrix, identity
from scipy.sparse.linalg import spsolve

STRIPS, LEVELS = 24, 16
RESIDUAL = 1e-7  # of the load
MOST_STEPS = 400


@dataclass(frozen=True)
class Bars:
    ends: np.ndarray  # (n, 2) node numbers
    lengths: np.ndarray
    stiffness: np.ndarray  # force at unit strain


@dataclass(frozen=True)
class NetInSpace:
    foot: np.ndarray  # (2,) of a whole bay
    head: np.ndarray
    lower_along: float
    upper_along: float


def solve_cable_net(strip, panel) -> NetInSpace:
    half = panel.post_spacing / 2.0
    z = np.linspace(0.0, half, STRIPS + 1)
    number = np.arange((STRIPS + 1) * (LEVELS + 1)).reshape(STRIPS + 1, LEVELS + 1)
    bars = build_bars(strip, panel, z, number)
    loads = lump_loads(strip, z)
    start = place_start(strip, panel, z)
    free = np.ones_like(start, dtype=bool)
    free[0, 0] = free[0, -1] = False
    free[-1, :, 2] = False  # mirror
    nodes = minimise(start.reshape(-1, 3), bars, loads.reshape(-1, 3), free.ravel())
    on_supports = loads.reshape(-1, 3) - gradient(nodes, bars)[0]
    foot, head = on_supports[number[0, 0]], on_supports[number[0, -1]]
    return NetInSpace(
        foot=2.0 * foot[:2],
        head=2.0 * head[:2],
        lower_along=foot[2],
        upper_along=head[2],
    )


def build_bars(strip, panel, z, number) -> Bars:
    half, width = z[-1], tributary(z)
    depth = 1.0 - (1.0 - z / half) ** 2  # of a parabola over its sag
    chord = np.hypot(*strip.head)
    lowered = {
        "uniform": 0.0,
        "upper": panel.upper.sag,
        "fitted": panel.upper.sag + panel.lower.sag,
    }[panel.cut]
    cut = (1.0 + strip.slack) * (chord - 2.0 * half * lowered * depth)
    ends, lengths, stiffness = [], [], []
    for i, length in enumerate(cut):
        ends += list(zip(number[i, :-1], number[i, 1:], strict=True))
        lengths += [length / LEVELS] * LEVELS
        stiffness += [strip.stiffness * width[i]] * LEVELS
    for rope, column in ((panel.lower, 0), (panel.upper, LEVELS)):
        ends += list(zip(number[:-1, column], number[1:, column], strict=True))
        lengths += [as_built(rope, half, *pair) for pair in pairwise(z)]
        stiffness += [rope.stiffness] * STRIPS
    return Bars(np.array(ends), np.array(lengths), np.array(stiffness))


def as_built(rope, half, low, high) -> float:
    """Length of a parabola of the rope's sag between two z."""
    steepest = 4.0 * rope.sag
    return quad(lambda z: np.hypot(1.0, steepest * (1.0 - z / half)), low, high)[0]


def tributary(z):
    width = np.full(z.size, z[1] - z[0])
    width[[0, -1]] /= 2.0
    return width


def lump_loads(strip, z):
    """Nodal forces of the section on levels of equal unstressed length."""
    ends = np.append(0.0, np.cumsum(strip.shares))
    places = np.empty(strip.forces.shape[1])
    places[::2] = ends
    places[1::2] = (ends[1:] + ends[:-1]) / 2.0
    level = np.clip(places * LEVELS, 0.0, LEVELS)
    below = np.minimum(level.astype(int), LEVELS - 1)
    above = level - below
    levels = np.zeros((LEVELS + 1, 3))
    np.add.at(levels[:, :2], below, ((1.0 - above) * strip.forces).T)
    np.add.at(levels[:, :2], below + 1, (above * strip.forces).T)
    return tributary(z)[:, None, None] * levels


def place_start(strip, panel, z):
    """Net bulged across its chord between ropes that hang."""
    half, head = z[-1], strip.head
    chord = np.hypot(*head)
    along = head / chord
    outward = np.array([along[1], -along[0]])
    hung = 0.1 * panel.post_spacing * (1.0 - (1.0 - z / half) ** 2)
    share = np.linspace(0.0, 1.0, LEVELS + 1)
    height = hung[:, None] + (chord - 2.0 * hung[:, None]) * share
    bulge = chord * share * (1.0 - share)
    start = np.empty((z.size, share.size, 3))
    start[..., :2] = height[..., None] * along + bulge[:, None] * outward
    start[..., 2] = z[:, None]
    return start


def gradient(nodes, bars):
    """Inner forces at the nodes (n, 3), and the energy; slack bars have none."""
    way, size, stretch = measure(nodes, bars)
    tension = bars.stiffness * stretch / bars.lengths
    pull = (tension / size)[:, None] * way
    inner = np.zeros_like(nodes)
    np.add.at(inner, bars.ends[:, 1], pull)
    np.add.at(inner, bars.ends[:, 0], -pull)
    return inner, float((tension * stretch).sum() / 2.0)


def measure(nodes, bars):
    way = nodes[bars.ends[:, 1]] - nodes[bars.ends[:, 0]]
    size = np.linalg.norm(way, axis=1)
    return way, size, np.maximum(size - bars.lengths, 0.0)


def hessian(nodes, bars):
    way, size, stretch = measure(nodes, bars)
    unit = way / size[:, None]
    along = np.einsum("ni,nj->nij", unit, unit)
    stiff = np.where(stretch > 0.0, bars.stiffness / bars.lengths, 0.0)
    across = stiff * stretch / size
    block = stiff[:, None, None] * along
    block = block + across[:, None, None] * (np.eye(3) - along)
    dofs = 3 * bars.ends[:, :, None] + np.arange(3)  # (n, 2, 3)
    rows, columns, values = [], [], []
    for a in (0, 1):
        for b in (0, 1):
            rows.append(np.repeat(dofs[:, a], 3, axis=1).ravel())
            columns.append(np.tile(dofs[:, b], (1, 3)).ravel())
            values.append((block if a == b else -block).reshape(-1))
    entries = [np.concatenate(one) for one in (values, rows, columns)]
    size = nodes.size
    return coo_matrix((entries[0], (entries[1], entries[2])), (size, size)).tocsr()


def minimise(nodes, bars, loads, free):
    """Nodes of the least energy; steps are bounded by a proximal term."""
    scale = np.abs(loads).sum()
    weight = 1e-3 * float(np.median(bars.stiffness / bars.lengths))

    def evaluate(at):
        inner, energy = gradient(at, bars)
        return (inner - loads).ravel()[free], energy - float((loads * at).sum())

    slope, energy = evaluate(nodes)
    for _ in range(MOST_STEPS):
        if np.abs(slope).sum() <= RESIDUAL * scale:
            return nodes
        bent = hessian(nodes, bars)[free][:, free]
        step = np.zeros(nodes.size)
        step[free] = -spsolve((bent + weight * identity(bent.shape[0])).tocsc(), slope)
        moved = nodes + step.reshape(-1, 3)
        new_slope, new_energy = evaluate(moved)
        # near the end energies differ by less than their rounding: slopes decide
        if new_energy < energy or np.abs(new_slope).sum() < np.abs(slope).sum():
            nodes, slope, energy = moved, new_slope, new_energy
            weight /= 4.0
        else:
            weight *= 8.0
    missing = np.abs(slope).sum() / scale
    raise AssertionError(f"the net in space is not at rest: {missing}")
