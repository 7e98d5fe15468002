"""The first page: the decision, its matrix, what is to be done."""

import math
import re
from dataclasses import replace

import pytest

from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.page import render_html
from netdesign.report.sections.annexes import name_verification
from netdesign.report.words import VERDICTS
from netdesign.study.scopes import Scope
from tests.report.build_study import build_study
from tests.report.reading import PageReader
from tests.turn import turn

STUDY = build_study()
SYMBOLS = {signs.symbol: verdict for verdict, signs in VERDICTS.items()}


def read_matrix(study):
    """Cells of the matrix by net row."""
    (table, *_) = PageReader(render_html(study)).tables["decision"]
    return dict(zip([row.id for row in study.rows], table[1:], strict=True))


def test_the_matrix_shows_the_worst_verdict_and_the_largest_utilisation():
    matrix = read_matrix(STUDY)
    for row in STUDY.rows:
        name, *cells, siting, governing = matrix[row.id]
        assert SYMBOLS[name[0]] is row.verdict
        shown = {SYMBOLS[cell[0]] for cell in (*cells, siting) if cell != "-"}
        assert min(shown, key=SEVERITY.index) is row.verdict
        assert SYMBOLS[siting[0]] is row.scopes[Scope.SITING].verdict
        assert SYMBOLS[cells[-1][0]] is row.scopes[Scope.STRUCTURE].verdict
        known = [x.used for x in row.checks if x.used is not None and x.is_of_force]
        forces = [x for x in row.checks if x.is_of_force]
        numbers = re.findall(r"\d+\.\d+", " ".join(x for x in cells if "kN" not in x))
        largest = max(map(float, numbers))
        assert largest <= max(known) + 0.006
        if len(known) == len(forces):
            assert largest == pytest.approx(max(known), abs=0.006)
        assert governing


def test_a_row_that_nothing_resists_shows_it():
    row = STUDY.rows[0]
    check = next(one for one in row.checks if one.is_of_force)
    endless = turn(check, Verdict.FAIL, utilisation=math.inf, reason="nothing is left")
    study = replace(STUDY, rows=[replace(row, checks=[endless])])
    assert "∞" in " ".join(read_matrix(study)[row.id])


def test_the_built_in_example_is_verified_without_a_site_file():
    run = replace(STUDY.provenance, site_file="example.xlsx")
    command = name_verification(replace(STUDY, provenance=run))
    assert command == "netdesign verify --study study.json"
