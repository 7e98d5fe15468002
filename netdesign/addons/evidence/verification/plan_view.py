"""Snow around the end of a row: closed forms of its limits, hexahedra in space.

What is in space is independent of the plan view (``planview``): velocities in three
directions, the whole profile over the thickness, no averaging. Linear creep, (N7) with
n = 1. Lengths are in d, stresses in rho g d sin psi. What is solved is the departure
from the neutral zone; its velocities are known. On the wall it undoes them, in the gap
it has no traction. Half a gap and half a row, closed by their planes of symmetry.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import skfem
from scipy.sparse import block_diag, coo_matrix, csc_matrix, diags_array
from scipy.sparse.linalg import splu

from netdesign.addons.evidence.verification.case import Found, VerificationCase, judge
from netdesign.addons.evidence.verification.planview.gap import (
    find_excess_within,
    find_isolated_load,
    find_load,
    solve_free_gap,
    solve_pulled_gap,
)
from netdesign.addons.evidence.verification.planview.waves import (
    compute_scales,
    solve_row,
)
from netdesign.addons.evidence.verification.slab import Slab
from netdesign.numerics.arrays import Floats, Mask
from netdesign.snow.creep_law import (
    ICE_DENSITY,
    compute_bulk_factor,
    compute_shear_factor,
)

_DEGREE = 4  # of the quadrature
_FAR = 6.0  # fading lengths up to the ends of the block
_GROWTH = 1.5  # of elements away from the wall and its end
_NEAR_GROWTH = 1.3  # within the length of the end effect
_TOUCH = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """Snow upslope of half a gap and half a row.

    Attributes
    ----------
    bulk_ratio : float
        a/b of the creep law [-].
    slip : float
        Slip length, 0 without slip, in d.
    gap : float
        A, 0 for an endless wall, in d.
    length : float
        Over which the end effect is summed, in d.
    slope_angle : float
        psi [rad].
    is_rough : bool
        Snow adheres to the wall; otherwise only the velocity across it is held.
    is_pulled : bool
        The snow below has come off the wall and hangs on that in the gap.
    is_straight : bool
        No velocity along the row, as in the plan view.
    size : float
        Of the elements at the wall and at its end, in d.
    layers : int
        Of elements over the thickness.
    """

    bulk_ratio: float
    slip: float
    gap: float
    length: float
    slope_angle: float
    is_rough: bool = False
    is_pulled: bool = False
    is_straight: bool = False
    size: float = 0.1
    layers: int = 2

    @property
    def bulk(self) -> float:
        """Second viscosity k over the first, of (N7)."""
        return self.bulk_ratio - 2.0 / 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WallLoad:
    """Load that holds the snow back, without the pressure at rest.

    Attributes
    ----------
    total, within : float
        On the modelled half row, and from its end to the length asked for.
    width : float
        Length of the half row, in d.
    """

    total: float
    within: float
    width: float


def solve_block(block: Block) -> WallLoad:
    """Load on the half row, from the reactions of the held velocities.

    Parameters
    ----------
    block : Block
        Snow, gap and mesh.
    """
    across = _space_along_row(block)
    reach = _FAR * math.sqrt(2.0 * (block.slip + 1.0 / 3.0) / (1.0 - _poisson(block)))
    upslope = -_grade(block.size, _GROWTH, reach + 2.0)[::-1]
    mesh = skfem.MeshHex.init_tensor(
        upslope, np.linspace(0.0, 1.0, block.layers + 1), across
    )
    element = skfem.ElementVector(skfem.ElementHex2())
    basis = skfem.Basis(mesh, element, intorder=_DEGREE)
    matrix = _assemble(block, basis)
    held = _hold_sides(block, basis)
    known, values, pushed = _hold_wall(block, basis)
    if block.is_pulled:
        values = _solve_with_below(block, basis, matrix, held, known, values)
    else:
        values = _solve(matrix, held | known, values)
    reactions = -(matrix @ values)[pushed]
    places = basis.doflocs[2, pushed] - block.gap / 2.0
    end = block.gap / 2.0 + block.length
    cell = end - across[across < end - _TOUCH][-1]
    ramp = (block.length - places) / (2.0 * cell) + 0.5  # as long on either side
    return WallLoad(
        total=float(reactions.sum()),
        within=float(reactions @ np.clip(ramp, 0.0, 1.0)),
        width=float(across[-1]) - block.gap / 2.0,
    )


def find_excess(block: Block) -> tuple[float, float]:
    """Extra load on the end, whole and within the length, over an endless wall's, in d.

    Parameters
    ----------
    block : Block
        Snow, gap and mesh; an endless wall is solved on the same one.
    """
    beside = solve_block(block)
    endless = solve_endless(block)
    return (
        beside.total / endless - beside.width,
        beside.within / endless - block.length,
    )


def solve_endless(block: Block) -> float:
    """Load for each d of an endless wall.

    Parameters
    ----------
    block : Block
        Its gap is left out.
    """
    endless = solve_block(replace(block, gap=0.0, is_pulled=False))
    return endless.total / endless.width


def _poisson(block: Block) -> float:
    return block.bulk / (2.0 * (block.bulk + 1.0))


def _space_along_row(block: Block) -> Floats:
    """Planes of nodes from mid-gap to mid-row; one of them ends the length."""
    if block.gap == 0.0:
        return np.array([0.0, block.length, 2.0 * block.length])
    half = block.gap / 2.0
    inner = _grade(block.size, _NEAR_GROWTH, block.length)
    last = float(inner[-1] - inner[-2])
    beyond = _FAR * math.sqrt(block.slip + 1.0 / 3.0) + 2.0 - block.length
    # the first element beyond the length is as long as the last within it
    outer = block.length + last + np.append(0.0, _grade(last, _GROWTH, beyond)[1:])
    return np.concatenate(
        [half - _grade(block.size, _GROWTH, half)[::-1], half + inner[1:], half + outer]
    )


def _grade(first: float, growth: float, total: float) -> Floats:
    """Places from 0 to the total whose distances grow; the first about as given."""
    places, step = [0.0], first
    while places[-1] < total:
        places.append(places[-1] + step)
        step *= growth
    return np.array(places) * (total / places[-1])


def _assemble(block: Block, basis: Any) -> csc_matrix:
    """Matrix of 2 eps(v) : eps(w) + k div v div w, and of the drag on the ground.

    Of all gradients at once: a form that is called for each pair of the 81 functions of
    a hexahedron takes ten times as long.
    """
    scalar = skfem.Basis(basis.mesh, basis.elem.elem, intorder=_DEGREE)
    slopes = np.array([function[0].grad for function in scalar.basis])
    n, axes, n_elements, n_points = slopes.shape
    flat = slopes.reshape(n * axes, n_elements, n_points).swapaxes(0, 1)
    products = (flat * scalar.dx[:, None]) @ flat.swapaxes(1, 2)
    # of function i along axis a and function j along axis b: (element, i, a, j, b)
    pairs = products.reshape(n_elements, n, axes, n, axes)
    values = block.bulk * pairs + pairs.swapaxes(2, 4)
    alike = np.einsum("eiaja->eij", pairs)
    for axis in range(axes):
        values[:, :, axis, :, axis] += alike
    dofs = basis.element_dofs.T  # those of a function's three axes in turn
    rows, columns = np.broadcast_arrays(dofs[:, :, None], dofs[:, None])
    entries = values.ravel(), (rows.ravel(), columns.ravel())
    creep = csc_matrix(entries, shape=(basis.N, basis.N))
    return creep + _assemble_drag(block, basis, scalar) if block.slip else creep


def _assemble_drag(block: Block, basis: Any, scalar: Any) -> csc_matrix:
    """Matrix of v w / slip length on the ground, along the slope and along the row."""
    mesh = basis.mesh
    ground = mesh.facets_satisfying(lambda at: at[1] < _TOUCH)
    base = skfem.FacetBasis(mesh, scalar.elem, facets=ground, intorder=_DEGREE)
    drag = skfem.BilinearForm(lambda v, w, _: v * w / block.slip).assemble(base)
    place = coo_matrix(drag)
    along, row = (np.empty(scalar.N, dtype=np.int64) for _ in range(2))
    along[scalar.element_dofs] = basis.element_dofs[0::3]
    row[scalar.element_dofs] = basis.element_dofs[2::3]
    rows, columns = (
        np.concatenate([along[part], row[part]]) for part in (place.row, place.col)
    )
    entries = np.tile(place.data, 2), (rows, columns)
    return csc_matrix(entries, shape=(basis.N, basis.N))


def _hold_sides(block: Block, basis: Any) -> Mask:
    """Unknowns held at 0 on the ground, at the symmetry planes and far away."""
    x, y, z = basis.doflocs
    along, up, side = (_find_component(basis, number) for number in range(3))
    ends = (z < _TOUCH) | (z > z.max() - _TOUCH) | block.is_straight
    ground = (y < _TOUCH) & (up | (block.slip == 0.0))
    return np.asarray(ground | (ends & side) | ((x < x.min() + _TOUCH) & along))


def _hold_wall(block: Block, basis: Any) -> tuple[Mask, Floats, Mask]:
    """Unknowns held on the wall, values of all, and those whose reactions load it."""
    x, y, z = basis.doflocs
    along, up = (_find_component(basis, number) for number in range(2))
    wall = (x > -_TOUCH) & (z > block.gap / 2.0 - _TOUCH)
    pushed = wall & along
    values = np.zeros(x.size)
    profile = y - y**2 / 2.0
    values[pushed] = -(block.slip + profile[pushed])
    if not block.is_rough:
        return pushed, values, pushed
    settling = profile / math.tan(block.slope_angle) / (2.0 + block.bulk)
    values[wall & up] = settling[wall & up]
    return wall, values, pushed


def _find_component(basis: Any, number: int) -> Mask:
    mask = np.zeros(basis.N, dtype=np.bool_)
    kinds = (basis.nodal_dofs, basis.edge_dofs, basis.facet_dofs, basis.interior_dofs)
    for kind in kinds:
        mask[kind[number]] = True
    return mask


def _solve_with_below(
    block: Block,
    basis: Any,
    matrix: csc_matrix,
    held: Mask,
    known: Mask,
    values: Floats,
) -> Floats:
    """Velocities upslope, with snow below that is joined to them in the gap.

    The block below is the mirror image of the one above, its wall free.
    """
    x, _, z = basis.doflocs
    gap = (x > -_TOUCH) & (z < block.gap / 2.0 - _TOUCH)
    count = x.size
    places = np.arange(2 * count)
    places[count:][gap] = np.flatnonzero(gap)
    join = csc_matrix((np.ones(2 * count), (np.arange(2 * count), places)))
    mirror = diags_array(np.where(_find_component(basis, 0), -1.0, 1.0))
    both = block_diag([matrix, mirror @ matrix @ mirror])
    fixed = np.concatenate([held | known, held | gap])  # those of the gap stand above
    start = np.concatenate([values, np.zeros(count)])
    return _solve(csc_matrix(join.T @ both @ join), fixed, start)[:count]


def _solve(matrix: csc_matrix, held: Mask, values: Floats) -> Floats:
    """Values of all unknowns in equilibrium, from those of the held ones."""
    free = ~held
    factor = splu(
        csc_matrix(matrix[free][:, free]),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    solved = values.copy()
    solved[free] = factor.solve(-matrix[free][:, held] @ values[held])
    return solved


_SMALL, _WIDE = 1e-3, 8.0  # half openings over l_z
# Snow one thickness high: lengths are in d.
_SLAB = Slab(thickness=1.0, slope_angle=math.radians(40.0), density=300.0)
_LENGTH = 1.0 / 3.0
# Slip length, gap, whether snow adheres to the wall; the tolerances of the table are
# those of planview/THEORY.md, section 6.
_IN_SPACE = ((0.0, 2.0 / 3.0, True), (1.0, 2.0 / 3.0, False), (1.0, 2.0, True))
_WIDEST = (4.0, 12.0, False)


def list_plan_view() -> list[VerificationCase]:
    """Limits of gap and row; the end of a wall in three dimensions."""
    in_space = [case for one in (*_IN_SPACE, _WIDEST) for case in _compare(*one)]
    return [*_list_limits(), *in_space, *_compare_straight(), *_compare_endless()]


def _list_limits() -> list[VerificationCase]:
    near = np.array([0.3])
    mast = math.pi / (math.log(4.0 / _SMALL) - np.euler_gamma)
    narrow = _SMALL * (1.0 - math.pi * _SMALL / 4.0)
    load = find_load(solve_free_gap(_WIDE), near)[0]
    return judge(
        {
            "plan-gap-narrow": Found(solve_free_gap(_SMALL).excess, narrow),
            "plan-gap-wide-load": Found(
                float(load), float(find_isolated_load(near)[0])
            ),
            "plan-gap-wide-pulled": Found(
                solve_pulled_gap(_WIDE).excess, 0.25 + math.sqrt(0.5)
            ),
            "plan-row-mast": Found(solve_row(_SMALL).total, mast),
            "plan-row-long": Found(solve_row(_WIDE).total, 2.0 * _WIDE + 1.0),
        }
    )


def build_block(slip: float, gap: float, *, is_rough: bool) -> Block:
    """Snow of the comparison in space, on the mesh of the pack; lengths in d."""
    relative = _SLAB.density / ICE_DENSITY
    a = compute_shear_factor(_SLAB.creep_law, relative)
    b = compute_bulk_factor(_SLAB.creep_law, relative)
    return Block(
        bulk_ratio=a / b,
        slip=slip,
        gap=gap,
        length=_LENGTH,
        slope_angle=_SLAB.slope_angle,
        is_rough=is_rough,
        size=0.15,
        layers=2,
    )


def find_plan_excess(slip: float, gap: float) -> tuple[float, float]:
    """Extra load of the plan view, whole and within a third of d, in d."""
    lateral = compute_scales(_SLAB, slip).lateral
    flow = solve_free_gap(gap / 2.0 / lateral)
    within = find_excess_within(flow, _LENGTH / lateral)
    return lateral * flow.excess, lateral * within


def _compare(slip: float, gap: float, is_rough: bool) -> list[VerificationCase]:
    block = build_block(slip, gap, is_rough=is_rough)
    name = f"slip-{slip:g}-gap-{gap:.2g}-{'rough' if is_rough else 'smooth'}"
    return _judge_block(block, name)


def _compare_straight() -> list[VerificationCase]:
    """Without velocity along the row only the averaging over the thickness is left."""
    slip, gap, is_rough = _WIDEST
    block = replace(build_block(slip, gap, is_rough=is_rough), is_straight=True)
    return _judge_block(block, f"slip-{slip:g}-gap-{gap:.2g}-straight")


def _judge_block(block: Block, name: str) -> list[VerificationCase]:
    in_space = find_excess(block)
    in_plan = find_plan_excess(block.slip, block.gap)
    return judge(
        {
            f"plan-in-space-{name}-{part}": Found(got, expected)
            for part, got, expected in zip(
                ("whole", "within"), in_plan, in_space, strict=True
            )
        }
    )


def _compare_endless() -> list[VerificationCase]:
    slip = _WIDEST[0]
    expected = solve_endless(build_block(slip, 0.0, is_rough=False))
    got = compute_scales(_SLAB, slip).longitudinal
    return judge({f"plan-in-space-endless-slip-{slip:g}": Found(got, expected)})
