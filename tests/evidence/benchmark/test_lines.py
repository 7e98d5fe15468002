"""Lines of scenes: what counts as a jump, how scenes are drawn, short real lines."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.evidence.benchmark import lines
from netdesign.evidence.benchmark.lines import (
    PARAMETERS,
    Line,
    Point,
    close_in,
    find_jumps,
    follow_line,
    write_lines,
)
from netdesign.evidence.benchmark.scenes import build_tables, draw_scene
from netdesign.outcome import Outcome, SolveError

ACCURACY = SolverSettings(accuracy=0.005)


def points_of(pulls, error=1.0):
    return [
        Point(place=k, pulls=(pull, pull), errors=(error, error), elements=100 + k)
        for k, pull in enumerate(pulls)
    ]


@given(st.lists(st.floats(-3.0, 3.0), min_size=4, max_size=9), st.floats(0.0, 1.0))
def test_noise_within_a_third_of_the_errors_is_no_jump(slopes, offset):
    """Straight lines with noise: three halves of the noise of a step may show."""
    rng = np.random.default_rng(7)
    clean = 1e3 + slopes[0] * np.arange(9)
    noise = rng.uniform(-0.3, 0.3, 9)
    found = find_jumps(points_of(clean + noise + offset))
    assert max(one["over_stated"] for one in found) < 1.0


def test_a_jump_is_told_with_its_place_and_size():
    pulls = 1e3 + 0.7 * np.arange(8)
    pulls[4:] += 13.7
    worst = max(find_jumps(points_of(pulls)), key=lambda one: one["over_stated"])
    assert worst["place"] == 3
    assert worst["over_stated"] == pytest.approx(13.7 / 2.0, rel=1e-9)
    assert worst["elements"] == [103, 104]


@pytest.mark.parametrize(
    ("pull", "stays"),
    [
        (lambda x: 1e3 + (90.0 if x > 0.62 else 0.0), True),
        (lambda x: 1e3 + 90.0 * max(0.0, x - 0.11), False),
    ],
    ids=["jump", "bend"],
)
def test_a_jump_stays_where_it_is_closed_in_on(pull, stays):
    error = 5.0

    def solve(value):
        pulls, errors = (1.0, pull(value)), (error, error)
        return Point(place=0, pulls=pulls, errors=errors, elements=7)

    jump = {"place": 3, "end": "head", "over_stated": 4.2, "relative": 0.1}
    found = close_in(jump, np.array([0.0, 1.0]), solve)
    assert found["place"] == 3
    if stays:
        assert found["over_stated"] == pytest.approx(90.0 / (2 * error), rel=1e-12)
    else:
        assert found["over_stated"] == pytest.approx(90.0 / 32 / (2 * error), rel=1e-12)


def test_a_gap_without_results_leaves_the_jump():
    def refuse(*_):
        raise SolveError(Outcome.DIVERGED, "nowhere")

    jump = {"place": 3, "end": "head", "over_stated": 4.2, "relative": 0.1}
    assert close_in(jump, np.array([0.0, 1.0]), refuse) is jump


def test_points_beside_a_refused_one_say_nothing():
    points = points_of([1e3, 1e3, 2e3, 2e3, 2e3])
    assert not find_jumps([*points[:2], *points[3:]])
    assert find_jumps(points)


@pytest.mark.parametrize("number", range(len(PARAMETERS)))
def test_each_quantity_goes_through_its_range(number):
    parameter = PARAMETERS[number]
    values = parameter.list_values(23)
    assert (values[0], values[-1]) == pytest.approx(parameter.bounds, rel=1e-12)
    assert (np.diff(values) > 0.0).all()
    scenes = lines._list_scenes(
        lines._draw_base(number, 11, parameter), parameter, parameter.list_values(5)
    )
    assert isinstance(scenes[2], Scene)
    built = [one for one in scenes if isinstance(one, Scene)]
    assert len(set(built)) == len(built)


def test_thickness_takes_layers_and_flush_nets_along():
    tables = draw_scene(
        5, next(k for k in range(99) if "layers" in draw_scene(5, k)["snow"])
    )
    tables["net"]["height_m"] = tables["snow"]["thickness_m"]
    lines._set_thickness(tables, 2.718)
    snow = tables["snow"]
    total = sum(layer["thickness_m"] for layer in snow["layers"])
    assert total == pytest.approx(2.718, rel=1e-12)
    assert tables["net"]["height_m"] == snow["thickness_m"] == 2.718


# Drawn by a search: with errors from the last difference alone the head's pull jumped
# by 1.4 times the stated errors between 1.6 and 1.7 degrees.
SMOOTH = {
    "slope": {"angle_deg": 45.71775631587626},
    "snow": {
        "thickness_m": 2.4979551328772036,
        "upslope_length_m": 53.85676330149508,
        "density_kg_m3": 457.0207050448685,
    },
    "ground": {
        "law": "sliding",
        "slip_length_m": 5.649038107658103,
        "contact": "one-sided",
    },
    "net": {
        "inclination_deg": 16.92020975197442,
        "height_m": 4.962629695999441,
        "stiffness_kN_per_m": 38716.82317249204,
        "slack": 0.027360202968030548,
    },
}


def test_smooth_net_on_one_sided_ground_does_not_jump():
    near, far = (
        lines._record(place, solve_steady(scene, ACCURACY, on_failure="raise"), None)
        for place, scene in enumerate(
            build_tables({**SMOOTH, "net": SMOOTH["net"] | {"friction_deg": friction}})
            for friction in (1.6, 1.7)
        )
    )
    for end in range(2):
        allowed = near.errors[end] + far.errors[end]
        assert abs(near.pulls[end] - far.pulls[end]) < allowed


def take_part(parameter, seed):
    """A fortieth of a quantity's range, somewhere in it."""
    values = parameter.list_values(200)
    first = int(np.random.default_rng(seed).integers(0, 194))
    return replace(parameter, bounds=(float(values[first]), float(values[first + 5])))


