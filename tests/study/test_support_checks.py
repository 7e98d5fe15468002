"""Checks beyond axial force on a row with given pulls: what they need and say."""

import math
import shutil
from dataclasses import replace

import numpy as np
import pytest

from netdesign.checks import load_standard
from netdesign.checks.comparison import find_action_factor
from netdesign.edge.input_files import find_resource
from netdesign.outcome import Verdict
from netdesign.study.member_checks import find_type_change
from netdesign.study.row_to_check import Basis
from tests.checks.given_pulls import (
    POST,
    find_second,
    judge_row,
    read_row,
    study_row,
)
from tests.each import each

SECOND = find_second(0.5)

SWISS = "swiss-guideline-2007"
GUYS, SPLAY = "guy_count", "guy_splay"
FOOT_AXIS = "foot_axis"
LIFTED, HELD = (5.0, 22.0), "foot_tension"  # the net pulls the head off the slope
BAR = {
    "kind": "bar",
    "bar_diameter": 32,
    "strength": 500,
    "pull_out": 380,
    "proven": "tests",
}
ROW = {
    "anchor": BAR,
    "foot": (20.0, 18.0),  # 41.99 degrees out of the ground
    "head": (5.0, -22.0),
    "gap": 0.5,
}
FOOT = math.degrees(math.atan2(18.0, 20.0))
ALONG_ROW = math.acos(1.0 / math.hypot(1.0, 0.1))  # turn by the load along the row


def judge(profile=SWISS, **changes):
    return judge_row(profile, **(ROW | changes))


def told(check):
    return check.verdict, str(check.reason)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({GUYS: 1}, "single guy in the plane of the section"),
        ({"uphill_anchor_distance": 0.0}, "do not end at the net's foot"),
        ({"downhill_anchor_distance": 0.0, "head": (0.4, -22.0)}, "cannot hold"),
    ],
)
def test_load_along_the_row_that_nothing_holds_is_not_proven(changes, reason):
    checks = judge(**changes)
    verdict, text = told(checks["post.lateral"])
    assert verdict is Verdict.NOT_PROVEN
    assert reason in text
    guy = checks["uphill_guy.rope"]
    assert [guy.read(symbol) for symbol in ("g", "A", "k_q")] == [None] * 3
    assert guy.read("E_k") == pytest.approx(SECOND * guy.read("E_s"), rel=1e-14)


def foot_across(angle):
    """Design force across the axis of the foot anchor [kN], by hand."""
    pull = SECOND * 3.5 * math.hypot(20.0, 18.0) * math.hypot(1.0, 0.1)
    return 1.5 * pull * math.sin(math.radians(angle))


def test_a_rope_anchor_that_is_pushed_fails_whatever_its_head():
    anchor = BAR | {"kind": "rope anchor"}
    anchor |= {"head_across": 5000}
    foot = (-20.0, 1.0)  # 177 degrees
    checks = judge(anchor=anchor, foot=foot, **{FOOT_AXIS: 40.0})
    verdict, text = told(checks["foot_anchor.direction"])
    assert verdict is Verdict.FAIL
    assert "a rope anchor is pushed there" in text


TUBE = {"tube_diameter": 114.3, "tube_wall": 12.5}


def test_a_block_that_does_not_hold_is_none_to_a_bar():
    """Typed or left empty: the ground yields at the mouth of the bore."""
    anchor = BAR | {"kind": "bar", "lever_arm": 20}
    axis = {FOOT_AXIS: FOOT - 20.0}
    weak = judge(anchor=anchor | {"head_across": 60}, **axis)
    without = judge(anchor=anchor, **axis)
    assert "foot_anchor.direction" not in weak
    found, bare = weak["foot_anchor.bending"], without["foot_anchor.bending"]
    assert found.utilisation == pytest.approx(bare.utilisation, rel=1e-12)
    assert found.verdict is bare.verdict


