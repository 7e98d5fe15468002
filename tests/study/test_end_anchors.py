"""Anchors that hold a row along itself: every check that the other anchors have."""

import math
from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.resistance.ground import AnchorType, Soil
from netdesign.resistance.steel import RoundSection
from netdesign.site.model import Resistance
from netdesign.structure.members import END_ANCHORS, EndMember
from tests.small_site import turn
from tests.study.test_panel_study import a_panel, an_end, checks_of, judge, with_panel

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
