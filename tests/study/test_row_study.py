"""One real row, coarsely solved: what is told of it holds when it is done."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.outcome import Verdict
from netdesign.site.model import Resistance
from netdesign.snow.ground import GroundLaw
from netdesign.structure.members import MEMBER_MODES
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CaseSolver, CheckRun
from tests.grid import solve_site
from tests.small_site import EYE, LASTS, build_row, build_site

RUN = CheckRun(settings=SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2]))
RANGES = Ranges.of(
    density=Interval(low=270.0, high=400.0),
    friction_angle=Interval(low=math.radians(20), high=math.radians(40)),
    inclination=Interval(low=math.radians(30), high=math.radians(30)),
)
WEAK = 160e3  # [N], the foot anchor's tendon; all else is strong


def a_resistance(member, mode):
    is_weak = (member, mode) == ("foot_anchor", "tendon")
    return Resistance(
        member=member,
        mode=mode,
        value=WEAK if is_weak else 1e7,
        basis="tested" if mode == "pull_out" else "declared",
        type_id="weak" if is_weak else "strong",
        source="Anchors!B2",
        ground="till",
        wear=LASTS if mode in ("tendon", "rope") else None,
    )


ROW = build_row(
    "R1",
    altitude=940.0,
    upslope_length=12.0,
    ground=GroundLaw(kind="no-slip"),
    net_height=2.8,
    resistances=tuple(a_resistance(member, mode) for member, mode in MEMBER_MODES),
    gap=1.0,
)


def study(row=ROW, ranges=RANGES, *, with_solver=False):
    site = build_site(row, ranges=ranges)
    links = dict.fromkeys(("weak", "strong", "B22"), (EYE,))
    site = replace(site, catalogue=row.resistances, links=links)
    solver = CaseSolver(RUN.settings, RUN.creep_law) if with_solver else None
    results = solve_site(site, RUN)
    standard = load_standard("nf-p-95-304-style")
    return judge_site(site, results, standard, RUN, solver).rows[0]


def check(row):
    return next(one for one in row.checks if one.id == "foot_anchor.tendon")


@pytest.fixture(scope="module")
def found():
    return study(with_solver=True)


@pytest.fixture(scope="module")
def changes(found):
    return {str(change.quantity): change for change in check(found).changes}


def test_weak_anchor_fails_and_every_change_is_told(found, changes):
    assert check(found).verdict is Verdict.FAIL
    assert set(changes) == {
        "characteristic resistance",
        "type strong of the workbook",
    }
    others = [one for one in found.checks if one.id != "foot_anchor.tendon"]
    assert all(one.changes == [] for one in others)


def test_resistance_that_is_told_is_enough_and_no_more(changes):
    needed = 1e3 * changes["characteristic resistance"].bound

    def verdict(value):
        stronger = replace(ROW.resistances[0], value=value)
        row = replace(ROW, resistances=(stronger, *ROW.resistances[1:]))
        return check(study(row)).verdict

    assert verdict(needed) is Verdict.PASS
    assert verdict(needed - 200.0) is not Verdict.PASS


def test_guideline_stands_beside_the_solve(found):
    record = found.guideline
    names = [case.name for case in record.cases]
    assert names == ["same_snow", "load_case_1", "load_case_2"]
    same = record.cases[0]
    assert same.density_kg_m3 == record.case.density_kg_m3 == 400.0
    assert same.glide_factor == 1.2  # the least of the guideline's tables
    ratio = record.solved_load_kN_per_m / same.load_kN_per_m
    assert 0.7 < ratio < 1.7  # two models of the same snow, see physics of the pressure
    assert "Both use the same glide factor" in str(record.sentence)
    of_cases = {one.name: one.loaded_share for one in record.cases}
    assert of_cases["load_case_1"] == pytest.approx(1.0, rel=1e-12)
    assert of_cases["load_case_2"] == pytest.approx(0.77, rel=1e-12)
    # the picture's coupled line: pressure alone, the load without friction
    pairs = zip(record.along_net, record.along_net[1:], strict=False)
    area = sum((y2 - y1) * (p1 + p2) / 2.0 for (y1, p1), (y2, p2) in pairs)
    assert 0.65 < area / record.solved_load_kN_per_m < 0.95
