"""Notional reliability of rows: what it rests on, what it never changes."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.reliability.check_by_case import find_check_by_case
from netdesign.addons.reliability.response import Line
from netdesign.addons.reliability.row_reliability import rate_reliability
from netdesign.addons.reliability.uncertainty_sheet import UncertainQuantity
from netdesign.checks import load_standard
from netdesign.outcome import Verdict
from netdesign.site.reader import read_site
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import compare_densities
from netdesign.structure.members import ROPE_OF, RopeForce
from netdesign.study import worst_checks
from netdesign.study.case_records import read_point
from netdesign.study.cases import search_site
from netdesign.study.check_site import name_rows
from netdesign.study.document import read_document, write_document
from netdesign.study.guideline_load import find_effects
from netdesign.study.judge import judge_site
from netdesign.study.member_force import find_force
from netdesign.study.row_to_check import CaseSolver
from netdesign.study.scopes import find_worst
from tests.each import each
from tests.make import load_rows, write_site
from tests.small_site import RUN
from tests.turn import turn

STANDARD = load_standard("nf-p-95-304-style")
_FOOT_ROPE = RopeForce.LOWER_ALONG
WITH = replace(RUN, has_reliability=True)


def tell(name, variation, **more):
    return UncertainQuantity(
        row_id="", name=name, variation=variation, source="told here", **more
    )


@pytest.fixture(scope="module")
def searched(tmp_path_factory):
    """Site of one row that glides and one that does not, and its cases."""
    path = tmp_path_factory.mktemp("site") / "site.xlsx"
    own = {"foot_anchor": "A57-tested", "end_anchor": "A40-tested", "end_guy": "E40"}
    ropes = {"ridge_rope": "B44", "lower_rope": "B44"}
    tables = load_rows(["R2", "R4"], cells={"R4": own | ropes})
    types = {one["id"]: one for one in tables["anchor_types"]}
    types["A40-tested"] |= {"tendon": 1500, "pull_out": 420, "test_mean": 420}
    site = read_site(write_site(path, tables))
    held, gliding = site.rows
    held = replace(held, ground=GroundLaw(kind="no-slip"), glide_factor=None)
    site = replace(site, rows=(held, gliding))
    return site, search_site(site, RUN)


@pytest.fixture(scope="module")
def judge(searched):
    def judge(*uncertain, run=WITH):
        site, solved = searched
        site = replace(site, of_addons={"Uncertainty": uncertain})
        solver = CaseSolver(run.settings, run.creep_law)
        return judge_site(site, solved, STANDARD, run, solver)

    return judge


@pytest.fixture(scope="module")
def study(judge):
    return judge()


def test_snow_is_denser_where_it_is_deeper(judge, searched):
    site, _ = searched
    told = tell("density", 0.01), tell("snow_height", 0.25)
    for record, row in zip(judge(*told).rows, site.rows, strict=True):
        found = {one.name: one for one in record.reliability.variables}
        deep = found["snow_height"].at_design_point
        height = row.snow_thickness / math.cos(row.slope_angle)
        assert abs(deep / height - 1.0) > 0.03
        denser = float(compare_densities(np.array([deep]), height)[0])
        density = found["density"].at_design_point / found["density"].mean
        assert density == pytest.approx(denser, rel=0.01)


@pytest.mark.parametrize("verdict", [Verdict.NOT_PROVEN, Verdict.DECLARED])
def test_a_row_with_an_open_check_has_none_however_safe_the_others_are(study, verdict):
    row = study.rows[0]
    for number in range(0, len(row.checks), 7):
        checks = list(row.checks)
        checks[number] = turn(checks[number], verdict)
        found = rate_reliability(None, checks, find_worst(checks), None, None)
        assert found.reason.key == "reliability.open_check"
        assert found.beta is None
    failing = turn(row.checks[3], Verdict.FAIL, utilisation=math.inf, reason="none")
    found = rate_reliability(None, [*row.checks, failing], None, None, None)
    assert found.reason.key == "reliability.open_check"


def test_it_is_of_the_governing_check_and_has_a_number(study):
    for row in study.rows:
        record, worst = row.reliability, find_worst(row.checks)
        assert record.reason is None
        assert record.check == worst.id
        assert 2.0 < record.beta < 7.0
        assert 0.0 < record.standard_error < 0.02
        assert record.solves <= 10
        shares = [one.alpha_squared for one in record.variables]
        assert sum(shares) == pytest.approx(1.0)
        # less used than 1: safer than at 1
        assert record.beta > record.beta_at_full
        implied = record.action_factor * record.resistance_factor
        given = record.profile_action_factor * record.profile_resistance_factor
        assert implied == pytest.approx(given / worst.utilisation, rel=0.01)


def raise_rope(site, row, case):
    """Growth of a border rope at the row's end, with a case's glide factor."""
    ranges, spacing = site.ranges, row.layout.post_spacing
    for name in ("thickness", "glide_factor") if case else ():
        ranges = ranges.with_value(name, case.values[name])
    end = find_effects(row, STANDARD, ranges).find_support("edge")
    return 1.0 + 2.0 * end.end_factor * end.end_length / spacing


def test_the_design_point_is_solved_by_the_full_model(searched, study):
    site, _ = searched
    solver = CaseSolver(RUN.settings, RUN.creep_law)
    for given, row in zip(site.rows, study.rows, strict=True):
        record, worst = row.reliability, find_worst(row.checks)
        cases = (read_point(record.design_point), read_point(worst.case))
        wanted = [(given, case, solver.law) for case in cases]
        at, now = (one.member_forces for one in solver.solve_all(wanted))
        name = ROPE_OF.get(worst.member, worst.member)
        growth = at[name].value / now[name].value
        if worst.position == "second":  # E^2 = N^2 + (k N + D)^2
            across = worst.read("E_s") * worst.read("b_e") / worst.read("b")
            rope = at[_FOOT_ROPE].value / now[_FOOT_ROPE].value
            along = worst.read("k") * growth * across + rope * worst.read("D")
            growth = math.hypot(growth * across, along) / worst.read("E_c")
        if worst.member in ROPE_OF:  # 1 + 2 f_R s_R / b of a border rope, (P9)
            growth *= raise_rope(site, given, cases[0]) / raise_rope(site, given, None)
        assert record.force_ratio == pytest.approx(growth, rel=0.03)
        assert record.force_ratio == pytest.approx(record.force_ratio_by_model, rel=0.1)


def follow(judge, monkeypatch):
    """Task, forces and checks of each row, with the rows' governing checks."""
    from netdesign.addons.reliability import row_reliability

    kept, real = [], row_reliability.find_check_by_case

    def keep(task, known, one, judged):
        kept.append((task, known, one, list(judged)))
        return real(*kept[-1])

    monkeypatch.setattr(row_reliability, "find_check_by_case", keep)
    judge()
    return kept


