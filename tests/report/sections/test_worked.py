"""Checks worked out: lines of the governing one, and the annex of all kinds."""

from dataclasses import replace

from netdesign.outcome import Verdict
from netdesign.report.blocks import Items
from netdesign.report.page.html import render_html
from netdesign.report.sections.worked import show_all, work_out
from netdesign.report.words import ENGLISH, show_check
from netdesign.study.governing import find_shown
from netdesign.words.message import say
from tests.report.build_study import build_row, build_study
from tests.report.reading import PageReader

STUDY = build_study()
ROW = STUDY.rows[0]


def read(cell):
    return cell.text or "".join(one.text for one in cell.content)


def list_lines(check):
    return [[read(cell) for cell in row] for row in work_out(check, ENGLISH).rows]


def test_worked_check_shows_symbols_numbers_and_result():
    row = build_row("A", 2, scale=0.6)
    *_, demand, derivation, resistance, ratio = list_lines(find_shown(ROW.checks))
    assert derivation[0] == "R_k"
    force = row.member_forces[0].value_kN
    assert demand[1] == f"= 1.5 · {force:.4g} kN"
    assert demand[2] == f"= {1.5 * force:.4g} kN"
    assert resistance[2] == f"= {480 / 1.35:.4g} kN"
    assert ratio[2].startswith(f"= {1.5 * force / (480 / 1.35):.2f} (")


def test_worked_steps_lead_from_the_solved_force_to_the_utilisation():
    edge, coupled, floor, action, *others = list_lines(ROW.checks[0])
    assert edge == [
        "b_e = b / 2 + f_R · Δl",
        "= 4 m / 2 + 1.6 · 1.5 m",
        "= 4.4 m",
    ]
    assert coupled[0] == "E_c = E_s · b_e / b"
    assert floor[0] == "E_g = E_g0 · b_e / b"
    assert action[0] == "E_k = max(E_c; E_g)"
    results = [one[2].removeprefix("= ") for one in (coupled, floor)]
    assert action[1] == f"= max({'; '.join(results)})"
    symbols = [one[0].partition(" = ")[0] for one in others]
    assert symbols[0] == "E_d"
    assert symbols[-2:] == ["R_d", "μ"]
    assert list_lines(replace(ROW.checks[0], steps=[])) == []


def test_the_annex_has_the_governing_check_of_every_kind():
    page = PageReader(render_html(STUDY))
    (table,) = page.tables["annex-checks"]
    told = " ".join(cell for line in table for cell in line)
    kinds = {}
    for row in STUDY.rows:
        for one in (one for one in row.checks if one.is_of_force):
            way = one.resistance_derivation and one.resistance_derivation.key
            kinds.setdefault((one.member, one.mode, one.position, way), []).append(one)
    known = [any(one.used is not None for one in kind) for kind in kinds.values()]
    assert told.count("μ =") == sum(known) > 5
    for kind in kinds.values():
        assert any(one.resistance_cell in told for one in kind)


def test_the_annex_has_each_requirement_without_a_force_once():
    page = " ".join(PageReader(render_html(STUDY)).text)
    annex = page[page.rindex(ENGLISH("heading.annex_checks")) :]
    wanted = {
        show_check(ENGLISH, one)
        for row in STUDY.rows
        for one in row.checks
        if not one.is_of_force
    }
    assert wanted
    assert all(name in annex for name in wanted)


def test_one_reason_of_many_checks_of_a_row_stands_once_in_the_annex():
    finding = say("heading.no_rows")
    checks = [
        replace(one, steps=[], met=Verdict.NOT_PROVEN, finding=finding)
        for one in ROW.checks
    ]
    bare = replace(STUDY, rows=[replace(ROW, checks=checks)])
    (items,) = (one for one in show_all(bare, ENGLISH).blocks if isinstance(one, Items))
    clauses = {(one.clause, one.verdict) for one in checks}
    assert len(items.items) == len(clauses) < len(checks)
    for one in checks:
        assert any(show_check(ENGLISH, one) in line for line in items.items)
