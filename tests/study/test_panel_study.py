"""Both sets of forces in the checks of a row: by section and by panel between posts."""

import math
from dataclasses import replace

import numpy as np

from netdesign.checks import load_standard
from netdesign.envelope import run as running
from netdesign.outcome import Outcome, Verdict
from netdesign.panel.inputs import CUTS, Panel, Rope
from netdesign.panel.solve import FailedPanel
from netdesign.site.model import Resistance, RowEnd
from netdesign.snow.ground import GroundLaw
from netdesign.solving.runner import Runner
from netdesign.structure.members import END_ANCHORS, END_MODES
from netdesign.study.judge import judge_site
from netdesign.words.message import say
from tests.each import each
from tests.grid import solve_site
from tests.small_site import (
    LASTS,
    RANGES,
    RUN,
    TURNS,
    build_row,
    build_site,
    list_net_parts,
    name_directions,
    name_force_checks,
    turn,
)

PROFILE = load_standard("eurocode")


def a_panel(spacing=3.5, **changes):
    values = {
        "post_spacing": spacing,
        "lower": Rope(stiffness=17.3e6, sag=0.043),
        "upper": Rope(stiffness=19.1e6, sag=0.057),
        "cut": "upper",
    }
    return (Panel(**(values | changes)),)


def an_end(angle=40.0, value=1e7):
    """What holds the row along itself; ``value`` of all members [N]."""
    resistances = tuple(
        Resistance(
            member=member,
            mode=mode,
            value=value,
            basis="tested" if mode == "pull_out" else "",
            type_id="T2",
            source="Anchors!B3",
            ground="till",
            wear=LASTS if mode in ("tendon", "rope") else None,
        )
        for member, mode in END_MODES
    )
    return RowEnd(
        guy_angle=math.radians(angle),
        stiffnesses=((15e6, 15e6, 36e6, 700e6),),
        lateral_axis=math.radians(80.0),
        resistances=(*resistances, *turn(END_ANCHORS)),
        anchors=tuple((one, TURNS) for one in END_ANCHORS),
    )


def with_panel(panel, *, end=None, **changes):
    """Row with this panel, held along the row unless told otherwise; or without one."""
    end = (end or an_end()) if panel else None
    return build_row("R1", panels=panel, row_end=end, **changes)


def judge(row, *, standard=PROFILE, solver=None, ranges=RANGES, solve=solve_site):
    site = build_site(row, ranges=ranges)
    return site, judge_site(site, solve(site, RUN), standard, RUN, solver)


def solve_anew(site, run):
    """Cases of a site as the program solves them now."""
    return solve_site(site, run, Runner())


def checks_of(study):
    return {check.id: check for check in study.rows[0].checks}


def draw_row(rng, number):
    spacing = rng.uniform(2.6, 4.4)
    row = build_row(
        f"R{number}",
        slope_angle=math.radians(rng.uniform(32.0, 44.0)),
        net_stiffness_per_m=10 ** rng.uniform(6.6, 7.4),
        slack=rng.uniform(0.02, 0.08),
        ground=GroundLaw(kind="no-slip" if rng.random() < 0.5 else "free"),
    )
    panel = a_panel(
        spacing,
        lower=Rope(stiffness=10 ** rng.uniform(6.9, 7.4), sag=rng.uniform(0.03, 0.1)),
        upper=Rope(stiffness=10 ** rng.uniform(6.9, 7.4), sag=rng.uniform(0.03, 0.1)),
        cut=str(rng.choice(CUTS)),
        has_mid_anchors=bool(rng.random() < 0.3),
    )
    layout = replace(row.layout, post_spacing=spacing)
    return replace(row, layout=layout), panel


def _list_ends(check):
    return check.step_of["E_d"].ends


@each("seed", range(6))
def test_no_demand_falls_below_that_without_a_panel(seed):
    row, panel = draw_row(np.random.default_rng(700 + seed), seed)
    plain, both = (
        judge(
            replace(
                row,
                panels=one,
                row_end=end,
                net_parts=list_net_parts(has_ropes=bool(one)),
            )
        )[1]
        for one, end in (((), None), (panel, an_end()))
    )
    before, after = checks_of(plain), checks_of(both)
    beside = {name for name in (*before, *after) if name.endswith(".second")}
    kept = [name for name in before if name not in beside]
    assert [name for name in after if name in kept] == kept
    force_checks = name_force_checks(has_ropes=True, has_end=True)
    added = set(force_checks) - set(name_force_checks())
    added |= set(name_directions(has_end=True)) - set(name_directions())
    assert set(after) - beside == set(kept) | added
    order = [Verdict.PASS, Verdict.DECLARED, Verdict.NOT_PROVEN, Verdict.FAIL]
    for name, check in after.items():
        if name in added or name not in before:
            continue
        assert order.index(check.verdict) >= order.index(before[name].verdict)
        if None in (check.demand_kN, before[name].demand_kN):
            continue  # the angle alone, within what a rope anchor turns by
        assert check.demand_kN == check.read("E_d")
        assert before[name].demand_kN == before[name].read("E_d")
        ends = zip(_list_ends(check), _list_ends(before[name]), strict=True)
        for now, least in ends:
            assert now >= least * (1.0 - 1e-12), name


def test_a_panel_that_fails_is_not_proven_with_its_reason(monkeypatch):
    def fail(*_):
        reason = say("panel.lies_on_ground", depth=0.123)
        return FailedPanel(outcome=Outcome.OUT_OF_VALIDITY, reason=reason)

    monkeypatch.setattr(running, "resolve_panels", fail)
    _, study = judge(with_panel(a_panel()), solve=solve_anew)
    forces = [one for one in study.rows[0].checks if one.position]
    assert {one.verdict for one in forces} == {Verdict.NOT_PROVEN}
    for one in forces:
        assert "lie on the ground" in str(one.reason)
        assert one.read("E_p0") is None
        assert one.read("V_p0") is None
    assert study.verdict is Verdict.NOT_PROVEN
