"""Ends of a row of panels: pulls along the row, what holds them, the end effect."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from netdesign.calculation.quantity import leaf
from netdesign.checks import load_standard
from netdesign.checks.forces import place_end_support, pull_at_end
from netdesign.envelope.row_pulls import find_rope_factors
from netdesign.outcome import Outcome, Verdict
from netdesign.structure.head import FailedSupport
from netdesign.structure.row_position import LoadedWidth
from netdesign.study import load_along_row
from netdesign.study.guideline_load import find_effects
from netdesign.study.row_to_check import CaseSolver
from netdesign.words.message import say
from tests.each import each
from tests.grid import solve_site
from tests.guideline.one_floor import find_row_floor
from tests.small_site import (
    RANGES,
    RUN,
    build_row,
    build_site,
    resist,
)
from tests.study.test_panel_study import (
    PROFILE,
    a_panel,
    an_end,
    checks_of,
    judge,
    with_panel,
)


def compute_end_factor(width, spacing):
    """Pull of a rope under the end effect over that without, (P8)."""
    support = place_end_support(
        leaf("b", spacing, "m", ""),
        leaf("f_R", width.end_factor, "-", ""),
        leaf("Δl", width.end_length, "m", ""),
    )
    return pull_at_end(leaf("T_r", 1.0, "kN", ""), support).value


@pytest.fixture(scope="module")
def judged():
    return judge(with_panel(a_panel(), end=an_end(angle=37.0)))


def test_end_members_take_the_ropes_pull_with_the_end_effect(judged):
    _, study = judged
    row, checks = study.rows[0], checks_of(study)
    forces = {one.quantity: one for one in row.forces}
    width = find_effects(with_panel(a_panel()), PROFILE, RANGES).find_support("edge")
    factor = compute_end_factor(width, 3.5)
    assert factor > 1.2
    lower, upper = (
        factor * forces[f"panel_{rope}_along"].value_kN for rope in ("lower", "upper")
    )
    upper *= row.floor.ridge_rope  # the guideline's load pulls more on it, (P12)
    lower *= row.floor.lower_rope
    assert row.floor.ridge_rope > 1.0
    expected = {
        "lateral_anchor.tendon.end": lower,
        "lateral_anchor.pull_out.end": lower,
        "end_guy.rope.end": upper / math.cos(math.radians(37.0)),
        "end_guy_anchor.tendon.end": upper / math.cos(math.radians(37.0)),
        "end_guy_anchor.pull_out.end": upper / math.cos(math.radians(37.0)),
    }
    for name, force in expected.items():
        check = checks[name]
        assert check.read("E_k") == pytest.approx(force, rel=1e-12)
        assert check.verdict is Verdict.PASS
        assert check.position == "edge"
    post = checks["post.compression.end"]
    # Abreast of the head: 30 deg of the net, 15 of the post, both anchors 3 m away.
    fall = math.atan2(2.5, 2.5 * math.tan(math.radians(30.0)) + 3.0)
    part = math.cos(fall) / math.cos(fall + math.radians(15.0))
    pushed = part * upper * math.tan(math.radians(37.0))
    assert post.read("Z") == pytest.approx(pushed, rel=1e-12)
    assert post.read(post.name_force("p")) > pushed
    assert checks["post.compression"].read("Z") is None
    width = post.read("b_e") / post.read("b")
    for model, inside in (("coupled", "E_s"), ("panel", "E_p0")):  # the head holds both
        of_net = (post.read(inside) + (post.read("A") or 0.0)) * width
        held = post.read(post.name_force(model[0]))
        assert held == pytest.approx(of_net + pushed, rel=1e-12)


RANK = [Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.DECLARED, Verdict.PASS]
GROUPS = ("end.", "lateral.", "post.", "tests.", "correlation.", "geometry.", "soil.")


def drop(standard, start):
    """Profile without the values whose ids begin so."""
    values = tuple(one for one in standard.values if not one.id.startswith(start))
    tables = tuple(one for one in standard.tables if not one.id.startswith(start))
    return replace(standard, values=values, tables=tables)


@each(
    "start, row_has_end",
    [(start, end) for start in (*GROUPS, "action.", "resistance.") for end in (1, 0)],
)
def test_a_profile_that_lacks_values_loses_no_row_and_improves_no_check(
    start, row_has_end
):
    """Whatever a profile lacks is not proven; the row's other checks are written."""
    row = with_panel(a_panel(), end=an_end(angle=37.0) if row_has_end else None)
    row = row if row_has_end else replace(row, gap=0.0, row_end=None)
    profiles = (PROFILE, drop(PROFILE, start))
    full, less = (checks_of(judge(row, standard=one)[1]) for one in profiles)
    whole = start in ("action.", "resistance.")
    for name, check in less.items():
        if name in full:
            was = full[name].verdict
            assert RANK.index(check.verdict) <= max(RANK.index(was), 1), name
        assert not whole or check.verdict is not Verdict.PASS or check.mode != "rope"
    if start == "end." and row_has_end:
        assert less["geometry.ends"].verdict is Verdict.NOT_PROVEN
        assert less["end_guy.rope"].verdict is Verdict.NOT_PROVEN
        assert "no end effect" in str(less["end_guy_anchor.tendon"].reason)
        assert less["foot_anchor.tendon"].verdict is full["foot_anchor.tendon"].verdict


