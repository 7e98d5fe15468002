"""Ends of a row of panels: pulls along the row, what holds them, the end effect."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from netdesign.calculation.quantity import given
from netdesign.checks import load_standard
from netdesign.checks.forces import place_end_support, pull_at_end
from netdesign.outcome import Verdict
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.effects import find_effects
from netdesign.study.row_to_check import CaseSolver
from netdesign.words.message import say
from tests.each import each
from tests.small_site import RANGES, RUN, build_row, name_force_checks, resist
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
        given("b", spacing, "m", ""),
        given("f_R", width.end_factor, "-", ""),
        given("Δl", width.end_length, "m", ""),
    )
    return pull_at_end(given("T_r", 1.0, "kN", ""), support).value


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
    pushed = upper * math.tan(math.radians(37.0))
    assert post.read("Z") == pytest.approx(pushed, rel=1e-12)
    assert post.read(post.name_force("p")) > pushed
    assert checks["post.compression"].read("Z") is None
    assert post.governs == "panel"


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


def test_members_of_an_end_without_a_panel_are_not_proven_and_no_check_is_lost():
    """A system that is not computed must not turn a row with an end guy into a pass."""
    row = with_panel(a_panel(), end=an_end(angle=37.0))
    row = replace(row, panels=(), panel_assumed=(), panel_lack=say("panel.triangular"))
    _, study = judge(row)
    checks = checks_of(study)
    bare = {"row_end": None, "panel_lack": None, "net_parts": row.net_parts[:1]}
    _, plain = judge(replace(row, **bare))
    assert plain.rows[0].verdict is Verdict.PASS
    open_checks = {
        name for name, one in checks.items() if one.verdict is Verdict.NOT_PROVEN
    }
    assert open_checks == {
        *name_force_checks(has_ropes=True, has_end=True)[-12:],
        *(name for name in checks if name.startswith("post") and name[-4:] == ".end"),
        *(name for name in checks if name.startswith("uphill_")),
        "lateral_anchor.direction.end",  # pulled at 80 degrees to its axis
    }
    for name in open_checks:
        assert "triangular nets are not covered" in str(checks[name].reason)
    for name, one in checks_of(plain).items():
        if name not in open_checks:
            assert checks[name].verdict is one.verdict


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
    assert study.verdict is Verdict.NOT_PROVEN
    for name in ("lateral_anchor.tendon.end", "end_guy.rope.end"):
        assert checks[name].verdict is Verdict.NOT_PROVEN
        assert checks[name].demand_kN > 0.0


def test_an_end_guy_without_its_angle_proves_neither_itself_nor_the_post():
    _, study = judge(with_panel(a_panel(), end=an_end(angle=None)))
    checks = checks_of(study)
    for name in (
        *("end_guy.rope.end", "end_guy_anchor.tendon.end"),
        *("post.compression.end", "post_base.bearing.end"),
    ):
        assert checks[name].verdict is Verdict.NOT_PROVEN
        assert "angle of the end guy" in str(checks[name].reason)
    assert checks["lateral_anchor.tendon.end"].verdict is Verdict.PASS
    assert checks["post.compression"].verdict is Verdict.PASS


def test_weak_end_fails():
    _, study = judge(with_panel(a_panel(), end=an_end(value=1e3)))
    assert study.verdict is Verdict.FAIL


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


def test_resistances_of_all_members_still_count():
    """An end of its own does not hide a weak member of the row."""
    weak = resist(foot_anchor__tendon=1e3)
    _, study = judge(with_panel(a_panel(), resistances=weak))
    assert checks_of(study)["foot_anchor.tendon"].verdict is Verdict.FAIL


def use_nearly(check, share):
    """Characteristic resistance of which a check uses this share [N]."""
    return check.read_band("E_d")[1] * check.read("γ_R") * 1e3 / share


def test_change_that_mends_an_end_member(judged):
    name = "end_guy_anchor.tendon.end"
    value = use_nearly(checks_of(judged[1])[name], 1.11)
    row = with_panel(a_panel(), end=an_end(37.0, value))
    _, study = judge(row, solver=CaseSolver(RUN.settings, RUN.creep_law))
    check = checks_of(study)[name]
    assert check.verdict is Verdict.FAIL
    changes = {one.quantity.key: one for one in check.changes}
    needed = changes["change.characteristic_resistance"].bound
    assert needed == pytest.approx(1.11e-3 * value, abs=0.1)
