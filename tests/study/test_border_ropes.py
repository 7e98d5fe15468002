"""Border ropes of which nobody gives sag or sliding: they leave a check open, at most.

The net type of row A2 of the input workbook's example says neither.
"""

import pytest

from netdesign.checks import OpenKind, load_standard
from netdesign.coupling.scene import SolverSettings
from netdesign.outcome import Verdict
from netdesign.site.reader import read_site
from netdesign.site.template.office_workbook import load_input_example, render_input
from netdesign.structure.members import ROPE_OF
from netdesign.study.cases import search_site
from netdesign.study.judge import judge_row
from netdesign.study.row_to_check import CaseSolver, CheckRun

RUN = CheckRun(settings=SolverSettings(accuracy=0.03))
STANDARD = load_standard("swiss-guideline-2007")
OF_OPEN = (Verdict.NOT_PROVEN, Verdict.DECLARED)
OPEN = ("assumed.by_ropes", "assumed.by_sags")


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    path = tmp_path_factory.mktemp("ropes") / "site.xlsx"
    path.write_bytes(render_input(load_input_example()))
    return read_site(path).take_rows({"A2"})


@pytest.fixture(scope="module")
def checks(site):
    (row,), (solved,) = site.rows, search_site(site, RUN)
    solver = CaseSolver(RUN.settings, RUN.creep_law)
    return judge_row(site, row, solved, STANDARD, RUN, solver).checks


def list_reasons(check):
    return {one.message.key: one.message for one in check.open}


def test_no_part_fails_by_a_pull_of_assumed_sag_alone(checks):
    pulled = [one for one in checks if {"T_r", "T_b", "E_t"} & one.step_of.keys()]
    beyond = [one for one in pulled if (one.utilisation or 0.0) > 1.0]
    assert len(beyond) > 10
    for check in beyond:
        reasons = list_reasons(check)
        if check.member in ROPE_OF and not check.member.endswith("anchor"):
            assert "assumed.by_sags" in reasons
            assert check.verdict is Verdict.NOT_PROVEN
        elif "assumed.by_ropes" in reasons:
            told = reasons["assumed.by_ropes"].arguments
            assert 0.0 < told["without"] <= 1.0 < told["used"]
            assert check.verdict in OF_OPEN


def test_it_is_beyond_one_all_the_same_and_never_passes(checks):
    opened = [one for one in checks if set(OPEN) & list_reasons(one).keys()]
    assert len(opened) > 5
    for check in opened:
        assert check.has_open(OpenKind.ASSUMED_DECIDES)
        assert check.utilisation_band[1] > 1.0
        assert check.verdict is not Verdict.PASS