def test_a_block_that_holds_inside_alone_changes_no_check_of_another_anchor():
    """The second support's check of that block goes, as the bar bends there."""
    anchor = BAR | {"kind": "bar", "lever_arm": 20}
    gap, beside = 3.0, find_second(3.0)
    angle = math.acos(math.cos(math.radians(20)) * math.cos(ALONG_ROW))
    of_second = 1.4 * foot_across(math.degrees(angle)) * beside / SECOND
    anchor |= {"head_across": of_second * (0.3 + 0.7 / beside)}
    axes = {FOOT_AXIS: FOOT - 20.0, "uphill_axis": 78.0}
    axes |= {"downhill_axis": 20.0, "gap": gap}
    checks = judge(anchor=anchor, **axes)
    turned = {one: each for one, each in checks.items() if each.mode == "direction"}
    assert all(name.startswith(one.member) for name, one in turned.items())
    inside = [one.member for one in turned.values() if one.position == "intermediate"]
    assert inside == ["foot_anchor", "uphill_anchor", "downhill_anchor"]
    assert checks["foot_anchor.direction"].verdict is Verdict.PASS
    assert "foot_anchor.direction.second" not in checks
    assert checks["foot_anchor.bending.end"].verdict is Verdict.FAIL


def test_a_row_says_how_long_its_tubes_are_at_least():
    anchor = BAR | {"kind": "bar", "lever_arm": 5} | TUBE
    (row,) = study_row(SWISS, **(ROW | {"anchor": anchor})).rows
    notes = [str(one) for one in row.notes if "the tube at the head" in str(one)]
    assert len(notes) == 3
    # 0.30518 m pi / 0.3224 = 2.974 m
    assert (
        "Net anchor (foot): the tube at the head of type A is at least 3.0 m"
        in notes[0]
    )


@pytest.mark.parametrize("lever", [None, 5, 40])
def test_a_bar_without_dimensions_is_the_worst_with_its_tendon(lever):
    anchor = {"tendon": 402, "pull_out": 380}
    anchor |= {"proven": "tests", "kind": "bar", "lever_arm": lever}
    axis = {FOOT_AXIS: FOOT - 7.0}
    found = judge(anchor=anchor, **axis)["foot_anchor.bending"].read("R_k")
    for diameter in (21, 28, 32, 40):
        typed = anchor | {"bar_diameter": diameter}
        typed["strength"] = 402e3 / (0.25 * math.pi * diameter**2)
        bar = judge(anchor=typed, **axis)["foot_anchor.bending"]
        assert found <= bar.read("R_k") * (1.0 + 1e-6)
    del anchor["tendon"]
    verdict, text = told(judge(anchor=anchor, **axis)["foot_anchor.bending"])
    assert verdict is Verdict.NOT_PROVEN
    assert "state tendon R_k and bar diameter" in text


def test_post_without_width_is_not_proven_and_its_base_slides_by_0_35():
    lost = ("post_width", "base_friction")
    post = {key: value for key, value in POST.items() if key not in lost}
    checks = judge(post=post)
    verdict, text = told(checks["post.compression_bending"])
    assert verdict is Verdict.NOT_PROVEN
    assert "width" in text
    assert checks["post_base.sliding"].read("μ_b") == 0.35


ETA, HEAD = "eta", "head_eccentricity"
GLIDES = {"glide_factor": 2.4}  # eta up to 3.4


def judge_post(eta, **changes):
    post = POST | {ETA: eta} | changes.pop("post", {})
    row = {"gap": 0.5} | GLIDES | changes
    return judge(post=post, **row)


@pytest.mark.parametrize(
    ("pull", "typed"),
    [
        (-22.0, (Verdict.PASS, Verdict.PASS)),
        (-38.0, (Verdict.PASS, Verdict.FAIL)),
        (-68.0, (Verdict.FAIL, Verdict.FAIL)),
    ],
)
def test_an_efficiency_that_nobody_gives_is_not_proven_where_it_decides(pull, typed):
    """Empty: the demand of the largest, a FAIL where the least fails as well."""
    head = {"head": (1.0, pull)}
    least, most = (
        judge_post(eta, **head)["post.compression_bending"] for eta in (1.0, 3.4)
    )
    found = judge_post(None, **head)["post.compression_bending"]
    assert (least.verdict, most.verdict) == typed
    assert found.utilisation == pytest.approx(most.utilisation, rel=1e-12)
    assert found.utilisation_band == pytest.approx(
        (least.utilisation_band[0], most.utilisation_band[1]), rel=1e-12
    )
    if typed == (Verdict.PASS, Verdict.FAIL):
        assert found.verdict is Verdict.NOT_PROVEN
        assert "anywhere from 1 to 3.4, which nobody gives" in str(found.reason)
    else:
        assert found.verdict is typed[0]
        assert "nobody gives" not in str(found.reason)


