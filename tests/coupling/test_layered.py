"""Layered snow drawn over the practical ranges: solved, soon, or refused soon.

The suite takes a few draws; ``python -m pytest -m robustness`` takes hundreds.
"""

import math
from dataclasses import replace

import pytest

from netdesign.addons.evidence.benchmark.scenes import build_tables
from netdesign.addons.evidence.benchmark.scenes import draw_scene as draw_any_scene
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import FailedSolution, Solution
from netdesign.coupling.steady import round
from netdesign.coupling.steady import solve as steady
from netdesign.coupling.steady.compiled import CompiledRounds
from netdesign.coupling.steady.solve import solve_steady
from netdesign.files.solution import write_solution_document
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.snowpack import Layer
from tests.coupling.drawn_scenes import draw_layered_site
from tests.scenes import build_scene

# Linear solves times triangles that a scene may take, solved or refused: some 20
# microseconds each, so 2 s; 0.1.0 took up to 14 s over a scene of this kind.
MOST_WORK = 1e5


def lay(*pairs):
    """Layers of thicknesses and densities [m, kg/m3], from the ground."""
    return tuple(Layer(thickness=high, density=density) for high, density in pairs)


@pytest.fixture
def work(monkeypatch):
    """Linear solves times triangles, of all flows, those that fail too."""
    spent = []
    solve_flow, take = round.solve_flow, CompiledRounds.take

    def count(law, mesh, *given, **named):
        flow = solve_flow(law, mesh, *given, **named)
        spent.append(flow.linear_solves * mesh.template.triangles.shape[1])
        return flow

    def count_in_core(self, *given):
        try:
            return take(self, *given)
        finally:
            triangles = self.problem.template.triangles.shape[1]
            spent.append(self.argument.effort.steps * triangles)

    monkeypatch.setattr(round, "solve_flow", count)
    monkeypatch.setattr(CompiledRounds, "take", count_in_core)
    return spent


@pytest.mark.parametrize("is_denser_below", [True, False])
@pytest.mark.parametrize("seed", range(9))
def test_drawn_layers_are_solved(work, seed, is_denser_below):
    scene = draw_layered_site(seed, is_denser_below=is_denser_below)
    solution = solve_steady(scene, on_failure="raise")
    assert solution.balance.relative_residual <= 1e-8
    assert solution.balance.suction_share <= 0.05
    assert 0 < sum(work) <= MOST_WORK


def is_of_geometry(scene, refused):
    """Uniform snow of the same mass is refused for the same reason."""
    uniform = replace(scene, snowpack=replace(scene.snowpack, layers=()))
    result = solve_steady(uniform)
    return (
        isinstance(result, FailedSolution) and result.reason.key == refused.reason.key
    )


@pytest.mark.robustness
@pytest.mark.parametrize("is_denser_below", [True, False])
def test_of_hundreds_of_practical_layers_less_than_one_in_a_hundred_is_refused(
    work, is_denser_below
):
    """Apart: what the geometry is refused for, and what the solver does not find."""
    scenes, of_geometry, own = 400, [], []
    for seed in range(scenes):
        work.clear()
        scene = draw_layered_site(seed, is_denser_below=is_denser_below)
        solution = solve_steady(scene)
        assert sum(work) <= MOST_WORK, seed
        if isinstance(solution, Solution):
            assert solution.balance.relative_residual <= 1e-8, seed
        elif is_of_geometry(scene, solution):
            of_geometry.append(seed)
        else:
            own.append(seed)
    assert len(own) < 0.01 * scenes, own
    assert len(of_geometry) < 0.01 * scenes, of_geometry


def stiff_over_soft():
    return build_scene(
        layers=lay((1.56, 252.0), (2.19, 428.0)),
        slope_deg=32.0,
        length_m=14.0,
        ground="no-slip",
        inclination_deg=17.0,
        stiffness_kN_per_m=20000,
        slack=0.008,
        friction_deg=41.0,
    )


def test_a_net_lets_go_of_snow_that_would_pull_on_it():
    """The same as if that had been asked for, and the document says so."""
    scene = stiff_over_soft()
    solution = solve_steady(scene, on_failure="raise")
    asked = solve_steady(replace(scene, net_contact="one-sided"), on_failure="raise")
    assert solution.is_released
    assert not asked.is_released
    assert solution.scene == asked.scene
    assert (solution.foot, solution.head) == (asked.foot, asked.head)
    assert solution.balance.suction_share <= 1e-9
    flags = [
        write_solution_document(one, SolverSettings(), wall_s=0.0)["flags"]
        for one in (solution, asked)
    ]
    assert any("lets go of it (one-sided)" in flag for flag in flags[0])
    assert not any("lets go" in flag for flag in flags[1])


