"""Judged rows from the store: exactly what a new run would make, or made anew."""

import math
import random
import sqlite3
from contextlib import closing
from dataclasses import dataclass, replace

import pytest

from netdesign.checks import load_standard
from netdesign.outcome import Fault, Outcome, SiteDataError
from netdesign.site.reader import read_site
from netdesign.solving.runner import Counts, Runner
from netdesign.solving.store import CaseStore
from netdesign.study import check_site as use_case
from netdesign.study.cases import search_site
from netdesign.study.check_site import check_site, name_rows
from netdesign.study.document import write_document
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CaseSolver
from tests.make import find_cell, load_rows, write_rows
from tests.small_site import RANGES, ROWS, RUN, WEAK, build_row, build_site, resist

STANDARDS = [load_standard(name) for name in ("nf-p-95-304-style", "eurocode")]
DRAWS = 24
# Cells that no echo of a row names: types, a declaration, the project.
BESIDE = [
    find_cell(table, key, line, tables=load_rows())
    for table, key, line in (
        *(("anchor_types", "tendon", 0), ("anchor_types", "pull_out", 0)),
        *(("anchor_types", "pull_out", 1), ("ropes", "rope", 0), ("ropes", "rope", 2)),
        *(("posts", "area", 0), ("declared", "author", 0)),
        *(("project", "name", 0), ("project", "number", 0)),
    )
]


@pytest.fixture
def told():
    return []


@pytest.fixture
def store(tmp_path, told):
    with CaseStore(tmp_path / "cases.sqlite", told.append) as one:
        yield one


@pytest.fixture
def judged(monkeypatch):
    """Ids of the rows that are judged, as they come."""
    ids, real = [], use_case._judge_row

    def judge(job, row, *rest):
        ids.append(row.id)
        return real(job, row, *rest)

    monkeypatch.setattr(use_case, "_judge_row", judge)
    return ids


@pytest.fixture
def quick_names(monkeypatch):
    monkeypatch.setattr(use_case, "identify_program", lambda: "here")


def check(site, store, standards=STANDARDS[:1], **changes):
    return check_site(site, standards, replace(RUN, **changes), Runner(store=store))


def write(studies):
    return [write_document(one) for one in studies]


def list_cells(site):
    """Cells of a site that can be changed, each with its text."""
    echoes = [echo for row in site.rows for echo in row.inputs] + list(
        site.range_inputs
    )
    found = {echo.cell: echo.text for echo in echoes if "!" in echo.cell}
    return found | dict.fromkeys(BESIDE, "")


def change_text(text, drawn):
    try:
        return f"{float(text) * drawn.uniform(0.97, 1.03):.4g}"
    except ValueError:
        return drawn.choice([f"{drawn.uniform(250, 420):.1f}", "Combe", "A40-tested"])


@pytest.mark.long
def test_a_changed_cell_gives_what_a_run_without_known_rows_gives(
    tmp_path, store, judged, monkeypatch
):
    """Cells of all sheets of three example rows, each changed alone, through one store.

    The run beside it knows cases, but no rows.
    """
    path = tmp_path / "site.xlsx"
    write_rows(path, ["R2", "R5", "R7"])
    site = read_site(path)
    check(site, store)
    assert judged == ["R2", "R5", "R7"]
    drawn, compared = random.Random(3601), 0
    cells = sorted(list_cells(site).items())
    for cell, text in drawn.sample(cells, DRAWS) + [(one, "") for one in BESIDE]:
        try:
            other = read_site(path, instead={cell: change_text(text, drawn)})
        except SiteDataError:
            continue  # the workbook refuses it
        judged.clear()
        warm = check(other, store)
        count = len(judged)
        with monkeypatch.context() as patch:
            patch.setattr(use_case, "name_rows", lambda *_: {})
            cold = check(other, store)
        assert len(judged) == count + 3
        assert warm == cold, cell
        assert write(warm) == write(cold), cell
        compared += count < 3
    assert compared >= 4  # else nothing of it was tried
    judged.clear()
    assert write(check(site, store)) == write(check(site, None))
    assert judged == ["R2", "R5", "R7"]  # of the run without a store alone


def test_only_the_row_that_changed_is_judged_again(store, judged):
    rows = (*ROWS, build_row("R3", upslope_length=5.1))
    first = check(build_site(*rows), store)
    changed = replace(rows[1], resistances=resist(WEAK))
    judged.clear()
    (second,) = check(build_site(rows[0], changed, rows[2]), store)
    assert judged == ["R2"]
    assert [second.rows[k] for k in (0, 2)] == [first[0].rows[k] for k in (0, 2)]
    assert second.rows[1] != first[0].rows[1]
    judged.clear()
    assert write(check(build_site(rows[2], rows[0]), store))  # in another order
    assert judged == []


def test_a_known_row_asks_for_no_case(store):
    site = build_site(*ROWS)
    check(site, store, STANDARDS)
    runner = Runner(store=store)
    again = check_site(site, STANDARDS, RUN, runner)
    assert runner.counts == Counts()
    assert write(again) == write(check_site(site, STANDARDS, RUN))


