"""The plain scikit-fem step against the fast kernel: one result, two ways."""

from dataclasses import replace

import pytest

from netdesign.addons.evidence.benchmark.scenes import SCENES, build_tables
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.solve import solve_steady
from tests.coupling.steady import plain_step

# The same steps with sums and eliminations in another order. The free ground lets
# rounding grow: nothing but the net holds the snow along X.
ROUNDING = 1e-9
SETTINGS = SolverSettings(levels=MESH_LEVELS[:2], accuracy=0.1)
WITH_PRESSURES = {
    **SCENES["dense-firn"],
    "snow": {**SCENES["dense-firn"]["snow"], "density_kg_m3": 880.0},
}
CHOSEN = {
    name: SCENES[name]
    for name in (
        *("paper-30", "slipping-part", "smooth-net", "rough-ground"),
        *("layered", "dense-firn", "freeboard"),
    )
} | {"with-pressures": WITH_PRESSURES}


@pytest.mark.parametrize("name", CHOSEN)
def test_paths_agree(name):
    scene = build_tables(CHOSEN[name])
    fast = solve_steady(scene, SETTINGS, on_failure="raise")
    plain = solve_steady(
        scene, replace(SETTINGS, step=plain_step.advance), on_failure="raise"
    )
    assert isinstance(fast, Solution)
    assert isinstance(plain, Solution)
    assert plain.cost == fast.cost
    for end in ("foot", "head"):
        expected, found = getattr(fast, end), getattr(plain, end)
        assert (found.x, found.y) == pytest.approx(
            (expected.x, expected.y), abs=ROUNDING * expected.size
        )
