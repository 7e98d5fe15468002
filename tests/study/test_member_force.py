"""The larger of coupled bound and floor, on the two supports of a row."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.outcome import Verdict
from netdesign.snow.ground import build_ground_from_glide_factor
from netdesign.structure.members import CARRYING_MEMBERS, NetPart
from netdesign.study.guideline_load import (
    list_assumed,
)
from netdesign.study.judge import judge_site
from tests.each import each
from tests.grid import solve_site
from tests.guideline.one_floor import find_row_floor
from tests.small_site import RUN, build_row, build_site, resist

SWISS = load_standard("swiss-guideline-2007")
RANGES = Ranges.of(
    density=Interval(low=200.0, high=270.0),
    friction_angle=Interval(low=math.radians(20), high=math.radians(45)),
    inclination=Interval(low=math.radians(28), high=math.radians(33)),
)
LIGHT = {
    "slope_angle": math.radians(45.0),
    "snow_thickness": 4.0,
    "net_height": 4.0,
    "upslope_length": 5.0,
    "ground": build_ground_from_glide_factor(2.4, 4.0),
    "net_stiffness_per_m": 2e7,
    "slack": 0.08,
    "gap": 1.0,
    "altitude": 1450.0,
}
ROW = build_row("R1", **LIGHT)


def a_floor(row=ROW, standard=SWISS):
    return find_row_floor(row, RANGES, standard)


@pytest.fixture(scope="module")
def solved():
    """The short, light snowpack of the issue, on two coarse meshes."""
    return solve_site(build_site(ROW, ranges=RANGES), RUN)


def judge(solved, standard=SWISS, **changes):
    """Study of the row; its site accepts the creep law for snow as light."""
    site = build_site(replace(ROW, **changes), ranges=RANGES)
    return site, judge_site(site, solved, standard, RUN)


def checks_of(study):
    return {check.id: check for check in study.rows[0].checks}


def test_short_light_snow_fails_by_the_guideline_where_the_coupled_force_passed(solved):
    """psi 45, D 4 m, N 2.4, 200 to 270 kg/m³, L 5 m: passed until 0.1.0."""
    resistances = resist(foot_anchor__tendon=400e3)
    _, study = judge(solved, resistances=resistances)
    check = checks_of(study)["foot_anchor.tendon"]
    assert study.verdict == check.verdict == Verdict.FAIL
    assert check.governs == "guideline"
    assert check.load_case == "load_case_2"
    assert "the guideline's load (load case 2) governs" in str(check.reason)
    assert 1.4 < check.utilisation < 1.5
    none = replace(SWISS, floor="none")
    _, without = judge(solved, none, resistances=resistances)
    alone = checks_of(without)["foot_anchor.tendon"]
    assert alone.verdict == Verdict.PASS
    assert alone.utilisation < 0.9
    assert without.profile.floor == "none"
    assert without.rows[0].floor is None


def test_snow_of_a_profile_of_one_s_own_changes_no_floor_and_no_comparison(solved):
    """The load model is the guideline's as it comes; the study lists it beside."""
    values = [
        replace(one, value=0.7 * one.value) if one.id == "snow.density" else one
        for one in SWISS.values
    ]
    own = replace(SWISS, id="mine", values=tuple(values))
    assert own.find("snow.density").value == pytest.approx(0.189)
    assert a_floor(standard=own) == a_floor()
    records = [judge(solved, one)[1] for one in (SWISS, own)]
    assert records[0].rows[0].floor == records[1].rows[0].floor
    assert records[0].rows[0].guideline == records[1].rows[0].guideline
    listed = {one.id: one.value for one in records[1].profile.values}
    assert listed["floor.snow.density"] == 0.27
    assert listed["snow.density"] == pytest.approx(0.189)


def test_floor_that_is_not_known_proves_nothing(solved):
    """A slope beyond the closed forms: the coupled results alone would pass."""
    site, study = judge(solved, slope_angle=0.04)
    forces = [check for check in study.rows[0].checks if check.position]
    assert {check.verdict for check in forces} == {Verdict.NOT_PROVEN}
    for check in forces:
        assert "guideline's load, the minimum load of every check" in str(check.reason)
        assert check.changes == []  # none of them makes it known
    assert study.rows[0].floor.forces == []
    assert study.rows[0].floor.reason is not None
    assert site.rows[0].slope_angle == 0.04


def test_floor_has_every_carrying_member_and_the_mesh(solved):
    floor = study_floor(judge(solved)[1])
    assert set(floor) == {*CARRYING_MEMBERS, NetPart.MESH}


def study_floor(study):
    return {one.member: one.force_kN for one in study.rows[0].floor.forces}


@each(
    "changes, told",
    [
        ({"glide_factor": 2.4}, {}),
        ({"altitude": None}, {"row.altitude_assumed": {"factor": 1.3}}),
        ({"glide_factor": 1.1}, {"row.glide_assumed": {"glide": 1.1, "least": 1.2}}),
    ],
)
def test_what_the_floor_takes_for_granted_is_told(changes, told):
    found = {one.key: one.arguments for one in list_assumed(replace(ROW, **changes))}
    assert found.keys() == told.keys()
    for key, numbers in told.items():
        assert found[key] == pytest.approx(numbers)


@pytest.mark.parametrize(("gap", "is_told"), [(1.99, True), (2.0, True), (1.7, False)])
def test_gap_close_to_a_threshold_shows_both_values(solved, gap, is_told):
    """1.99 and 2.00 m give one demand, and the other value beside it."""
    _, study = judge(solved, gap=gap)
    width = checks_of(study)["foot_anchor.tendon.end"].read("b_e")
    told = [one for one in study.rows[0].notes if one.key == "row.gap_at_threshold"]
    assert bool(told) is is_told
    free = 0.5 * ROW.layout.post_spacing + 4.0 * 4.0 / 3.0
    assert (width == pytest.approx(free, rel=1e-9)) is is_told
    if is_told:
        assert told[0].arguments["wider"] == pytest.approx(width, rel=1e-12)
        assert told[0].arguments["other"] < 0.7 * width
