"""Results that may not depend on how they were computed, and ill-conditioned scenes."""

import copy
import os
import subprocess
import sys

import numpy as np
import pytest

from netdesign.addons.evidence.benchmark.scenes import SCENES, build_tables
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow import element
from netdesign.snow.element import share_template
from netdesign.snow.mesh import MeshTemplate, build_template
from tests.each import each

# The order of summation and of elimination changes, the iterations take the same
# steps: what differs is their rounding. Where snow slips, a node may be tied between
# sticking and slipping on the way; tight iterations forget which way it went.
ROUNDING = 1e-9
SETTINGS = SolverSettings(accuracy=0.01)
TIGHT = SolverSettings(accuracy=1e-3)
CHOSEN = ("paper-30", "slipping-part", "rough-ground", "layered")


def solve(tables, settings=SETTINGS) -> Solution:
    solution = solve_steady(build_tables(tables), settings, on_failure="raise")
    assert isinstance(solution, Solution)
    return solution


def pulls(solution: Solution) -> list[float]:
    ends = (solution.foot, solution.head)
    return [part for end in ends for part in (end.x, end.y)]


def renumber(template: MeshTemplate, seed: int) -> MeshTemplate:
    """The same mesh with vertices, midpoints and triangles in random order."""
    rng = np.random.default_rng(seed)
    n_nodes, n_vertices = template.nodes.shape[1], template.n_vertices
    midpoints = rng.permutation(n_nodes - n_vertices)
    order = np.concatenate([rng.permutation(n_vertices), n_vertices + midpoints])
    new_number = np.empty(n_nodes, dtype=np.int64)
    new_number[order] = np.arange(n_nodes)
    shuffled = rng.permutation(template.triangles.shape[1])
    return MeshTemplate(
        nodes=template.nodes[:, order],
        triangles=new_number[template.triangles[:, shuffled]],
        orientation=template.orientation[shuffled],
        edges=new_number[template.edges][:, midpoints],
        net=new_number[template.net],
        ground=new_number[template.ground],
        surface=new_number[template.surface],
        upstream=new_number[template.upstream],
        aspect=template.aspect,
        interfaces=template.interfaces,
    )


@pytest.mark.parametrize("name", CHOSEN)
def test_numbering_of_nodes_does_not_matter(monkeypatch, name):
    expected = solve(SCENES[name], TIGHT)
    shuffled = {}

    def build_shuffled(*arguments):
        if arguments not in shuffled:
            shuffled[arguments] = renumber(build_template(*arguments), seed=7)
        return shuffled[arguments]

    monkeypatch.setattr(element, "build_template", build_shuffled)
    share_template.cache_clear()
    found = solve(SCENES[name], TIGHT)
    share_template.cache_clear()
    assert len(shuffled) >= 2
    assert found.cost == expected.cost
    np.testing.assert_allclose(pulls(found), pulls(expected), rtol=ROUNDING)
    # the meshes are not by chance numbered alike
    assert not np.array_equal(found.mesh_nodes, expected.mesh_nodes)


def test_order_of_cases_does_not_matter():
    forwards = {name: pulls(solve(SCENES[name])) for name in CHOSEN}
    backwards = {name: pulls(solve(SCENES[name])) for name in reversed(CHOSEN)}
    assert backwards == forwards  # to the last bit: nothing is carried between cases


PROBE = """
from netdesign.addons.evidence.benchmark.scenes import SCENES, build_tables
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.solve import solve_steady
for name in ("paper-30", "slipping-part"):
    solution = solve_steady(build_tables(SCENES[name]), SolverSettings(accuracy=0.002))
    for end in (solution.foot, solution.head):
        print(repr(end.x), repr(end.y))
"""


def test_number_of_threads_does_not_matter(tmp_path):
    """Two in a process of its own; here there is one, see tests/conftest.py."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    result = subprocess.run(
        [sys.executable, "-c", PROBE],
        env={**os.environ, **dict.fromkeys(names, "2")},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stderr
    by_two = [float(word) for word in result.stdout.split()]
    assert {os.environ[name] for name in names} == {"1"}
    fine = SolverSettings(accuracy=0.002)
    by_one = [
        part
        for name in ("paper-30", "slipping-part")
        for part in pulls(solve(SCENES[name], fine))
    ]
    np.testing.assert_allclose(by_two, by_one, rtol=ROUNDING)


STIFF = {"net": {"stiffness_kN_per_m": 1e6, "slack": 0.0}}
DENSE = {"snow": {"density_kg_m3": 900.0}}
THIN = {
    "snow": {"thickness_m": 0.2, "upslope_length_m": 5.0},
    "net": {"height_m": 0.2},
}
LONG = {"snow": {"upslope_length_m": 180.0}}  # of 3 m
ALL = {
    "snow": {"density_kg_m3": 900.0, "thickness_m": 0.2, "upslope_length_m": 12.0},
    "net": {"stiffness_kN_per_m": 1e6, "slack": 0.0, "height_m": 0.2},
}
GROUNDS = (
    {"law": "free"},
    {"law": "no-slip"},
    {"law": "sliding", "slip_length_m": 1.0},
    {"law": "free", "contact": "one-sided"},
)


@each("ground", GROUNDS)
@each(
    "extreme",
    [STIFF, DENSE, THIN, LONG, ALL],
)
def test_ill_conditioned_scenes_converge(ground, extreme):
    tables = copy.deepcopy(SCENES["sliding-short"])
    for table, values in extreme.items():
        tables[table] |= values
    solution = solve(tables | {"ground": ground})
    balance = solution.balance
    assert balance.relative_residual <= 1e-8
    assert balance.friction_excess <= 1e-8
    assert balance.smallest_tension > 0.0
    # along X the net holds the whole weight on a free ground, else a part of it
    share = (solution.foot.x + solution.head.x) / balance.weight_along_slope
    assert 0.0 < share <= 1.0 + 1e-8
    if ground["law"] == "free":
        assert share == pytest.approx(1.0, abs=1e-8)
