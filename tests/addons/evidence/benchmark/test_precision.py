"""Rows of the benchmark, and the truth of a finer mesh that they are held against."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.evidence.benchmark.precision import (
    HALVINGS,
    Row,
    Truth,
    measure_steady,
    refine_size,
    solve_truth,
    summarise,
)
from netdesign.addons.evidence.benchmark.scenes import load_scenes
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.snow.mesh import MeshSize, build_template

LEAST = {"finest": 2, "repeats": 1}


@pytest.fixture(scope="module")
def rows():
    scenes = load_scenes(("rough-ground",))
    return measure_steady("rough-ground", scenes["rough-ground"], **LEAST)


def test_finer_meshes_err_less(rows):
    """Each row is solved anew: none is a copy of the one before."""
    coarse, fine = rows
    assert fine.elements > coarse.elements
    assert fine.error < coarse.error
    assert fine.linear_solves > 0


def a_row(**changed) -> Row:
    row = Row(
        scene="a",
        method="steady",
        elements=1,
        degrees_of_freedom=100,
        wall_s=0.01,
        error=0.01,
        stated_error=0.02,
        linear_solves=1,
        rounds=1,
        peak_mb=1.0,
    )
    return replace(row, **changed)


def test_summary_of_known_rows():
    """Time ~ N^1.5, error ~ h^2 = N^-1."""
    rows = [
        a_row(
            elements=place,
            degrees_of_freedom=unknowns,
            wall_s=unknowns**1.5,
            error=1.0 / unknowns,
        )
        for place, unknowns in enumerate((100, 400, 1600))
    ]
    summary = summarise([*rows, a_row(method="transient", wall_s=1e9)])
    assert summary["cost_order"] == pytest.approx(1.5)
    assert summary["worst_cost_order"] == pytest.approx(1.5)
    assert summary["error_order"] == pytest.approx(2.0)


def test_a_finer_mesh_is_finer_in_each_direction_everywhere():
    """Four pieces of every side, at the net's foot as well."""
    size = MeshSize(net_spacing=0.2, corner=0.01, sectors=2, upslope_spacing=0.5)
    coarse, fine = (
        build_template(20.0, s) for s in (size, refine_size(size, HALVINGS))
    )
    assert fine.triangles.shape[1] == 16 * coarse.triangles.shape[1]
    for chain in ("net", "ground"):
        axis = 1 if chain == "net" else 0
        coarser, finer = (t.nodes[axis, getattr(t, chain)[::2]] for t in (coarse, fine))
        np.testing.assert_allclose(finer[::4], coarser, atol=1e-15)
        np.testing.assert_allclose(np.diff(finer)[::4], np.diff(coarser) / 4)


def test_errors_are_those_of_the_vectors(solved):
    solution = solved()
    foot, head = solution.foot, solution.head
    # a quarter turn of a pull of the same size: the error is sqrt(2) of it
    truth = Truth(foot=np.array([-foot.y, foot.x]), head=np.array([head.x, head.y]))
    assert truth.compare_ends(solution) == pytest.approx((np.sqrt(2.0), 0.0))
    assert truth.compare(solution) == pytest.approx(np.sqrt(2.0))


def test_truth_is_nearer_to_a_finer_solution(a_scene, solved):
    truth = solve_truth(a_scene(), MESH_LEVELS[3], SolverSettings())
    coarse, fine = solved(), solved(first_level=2)
    assert truth.compare(fine) < truth.compare(coarse) / 2
    # FACTS.md, section 6: two independent codes
    assert np.hypot(*truth.foot) == pytest.approx(309.67e3, rel=3e-4)
    assert 2**HALVINGS == 4
