"""The larger of coupled bound and floor, on the two supports of a row."""

import math
import random
from dataclasses import replace

import pytest

from netdesign.calculation.steps import list_steps
from netdesign.checks import Check, load_standard
from netdesign.envelope.ranges import Case, Interval, Ranges
from netdesign.guideline.load_cases import find_glide_factor
from netdesign.outcome import Verdict
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.structure.members import CARRYING_MEMBERS, Member, NetPart
from netdesign.study.case_records import LargestForce
from netdesign.study.guideline_load import (
    find_altitude_factor,
    find_effects,
    list_assumed,
    record_floor,
)
from netdesign.study.judge import judge_site
from netdesign.study.member_force import (
    RowForces,
    find_force,
)
from netdesign.study.record_envelope import record_point
from netdesign.study.record_provenance import record_profile
from tests.grid import solve_site
from tests.guideline.one_floor import find_row_floor
from tests.read_check import compare_support
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


def test_numbers_of_the_load_model_stand_in_the_study_under_every_profile():
    """As values of the floor, unless the profile has the very same of its own.

    With the least and the largest glide factor of the guideline's tables.
    """
    model = [one for one in SWISS.values if one.id.startswith("snow.")]
    assert len(model) == 14
    ends = ("glide.factor.north.1", "glide.factor.south.4")
    model += [one for one in SWISS.listed if one.id in ends]
    for profile, prefix in (("eurocode", "floor."), ("swiss-guideline-2007", "")):
        standard = load_standard(profile)
        found = {one.id: one for one in record_profile(standard).values}
        for value in model:
            one = found[f"{prefix}{value.id}"]
            assert (one.value, one.status) == (value.value, value.status)
        assert len(found) == len(standard.listed) + (16 if prefix else 0)
        none = record_profile(replace(standard, floor="none"))
        assert not [one for one in none.values if one.id.startswith("floor.")]


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


def test_what_the_floor_takes_for_granted_stands_in_the_notes(solved):
    site, plain = judge(solved)
    assert list_assumed(site.rows[0]) == []
    assert find_altitude_factor(site.rows[0]) == 1.0
    changes = {"altitude": None, "glide_factor": 1.1}
    site, study = judge(solved, **changes)
    (row,) = site.rows
    assert find_altitude_factor(row) == pytest.approx(1.3, rel=1e-12)
    assumed = list_assumed(row)
    told = [str(one) for one in assumed]
    assert told[0].endswith("is calculated with its largest altitude factor, 1.30")
    assert "factor of 1.1 lies below the smallest" in told[1]
    assert told[1].endswith(
        "the coupled forces and the guideline's load are calculated with 1.2"
    )
    assert [one for one in study.rows[0].notes if one in assumed] == assumed
    assert not set(assumed) & set(plain.rows[0].notes)
    densities = {one.name: one.density_kg_m3 for one in study.rows[0].guideline.cases}
    assert densities["load_case_1"] == pytest.approx(351.0, rel=1e-12)
    assert {one.glide_factor for one in study.rows[0].guideline.cases} == {1.2}
    none = replace(SWISS, floor="none")
    _, without = judge(solved, none, **changes)
    assert set(assumed) <= set(without.rows[0].notes)


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


def find_member_force(member, ends, width, *, has_floor=True):
    """Force on a member from the low end, value and high end of the solved one [kN]."""
    given = next(one for one in ROW.resistances if one.member == member)
    at = record_point(Case(density=250.0, friction_angle=0.5, inclination=0.5))
    low, value, high = ends
    solved = LargestForce(
        quantity=member,
        low_kN=low,
        value_kN=value,
        high_kN=high,
        bound_kN=value,
        case=at,
    )
    forces = RowForces(
        site=None,
        law=None,
        row=ROW,
        standard=SWISS,
        effects=find_effects(ROW, SWISS, RANGES),
        largest={member: solved},
        floor=record_floor(a_floor()) if has_floor else None,
        held=None,
        tilt=0.0,
    )
    return find_force(forces, given, width)


def check_alone(force, load_case=""):
    """Check of a force without a resistance."""
    steps = list_steps(force.action)
    named = {"id": "a.b", "clause": "", "member": "a", "mode": "b"}
    return Check(**named, steps=steps, load_case=load_case)


def test_band_is_cut_off_at_the_floor():
    draw, effects = random.Random(31), find_effects(ROW, SWISS, RANGES)
    width = effects.supports[0]
    scale = a_floor().find(Member.POST).force / 1e3
    for _ in range(200):
        ends = sorted(draw.uniform(0.3, 1.9) * scale for _ in range(3))
        found = find_member_force(Member.POST, ends, width)
        cut = [max(end, scale) for end in ends]
        action = found.action
        assert [action.low, action.value, action.high] == pytest.approx(cut, rel=1e-12)
        assert action.low >= found.on.guideline.value
        assert check_alone(found).governs == (
            "guideline" if scale >= ends[2] else "coupled"
        )
    free = find_member_force(Member.POST, ends, width, has_floor=False)
    assert [free.action.low, free.action.value, free.action.high] == ends
    assert (check_alone(free).governs, free.on.guideline) == ("coupled", None)


def test_reason_names_the_load_and_gives_back_its_own_part():
    width, none = find_effects(ROW, SWISS, RANGES).supports[1], (0.0, 0.0, 0.0)
    forced = find_member_force(Member.FOOT_ANCHOR, none, width)
    case = a_floor().find(Member.FOOT_ANCHOR).case.name
    told = check_alone(forced, case).reason
    assert str(told).endswith(
        "; the guideline's load (load case 2) governs the design force."
    )
    slack = find_member_force(Member.DOWNHILL_GUY, none, width)
    assert slack.action.high == 0.0
    found = check_alone(slack, case)
    assert found.reason == found.plain_reason


def test_support_inside_and_end_are_checked_each_with_its_own_types(solved):
    """A free end is loaded wider; its stronger anchor leaves the others as they are."""
    strong = resist(foot_anchor__tendon=3e6)
    _, study = judge(
        solved,
        gap=math.inf,
        resistances=resist(foot_anchor__tendon=700e3),
        end_resistances=strong,
    )
    checks = checks_of(study)
    inside, end = checks["foot_anchor.tendon"], checks["foot_anchor.tendon.end"]
    spacing = ROW.layout.post_spacing
    # f_R = 1.00 + 1.25 * 2.4 = 4.0 over 4 m / 3
    wide = 0.5 * spacing + 4.0 * 4.0 / 3.0
    assert inside.read("b_e") is None
    assert compare_support(end) == pytest.approx(
        compare_support(inside) * wide / spacing, rel=1e-12
    )
    assert end.read("b_e") == pytest.approx(wide, rel=1e-9)
    assert end.demand_kN == pytest.approx(inside.demand_kN * wide / spacing, rel=1e-12)
    assert end.read("R_k") == 3000.0
    assert inside.read("R_k") == 700.0
    assert (inside.verdict, end.verdict) == (Verdict.PASS, Verdict.PASS)
    assert wide > 2.0 * spacing - 0.5


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
