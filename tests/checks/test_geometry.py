"""Geometry of a row against limits, at their bounds and without them."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from netdesign.checks import (
    list_standards,
    load_standard,
)
from netdesign.checks.geometry import check_slope, compute_largest_row_spacing
from netdesign.checks.rating import OpenKind
from netdesign.checks.schema import SPACING_CAP
from netdesign.edge.json_text import write_json
from netdesign.outcome import Verdict
from tests.checks.row_geometry import RowGeometry, check_geometry
from tests.each import each

SWISS = load_standard("swiss-guideline-2007")
EUROCODE = load_standard("eurocode")
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


@each(
    "changes, mode, verdict",
    [
        ({"slope_angle": math.radians(30)}, "slope", Verdict.PASS),
        ({"slope_angle": math.radians(29.9)}, "slope", Verdict.FAIL),
        ({"slope_angle": math.radians(50.1)}, "slope", Verdict.FAIL),
        ({"net_height": 2.999}, "height", Verdict.FAIL),
        ({"net_height": math.nan}, "height", Verdict.NOT_PROVEN),
        ({"gap": 2.0}, "gap", Verdict.PASS),
        ({"gap": 2.01}, "gap", Verdict.FAIL),
        ({"upslope_length": math.nan}, "spacing", Verdict.NOT_PROVEN),
    ],
)
def test_at_the_bounds(changes, mode, verdict):
    assert verdicts(**changes)[mode] is verdict


def test_a_gap_and_a_distance_below_a_metre_are_within():
    assert verdicts(gap=0.0)["gap"] is Verdict.PASS
    assert verdicts(upslope_length=0.5)["spacing"] is Verdict.PASS


def test_a_free_end_has_no_gap_to_be_checked():
    assert "gap" not in verdicts(gap=math.inf)


def test_row_spacing_of_the_guideline():
    """f_L = 2 * 1 / (1 - 0.55) = 4.444 at 45 degrees; H_K = 3 / cos 45 = 4.243 m."""
    largest = compute_largest_row_spacing(math.radians(45), 3.0, 0.55)
    assert largest == pytest.approx(4.4444 * 4.2426, rel=1e-4)
    # tan 38 = 0.78129: f_L = 1.56257 / 0.23129 = 6.7560; H_K = 3.8071 m
    largest = compute_largest_row_spacing(math.radians(38), 3.0, 0.55)
    assert largest == pytest.approx(25.721, rel=1e-4)
    at_45 = {"slope_angle": math.radians(45)}
    assert verdicts(upslope_length=18.8, **at_45)["spacing"] is Verdict.PASS
    assert verdicts(upslope_length=18.9, **at_45)["spacing"] is Verdict.FAIL


@pytest.mark.parametrize(
    ("friction", "factor"), [(0.5, 4.95), (0.55, 5.8), (0.6, 7.02)]
)
def test_factor_of_the_row_spacing_at_40_degrees(friction, factor):
    height = 2.7 / math.cos(math.radians(40))
    largest = compute_largest_row_spacing(math.radians(40), 2.7, friction)
    assert largest / height == pytest.approx(factor, abs=5e-3)


def test_beyond_the_cap_a_distance_that_the_formula_allows_is_not_proven():
    # at 32 degrees f_L is 16.7; the cap of 7 is 7 * 3 / cos 32 = 24.76 m
    flat = {"slope_angle": math.radians(32)}
    assert verdicts(upslope_length=24.7, **flat)["spacing"] is Verdict.PASS
    assert verdicts(upslope_length=24.8, **flat)["spacing"] is Verdict.NOT_PROVEN


def test_flat_slope_needs_no_rows():
    assert compute_largest_row_spacing(math.atan(0.55), 3.0, 0.55) == math.inf
    assert verdicts(slope_angle=math.atan(0.5))["spacing"] is Verdict.PASS


@pytest.mark.parametrize("slope", [26.3, 28.7, 29.1, 41.2])
def test_checks_of_every_slope_can_be_written(slope):
    """Also where no distance of the rows is too large: infinity is no number there."""
    row = replace(ROW, slope_angle=math.radians(slope))
    text = write_json(check_geometry(row, SWISS))
    assert f"{slope:.10g} degrees" in " ".join(
        str(check.reason) for check in check_geometry(row, SWISS)
    )
    assert "geometry.spacing" in text


PROFILES = [load_standard(name) for name in list_standards()]


@pytest.mark.parametrize("profile", PROFILES, ids=lambda one: one.id)
@given(st.floats(0.0, 89.0))
@settings(max_examples=60)
def test_no_profile_passes_a_slope_that_cannot_be_believed(profile, degrees):
    check = check_slope(math.radians(degrees), profile)
    is_inside = 25.0 <= degrees <= 60.0
    assert is_inside or check.verdict is not Verdict.PASS
    has_limits = profile.find("geometry.slope.min") is not None
    if not has_limits:
        expected = Verdict.PASS if is_inside else Verdict.NOT_PROVEN
        assert check.verdict is expected


@given(st.floats(60.01, 75.0))
@settings(max_examples=30)
def test_a_percentage_is_guessed_where_degrees_are_too_many(degrees):
    """The row of the verdict page: 65, meant in percent."""
    check = check_slope(math.radians(degrees), load_standard("eurocode"))
    meant = math.degrees(math.atan(degrees / 100))
    assert f"% are {meant:.4g} degrees)." in str(check.reason)


@pytest.mark.parametrize(
    ("mode", "limit"),
    [
        ("inclination", "geometry.inclination.min"),
        ("slope", "geometry.slope.min"),
        ("height", "geometry.height.ratio"),
        ("spacing", "geometry.spacing.ground_friction"),
        ("gap", "geometry.gap.max"),
    ],
)
def test_each_check_names_its_clause(mode, limit):
    values = tuple(
        replace(value, clause=f"clause of {value.id}") for value in SWISS.values
    )
    checks = check_geometry(ROW, replace(SWISS, values=values))
    (check,) = (c for c in checks if c.mode == mode)
    assert check.clause == f"clause of {limit}"


def test_one_end_of_a_range_alone_is_no_limit():
    for left_out in ("geometry.slope.min", "geometry.slope.max"):
        values = tuple(v for v in SWISS.values if v.id != left_out)
        check = check_slope(ROW.slope_angle, replace(SWISS, values=values))
        assert str(check.reason).endswith("lies inside 25 to 60 degrees.")


BARE = replace(SWISS, values=())
UNCAPPED = replace(
    SWISS, values=tuple(one for one in SWISS.values if one.id != SPACING_CAP)
)
FAR = {"upslope_length": 24.9, "slope_angle": math.radians(31)}


@each(
    "mode, standard, changes, kind, key, numbers",
    [
        ("inclination", BARE, {}, OpenKind.RESISTANCE_MISSING,
         "geometry.no_inclination_limits", set()),
        ("slope", BARE, {}, OpenKind.RESISTANCE_MISSING,
         "geometry.no_plausible_slope", set()),
        ("slope", EUROCODE, {"slope_angle": math.radians(73.0)},
         OpenKind.VALUE_ASKED, "geometry.percentage", {73.0}),
        ("slope", EUROCODE, {"slope_angle": math.radians(22.5)},
         OpenKind.VALUE_ASKED, "geometry.slope_not_plausible", {22.5, 25.0, 60.0}),
        ("spacing", SWISS, FAR, OpenKind.UNSOLVED, "geometry.spacing_capped", {24.9}),
        ("spacing", UNCAPPED, FAR, OpenKind.UNSOLVED, "geometry.no_cap", set()),
        ("spacing", UNCAPPED, FAR | {"upslope_length": 3.0}, OpenKind.UNSOLVED,
         "geometry.no_cap", set()),
    ],
)  # fmt: skip
def test_what_leaves_geometry_open_is_said_with_its_kind(
    mode, standard, changes, kind, key, numbers
):
    row = replace(ROW, **changes)
    (check,) = (one for one in check_geometry(row, standard) if one.mode == mode)
    (point,) = check.open
    assert check.verdict is Verdict.NOT_PROVEN
    assert (point.kind, point.message.key) == (kind, key)
    given = [one for one in point.message.arguments.values() if isinstance(one, float)]
    assert numbers <= {round(one, 9) for one in given}
    if key == "geometry.spacing_capped":
        assert len(point.message.arguments) == 2
