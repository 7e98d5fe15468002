"""Geometry of a row against limits, at their bounds and without them."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import RowGeometry, check_geometry, load_standard
from netdesign.checks.geometry import compute_largest_row_spacing
from netdesign.outcome import Verdict

SWISS = load_standard("swiss-guideline-2007")
ROW = RowGeometry(
    inclination_low=math.radians(25),
    inclination_high=math.radians(35),
    slope_angle=math.radians(38),
    snow_thickness=3.0,
    net_height=3.0,
    upslope_length=20.0,
    gap=1.0,
)


def verdicts(**changes) -> dict[str, Verdict]:
    checks = check_geometry(replace(ROW, **changes), SWISS)
    return {check.mode: check.verdict for check in checks}


def test_sound_row_passes_all_five():
    assert verdicts() == dict.fromkeys(
        ("inclination", "slope", "height", "spacing", "gap"), Verdict.PASS
    )


@pytest.mark.parametrize(
    ("changes", "mode", "verdict"),
    [
        ({"slope_angle": math.radians(30)}, "slope", Verdict.PASS),
        ({"slope_angle": math.radians(29.9)}, "slope", Verdict.FAIL),
        ({"slope_angle": math.radians(50.1)}, "slope", Verdict.FAIL),
        ({"net_height": 2.999}, "height", Verdict.FAIL),
        ({"net_height": math.nan}, "height", Verdict.NOT_PROVEN),
        ({"gap": 2.0}, "gap", Verdict.PASS),
        ({"gap": 2.01}, "gap", Verdict.FAIL),
        ({"gap": math.inf}, "gap", Verdict.NOT_PROVEN),
        ({"upslope_length": math.nan}, "spacing", Verdict.NOT_PROVEN),
    ],
)
def test_at_the_bounds(changes, mode, verdict):
    assert verdicts(**changes)[mode] is verdict


def test_row_spacing_of_the_guideline():
    """f_L = 2 * 1 / (1 - 0.55) = 4.444 at 45 degrees; H_K = 3 / cos 45 = 4.243 m."""
    largest = compute_largest_row_spacing(math.radians(45), 3.0, 0.55)
    assert largest == pytest.approx(4.4444 * 4.2426, rel=1e-4)
    at_45 = {"slope_angle": math.radians(45)}
    assert verdicts(upslope_length=18.8, **at_45)["spacing"] is Verdict.PASS
    assert verdicts(upslope_length=18.9, **at_45)["spacing"] is Verdict.FAIL


def test_flat_slope_needs_no_rows():
    assert compute_largest_row_spacing(math.atan(0.55), 3.0, 0.55) == math.inf
    assert verdicts(slope_angle=math.atan(0.5))["spacing"] is Verdict.PASS


def test_limits_that_a_profile_lacks_are_not_checked():
    bare = replace(SWISS, values=())
    assert [(c.mode, c.verdict) for c in check_geometry(ROW, bare)] == [
        ("inclination", Verdict.NOT_PROVEN)
    ]
