"""Glide factor by which the guideline, a row and its ends are loaded."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Case, Interval, Ranges
from netdesign.guideline.load_cases import find_glide_factor
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.snow.ground import (
    DEFAULT_CREEP_LAW,
    LARGEST_GLIDE_FACTOR,
    GroundLaw,
    build_ground_from_glide_factor,
    load_glide_tables,
)
from netdesign.study.guideline_load import (
    find_glide_factors,
    find_row_glide_factor,
    find_solved_ground,
    load_glide_limits,
)
from netdesign.study.row_to_check import build_scene
from tests.small_site import RUN, build_row

SLIDING = GroundLaw(kind="sliding", slip_length=7.3)
ONE_CASE = Ranges.of(
    density=Interval(low=347.0, high=347.0),
    friction_angle=Interval(low=0.41, high=0.41),
    inclination=Interval(low=0.47, high=0.47),
)


def a_row(ground=SLIDING, glide_factor=None):
    row = build_row("R1", ground=ground, gap=1.7)
    layout = replace(row.layout, post_spacing=2.0)  # its ends carry more
    return replace(row, glide_factor=glide_factor, layout=layout)


@pytest.mark.parametrize("glide", [1.2003, 2.713, 3.2])
def test_a_typed_factor_is_taken_as_it_is(glide):
    """Whatever slip length the ground has: it is not asked."""
    assert find_row_glide_factor(a_row(glide_factor=glide)) == glide


@pytest.mark.parametrize("glide", [1.37, 2.713, 3.2])
def test_without_one_the_slip_length_leads_back_to_it(glide):
    row = a_row()
    ground = build_ground_from_glide_factor(glide, row.snow_thickness)
    assert find_row_glide_factor(a_row(ground)) == pytest.approx(glide, rel=1e-12)


@pytest.mark.parametrize(
    ("ground", "expected"),
    [
        (GroundLaw(kind="no-slip"), 1.2),  # the least of the guideline's tables
        (GroundLaw(kind="sliding", slip_length=0.013), 1.2),
        (GroundLaw(kind="free"), 3.2),  # the largest of the guideline's tables
        (GroundLaw(kind="sliding", slip_length=199.0), LARGEST_GLIDE_FACTOR),
    ],
)
def test_at_the_ends_of_the_table(ground, expected):
    assert find_row_glide_factor(a_row(ground)) == expected
    assert find_glide_factor(ground, a_row().snow_thickness, (1.2, 3.2)) == expected


def test_no_factor_lies_below_the_least_of_the_guideline_s_tables():
    """Typed, of a slip length or of a ground without slip; limits from the profile."""
    tables = load_standard("swiss-guideline-2007").tables
    rows = [one.rows for one in tables if one.id.startswith("glide.factor")]
    factors = [row.value for table in rows for row in table]
    assert load_glide_limits() == (min(factors), max(factors)) == (1.2, 3.2)
    for glide in (1.0, 1.0004, 1.1999):
        assert find_row_glide_factor(a_row(glide_factor=glide)) == 1.2


def test_factors_of_many_thicknesses_are_those_of_each():
    thicknesses = np.array([0.31, 1.47, 2.9, 4.4])
    grounds = [
        SLIDING,
        GroundLaw(kind="sliding", slip_length=0.4),
        GroundLaw(kind="no-slip"),
        GroundLaw(),
    ]
    for row in [*(a_row(ground) for ground in grounds), a_row(glide_factor=2.17)]:
        many = find_glide_factors(row, thicknesses)
        each = [
            find_row_glide_factor(replace(row, snow_thickness=d)) for d in thicknesses
        ]
        assert many.tolist() == each


CASE = Case(density=347.0, friction_angle=0.41, inclination=0.47)


def find_solved_slip(ground, thickness):
    """Slip length of the ground that a row's case is solved with [m]."""
    row = replace(a_row(ground), snow_thickness=thickness, net_height=thickness)
    scene = build_scene(row, CASE, RUN.creep_law)
    assert scene.ground.kind == "sliding"
    return scene.ground.slip_length


def test_forces_of_a_check_take_at_least_the_slip_of_the_least_factor():
    """N = 1.2 lies between 1.1963 at 0.25 and 1.2330 at 0.315 of the thickness."""
    least = 0.25 + (1.2 - 1.1963) / (1.2330 - 1.1963) * (0.315 - 0.25)
    for d in (1.31, 2.47):
        rough = find_solved_slip(GroundLaw(kind="no-slip"), d)
        assert rough == pytest.approx(least * d, rel=1e-12)
        slips = [0.01, 0.999 * least * d, 1.001 * least * d, 3.0 * d]
        found = [
            find_solved_slip(GroundLaw(kind="sliding", slip_length=one), d)
            for one in slips
        ]
        assert found == pytest.approx([rough, rough, *slips[2:]], rel=1e-12)
    free = build_scene(a_row(GroundLaw()), CASE, RUN.creep_law)
    assert free.ground == GroundLaw()


def test_other_creep_laws_have_the_slip_of_their_own_table():
    row = replace(a_row(GroundLaw(kind="no-slip")), snow_thickness=2.0)
    for law in CREEP_LAWS.values():
        known = law.name if law.name in load_glide_tables() else DEFAULT_CREEP_LAW
        expected = build_ground_from_glide_factor(1.2, 2.0, known)
        assert find_solved_ground(row, law) == expected