def cut_to(known, solved, case):
    """Forces of a row that are those of one case, with what may hide."""
    largest = {}
    for name, record in known.largest.items():
        most = max(
            one.member_forces[name].high for one in solved if name in one.member_forces
        )
        share = case.member_forces[name].high / most if most else 0.0
        kN = share * record.high_kN
        largest[name] = replace(record, low_kN=kN, value_kN=kN, high_kN=kN)
    return replace(known, largest=largest)


def test_beside_the_end_a_check_is_followed_as_its_formula_says(judge, monkeypatch):
    """E = sqrt(N^2 + (k N + D)^2) of a foot, guys with D c / sin beta; each case."""
    followed = set()
    for task, known, *_ in follow(judge, monkeypatch):
        solved, width = task.solved.results, known.effects.find_support("second")
        for one in worst_checks._judge_at(
            [known], width, task.row.resistances_at("second")
        ):
            force = one.force
            if force.push is None:
                continue
            by_case = find_check_by_case(task, known, one, [one])
            if by_case is None:
                post = one.resistance.member in ("post", "post_base")
                unsolved = not force.largest.high_kN  # and not pulled in any case
                assert (
                    post or unsolved or force.load.across or one.resistance.dimensions
                )
                continue
            followed.add((task.row.id, one.resistance.member))
            factor, design = one.check.read("γ_E"), one.check.read("R_d")
            for case in solved[::7]:
                of_case = find_force(
                    cut_to(known, solved, case), one.resistance, one.width
                )
                direct = max(of_case.coupled.high, of_case.by_panel.high)
                used = factor * direct / design
                assert by_case.utilisation(case) == pytest.approx(used, rel=1e-9)
                # without the rope's unbalanced pull it would be less
                bare = replace(by_case, push=None).utilisation(case)
                assert bare < 0.999 * used
    assert {("R2", "foot_anchor"), ("R4", "foot_anchor")} <= followed
    assert ("R2", "uphill_guy") in followed


