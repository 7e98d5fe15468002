"""Ends of a row of panels: pulls along the row, what holds them, the end effect."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from netdesign.calculation.quantity import leaf
from netdesign.checks.forces import place_end_support, pull_at_end
from netdesign.outcome import Outcome, Verdict
from netdesign.structure.head import FailedSupport
from netdesign.structure.row_position import LoadedWidth
from netdesign.study import load_along_row
from netdesign.words.message import say
from tests.each import each
from tests.small_site import (
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