def test_a_row_is_judged_on_its_part_of_the_site_alone():
    """The whole site brings the same study."""
    site = build_site(*ROWS, notes=())
    whole = judge_site(
        site, search_site(site, RUN), STANDARDS[0], RUN,
        CaseSolver(RUN.settings, RUN.creep_law),
    )  # fmt: skip
    assert check_site(site, STANDARDS[:1], RUN) == [whole]


@dataclass(frozen=True, kw_only=True)
class Scatter:
    """What an add-on reads of its sheet."""

    row_id: str
    name: str
    variation: float
    period: float | None = None


def test_whatever_decides_a_row_is_in_its_name(tmp_path, quick_names):
    """Its own values, those of the site that bear on it, profiles and settings."""
    write_rows(tmp_path / "site.xlsx", ["R5"])
    site = replace(read_site(tmp_path / "site.xlsx"), confirmed=())
    (row,), (profile, other) = site.rows, STANDARDS
    scatter = Scatter(row_id="R5", name="model", variation=0.11)
    again = replace(scatter, variation=math.nextafter(0.11, 1.0))
    weaker = replace(profile.values[0], value=0.99 * profile.values[0].value)
    altered = replace(profile, values=(weaker,))
    sites = [
        site,
        *(replace(site, rows=(replace(row, **one),)) for one in (
            {"slack": math.nextafter(row.slack, 1.0)}, {"gap": 0.37},
            {"resistances": row.resistances[1:]}, {"row_end": None}, {"panels": ()},
        )),
        replace(site, catalogue=site.catalogue[1:]),
        replace(site, links={}),
        replace(site, confirmed=("Parts!H24",)),
        replace(site, ranges=site.ranges.replaced_by(RANGES)),
        *(replace(site, of_addons={"Uncertainty": (x,)}) for x in (scatter, again)),
    ]  # fmt: skip
    profiles = (
        [profile],
        [other, profile],
        [altered, other],
    )
    runs = (
        {"settings": replace(RUN.settings, accuracy=0.02)},
        {"creep_law": replace(RUN.creep_law, source="x")},
        {"has_reliability": True},
    )
    cases = [(one, STANDARDS, RUN) for one in sites]
    cases += [(site, one, RUN) for one in profiles]
    cases += [(site, STANDARDS, replace(RUN, **one)) for one in runs]
    assert len({name_rows(*one)["R5"] for one in cases}) == len(cases)


def test_time_is_no_part_of_a_name(quick_names):
    site = build_site(*ROWS)
    other = replace(RUN, started="")
    again = replace(site, notes=(), file_name="y", sha256="1" * 64)
    assert name_rows(again, STANDARDS, other) == name_rows(site, STANDARDS, RUN)


def test_a_row_with_a_value_of_no_known_kind_is_judged_every_time():
    site = build_site(replace(ROWS[0], questions=(object(),)))
    assert name_rows(site, STANDARDS, RUN) == {}


def test_another_code_is_not_answered_by_this_one(store, judged, monkeypatch):
    site = build_site(*ROWS)
    check(site, store)
    monkeypatch.setattr(use_case, "identify_program", lambda: "9.9+feed")
    check(site, store)
    assert judged == ["R1", "R2"] * 2


def test_a_damaged_record_is_told_and_the_row_is_judged_again(store, judged, told):
    site = build_site(*ROWS)
    first = check(site, store)
    with closing(sqlite3.connect(store.path)) as base:
        base.execute("UPDATE rows SET packed = substr(packed, 1, 99) WHERE number = 1")
        base.commit()
    judged.clear()
    assert check(site, store) == first
    assert judged == ["R1"]
    assert [one.key for one in told] == ["store.row_damaged"]
    assert check(site, store) == first
    assert judged == ["R1"]


@pytest.mark.parametrize("kind", ["fault", "lost"])
def test_a_row_that_another_run_cannot_rely_on_is_not_kept(store, judged, kind):
    runner = Runner(store=store)
    if kind == "fault":
        runner.keep_fault(Fault(kind="ValueError", message="x", place="y"), "R1")
    runner.counts.lost = int(kind == "lost")
    site = build_site(*ROWS[:1])
    check_site(site, STANDARDS[:1], RUN, runner)
    check(site, store)
    assert judged == ["R1", "R1"]


@pytest.mark.parametrize("lost", [Outcome.WORKER_FAILED, Outcome.PROGRAM_FAULT])
def test_the_runner_counts_what_was_lost(lost):
    from netdesign.coupling.solution import FailedSolution
    from netdesign.words.message import say

    runner = Runner()
    for outcome in (lost, Outcome.NO_EQUILIBRIUM):
        failed = FailedSolution(outcome=outcome, reason=say("worker.died"))
        runner._note("a", failed)
    assert (runner.counts.solved, runner.counts.lost) == (2, 1)
