"""Rows of which no case of a search has a result, or those on one side alone."""

import math

import pytest

from netdesign.checks import load_standard
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import FailedSolution
from netdesign.outcome import Outcome, Verdict
from netdesign.report.page.html import render_html
from netdesign.solving.runner import Runner
from netdesign.solving.workers import OwnProcess, solve_job
from netdesign.study.cases import search_site
from netdesign.study.document import read_document, write_document
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun
from tests.make import load_rows, read_tables

RUN = CheckRun(settings=SolverSettings(accuracy=0.001))
LOST = Outcome.NO_EQUILIBRIUM
FAILED = FailedSolution(outcome=LOST, reason=LOST.message)


class Failing(OwnProcess):
    """Solver of the jobs that ``is_solved`` lets through."""

    def __init__(self, is_solved):
        self.is_solved = is_solved

    def solve(self, jobs):
        for place, job in enumerate(jobs):
            yield place, solve_job(job) if self.is_solved(job) else FAILED


def leans_least(job):
    return job.scene.net.inclination < math.radians(25.01)


def is_one_roughly(job):
    """One case of a search's first, until it is solved again."""
    is_rough = len(job.settings.levels) == 2
    is_dense = job.scene.snowpack.density > 399.0
    is_smooth = job.scene.net.friction_angle < math.radians(15.01)
    return is_rough and is_dense and is_smooth and leans_least(job)


SOLVED = {
    "none": lambda _: False,
    "one side": leans_least,
    "one roughly": is_one_roughly,
}


@pytest.fixture(scope="module")
def example():
    return read_tables(load_rows())


@pytest.mark.parametrize("solved", SOLVED)
def test_a_row_without_results_is_not_proven(example, solved):
    site = example.take_rows(["R1"])
    workers = Failing(SOLVED[solved])
    found = search_site(site, RUN, Runner(workers=workers))
    standard = load_standard("eurocode")
    study = judge_site(site, found, standard, RUN)
    (row,) = study.rows
    assert {one.outcome for one in row.cases} >= {LOST}
    assert any(one.verdict is Verdict.NOT_PROVEN for one in row.checks)
    of_forces = [one for one in row.checks if not one.id.startswith("geometry.")]
    assert {one.verdict for one in of_forces} <= {Verdict.NOT_PROVEN, Verdict.FAIL}
    again = read_document(write_document(study))
    assert len(render_html(again, "de")) > 1000