@pytest.mark.parametrize(
    ("pull", "verdict"), [(-12.0, Verdict.NOT_PROVEN), (-98.0, Verdict.FAIL)]
)
def test_snow_that_may_be_too_much_alone_proves_nothing(pull, verdict):
    thin = {"section_modulus": 45, "post_width": 150}
    head = {"head": (1.0, pull), "post": thin}
    alone = judge_post(3.4, **head)["post.compression_bending"]
    assert alone.is_unbounded
    least = judge_post(1.0, **head)["post.compression_bending"]
    found = judge_post(None, **head)["post.compression_bending"]
    assert found.verdict is verdict
    assert found.utilisation == pytest.approx(least.utilisation)
    assert "which nobody excludes" in str(found.reason)


@pytest.mark.parametrize("gap", [0.5, 1.9, 12.0])
@pytest.mark.parametrize("eta", [1.0, 2.1, None])
def test_the_end_post_has_the_larger_of_end_effect_and_efficiency(gap, eta):
    """Their line loads are the same snow: the larger one, never the product."""
    row = {"gap": gap, "head": (1.0, -15.0)}
    checks = judge_post(eta, **row)
    inside, end = (checks[f"post.compression_bending{one}"] for one in ("", ".end"))
    factor = end.read("f_R")
    for check, least in ((inside, 0.0), (end, 1.0 + factor)):
        used = check.resistance_derivation.arguments["efficiency"]
        assert used == pytest.approx(max(3.4 if eta is None else eta, least))


@pytest.mark.parametrize(
    ("post", "ends"),
    [
        ({}, 84.7),  # 4 W / A of a section that nobody names
        ({HEAD: 0}, 0.0),
        ({"id": "HEB120"}, 60.0),
        ({"id": "HEB120", HEAD: 25}, 25.0),
    ],
)
def test_a_post_whose_eccentricity_nobody_gives_rests_on_its_edges(post, ends):
    post = POST | {HEAD: None} | post
    checks = judge(post=post, head=(1.0, -9.0))
    derived = checks["post.compression_bending"].resistance_derivation
    told = derived.arguments
    assert (told["head"], told["foot"]) == pytest.approx((ends, ends), abs=0.05)


@each(
    "file, value, name, changes",
    [
        ("limits.toml", "anchor.dip.min", "foot_anchor.pull_out", {}),
        ("limits.toml", "anchor.angle.rope", "foot_anchor.direction",
         {"anchor": BAR | {"kind": "rope anchor"}}),
        ("model.toml", "post.efficiency", "post.compression_bending",
         {"post": POST | {ETA: None}}),
        ("model.toml", "post.efficiency.per_glide", "post.compression_bending",
         {"post": POST | {ETA: None}}),
        ("factors.toml", "resistance.tension", "post_foot.tension",
         {"head": LIFTED, "post": POST | {HELD: 200}}),
    ],
)  # fmt: skip
def test_a_profile_proves_nothing_by_a_value_that_it_lacks(
    tmp_path, file, value, name, changes
):
    mine = shutil.copytree(find_resource("standards") / SWISS, tmp_path / value)
    blocks = (mine / file).read_text("utf-8").split("\n\n")
    kept = [one for one in blocks if f'id = "{value}"' not in one]
    assert len(kept) == len(blocks) - 1
    (mine / file).write_text("\n\n".join(kept), "utf-8")
    verdict, text = told(judge(mine, **changes)[name])
    assert verdict is Verdict.NOT_PROVEN
    assert value in text


@pytest.mark.parametrize(("height", "tilt"), [(2.917, 11.3), (3.371, 26.9)])
@pytest.mark.parametrize("share", [0.71, 0.987, 0.992, 1.37])
def test_a_post_passes_by_no_buckling_length_but_its_own(height, tilt, share):
    true = height / math.cos(math.radians(tilt))
    post = POST | {ETA: 1.0, "buckling_length": round(share * true, 4)}
    row = {"net_height": height, "post_tilt": tilt, "head": (1.0, -4.0)}
    checks = judge(post=post, **row)
    for mode in ("compression", "compression_bending"):
        verdict, text = told(checks[f"post.{mode}"])
        is_long = share > 0.99
        assert verdict is (Verdict.PASS if is_long else Verdict.NOT_PROVEN), text
        assert ("shorter than the post of this net row" in text) is not is_long
        assert is_long or f"{true:.2f} m" in text