def test_what_the_end_guy_presses_holds_the_base_too():
    """Friction of the base: its utilisation is that inside the row."""
    friction = 0.61
    resistances = tuple(
        replace(one, value=None, dimensions=friction) if one.mode == "sliding" else one
        for one in resist()
    )
    _, study = judge(with_panel(a_panel(), resistances=resistances))
    checks = checks_of(study)
    inside, end = checks["post_base.sliding"], checks["post_base.sliding.end"]
    assert end.read("Z") > 0.0
    assert end.utilisation == pytest.approx(inside.utilisation, rel=1e-9)


def test_nothing_that_holds_the_row_leaves_it_unproven():
    _, study = judge(with_panel(a_panel(), end=an_end(value=None)))
    checks = checks_of(study)
    assert study.verdict is not Verdict.PASS
    for name in ("lateral_anchor.tendon.end", "end_guy.rope.end"):
        assert checks[name].verdict is Verdict.NOT_PROVEN
        assert checks[name].demand_kN > 0.0


def test_a_row_that_goes_on_has_no_end():
    row = build_row("R1", panels=a_panel(), gap=0.0)
    _, study = judge(row)
    assert not [one for one in study.rows[0].checks if one.id.endswith(".end")]


def test_under_the_guideline_s_profile_the_ends_are_checked_too():
    standard = load_standard("swiss-guideline-2007")
    _, study = judge(with_panel(a_panel()), standard=standard)
    checks = checks_of(study)
    lateral = checks["lateral_anchor.tendon.end"]
    assert lateral.read("E_g") is None
    assert lateral.read("E_k") > 0.0
    assert checks["post.compression.end"].read("Z") > 0.0


def pull_rope(load, points, spacing, sag, stiffness):
    """Force along the row of a rope under a load [N/m] at equal places, (P2)."""
    dz = points[1] - points[0]
    run = np.concatenate([[0.0], np.cumsum((load[1:] + load[:-1]) / 2.0 * dz)])
    shear = np.trapezoid(run, points) / spacing - run
    slope = 4.0 * sag * (1.0 - 2.0 * points / spacing)
    length = np.trapezoid(np.sqrt(1.0 + slope**2), points)

    def excess(log_force):
        force = math.exp(log_force)
        stretch = np.sqrt(1.0 + (shear / force) ** 2)
        whole = np.trapezoid(stretch / (1.0 + force * stretch / stiffness), points)
        return whole - length

    return math.exp(brentq(excess, 0.0, 30.0))


@each("seed", range(12))
def test_the_end_effect_raises_a_rope_s_pull_by_less_than_its_factor(seed):
    rng = np.random.default_rng(60 + seed)
    spacing, end_factor = rng.uniform(2.5, 5.0), rng.uniform(0.5, 4.0)
    reach = rng.uniform(0.1, 0.75) * spacing
    width = LoadedWidth(
        position="edge",
        width=spacing / 2.0 + end_factor * reach,
        end_factor=end_factor,
        end_length=reach,
    )
    points = np.linspace(0.0, spacing, 4001)
    load = np.full(points.size, 10 ** rng.uniform(4.0, 5.0))
    rope = (spacing, rng.uniform(0.0, 0.12), 10 ** rng.uniform(6.8, 7.6))
    plain = pull_rope(load, points, *rope)
    raised = pull_rope(
        load * np.where(points < reach, 1.0 + end_factor, 1.0), points, *rope
    )
    assert plain < raised <= compute_end_factor(width, spacing) * plain


def use_nearly(check, share):
    """Characteristic resistance of which a check uses this share [N]."""
    return check.read_band("E_d")[1] * check.read("γ_R") * 1e3 / share


def test_change_that_mends_an_end_member(judged):
    name = "end_guy_anchor.tendon.end"
    value = use_nearly(checks_of(judged[1])[name], 1.31)
    row = with_panel(a_panel(), end=an_end(37.0, value))
    _, study = judge(row, solver=CaseSolver(RUN.settings, RUN.creep_law))
    check = checks_of(study)[name]
    assert check.verdict is Verdict.FAIL
    changes = {one.quantity.key: one for one in check.changes}
    needed = changes["change.characteristic_resistance"].bound
    assert needed == pytest.approx(1.31e-3 * value, abs=0.1)


