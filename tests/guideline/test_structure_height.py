"""Load of the guideline on a structure of its own height, against worked numbers.

Foot anchor, uphill guy and post inside the row of four rows of the built-in example,
inclination 25 to 35 degrees, to the digits in which they were worked. A closed form of
its own, for whole studies: tests/verification/second_reader/guideline.py.
"""

import math
from dataclasses import dataclass, replace

import pytest

from netdesign.checks import load_standard
from netdesign.guideline.floor import NetRanges
from netdesign.guideline.load_cases import NetGeometry, compare_with_guideline
from netdesign.guideline.load_model import read_load_model
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import Member
from tests.each import each
from tests.guideline.one_floor import find_floor

SWISS = load_standard("swiss-guideline-2007")
MODEL = read_load_model(SWISS)
USUAL = replace(MODEL, normal_loose=0.35, normal_dense=0.35)
WITH_FORM = replace(USUAL, dimensioning=1e3)
MEMBERS = (Member.FOOT_ANCHOR, Member.UPHILL_GUY, Member.POST)


@dataclass(frozen=True)
class Row:
    """A net row of the built-in example."""

    slope: float
    typed: float  # snow thickness
    net: float  # D_K
    stiffness: float
    slack: float
    glide: float
    altitude: float
    spacing: float
    uphill: float
    downhill: float

    @property
    def full_height(self) -> float:
        """H_K."""
        return self.net / math.cos(math.radians(self.slope))


ROWS = {
    "R1": Row(30, 2.5, 2.5, 8000, 0.05, 1.2, 1870, 4.0, 2.5, 2.5),
    "R2": Row(35, 2.8, 3.0, 10000, 0.06, 1.2, 1880, 3.5, 3.0, 3.0),
    "R4": Row(
        *(40, 3.9 * math.cos(math.radians(40)), 3.5, 15000, 0.08, 1.8),
        *(1860, 3.0, 4.0, 3.5),
    ),
    "R5": Row(45, 3.5, 4.0, 20000, 0.08, 2.4, 1840, 3.0, 4.5, 4.0),
}


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


@each("name, text", zip(ROWS, TABLE["same resultant"], strict=True))
def test_program_brings_the_load_of_case_1_on_the_lower_part_too(name, text):
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
    names = {one.member: one.case.name for one in find(ROWS["R4"])[1].forces}
    assert names[Member.FOOT_ANCHOR] == "load_case_2"
    assert names[Member.UPHILL_GUY] == "load_case_1"


def test_downhill_guy_is_largest_in_a_net_that_is_not_full():
    """R1: 3.8 kN at 0.7 H_K, 0.1 at H_K; so H is searched."""
    row = ROWS["R1"]
    downhill = find(row, USUAL, (0.5 * row.net, row.net))[1].find(Member.DOWNHILL_GUY)
    assert downhill.force / 1e3 >= 3.75
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
    at_one = replace(build_ranges(row), inclinations=(math.radians(35.0),) * 2)
    foot = find_floor(MODEL, at_one, row.altitude).find(Member.FOOT_ANCHOR)
    same, first, second = compare_with_guideline(
        MODEL, net, density=400.0, altitude=row.altitude, glide_factors=(1.8, 1.8)
    )
    assert same.case.height_vertical == pytest.approx(3.9, rel=1e-12)
    assert (same.case.normal_share, same.case.settled) == (0.35, 1.0)
    assert foot.case.name == "load_case_2"
    assert second.foot == pytest.approx(foot.force, rel=1e-12)
    assert first.foot < second.foot
    assert second.case.height_vertical == pytest.approx(row.full_height, rel=1e-12)


def test_profile_of_the_guideline_alone_has_the_dimensioning_form():
    """1 kN/m3; the others leave it out."""
    ids = ("eurocode", "nf-p-95-304-style", "onr-24805-style")
    assert SWISS.find("load.dimensioning").value == 1.0
    assert {load_standard(one).find("load.dimensioning") for one in ids} == {None}
