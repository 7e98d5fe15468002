"""Independent finite elements for three scenes: other elements, other solver.

Of the program: the net's curve, a and b of the layers, slope and base.
``python -m tests.verification.quads`` prints the figures that are stored.
"""

import sys
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

GAUSS = np.sqrt(0.6)
POINTS = np.array([-GAUSS, 0.0, GAUSS])
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 9.0
FLOOR = 1e-4  # of the strain rate, over that of the scene
_STEPS, _LEFT = 120, 1e-9


@dataclass(frozen=True)
class Flow:
    """Scene without units: lengths in d, stresses in mean rho g d."""

    curve: np.ndarray  # (2, n), foot to head
    length: float
    gravity: tuple  # over g
    layers: tuple  # of (top, density ratio, a ratio, b ratio)
    exponent: float
    sticks_to_ground: bool


def shape(t):
    """Quadratic shape functions and derivatives on (-1, 0, 1)."""
    value = np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2])
    return value, np.array([t - 0.5, -2 * t, t + 0.5])


def grade(parts, least, is_both):
    """Places from 0 to 1, geometric from ``least`` on, at one end or at both."""
    if is_both:
        half = grade(parts // 2, 2 * least, False) / 2
        return np.concatenate([half, (1 - half[:-1])[::-1]])
    low, high = 1.0 + 1e-9, 10.0
    for _ in range(200):
        ratio = (low + high) / 2
        total = least * (ratio**parts - 1) / (ratio - 1)
        low, high = (ratio, high) if total < 1 else (low, ratio)
    steps = least * ratio ** np.arange(parts)
    return np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()


def halve(places):
    """Places with the middles between them."""
    return np.interp(np.arange(2 * places.size - 1) / 2, np.arange(places.size), places)


def build_grid(flow, parts, least):
    """Nodes (2, rows, columns): columns from the net upslope, rows from the ground."""
    tops = [0.0, *(top for top, *_ in flow.layers)]
    share = max(2, 2 * round(parts / 2 / len(flow.layers)))
    heights = [
        low + (high - low) * grade(share, least / (high - low), True)
        for low, high in pairwise(tops)
    ]
    rows = halve(np.unique(np.concatenate(heights).round(14)))
    columns = halve(grade(2 * parts, least / flow.length, False))
    net = np.interp(rows, flow.curve[1], flow.curve[0])
    x = net[:, None] - (net[:, None] + flow.length) * columns[None, :]
    return np.array([x, np.broadcast_to(rows[:, None], x.shape)])


def list_cells(rows, columns):
    """Nodes of each quadrilateral, (n, 9)."""
    number = np.arange(rows * columns).reshape(rows, columns)
    blocks = [
        number[i : rows - 2 + i : 2, j : columns - 2 + j : 2].ravel()
        for i in range(3)
        for j in range(3)
    ]
    return np.array(blocks).T


def integrate(grid, cells):
    """Strain operator (cells, 9, 3, 18), weights and shape functions at the points."""
    corners = grid.reshape(2, -1)[:, cells]  # (2, n, 9)
    strains, weights, shapes = [], [], []
    for s, ws in zip(POINTS, WEIGHTS, strict=True):
        for t, wt in zip(POINTS, WEIGHTS, strict=True):
            (vs, ds), (vt, dt) = shape(s), shape(t)
            local = np.array([np.outer(ds, vt).ravel(), np.outer(vs, dt).ravel()])
            jacobian = np.einsum("inj,kj->nik", corners, local)
            size = np.linalg.det(jacobian)
            slopes = np.einsum("nki,kj->nij", np.linalg.inv(jacobian), local)
            operator = np.zeros((cells.shape[0], 3, 18))
            operator[:, 0, 0::2] = operator[:, 2, 1::2] = slopes[:, 0]
            operator[:, 1, 1::2] = operator[:, 2, 0::2] = slopes[:, 1]
            strains.append(operator)
            weights.append(np.abs(size) * ws * wt)
            shapes.append(np.outer(vs, vt).ravel())
    return np.array(strains), np.array(weights), np.array(shapes)


def measure_law(flow, grid, cells):
    """Q of eps_D^2 = eps . Q eps and density, of each cell."""
    middle = grid[1].ravel()[cells[:, 4]]
    tops = np.array([top for top, *_ in flow.layers])
    place = np.searchsorted(tops, middle)
    density, a, b = (
        np.array(one)[place] for one in list(zip(*flow.layers, strict=True))[1:]
    )
    trace = np.outer([1, 1, 0], [1, 1, 0])
    deviator = np.diag([1.0, 1.0, 0.5]) - trace / 3.0  # e : e, plane strain
    law = (2 / a)[:, None, None] * deviator + (1 / b)[:, None, None] * trace
    return law, density


def solve(flow, parts, least=2e-3):
    """Resultant (2,) and moment about the foot of the snow's forces on the net."""
    grid = build_grid(flow, parts, least)
    cells = list_cells(*grid.shape[1:])
    operator, weights, shapes = integrate(grid, cells)
    law, density = measure_law(flow, grid, cells)
    dofs = np.stack([2 * cells, 2 * cells + 1], axis=-1).reshape(len(cells), 18)
    size, n = 2 * grid[0].size, flow.exponent
    load = np.zeros(size)
    pull = np.einsum("gn,gj,n->nj", weights, shapes, density)
    for axis in (0, 1):
        np.add.at(load, dofs[:, axis::2], pull * flow.gravity[axis])
    free = find_free(flow, grid)

    def spread(velocity, exponent):
        strain = np.einsum("gnij,nj->gni", operator, velocity[dofs])
        stress = np.einsum("nij,gnj->gni", law, strain)
        square = np.einsum("gni,gni->gn", strain, stress) + FLOOR**2
        factor = square ** ((1 - exponent) / (2 * exponent))
        energy = exponent / (exponent + 1) * weights * square * factor
        return stress, square, factor, energy.sum() - load @ velocity

    def forces(velocity, exponent):
        stress, _, factor, _ = spread(velocity, exponent)
        found = np.zeros(size)
        parts_of = np.einsum("gn,gnij,gni->nj", weights * factor, operator, stress)
        np.add.at(found, dofs, parts_of)
        return found

    def step(velocity, exponent):
        stress, square, factor, _ = spread(velocity, exponent)
        outer = np.einsum("gni,gnj->gnij", stress, stress)
        share = (1 - exponent) / exponent / square
        modulus = law[None] + share[..., None, None] * outer
        scaled = (weights * factor)[..., None, None] * modulus
        blocks = np.einsum("gnki,gnkl,gnlj->nij", operator, scaled, operator,
                           optimize=True)  # fmt: skip
        index = np.broadcast_to(dofs[:, :, None], blocks.shape)
        matrix = coo_matrix(
            (blocks.ravel(), (index.ravel(), index.swapaxes(1, 2).ravel())),
            shape=(size, size),
        ).tocsc()[free][:, free]
        left = (load - forces(velocity, exponent))[free]
        change = np.zeros(size)
        change[free] = splu(matrix).solve(left)
        return change, left

    velocity = np.zeros(size)
    velocity += step(velocity, 1.0)[0]
    scale = np.abs(load).sum()
    for _ in range(_STEPS):
        change, left = step(velocity, n)
        if np.abs(left).max() < _LEFT * scale:
            break
        before, length = spread(velocity, n)[3], 1.0
        slope = left @ change[free]
        while spread(velocity + length * change, n)[3] > before - 1e-4 * length * slope:
            length /= 2
            if length < 1e-6:
                break
        velocity += length * change
    reaction = (load - forces(velocity, n)).reshape(-1, 2)
    net = np.arange(grid.shape[1]) * grid.shape[2]  # first column
    x, y = grid.reshape(2, -1)[:, net]
    push = reaction[net]
    if not flow.sticks_to_ground:
        push[0, 1] = 0.0  # the ground holds the foot's corner
    moment = (y * push[:, 0] - x * push[:, 1]).sum()
    return push.sum(axis=0), moment


def find_free(flow, grid):
    """Numbers of the velocities that nothing holds."""
    held = np.zeros((*grid.shape[1:], 2), dtype=bool)
    held[:, 0] = True
    held[0, :, 1] = True
    if flow.sticks_to_ground:
        held[0] = True
    return np.flatnonzero(~held.ravel())


def read_scene(scene):
    """Flow without units of a scene; forces in N/m by ``unit``."""
    from netdesign.snow.creep_law import (
        ICE_DENSITY,
        compute_bulk_factor,
        compute_shear_factor,
    )

    solution = scene.solution
    pack, law = solution.scene.snowpack, solution.scene.creep_law
    depth, top, layers = pack.thickness, 0.0, []
    mean = compute_shear_factor(law, pack.density / ICE_DENSITY)
    for layer in solution.scene.layers:
        top += layer.thickness / depth
        relative = layer.density / ICE_DENSITY
        a, b = compute_shear_factor(law, relative), compute_bulk_factor(law, relative)
        layers.append((top, layer.density / pack.density, a / mean, b / mean))
    flow = Flow(
        curve=solution.net_curve / depth,
        length=pack.upslope_length / depth,
        gravity=(np.sin(pack.slope_angle), -np.cos(pack.slope_angle)),
        layers=tuple(layers),
        exponent=law.exponent,
        sticks_to_ground=solution.scene.ground.kind == "no-slip",
    )
    return flow, pack.density * 9.81 * depth**2, depth


def main():
    """Print the figures that are stored, beside those of the program."""
    from netdesign.addons.evidence.verification.winters import solve_shared

    for scene in solve_shared():
        flow, unit, depth = read_scene(scene)
        for parts, least in ((16, 4e-3), (24, 2e-3), (36, 1e-3)):
            force, moment = solve(flow, parts, least)
            told = (scene.name, parts, *(force * unit), moment * unit * depth)
            sys.stdout.write(f"{told}\n")
        told = ("program", *scene.resultant, scene.moment)
        sys.stdout.write(f"{told}\n")


if __name__ == "__main__":
    main()