def test_the_guideline_s_load_reaches_the_ropes():
    """(P12): its largest pulls at foot and head over those of the solved panels."""
    row = with_panel(a_panel(), end=an_end(angle=37.0))
    (envelope,) = solve_site(build_site(row), RUN)
    floor = find_row_floor(row, RANGES, load_standard("swiss-guideline-2007"))
    panels = [one.panel.solution for one in envelope.results]
    feet = [np.hypot(*np.add(one.foot, one.mid_foot)) for one in panels]
    heads = [np.hypot(*one.head) for one in panels]
    foot = floor.find("foot_anchor").force / max(feet)
    head = floor.head.pull / max(heads)
    found = find_rope_factors(envelope.results, floor)
    expected = (max(1.0, foot), max(1.0, head), max(1.0, head))
    assert found == pytest.approx(expected, rel=1e-12)
    assert max(found) > 1.0
    half = replace(floor, head=replace(floor.head, pull=0.3 * floor.head.pull))
    assert find_rope_factors(envelope.results, half).ridge == 1.0
    double = replace(floor, head=replace(floor.head, pull=2.0 * floor.head.pull))
    doubled = find_rope_factors(envelope.results, double).ridge
    assert doubled == pytest.approx(2.0 * head)


# Of other types at the end, whose checks say nothing of those inside.
OTHER = tuple(replace(one, type_id="T2") for one in resist())


def test_ropes_that_slide_leave_the_second_support_its_width_alone():
    end = an_end(angle=37.0)
    row = with_panel(a_panel(), end=end, end_resistances=OTHER)
    held, slide = (
        checks_of(judge(replace(row, row_end=one))[1])
        for one in (end, replace(end, ropes_slide=True))
    )
    for name in ("uphill_guy.rope", "post.compression", "foot_anchor.tendon"):
        both = [one[f"{name}.second"] for one in (held, slide)]
        assert both[0].read("D") > 0.0
        assert both[1].read("D") is None
        assert both[0].demand_kN > both[1].demand_kN
        assert both[1].read("b_e") > both[1].read("b")


def test_no_load_of_the_second_support_is_lost():
    """Inside, at the end or of its own: some check of the type has its force."""
    end, seen = an_end(angle=37.0), 0
    for gap in (0.7, 1.6, math.inf):
        row = with_panel(a_panel(), end=end, gap=gap)
        apart = replace(row, end_resistances=OTHER)
        _, together = judge(row)
        _, alone = judge(apart)
        shown = checks_of(together)
        for name, check in checks_of(alone).items():
            if not name.endswith(".second") or check.demand_kN is None:
                continue
            inside = name.removesuffix(".second")
            beside = (inside, name, f"{inside}.end")
            told = [shown[one].demand_kN for one in beside if one in shown]
            assert max(told) >= check.demand_kN * (1.0 - 1e-12), name
            seen += 1
    assert seen > 20


def test_an_end_guy_that_nothing_holds_proves_no_member_of_the_end(monkeypatch):
    def fail(*_):
        reason = say("support.not_held_sideways")
        return FailedSupport(outcome=Outcome.NO_EQUILIBRIUM, reason=reason)

    monkeypatch.setattr(load_along_row, "hold_end_guy", fail)
    _, study = judge(with_panel(a_panel(), end=an_end(angle=37.0)))
    checks = checks_of(study)
    for name in ("post.compression", "uphill_guy.rope", "downhill_anchor.pull_out"):
        assert checks[f"{name}.end"].verdict is Verdict.NOT_PROVEN
        assert checks[name].verdict is Verdict.PASS
    assert study.rows[0].end_guy is None


def test_a_truss_that_does_not_stand_proves_no_member_of_the_end(monkeypatch):
    monkeypatch.setattr(load_along_row, "share_with_end_guy", lambda *_, **__: None)
    _, study = judge(with_panel(a_panel(), end=an_end(angle=37.0)))
    assert checks_of(study)["uphill_guy.rope.end"].verdict is Verdict.NOT_PROVEN


def test_what_is_assumed_of_the_end_is_told():
    row = with_panel(a_panel(), end=an_end(angle=37.0))
    keys = {one.key for one in judge(row)[1].rows[0].notes}
    assert {"row.end_guy_holds_all", "row.end_guy_at_head"} <= keys
    assert "row.posts_unknown" not in keys
    loose = replace(row, post_count=None)
    keys = {one.key for one in judge(loose)[1].rows[0].notes}
    assert "row.posts_unknown" in keys


def test_the_foot_beside_the_end_is_pulled_farther_along_the_row():
    """tan of the turn: 0.1 of the load, and D over the foot's force, (P11)."""
    row = with_panel(a_panel(), end=an_end(angle=37.0), gap=1.0)
    site, study = judge(row)
    of_foot = {
        one.position: one for one in study.rows[0].pulls if one.anchor == "foot_anchor"
    }
    assert set(of_foot) == {"intermediate", "second"}
    width = find_effects(row, PROFILE, RANGES).find_support("second")
    grown = width.end_factor * width.end_length / 3.5
    (envelope,) = solve_site(site, RUN)
    along = max(
        one.panel.solution.lower.along / np.hypot(*one.panel.solution.foot)
        for one in envelope.results
    )
    plain, beside = (of_foot[one] for one in ("intermediate", "second"))
    flat = math.cos(plain.angle) * math.hypot(1.0, 0.1)
    turned = math.acos(flat / math.hypot(1.0, 0.1 + along * grown))
    assert beside.angle == pytest.approx(turned, rel=1e-6)
    assert beside.angle > plain.angle + 0.01
