"""Anchors that hold a row along itself: every check that the other anchors have."""

import math
from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.resistance.ground import AnchorType, Soil
from netdesign.resistance.steel import RoundSection, compute_bent_bar_resistance
from netdesign.site.model import Resistance
from netdesign.structure.members import END_ANCHORS, EndMember
from tests.each import each
from tests.small_site import turn
from tests.study.test_panel_study import a_panel, an_end, checks_of, judge, with_panel

LATERAL, OF_GUY = END_ANCHORS
# 0.96 mm are lost of each face of 50 mm
BAR = RoundSection(outer=0.050 - 2 * 0.96e-3, strength=500e6)
BENDS = AnchorType(
    kind="bar",
    section=BAR,
    lever=0.005,
    drilled=6.0,
    bond=4.0,
)
GROUND = Soil(cohesion=32e3, friction=math.radians(36.0), weight=20e3)


def hold(kind, *, mode, axis=50.0, angle=30.0, **changes):
    """End of a row whose two anchors are of this type, in this mode beside the axis."""
    end = an_end(angle=angle)
    beside = [
        replace(one, mode=mode, dimensions=kind, basis="computed")
        for one in turn(END_ANCHORS)
    ]
    plain = [one for one in end.resistances if one.mode != "direction"]
    return replace(
        end,
        lateral_axis=None if axis is None else math.radians(axis),
        resistances=(*plain, *beside),
        anchors=tuple((one, kind) for one in END_ANCHORS),
        **changes,
    )


def study_end(end, **changes):
    row = with_panel(a_panel(), end=end, **changes)
    _, study = judge(row)
    pulls = {one.anchor: one for one in study.rows[0].pulls}
    return checks_of(study), pulls


@pytest.mark.parametrize(
    ("axis", "used"), [(50.0, 1.543), (30.0, 1.142), (25.0, 1.029), (20.0, 0.921)]
)
def test_a_bar_of_50_mm_across_the_row_bears_what_was_worked_by_hand(axis, used):
    """Row R4 of the example: design force 433.7 kN, factor 1.495 on R_k."""
    bent = compute_bent_bar_resistance(BAR, angle=math.radians(axis), lever=0.005)
    assert 433.7e3 / (bent.value / 1.495) == pytest.approx(used, abs=1e-3)


@each("axis", [50.0, 25.0, 17.0])
def test_a_lateral_bar_bends_by_the_angle_of_its_axis_to_the_row(axis):
    checks, pulls = study_end(hold(BENDS, mode="bending", axis=axis))
    check = checks["lateral_anchor.bending.end"]
    bent = compute_bent_bar_resistance(BAR, angle=math.radians(axis), lever=0.005)
    assert check.read("R_k") == pytest.approx(bent.value / 1e3, rel=1e-9)
    assert check.read("E_k") == checks["lateral_anchor.tendon.end"].read("E_k")
    pull = pulls[LATERAL]
    assert pull.angle_deg == pytest.approx(axis)
    sine = math.sin(math.radians(axis)) * math.cos(math.radians(38.0))
    assert math.sin(math.radians(pull.dip_deg)) == pytest.approx(sine)


def test_without_an_axis_a_lateral_anchor_dips_15_degrees():
    end = hold(BENDS, mode="bending", axis=None)
    checks, pulls = study_end(end)
    axis = math.degrees(math.asin(math.sin(math.radians(15)) / math.cos(0.663225)))
    assert pulls[LATERAL].axis_deg == pytest.approx(axis, rel=1e-5)
    assert pulls[LATERAL].dip_deg == pytest.approx(15.0)
    bent = compute_bent_bar_resistance(BAR, angle=math.radians(axis), lever=0.005)
    found = checks["lateral_anchor.bending.end"]
    assert found.read("R_k") == pytest.approx(bent.value / 1e3, rel=1e-6)


@each("angle", [3.0, 12.0, 30.0, 55.0])
def test_the_end_guys_anchor_goes_on_with_the_guy_or_dips_15_degrees(angle):
    _, pulls = study_end(hold(BENDS, mode="bending", angle=angle))
    pull = pulls[OF_GUY]
    dip = math.degrees(
        math.asin(math.sin(math.radians(angle)) * math.cos(math.radians(38.0)))
    )
    assert pull.dip_deg == pytest.approx(max(dip, 15.0))
    assert pull.angle_deg == pytest.approx(max(0.0, 15.0 - dip), abs=1e-6)
    assert pull.least_deg == pull.largest_deg == pytest.approx(angle)


def test_rope_anchors_of_the_end_need_a_head_beyond_30_degrees():
    rope = AnchorType(kind="rope anchor", section=None, lever=None, drilled=6.0)
    for axis, verdict in ((29.0, Verdict.PASS), (31.0, Verdict.NOT_PROVEN)):
        checks, _ = study_end(hold(rope, mode="direction", axis=axis))
        assert checks["lateral_anchor.direction.end"].verdict is verdict
    _, force = checks["lateral_anchor.tendon.end"].read_band("E_d")
    across = force * math.sin(math.radians(31.0))
    told = str(checks["lateral_anchor.direction.end"].reason)
    assert f"has to take {across:.0f} kN across" in told
    held = replace(rope, across=1e3 * across * 1.4 * 1.02)
    checks, _ = study_end(hold(held, mode="direction", axis=31.0))
    found = checks["lateral_anchor.direction.end"]
    assert found.verdict is Verdict.PASS
    assert found.utilisation_band[1] == pytest.approx(1.0 / 1.02, rel=1e-9)


def test_ground_of_the_end_s_anchors_is_checked():
    checks, _ = study_end(hold(replace(BENDS, soil=GROUND), mode="wedge", axis=25.0))
    for anchor in END_ANCHORS:
        found = checks[f"{anchor}.wedge.end"]
        assert found.read("R_k") > 0.0
        assert "cone of ground" in str(found.resistance_derivation)


def test_an_end_of_which_nobody_says_anything_has_all_its_checks_open():
    bare = [
        Resistance(member=one, mode=mode, source="Ends")
        for one in END_ANCHORS
        for mode in ("tendon", "pull_out", "bending", "direction")
    ]
    end = replace(an_end(), resistances=tuple(bare), anchors=(), lateral_axis=None)
    checks, pulls = study_end(end)
    assert EndMember.END_GUY_ANCHOR in pulls
    for one in bare:
        found = checks[f"{one.member}.{one.mode}.end"]
        assert found.verdict is Verdict.NOT_PROVEN