@pytest.fixture
def fail_after(monkeypatch):
    """Fails on the mesh after so many; gives the problems that were solved before."""

    def prepare(meshes, failure):
        couple, solved = steady.couple, []

        def couple_some(problem, *given, **named):
            if len(solved) == meshes:
                raise failure
            solved.append(problem)
            return couple(problem, *given, **named)

        monkeypatch.setattr(steady, "couple", couple_some)
        return solved

    return prepare


@pytest.mark.parametrize("meshes", [1, 2, 3])
def test_meshes_before_one_that_fails_are_a_result(a_scene, fail_after, meshes):
    """If they are two: their difference is the error, whatever was asked for."""
    solved = fail_after(meshes, SolveError(Outcome.MAX_ITERATIONS, "too fine"))
    settings = SolverSettings(accuracy=1e-4)
    result = solve_steady(a_scene(ground="no-slip", inclination_deg=30.0), settings)
    if meshes == 1:
        assert result.outcome is Outcome.MAX_ITERATIONS
        return
    assert isinstance(result, Solution)
    finest = solved[-1].template.triangles.shape[1]
    assert result.cost.elements == finest
    assert result.foot.error > 1e-4 * result.foot.size
    assert len(solved) == meshes < len(MESH_LEVELS)


@pytest.mark.parametrize("meshes", [2, 3])
def test_a_net_that_touches_the_ground_on_a_finer_mesh_is_refused(
    a_scene, fail_after, meshes
):
    fail_after(meshes, SolveError(Outcome.OUT_OF_VALIDITY, "touches the ground"))
    scene = a_scene(ground="no-slip", inclination_deg=31.3)
    refused = solve_steady(scene, SolverSettings(accuracy=1e-4))
    assert refused.outcome is Outcome.OUT_OF_VALIDITY


def stiff_scene():
    """A hard middle layer on ground that slips: rounds alone gain little."""
    return build_scene(
        layers=lay((0.91, 257.0), (0.77, 419.0), (1.3, 213.0)),
        slope_deg=42.0,
        length_m=20.0,
        ground="sliding",
        slip_length_m=1.3,
        height_m=3.2,
        inclination_deg=27.5,
        stiffness_kN_per_m=9000,
        slack=0.03,
        friction_deg=15.0,
    )


def loose_scene():
    """Its pulls were a third of the stated error away from where rounds lead."""
    return build_scene(
        layers=lay((1.354, 252.5), (1.259, 485.9), (0.613, 473.0)),
        slope_deg=54.17,
        length_m=25.66,
        ground="free",
        inclination_deg=16.44,
        stiffness_kN_per_m=21100,
        slack=0.0336,
        friction_deg=39.33,
    )


@pytest.mark.parametrize("build", [stiff_scene, loose_scene])
def test_pulls_are_those_of_rounds_without_end_to_a_tenth_of_their_error(build):
    """Though a finer mesh stops by what the coarser one told."""
    scene, levels = build(), MESH_LEVELS[:3]
    quick = solve_steady(scene, SolverSettings(accuracy=0.005, levels=levels))
    tight = solve_steady(
        scene,
        SolverSettings(
            accuracy=0.005, levels=levels, shape_tolerance=3e-6, stress_tolerance=1e-6
        ),
    )
    for end in ("foot", "head"):
        own, other = getattr(quick, end), getattr(tight, end)
        apart = math.hypot(own.x - other.x, own.y - other.y)
        assert apart <= 0.1 * own.error


@pytest.mark.parametrize(
    ("number", "cause"),
    [(847, "steady.much_slack"), (478, "steady.layers_contrast")],
)
def test_a_net_that_does_not_come_to_rest_has_its_cause_told(number, cause):
    """Scenes of ``netdesign bench --stress 2000 --seed 1``."""
    failed = solve_steady(build_tables(draw_any_scene(1, number)))
    assert failed.outcome is Outcome.NO_EQUILIBRIUM
    assert cause in [one.key for one in failed.reason.arguments["causes"]]
