"""Spread of the model form beside the coupled forces of a row."""

from contextlib import contextmanager

import pytest

from netdesign.calculation.quantity import Kind
from netdesign.calculation.steps import Step
from netdesign.checks.check import Check
from netdesign.coupling.scene import SolverSettings
from netdesign.envelope.ranges import Case
from netdesign.snow.creep_law import BOUTILLIER_2004
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.study.judge import record_model_form
from netdesign.study.row_to_check import CaseSolver
from tests.small_site import build_row

CASE = Case(density=393.0, friction_angle=0.41, inclination=0.52)
CHECK = Check(
    id="foot_anchor.tendon",
    clause="",
    member="foot_anchor",
    mode="tendon",
    steps=[
        Step(symbol="μ", unit="-", value=0.7, low=0.69, high=0.71, kind=Kind.WORKED)
    ],
)


def build_probe():
    return CaseSolver(SolverSettings(accuracy=0.02), BOUTILLIER_2004)


def solve(solver, row, case):
    (result,) = solver.solve_all([(row, case, solver.law)])
    return result


@contextmanager
def record_slips(solver):
    """Slip lengths of the rows that are solved [m], by the creep law."""
    slips, solve_all = {}, solver.solve_all

    def record_all(wanted):
        slips.update({law.name: row.ground.slip_length for row, _, law in wanted})
        return solve_all(wanted)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(solver, "solve_all", record_all)
        yield slips


@pytest.fixture(scope="module")
def sliding():
    row = build_row(
        "R7",
        ground=build_ground_from_glide_factor(1.9, build_row("R7").snow_thickness),
        glide_factor=1.9,
    )
    solver = build_probe()
    return row, solver, solve(solver, row, CASE)


def test_model_form_of_a_sliding_row(sliding):
    row, solver, result = sliding
    with record_slips(solver) as slips:
        record = record_model_form(solver, row, result, "foot_anchor", CHECK)
    variants = {one.creep_law: one for one in record.variants}
    assert set(variants) == {"zwinger-2007", "gagliardini-1997"}
    known = {one.ratio for one in record.variants if one.ratio is not None}
    assert record.ratios[0] == min(known) < 0.95
    assert record.ratios[1] == max(known | {1.0})
    # the other law means the same N, and so another slip length
    assert slips["zwinger-2007"] != row.ground.slip_length
    refused = variants["gagliardini-1997"]
    assert refused.ratio is None
    assert "sideways" in str(refused.reason)
    assert len(slips) <= 2


def test_model_form_of_a_row_whose_slip_length_was_typed():
    row = build_row("R7", ground=GroundLaw(kind="sliding", slip_length=2.2))
    solver = build_probe()
    result = solve(solver, row, CASE)
    with record_slips(solver) as slips:
        record_model_form(solver, row, result, "post", CHECK)
    assert set(slips.values()) == {2.2}
