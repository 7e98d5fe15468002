"""Values typed over in the workbook, against the calculation worked out again.

Forces stay those of the study; every check of it is compared, not only those that use
the value.
"""

import io
import re
import tempfile
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from netdesign.calculation.quantity import Kind
from netdesign.calculation.steps import evaluate
from netdesign.checks import load_standard
from netdesign.checks.check import judge
from netdesign.outcome import Verdict
from netdesign.report.words import ENGLISH
from netdesign.report.workbook.excel import render_workbook
from netdesign.site.reader import read_site
from netdesign.solving.runner import Runner
from netdesign.study.cases import solve_site
from netdesign.study.judge import judge_site
from tests.golden.drawn import RUN
from tests.report.build_study import build_study
from tests.report.reading import find_steps, read_rows, read_workbook, recalculate
from tests.site_lines import write_lines
from tests.study.knowing_less.drawn_site import draw_lines

SEED = 9000
# Values that the forces rest on, too; those that a resistance, another check does.
IN_FORCES = ("b",)
FOLLOWED = {"bending.": ("k", "β"), "post_bending.": ("γ_E", "γ_R")}
WITHOUT_FORCE = ("k", "β")
LINK = re.compile(r"(?:'([^']+)'!)?\$?([A-Z])\$?(\d+)")


@cache
def judge_drawn():
    """Study of a drawn site with a panel, guys that are splayed, and ends."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "site.xlsx"
        write_lines(path, draw_lines(SEED))
        site = read_site(path)
    standard = load_standard("nf-p-95-304-style")
    return judge_site(site, solve_site(site, RUN, Runner()), standard, RUN)


def draw_changes(count):
    """Study, place of a check, symbol and new value, each drawn."""
    rng = np.random.default_rng(20261124)
    studies = (build_study(rows=2), judge_drawn())
    for number in range(count):
        study = studies[number % 2]
        leaves = [
            (k, step)
            for k, (_, check) in enumerate(list_calculated(study))
            for step in check.steps
            if step.kind in (Kind.GIVEN, Kind.PROFILE) and step.value is not None
        ]
        symbol = rng.choice(sorted({step.symbol for _, step in leaves}))
        mine = [one for one in leaves if one[1].symbol == symbol]
        place, step = mine[rng.integers(len(mine))]
        value = step.value * rng.uniform(0.4, 2.5)
        if step.unit == "deg":
            value = rng.uniform(5.0, 60.0)
        yield study, place, step, value


def list_calculated(study):
    rows = enumerate(study.rows)
    return [(row, c) for row, one in rows for c in one.checks if c.steps]


def type_over(study, place, symbol, value):
    """Workbook with the cell typed over that a step's value comes from."""
    book = read_workbook(render_workbook(study), formulas=True)
    sheet = book["Steps"]
    cell = sheet[f"E{find_steps(sheet)[place][symbol]}"]
    while isinstance(cell.value, str):
        name, column, line = LINK.search(cell.value.replace("_xlfn", "")).groups()
        sheet = book[name] if name else sheet
        cell = sheet[f"{column}{line}"]
    cell.value = value
    book.save(buffer := io.BytesIO())
    return buffer.getvalue()


def is_same_value(step, row, other, row_of_other):
    """Both are read from one cell."""
    keys = [(x.symbol, x.source, x.kind, x.value) for x in (step, other)]
    of_row = step.symbol in ("f_R", "Δl")  # of the row, by a rule of the profile
    return keys[0] == keys[1] and (row == row_of_other or not of_row)


def work_out(check, row, step, row_of_step, value, is_linked):
    """Utilisation and verdict of a check under the changed value.

    ``is_linked``: it was changed among the inputs, or in the profile.
    """
    changed = [
        replace(one, value=value, low=None, high=None)
        if is_same_value(one, row, step, row_of_step)
        else one
        for one in check.steps
    ]
    used = evaluate(changed)["μ"]
    told = check.resistance_derivation
    follows = next(
        (v for k, v in FOLLOWED.items() if told and told.key.startswith(k)), ()
    )
    is_used = changed != check.steps
    if (step.symbol in IN_FORCES and (is_used or is_linked)) or (
        step.symbol in follows and is_used
    ):
        return used.value, Verdict.NOT_PROVEN
    ends = [np.nan if x is None else x for x in check.utilisation_band]
    is_by_ratio = judge(*ends, least=0.0, most=1.0) is check.verdict
    ends = [np.nan if x is None else x for x in (used.low, used.high)]
    verdict = judge(*ends, least=0.0, most=1.0, is_complete=is_by_ratio)
    if check.is_unbounded:
        return used.value, check.verdict
    is_declared = check.declared is not None and verdict is not Verdict.FAIL
    return used.value, Verdict.DECLARED if is_declared else verdict


def compare_changes(count, folder):
    """Verdicts of changed workbooks, and whether they are those of before."""
    changes = list(draw_changes(count))
    books = {
        str(number): type_over(study, place, step.symbol, value)
        for number, (study, place, step, value) in enumerate(changes)
    }
    fresh = recalculate(books, folder)
    verdicts = set()
    for number, (study, place, step, value) in enumerate(changes):
        lines = read_rows(read_workbook(fresh[str(number)])["Checks"], "No.")
        row_of_step, _ = list_calculated(study)[place]
        is_linked = study is judge_drawn()  # to inputs and profile
        checks = [(row, c) for row, one in enumerate(study.rows) for c in one.checks]
        for line, (row, check) in zip(lines, checks, strict=True):
            if not check.steps:
                if is_linked and step.symbol in (*IN_FORCES, *WITHOUT_FORCE):
                    shown = line["Verdict"]
                    assert shown == ENGLISH("verdict.not_proven"), check.id
                continue
            used, verdict = work_out(check, row, step, row_of_step, value, is_linked)
            told = (number, check.id, step.symbol, step.value, value)
            none = "∞" if check.is_unbounded else "-"
            wanted = none if used is None else pytest.approx(used, rel=1e-9)
            assert line["μ"] == wanted, told
            assert line["Verdict"] == ENGLISH(f"verdict.{verdict}"), told
            verdicts.add((verdict, verdict is check.verdict))
    return verdicts


@pytest.mark.parametrize(
    "count",
    [
        pytest.param(10, marks=pytest.mark.long),
        pytest.param(50, marks=pytest.mark.slow),
    ],
)
def test_changed_values_give_the_verdicts_of_their_calculations(count, tmp_path):
    verdicts = compare_changes(count, tmp_path)
    assert {verdict for verdict, _ in verdicts} >= {Verdict.PASS, Verdict.FAIL}
    assert any(not is_same for _, is_same in verdicts)
