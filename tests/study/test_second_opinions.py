"""Closed form and spread of the model form beside the coupled forces of a row."""

import math
from dataclasses import replace

import pytest

from netdesign.calculation.quantity import Kind
from netdesign.calculation.steps import Step
from netdesign.coupling.scene import SolverSettings
from netdesign.envelope.ranges import Case
from netdesign.haefeli.pressure import compute_slab_force
from netdesign.haefeli.slab import Slab, find_linear_slip
from netdesign.outcome import Verdict
from netdesign.snow.creep_law import BOUTILLIER_2004, GAGLIARDINI_1997
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.study.model_form import record_model_form
from netdesign.study.record_independent import record_slab
from netdesign.study.records import CheckRecord
from netdesign.study.row_to_check import CaseSolver
from tests.small_site import build_row

CASE = Case(density=393.0, friction_angle=0.41, inclination=0.52)
CHECK = CheckRecord(
    id="foot_anchor.tendon",
    clause="",
    member="foot_anchor",
    mode="tendon",
    demand_kN=70.0,
    resistance_kN=100.0,
    utilisation=0.7,
    steps=[
        Step(symbol="μ", unit="-", value=0.7, low=0.69, high=0.71, kind=Kind.WORKED)
    ],
    verdict=Verdict.PASS,
    case=None,
    reason="holds",
)


def build_probe():
    return CaseSolver(SolverSettings(accuracy=0.02), BOUTILLIER_2004)


def solve(solver, row, case):
    (result,) = solver.solve_all([(row, case, solver.law)])
    return result


@pytest.fixture(scope="module")
def sliding():
    row = build_row(
        "R7",
        ground=build_ground_from_glide_factor(1.9, build_row("R7").snow_thickness),
        glide_factor=1.9,
    )
    solver = build_probe()
    return row, solver, solve(solver, row, CASE)


def test_closed_form_of_a_sliding_row(sliding):
    row, _, result = sliding
    record = record_slab(row, result, BOUTILLIER_2004)
    by_factor, by_length = record.cases
    slab = Slab(
        thickness=row.held_thickness, slope_angle=row.slope_angle, density=393.0
    )
    force = compute_slab_force(
        slab,
        slip_length=find_linear_slip(slab, 1.9),
        upslope_length=row.upslope_length,
        inclination=0.52,
    )
    assert by_factor.load_kN_per_m == pytest.approx(force.total / 1e3, rel=1e-12)
    assert by_length.slip_length_m == row.ground.slip_length
    # linear creep is held back farther at the same slip length
    assert by_length.load_kN_per_m > by_factor.load_kN_per_m
    assert by_factor.load_difference_percent == pytest.approx(
        100.0 * (record.solved_load_kN_per_m * 1e3 / force.total - 1.0)
    )
    # both are the same snow at the same N: within a sixth of each other (measured)
    assert abs(by_factor.load_difference_percent) < 16.0
    assert by_factor.foot_anchor_kN > by_factor.load_kN_per_m


def test_closed_form_of_free_ground_is_the_weight():
    row = build_row("R7", ground=GroundLaw(kind="free"))
    result = solve(build_probe(), row, CASE)
    (free,) = record_slab(row, result, BOUTILLIER_2004).cases
    assert (free.slip_length_m, free.influence_length_m) == (None, None)
    depth = row.held_thickness
    area = depth * row.upslope_length + depth**2 * math.tan(0.52) / 2.0
    weight = 393.0 * 9.81 * area * math.sin(row.slope_angle)
    assert free.load_kN_per_m * 1e3 == pytest.approx(weight, rel=1e-12)
    # the coupled net's bulge holds 5 % more, on short snow with slack 0.05
    assert 0.0 < free.load_difference_percent < 6.0


def test_snow_that_the_law_refuses_has_no_closed_form(sliding):
    row, _, result = sliding
    assert record_slab(row, result, GAGLIARDINI_1997) is None
    failed = replace(result, solution=None)
    assert record_slab(row, failed, BOUTILLIER_2004) is None


def test_model_form_of_a_sliding_row(sliding):
    row, solver, result = sliding
    record = record_model_form(solver, row, result, "foot_anchor", CHECK)
    variants = {(one.kind, one.creep_law): one for one in record.variants}
    known = {one.ratio for one in record.variants if one.ratio is not None}
    assert record.low_ratio == min(known) < 0.95
    assert record.high_ratio == max(known | {1.0})
    assert record.utilisation_low == pytest.approx(0.7 * record.low_ratio)
    assert (record.numerical_low, record.numerical_high) == (0.69, 0.71)
    # each exponent means the same N, and so another slip length
    slips = [
        variants["exponent", f"boutillier-2004-n{n}"].slip_length_m
        for n in (1.8, 2.15, 3.6)
    ]
    assert slips == sorted(slips)
    assert slips[0] < row.ground.slip_length < slips[2]
    stated = variants["exponent", "boutillier-2004-n1.8"]
    assert (stated.stated, stated.is_calibrated) == ("no", True)
    refused = variants["creep_law", "gagliardini-1997"]
    assert refused.ratio is None
    assert "sideways" in str(refused.reason)
    # nothing is solved for a law that cannot take the snow, at any exponent
    assert ("exponent", "gagliardini-1997-n1.8") not in variants
    assert record.solves <= 10


def test_model_form_of_a_row_whose_slip_length_was_typed():
    row = build_row("R7", ground=GroundLaw(kind="sliding", slip_length=2.2))
    solver = build_probe()
    record = record_model_form(solver, row, solve(solver, row, CASE), "post", CHECK)
    solved = [one for one in record.variants if one.ratio is not None]
    assert {one.slip_length_m for one in solved} == {2.2}
    # at the same slip length a smaller exponent is held back farther
    by_law = {one.creep_law: one.ratio for one in solved if one.kind == "exponent"}
    assert by_law["boutillier-2004-n1.8"] > 1.0 > by_law["boutillier-2004-n3.6"]
    (linear,) = (one for one in solved if one.kind == "slip_law")
    assert linear.ratio > 1.0


def test_model_form_needs_a_force(sliding):
    row, solver, result = sliding
    assert record_model_form(solver, row, result, "post_of_no_kind", CHECK) is None


def test_beyond_the_branch_no_exponent_is_derived():
    row = build_row("R7", ground=GroundLaw(kind="free"))
    dense = replace(CASE, density=760.0)
    solver = build_probe()
    result = solve(solver, row, dense)
    record = record_model_form(solver, row, result, "foot_anchor", CHECK)
    derived = [one for one in record.variants if one.kind == "exponent"]
    assert derived
    assert all("no other exponent" in str(one.reason) for one in derived)
    assert all(one.ratio is None for one in derived)