@each(
    "quantity",
    [
        tell("model", 0.31),
        tell("resistance", 0.33),
        tell("resistance", 0.2, mean_ratio=1.02),
        tell("snow_height", 0.3, period=30.0),
        tell("model", 0.2, mean_ratio=1.2),
    ],
)
def test_more_scatter_and_less_margin_lower_the_index(judge, study, quantity):
    for row, again in zip(study.rows, judge(quantity).rows, strict=True):
        now, moved = row.reliability, again.reliability
        assert moved.beta is None or moved.beta < now.beta - 0.05


def test_a_design_point_beyond_what_was_solved_is_not_available(judge):
    (_, gliding) = judge(tell("glide_factor", 0.9), tell("model", 0.02)).rows
    record = gliding.reliability
    assert record.beta is None
    assert record.reason.key in ("reliability.beyond", "reliability.missed")
    assert record.variables == []


def test_a_fault_of_its_own_is_a_reason_and_no_fault_of_the_checks(
    judge, study, monkeypatch
):
    from netdesign.addons.reliability import row_reliability

    def fail(*_):
        raise ZeroDivisionError("made up")

    monkeypatch.setattr(row_reliability, "find_reliability", fail)
    found = judge()
    assert found.verdict is study.verdict
    for row, before in zip(found.rows, study.rows, strict=True):
        assert row.reliability.reason.key == "reliability.fault"
        assert row.checks == before.checks


def test_a_stored_study_has_it_and_contradicts_nothing(study):
    again = read_document(write_document(study))
    assert [row.reliability for row in again.rows] == [
        row.reliability for row in study.rows
    ]


def test_the_store_keeps_rows_with_and_without_it_apart(searched):
    site, _ = searched
    typed = replace(site, of_addons={"Uncertainty": (tell("model", 0.19),)})
    pairs = [(site, RUN), (site, WITH), (typed, WITH)]
    names = [name_rows(one, [STANDARD], run)["R2"] for one, run in pairs]
    assert len(set(names)) == 3


def test_a_line_goes_through_its_values_and_on_along_its_tangent():
    line = Line(
        name="thickness", low=1.3, centre=2.1, high=2.9, solved=2.7, bend=-0.4
    ).meet(2.7, 0.53)
    assert line.find(np.array([2.7]))[0] == pytest.approx(0.53)
    assert line.find(np.array([2.1]))[0] == 0.0
    steps = np.array([2.9 - 1e-6, 2.9, 2.9 + 1e-6, 3.4, 3.4 * (3.4 / 2.9)])
    found = line.find(steps)
    inner, outer = np.diff(found[:3])
    assert outer == pytest.approx(inner, rel=1e-4)
    assert found[4] - found[3] == pytest.approx(found[3] - found[1])


def test_what_nobody_typed_is_told_as_assumed(judge, study):
    assert all(
        one.is_assumed for row in study.rows for one in row.reliability.variables
    )
    told = judge(tell("snow_height", 0.27, period=80.0), tell("model", 0.25))
    for row in told.rows:
        typed = {one.name for one in row.reliability.variables if not one.is_assumed}
        assert typed == {"snow_height", "model"}
        sources = {str(one.source.arguments) for one in row.reliability.variables}
        assert "{'text': 'told here'}" in sources


def test_without_a_distribution_it_is_not_available(searched, judge):
    site, solved = searched
    rows = tuple(replace(row, glide_factor=None) for row in site.rows)
    solver = CaseSolver(WITH.settings, WITH.creep_law)
    found = judge_site(replace(site, rows=rows), solved, STANDARD, WITH, solver)
    gliding = found.rows[1].reliability
    assert (gliding.beta, gliding.reason.key) == (None, "reliability.no_distribution")