@pytest.mark.parametrize("number", [0, 1, 2, 5, 6, 7])
def test_a_short_line(number, monkeypatch):
    parts = tuple(take_part(one, 29) for one in PARAMETERS)
    monkeypatch.setattr(lines, "PARAMETERS", parts)
    monkeypatch.setattr(lines, "TRUTHS", 0)
    found = follow_line(number, seed=13, accuracy=0.02, points=6)
    assert found.parameter == PARAMETERS[number].name
    assert found.solved + found.refused == 6
    assert found.solved >= 4
    assert found.largest_jump < 1.0
    assert not found.jumps


def test_truths_along_a_line(monkeypatch):
    monkeypatch.setattr(lines, "TRUTHS", 1)
    found = follow_line(0, seed=13, accuracy=0.02, points=4)
    (ratio,) = found.ratios
    assert 0.0 < ratio < 1.0


def test_a_truth_that_fails_is_told(monkeypatch):
    def fail(*_):
        raise SolveError(Outcome.DIVERGED, "too fine")

    monkeypatch.setattr(lines, "_compare", fail)
    found = follow_line(0, seed=13, accuracy=0.05, points=3)
    assert len(found.missing) == found.solved > 0
    assert "too fine" in str(found.missing[0])


def a_line(**changes):
    given = {
        "number": 0,
        "parameter": "slack",
        "solved": 200,
        "refused": 0,
        "jumps": [],
        "bends": 0,
        "largest_jump": 0.4,
        "ratios": [0.3] * 20,
        "missing": [],
        "reasons": [],
    }
    return Line(**given | changes)


@pytest.mark.parametrize(
    ("changes", "passes"),
    [
        ({}, True),
        ({"ratios": [0.3] * 19 + [1.5]}, True),
        ({"ratios": [0.3] * 19 + [1.51]}, False),
        ({"ratios": [0.3] * 18 + [1.1, 1.2]}, False),
        ({"ratios": []}, False),
        ({"jumps": [{"place": 3}]}, False),
        ({"missing": ["diverged"]}, False),
    ],
)
def test_what_passes(changes, passes):
    document = write_lines([a_line(**changes)], 1, 0.01)
    assert document["schema"] == "netdesign.lines/1"
    assert document["pass"] is passes
