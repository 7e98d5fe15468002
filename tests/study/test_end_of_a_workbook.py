"""A workbook whose row end is held, with and without a complete panel between posts."""

import math
import random

import pytest

from netdesign.checks import load_standard
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.outcome import Verdict
from netdesign.study.cases import search_site
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun
from tests.make import VERTICAL, draw_untidy, read_tables

RUN = CheckRun(
    settings=SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2]),
    started="",
)
PANEL = {
    "ridge_rope": "border",
    "ridge_sag": 9.7,
    "lower_rope": "border",
    "lower_sag": 11.1,
}
MEMBERS = {"lateral_anchor", "end_guy", "end_guy_anchor"}


def judge(panel):
    """Study of one drawn row with this panel, from its tables."""
    tables = draw_untidy(random.Random(31))
    tables["rows"] = [one for one in tables["rows"] if one["id"] == "U2"]
    (row,), tables["declared"] = tables["rows"], []
    row |= {"end_anchor": "strong", "snow": 2.13, "post_spacing": 2.71}
    del tables["soils"]
    (net,) = (one for one in tables["net_types"] if one["id"] == row["net_type"])
    net |= {"net_height": 2.07, "slack": 4.3, "end_guy_angle": 37.0}
    net["ropes_at_supports"] = "slide"
    net |= dict.fromkeys(PANEL) | panel
    for rope in tables["ropes"]:  # beyond all forces, as are links and bars
        rope["rope"] *= 3.0
    for link in tables["links"]:
        link |= {"force": 2900.0, "meaning": "strength"}
    (strong,) = (one for one in tables["anchor_types"] if one["id"] == "strong")
    strong |= {"bar_diameter": 89.7, "tendon": 3000.0, "tube_diameter": 139.7}
    strong["tube_wall"] = 20.0
    site, standard = read_tables(tables, VERTICAL), load_standard("eurocode")
    study = judge_site(site, search_site(site, RUN), standard, RUN)
    return study.rows[0]


def at_end(row):
    return {one.id: one for one in row.checks if one.member in MEMBERS}


@pytest.mark.parametrize("mid", ["no", "yes"])
def test_with_its_panel_each_of_them_has_a_demand(mid):
    """Net and uphill guy end at one anchor here."""
    row = judge({**PANEL, "mid_anchors": mid})
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
