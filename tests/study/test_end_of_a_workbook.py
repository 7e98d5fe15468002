"""A workbook whose row end is held, with and without a complete panel between posts."""

import math
import random

import pytest

from netdesign.checks import load_standard
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.outcome import Verdict
from netdesign.site.reader import read_site
from netdesign.study.cases import search_site
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun
from netdesign.words.catalogue import LANGUAGES, render
from tests.digits import write_force
from tests.old_example import write_old_example
from tests.verification.untidy_site import PROFILE, draw_site

RUN = CheckRun(
    settings=SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2]),
    started="",
)
PANEL = {
    "panel_system": "rectangular",
    "net_cut": "fitted",
    "ridge_rope": "border",
    "ridge_sag": 0.047,
    "lower_rope": "border",
    "lower_sag": 0.061,
}
END = {
    "row": "U2",
    "support_types": "as inside",
    "lateral_anchor": "strong",
    "end_guy": "number",
    "end_guy_anchor": "strong",
    "end_guy_angle": 37.0,
    "lateral_axis": 25.0,
}
MEMBERS = {"lateral_anchor", "end_guy", "end_guy_anchor"}


def judge(folder, panel, without=()):
    """Study of one drawn row with this panel, from its workbook."""
    lines = draw_site(random.Random(31))
    row = next(one for one in lines["Nets"] if one["id"] == "U2")
    row = {**row, "slack": 0.043, **panel}
    lines["Nets"] = [{key: one for key, one in row.items() if key not in without}]
    lines["Ranges"] = [one for one in lines["Ranges"] if one["quantity"] != "slack"]
    border = {"id": "border", "rope": 266.0, "axial_stiffness": 17600.0}
    lines["Ropes"].append(border | {"protected_years": 90})
    lines["Links"].append(
        {"type": "border", "link": "eye", "strength": 301.0, "chain": "complete"}
    )
    (strong,) = (one for one in lines["Anchors"] if one["id"] == "strong")
    strong["bar_diameter"] = 61.7  # beyond all forces, numerical uncertainty included
    lines["Ends"], lines["Declared"] = [END], []
    path = folder / "site.xlsx"
    write_old_example(path, lines=lines)
    site, standard = read_site(path), load_standard(PROFILE)
    study = judge_site(site, search_site(site, RUN), standard, RUN)
    return study.rows[0]


def at_end(row):
    return {one.id: one for one in row.checks if one.member in MEMBERS}


def test_an_end_that_is_held_is_not_proven_without_a_panel(tmp_path):
    """One that is assumed throughout tells forces, and proves nothing."""
    row = judge(tmp_path, {}, without=("panel_system",))
    assert row.verdict in (Verdict.NOT_PROVEN, Verdict.FAIL)
    checks = at_end(row)
    assert {one.member for one in checks.values()} == MEMBERS
    post = next(one for one in row.checks if one.id == "post.compression.end")
    for check in (*checks.values(), post):
        assert check.verdict in (Verdict.NOT_PROVEN, Verdict.FAIL)


@pytest.mark.parametrize("mid", ["no", "yes"])
def test_with_its_panel_each_of_them_has_a_demand(tmp_path, mid):
    """Net and uphill guy end at one anchor here."""
    row = judge(tmp_path, {**PANEL, "mid_anchors": mid})
    checks = at_end(row)
    assert {one.member for one in checks.values()} == MEMBERS
    for check in checks.values():
        assert check.demand_kN > 0.0
        assert check.verdict in (Verdict.PASS, Verdict.FAIL)
    shared = next(one for one in row.checks if one.id == "foot_anchor.tendon")
    assert shared.is_by_panel is (mid == "no")
    forces = {one.quantity: one.value_kN for one in row.forces}
    key = "panel_foot_anchor" if shared.is_by_panel else "foot_anchor"
    assert shared.read("E_p0" if shared.is_by_panel else "E_s") == forces[key]
    require_one_anchor_told(row)


def require_one_anchor_told(row):
    """Net anchor (foot) and lateral anchor as one: the root of both squares."""
    forces = {
        member: max(
            one.read("E_k")
            for one in row.checks
            if one.member == member and one.is_of_force and one.position == "edge"
        )
        for member in ("foot_anchor", "lateral_anchor")
    }
    (note,) = (one for one in row.notes if one.key == "row.one_anchor")
    assert note.arguments["both"] == pytest.approx(math.hypot(*forces.values()))
    for language in LANGUAGES:
        shown = write_force(note.arguments["both"])
        assert shown in render(note, language).replace(",", ".")
