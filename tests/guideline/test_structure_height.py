"""Load of the guideline on a structure of its own height, against worked numbers.

Foot anchor, uphill guy and post inside the row of four rows of the built-in example,
inclination 25 to 35 degrees, to the digits in which they were worked; first by the
closed form of `own_loads`, then by the program.
"""

import math
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.guideline.floor import NetRanges
from netdesign.guideline.load_cases import NetGeometry, compare_with_guideline
from netdesign.guideline.load_model import read_load_model
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import Member
from tests.each import each
from tests.guideline.one_floor import find_floor
from tests.guideline.own_loads import ROWS, find_largest

SWISS = load_standard("swiss-guideline-2007")
MODEL = read_load_model(SWISS)
USUAL = replace(MODEL, normal_loose=0.35, normal_dense=0.35)
WITH_FORM = replace(USUAL, dimensioning=1e3)
SHARES = (0.2, 0.35, 0.5)
MEMBERS = (Member.FOOT_ANCHOR, Member.UPHILL_GUY, Member.POST)
# By form, of R1, R2, R4 and R5 [kN].
TABLE = {
    "same resultant": (
        "64.33 23.14 69.25",
        "88.28 35.62 92.67",
        "144.0 65.70 137.2",
        "273.1 127.3 245.7",
    ),
    "dimensioning": (
        "70.09 25.53 75.60",
        "91.13 36.93 95.73",
        "144.1 65.74 137.3",
        "270.0 125.8 243.0",
    ),
}
CELLS = [
    (form, name, text)
    for form, texts in TABLE.items()
    for name, text in zip(ROWS, texts, strict=True)
]


def require_digits(found, text):
    """Refuse numbers [kN] that are not the printed ones, each to its digits."""
    for value, printed in zip(found, text.split(), strict=True):
        half = 0.5 * 10.0 ** -len(printed.partition(".")[2])
        assert value == pytest.approx(float(printed), abs=half * 1.001), printed


def build_ranges(row, thicknesses=None):
    """The same row as the program has it; full of snow unless told otherwise."""
    return NetRanges(
        net=NetGeometry(
            slope_angle=math.radians(row.slope),
            snow_thickness=row.typed,
            net_height=row.net,
            inclination=0.0,
            stiffness=1e3 * row.stiffness,
            slack=row.slack,
            layout=SupportLayout(
                post_spacing=row.spacing,
                uphill_anchor_distance=row.uphill,
                downhill_anchor_distance=row.downhill,
            ),
        ),
        inclinations=(math.radians(25.0), math.radians(35.0)),
        thicknesses=thicknesses or (row.net, row.net),
        stiffnesses=(1e3 * row.stiffness,) * 2,
        slacks=(row.slack, row.slack),
        find_glide_factors=lambda d: (0.0 * d + row.glide,) * 2,
    )


def find(row, model=MODEL, thicknesses=None):
    """Largest forces of the three members, and the whole floor [kN]."""
    floor = find_floor(model, build_ranges(row, thicknesses), row.altitude)
    return [floor.find(member).force / 1e3 for member in MEMBERS], floor


@each("form, name, text", CELLS)
def test_reference_numbers_by_a_closed_form_of_our_own(form, name, text):
    require_digits(find_largest(ROWS[name], form)[:3], text)


@each("form, name, text", [one for one in CELLS if one[0] == "same resultant"])
def test_program_brings_the_load_of_case_1_on_the_lower_part_too(form, name, text):
    require_digits(find(ROWS[name], USUAL)[0], text)


@each("name", ROWS)
def test_largest_of_slope_and_dimensioning_form_counts(name):
    """R5 stands at 45 degrees, where the form has less than the slope's own load."""
    row = ROWS[name]
    index = list(ROWS).index(name)
    of_slope, of_form = TABLE["same resultant"][index], TABLE["dimensioning"][index]
    larger = [
        max(pair, key=float)
        for pair in zip(of_slope.split(), of_form.split(), strict=True)
    ]
    require_digits(find(row, WITH_FORM)[0], " ".join(larger))


@each("name", ROWS)
def test_dimensioning_form_has_the_net_s_height_whatever_snow_is_tried(name):
    row = ROWS[name]
    found, floor = find(row, WITH_FORM, (0.4 * row.net, 0.5 * row.net))
    require_digits(found, TABLE["dimensioning"][list(ROWS).index(name)])
    assert {
        one.net.snow_thickness for one in floor.forces if one.case.creep_factor
    } == {row.net}


