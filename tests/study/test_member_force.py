"""The larger of coupled bound and floor, on the two supports of a row."""

import math
import random
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.guideline.load_cases import find_glide_factor
from netdesign.outcome import Verdict
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.structure.members import CARRYING_MEMBERS, NetPart
from netdesign.study.judge import judge_site
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


def test_further_ranges_enter_the_floor_and_a_single_value_is_that_value():
    further = {
        "snow_height": Interval(low=2.1 * math.sqrt(2.0), high=4.0 * math.sqrt(2.0)),
        "slack": Interval(low=0.03, high=0.08),
        "net_stiffness": Interval(low=9e6, high=2e7),
        "slip_length": Interval(low=0.3, high=5.1),
        "upslope_length": Interval(low=4.0, high=9.0),
    }
    draw, inside = random.Random(6), 0
    row = replace(ROW, glide_factor=None)
    wide = find_row_floor(row, widen_ranges(further), SWISS)
    for _ in range(40):
        point = {name: draw.uniform(one.low, one.high) for name, one in further.items()}
        single = {k: Interval(low=v, high=v) for k, v in point.items()}
        lean = draw.uniform(RANGES["inclination"].low, RANGES["inclination"].high)
        single["inclination"] = Interval(low=lean, high=lean)
        one = find_row_floor(row, widen_ranges(single), SWISS)
        for force in one.forces:
            net = force.net
            assert net.inclination == lean
            assert (net.slack, net.stiffness) == (
                point["slack"],
                point["net_stiffness"],
            )
            thickness = point["snow_height"] * math.cos(ROW.slope_angle)
            assert thickness * (1.0 - 1e-12) <= net.snow_thickness <= ROW.net_height
            slip = GroundLaw(kind="sliding", slip_length=point["slip_length"])
            glide = find_glide_factor(slip, net.snow_thickness, (1.2, 3.2))
            assert force.load.glide_factor == pytest.approx(glide, rel=1e-12)
            assert force.force <= wide.find(force.member).force * (1.0 + 1e-6)
            inside += force.force > 0.0
    assert inside > 150
    typed = find_row_floor(
        ROW,
        widen_ranges({"glide_factor": Interval(low=1.1, high=2.9)}),
        SWISS,
    )
    assert max(one.load.glide_factor for one in typed.forces) == 2.9
    assert min(one.load.glide_factor for one in typed.forces) >= 1.2


def widen_ranges(further):
    return Ranges(intervals=tuple((dict(RANGES.intervals) | further).items()))
