"""The coupled solve: outcomes, freeboard, error. Truth: tests/verification."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling import interface
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import FailedSolution, Solution
from netdesign.coupling.steady import net, round
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import Outcome
from netdesign.snow import flow
from netdesign.snow.placed_mesh import PlacedMesh
from tests.each import each

COARSE = SolverSettings(
    accuracy=0.1,
    stress_tolerance=1e-8,
    shape_tolerance=1e-7,
    levels=MESH_LEVELS[1:3],
)

ENDS = ("foot", "head")


def pull(end) -> np.ndarray:
    return np.array([end.x, end.y])


def assert_fails(outcome, result, reason: str) -> None:
    assert isinstance(result, FailedSolution)
    assert result.outcome is outcome
    assert reason in str(result.reason)


# --- outcomes ----------------------------------------------------------------


def test_converged(solved):
    solution = solved(inclination_deg=30.0)
    assert isinstance(solution, Solution)
    assert solution.method == "steady"
    assert solution.balance.relative_residual <= 1e-8
    assert solution.balance.friction_excess <= 1e-8
    assert 0.0 < solution.tension_min <= solution.head.size
    assert solution.foot.size <= solution.tension_max


@pytest.mark.parametrize(
    ("given", "settings", "outcome", "reason"),
    [
        (
            {"slack": 0.05, "inclination_deg": 60.0},
            {},
            Outcome.OUT_OF_VALIDITY,
            "touch the ground: less slack",
        ),
        ({}, {"max_rounds": 2}, Outcome.MAX_ITERATIONS, "still moves by"),
        ({}, {"max_rounds": 2}, Outcome.MAX_ITERATIONS, "after 2 rounds"),
        ({}, {"max_iterations": 1}, Outcome.MAX_ITERATIONS, "snow flow"),
    ],
)
def test_what_is_not_found_is_a_reason(a_scene, given, settings, outcome, reason):
    assert_fails(
        outcome, solve_steady(a_scene(**given), replace(COARSE, **settings)), reason
    )


def end_without_equilibrium(*given, known=net.solve_funicular):
    return replace(known(*given), outcome=Outcome.NO_EQUILIBRIUM)


def lose(axis):
    """Forces of which a millionth of rho g d^2 is lost between snow and ground."""
    known = interface.compute_support_forces

    def compute(*given):
        forces, lost = known(*given), np.zeros(2)
        lost[axis] = 1e-6
        return replace(forces, on_ground=forces.on_ground + lost)

    return compute


def never_slip(law, mesh, contact, velocity, reaction):
    """Equilibrium is met, Coulomb is not."""
    return replace(contact, sign=np.zeros_like(contact.sign))


def disturb(*given, known=round.solve_flow, **named):
    """A flow whose last stress is off by a millionth."""
    result = known(*given, **named)
    stress = result.state.stress
    noise = 1e-6 * np.random.default_rng(1).normal(size=stress.shape)
    return replace(result, state=replace(result.state, stress=stress + noise))


LOST = (Outcome.BALANCE_VIOLATED, "force missing from the balance")
NO_CORRECTION = (interface, "remove_rounding", lambda _, __, state: state)


@pytest.mark.parametrize(
    ("patches", "ended"),
    [
        (
            [(PlacedMesh, "is_valid", property(lambda _: False))],
            (Outcome.OUT_OF_VALIDITY, "mesh of the snow folds over"),
        ),
        (
            [(net, "solve_funicular", end_without_equilibrium)],
            (Outcome.NO_EQUILIBRIUM, "no equilibrium"),
        ),
        ([(interface, "compute_support_forces", lose(0))], LOST),
        ([(interface, "compute_support_forces", lose(1))], LOST),
        (
            [(flow, "update_contact", never_slip)],
            (Outcome.BALANCE_VIOLATED, "shear beyond the friction limit"),
        ),
        ([(round, "solve_flow", disturb), NO_CORRECTION], LOST),
    ],
)
def test_a_spoilt_part_is_told(a_scene, monkeypatch, patches, ended):
    """In NumPy: the core has its own parts."""
    monkeypatch.setenv("NETDESIGN_CORE", "numpy")
    for owner, name, spoilt in patches:
        monkeypatch.setattr(owner, name, spoilt)
    is_coulomb = "friction" in ended[1]
    given = {"inclination_deg": 30.0, "friction_deg": 5.0} if is_coulomb else {}
    is_stress = any(name == "solve_flow" for _, name, _ in patches)
    settings = replace(COARSE, shape_tolerance=1e-4) if is_stress else COARSE
    outcome, reason = ended
    assert_fails(outcome, solve_steady(a_scene(**given), settings), reason)


# --- freeboard ---------------------------------------------------------------


@pytest.mark.parametrize("inclination", [0.0, 30.0])
def test_freeboard_is_straight_and_above_the_snow(solved, inclination):
    solution = solved(inclination_deg=inclination, height_m=5.0, slack=0.02)
    last = solution.net_curve[:, -3:]
    assert last[1, 0] == pytest.approx(4.0, abs=1e-9)  # contact ends at the surface
    np.testing.assert_allclose(last[:, 1], (last[:, 0] + last[:, 2]) / 2, rtol=1e-12)
    np.testing.assert_allclose(last[:, 2], solution.scene.net.head, atol=1e-9)
    free = last[:, 0] - last[:, 2]
    direction = free / np.hypot(*free)
    # no load on it: the head is pulled along it, exactly
    np.testing.assert_allclose(
        pull(solution.head) / solution.head.size, direction, atol=1e-9
    )
    assert solution.net_forces.shape[1] == solution.net_curve.shape[1] - 2


# --- error -------------------------------------------------------------------


SCENES = [
    {},
    {"inclination_deg": 30.0},
    {"inclination_deg": 30.0, "friction_deg": 0.0},
    {"inclination_deg": 30.0, "friction_deg": 5.0},
    {"inclination_deg": 30.0, "ground": "no-slip"},
    {
        "inclination_deg": 30.0,
        "ground": "sliding",
        "slip_length_m": 2.0,
        "friction_deg": 5.0,
    },
]
LOOSE = [
    {"ground": "sliding", "slip_length_m": 2.0, "friction_deg": 5.0},
    {"inclination_deg": 20.0, "slack": 0.1},
    {"inclination_deg": 20.0, "slack": 0.1, "friction_deg": 10.0, "height_m": 4.8},
]


def true_over_stated(solved, first_level, scene):
    """Of both pulls, the finest mesh being four or eight times as fine."""
    coarse, fine = solved(first_level, **scene), solved(2, **scene)
    return max(
        np.hypot(*(pull(getattr(coarse, end)) - pull(getattr(fine, end))))
        / getattr(coarse, end).error
        for end in ENDS
    )


@each("first_level", [0, 1])
@each("scene", SCENES + LOOSE)
def test_stated_error_holds(solved, first_level, scene):
    assert true_over_stated(solved, first_level, scene) <= 1.0


def test_mesh_is_refined_until_accurate(a_scene):
    scene = a_scene(inclination_deg=30.0)
    loose = solve_steady(scene, SolverSettings(accuracy=0.01))
    tight = solve_steady(scene, SolverSettings(accuracy=1.5e-3))
    assert loose.cost.elements < tight.cost.elements
    for solution, accuracy in ((loose, 0.01), (tight, 1.5e-3)):
        for end in ENDS:
            found = getattr(solution, end)
            assert found.error <= accuracy * found.size


# --- what a scene does not need ----------------------------------------------


@pytest.mark.parametrize("inclination", [0.0, 30.0])
def test_snow_beyond_the_nets_reach_becomes_its_load(a_scene, inclination, monkeypatch):
    """Fewer triangles, the same pulls to within the mesh's own error."""
    scene = a_scene(length_m=240.0, inclination_deg=inclination)
    assert scene.modelled_aspect == 8.0
    cut = solve_steady(scene, COARSE, on_failure="raise")
    monkeypatch.setattr("netdesign.coupling.scene._CUT_FROM", 1e9)
    assert scene.modelled_aspect == 240.0 / 4.0
    whole = solve_steady(scene, COARSE, on_failure="raise")
    assert cut.cost.degrees_of_freedom < 0.8 * whole.cost.degrees_of_freedom
    weights = [one.balance.weight_along_slope for one in (cut, whole)]
    assert weights[0] == pytest.approx(weights[1], rel=1e-3)  # of the bulges
    for end in ENDS:
        np.testing.assert_allclose(
            pull(getattr(cut, end)),
            pull(getattr(whole, end)),
            atol=1e-3 * getattr(whole, end).size,
        )


@pytest.mark.parametrize(
    "changes",
    [{"ground": "no-slip"}, {"length_m": 35.0}, {"ground_contact": "one-sided"}],
    ids=str,
)
def test_snow_that_the_ground_holds_or_that_is_near_is_not_cut(a_scene, changes):
    contact = changes.get("ground_contact", "two-sided")
    given = {key: value for key, value in changes.items() if key != "ground_contact"}
    scene = replace(a_scene(**{"length_m": 80.0, **given}), ground_contact=contact)
    assert (
        scene.modelled_aspect
        == scene.snowpack.upslope_length / scene.snowpack.thickness
    )
    assert scene.steady_flow_problem.end_load == 0.0


def test_failure_names_what_leaves_no_steady_state(a_scene):
    """One-sided ground under snow that slips: too few rounds are not its only cause."""
    scene = replace(
        a_scene(inclination_deg=30.0, friction_deg=5.0), ground_contact="one-sided"
    )
    result = solve_steady(scene, replace(COARSE, max_rounds=2))
    assert_fails(Outcome.NO_EQUILIBRIUM, result, "lifts off a one-sided support")
    assert "the net still moves by" in str(result.reason)