def test_a_post_that_fails_by_a_short_buckling_length_fails():
    post = POST | {"buckling_length": 2.173}
    checks = judge(post=post, head=(31.7, -190.3))
    assert checks["post.compression"].verdict is Verdict.FAIL


def test_a_type_for_shorter_posts_is_no_remedy():
    site = read_row(anchor=BAR, gap=0.5)
    (row,), (given,) = site.rows, (
        one for one in site.rows[0].resistances if one.mode == "compression"
    )  # fmt: skip
    short = replace(given, type_id="short", value=9e6, buckling_length=2.9)
    long = replace(given, type_id="long", value=9.1e6, buckling_length=3.2)
    standard = load_standard(SWISS)
    for catalogue, found in (((short,), None), ((short, long), "long")):
        stocked = replace(site, catalogue=catalogue)
        basis = Basis(site=stocked, row=row, standard=standard)
        change = find_type_change(basis, given, 5.3e3, None)
        assert (change and change.quantity.arguments["type"]) == found


@pytest.mark.parametrize("head", [(5.0, -22.0), (5.0, 0.0)])
def test_a_post_that_nothing_lifts_has_no_check_of_its_foot(head):
    for post in (POST, POST | {HELD: 0}, POST | {HELD: 150}):
        checks = judge(head=head, post=post)
        assert not any(name.startswith("post_foot") for name in checks)


@pytest.mark.parametrize(
    ("held", "verdict", "reason"),
    [
        (None, Verdict.NOT_PROVEN, "no resistance of the foot to tension is given"),
        (0, Verdict.FAIL, "The post lifts, and its foot is loose"),
        (90, Verdict.FAIL, "exceeds"),
        (170, Verdict.PASS, "stays within"),
    ],
)
def test_a_lifted_post_asks_for_its_foot(held, verdict, reason):
    """Post and downhill guy by lengths: P = Z (head - base) + Td (head - anchor)."""
    post = POST if held is None else POST | {HELD: held}
    checks = judge(head=LIFTED, post=post)
    found = checks["post_foot.tension"]
    assert told(found)[0] is verdict
    assert reason in told(found)[1]
    lean = 3.0 * math.tan(math.radians(15))
    ways = np.array([[lean, lean - 3.0], [3.0, 3.0]])
    post_kn, guy = np.linalg.solve(ways, 3.5 * np.array(LIFTED))
    assert guy > 0.0
    expected = SECOND * post_kn * math.hypot(lean, 3.0)
    assert found.read("E_k") == pytest.approx(expected, rel=1e-12)
    assert found.demand_kN == pytest.approx(1.5 * found.read("E_k"), rel=1e-14)
    if held:
        assert found.resistance_kN == pytest.approx(held / 1.4, rel=1e-14)
    assert found.is_unbounded is (held == 0)
    assert checks["post_foot.tension.end"].demand_kN < found.demand_kN
    pressed = checks["post_base.bearing"]  # by the load along the row alone, (S18)
    load = 0.1 * 3.5 * math.hypot(*LIFTED) / math.tan(math.radians(30))
    expected = SECOND * pressed.read("w") * load
    assert pressed.read("E_k") == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("profile", "mode", "source"),
    [
        ("eurocode", "tension", "action.uplift"),
        ("eurocode", "compression", "action.snow"),
        (SWISS, "tension", "action.snow"),
    ],
)
def test_factor_of_uplift_takes_the_place_of_that_of_snow(profile, mode, source):
    found = find_action_factor(load_standard(profile), mode)
    assert (found.source, found.value) == (source, 1.5)


@pytest.mark.parametrize("turn", [1.0, 4.0, 7.0, 15.0, 31.0])
def test_what_nobody_says_of_a_bar_fails_only_where_its_best_fails_too(turn):
    axis = {FOOT_AXIS: FOOT - turn}

    def bend(**changes):
        anchor = BAR | {"tendon": 402} | changes
        return judge(anchor=anchor, **axis)["foot_anchor.bending"]

    best = bend(**{"lever_arm": 0})
    unsaid, of_no_kind = bend(), bend(**{"kind": None})
    assert unsaid.utilisation_band[0] == pytest.approx(best.utilisation_band[0])
    assert (unsaid.verdict is Verdict.FAIL) is (best.verdict is Verdict.FAIL)
    assert of_no_kind.verdict is not Verdict.FAIL
    assert unsaid.utilisation >= best.utilisation