@each("name", ROWS)
def test_program_is_the_closed_form_with_loose_and_dense_snow(name):
    row = ROWS[name]
    own = find_largest(row, "same resultant", normals=SHARES)
    found, floor = find(row)
    assert found == pytest.approx(own[:3], rel=3e-4)  # own steps of 0.25 degree
    assert all(one >= 0.9999999 * two for one, two in zip(found, own, strict=False))
    assert floor.head.pull / 1e3 == pytest.approx(own[4], rel=3e-4)
    both = find(row, replace(MODEL, dimensioning=1e3))[0]
    by_form = find_largest(row, "dimensioning", normals=SHARES)
    expected = [max(pair) for pair in zip(own[:3], by_form[:3], strict=True)]
    assert both == pytest.approx(expected, rel=3e-4)


@each(
    "name, foot, post, head",
    [("R1", 2.6, 8.8, 9.4), ("R4", 1.1, 6.0, 7.2), ("R5", 0.6, 4.4, 4.6)],
)
def test_dense_snow_presses_more_into_the_ground(name, foot, post, head):
    """Shares of 0.5 in the place of 0.35 [%]; 0.2 is worse nowhere here."""
    usual, floor = find(ROWS[name], USUAL)
    dense, more = find(ROWS[name])
    rise = [100.0 * (new / old - 1.0) for new, old in zip(dense, usual, strict=True)]
    assert (rise[0], rise[2]) == pytest.approx((foot, post), abs=0.05)
    assert 100.0 * (more.head.pull / floor.head.pull - 1.0) == pytest.approx(
        head, abs=0.05
    )
    assert {one.case.normal_share for one in more.forces if one.force > 0.0} == {0.5}


def test_neither_case_governs_all_members():
    """From case 1 to case 2 the foot gets more, the uphill guy less."""
    for row in ROWS.values():
        first, second = (
            find_largest(row, "same resultant", cases=(one,)) for one in (1, 2)
        )
        assert 1.13 < second[0] / first[0] < 1.19
        assert second[1] < 0.67 * first[1]
    names = {one.member: one.case.name for one in find(ROWS["R4"])[1].forces}
    assert names[Member.FOOT_ANCHOR] == "load_case_2"
    assert names[Member.UPHILL_GUY] == "load_case_1"


def test_downhill_guy_is_largest_in_a_net_that_is_not_full():
    """R1: 3.8 kN at 0.7 H_K, 0.1 at H_K; so H is searched."""
    row = ROWS["R1"]
    at_07, full = (
        find_largest(row, "same resultant", heights=(share * row.full_height,))[3]
        for share in (0.7, 1.0)
    )
    assert (at_07, full) == pytest.approx((3.8, 0.1), abs=0.05)
    wide, _ = find(row, USUAL, (0.5 * row.net, row.net)), None
    downhill = wide[1].find(Member.DOWNHILL_GUY)
    assert downhill.force / 1e3 >= at_07
    assert 0.6 < downhill.net.snow_thickness / row.net < 0.8


def test_less_snow_in_the_workbook_lowers_no_force():
    """R4: with 3.0 m of snow typed in the place of 3.9 m the foot has its 144 kN.

    Against 125.9 kN, the design resistance over 1.5, that is 1.14.
    """
    row = ROWS["R4"]
    before = [0.0] * 3
    for height in (3.9, 3.0, 2.1):
        low = height * math.cos(math.radians(row.slope))
        found = find(row, USUAL, (low, row.net))[0]
        assert all(
            new >= 0.9999999 * old for new, old in zip(found, before, strict=True)
        )
        assert found[0] == pytest.approx(144.0, abs=0.05)
        before = found
    assert before[0] / 125.9 == pytest.approx(1.14, abs=0.005)


def test_comparison_has_the_larger_of_all_forms_for_the_net_s_height():
    """At one inclination; the same snow stays as typed, with the usual share."""
    row = ROWS["R4"]
    net = replace(build_ranges(row).net, inclination=math.radians(35.0))
    of_net = find_largest(row, "same resultant", cases=(2,), normals=SHARES)[0]
    same, first, second = compare_with_guideline(
        MODEL, net, density=400.0, altitude=row.altitude, glide_factors=(1.8, 1.8)
    )
    assert same.case.height_vertical == pytest.approx(3.9, rel=1e-12)
    assert (same.case.normal_share, same.case.settled) == (0.35, 1.0)
    assert second.foot / 1e3 == pytest.approx(of_net, rel=1e-6)
    assert first.foot < second.foot
    assert second.case.height_vertical == pytest.approx(row.full_height, rel=1e-12)


def test_profile_of_the_guideline_alone_has_the_dimensioning_form():
    """1 kN/m3; the others leave it out."""
    ids = ("eurocode", "nf-p-95-304-style", "onr-24805-style")
    assert SWISS.find("load.dimensioning").value == 1.0
    assert {load_standard(one).find("load.dimensioning") for one in ids} == {None}
