"""Snow around the end of a row: closed forms of its limits, hexahedra in space."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from netdesign.evidence.verification.case import Found, VerificationCase, judge
from netdesign.evidence.verification.snow_in_space import (
    Block,
    find_excess,
    solve_endless,
)
from netdesign.haefeli.slab import Slab
from netdesign.planview.free_gap import find_isolated_load, solve_free_gap
from netdesign.planview.gap import find_excess_within, find_load
from netdesign.planview.pulled_gap import solve_pulled_gap
from netdesign.planview.row import solve_row
from netdesign.planview.scales import compute_scales
from netdesign.snow.creep_law import (
    ICE_DENSITY,
    compute_bulk_factor,
    compute_shear_factor,
)

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
