import json

import pytest

from netdesign.commands import check_run
from netdesign.solving import workers
from tests.make import write_rows

# Seven rows of an approved net, and one whose slack is searched, too.
SEARCH, BESIDE = 7 * 61 + 95, 8 * 2


@pytest.fixture
def _timed(monkeypatch):
    monkeypatch.setattr(check_run, "_measure_case", lambda *_: 0.5)


def announce(call, *options):
    ended = call("check", "--example", "--dry-run", "--json", *options)
    assert ended.code == 0
    return json.loads(ended.out)


@pytest.mark.usefixtures("_timed")
@pytest.mark.parametrize("jobs", [1, 3])
def test_the_time_is_that_of_one_case_times_the_solves_of_all_phases(call, jobs):
    """Each row keeps one process busy; reports are made by one."""
    plan = announce(call, "--jobs", jobs)
    assert (plan["net_rows"], plan["cases"]) == (8, SEARCH)
    assert plan["further_solves"] == BESIDE
    assert plan["predicted_s"] == pytest.approx(0.5 * (SEARCH + BESIDE) / jobs + 1.5)


@pytest.mark.usefixtures("_timed")
def test_profiles_share_their_solves(call):
    plan = announce(call, "--jobs", 1)
    cases = {one["phase"]: one["cases"] for one in plan["phases"]}
    assert cases == {"envelope": SEARCH, "checks": BESIDE, "reports": 0}
    two = announce(call, *("--standard", "eurocode", "--standard", "nf-p-95-304-style"))
    assert two["further_solves"] == BESIDE


@pytest.mark.usefixtures("_timed")
def test_a_search_is_told_as_about_so_many_cases(call):
    ended = call("check", "--example", "--dry-run", "--jobs", 1)
    assert (
        "8 net rows, about 522 cases and about 16 further solves, about 270 s"
    ) in ended.out
    assert "522 (up to 2120) largest forces" in ended.out
    assert "16 other creep laws" in ended.out


def test_a_case_is_solved_to_know_its_time(call, tmp_path):
    plan = announce(call, "--accuracy", "0.1")
    assert plan["predicted_s"] > 0
    assert list(tmp_path.iterdir()) == []


def test_a_fault_of_the_program_ends_a_dry_run_with_5(call, monkeypatch):
    def fail(*_):
        message = "spoilt"
        raise IndexError(message)

    monkeypatch.setattr(workers, "solve_scene", fail)
    ended = call("check", "--example", "--dry-run", "--json")
    assert ended.code == 5
    assert json.loads(ended.out)["net_rows"] == 8
    assert "internal error, please report it: IndexError: spoilt" in ended.err


@pytest.mark.parametrize("row", ["R4", pytest.param("R7", marks=pytest.mark.long)])
def test_no_more_is_solved_of_the_example_than_was_promised(
    call, tmp_path, monkeypatch, row
):
    """One that passes narrowly, and one that fails."""
    path, calls = tmp_path / "site.xlsx", []
    write_rows(path, [row], leans=True)
    quick = ("check", path, "--accuracy", "0.05", "--jobs", "1", "--json")
    plan = json.loads(call(*quick, "--dry-run").out)

    def solve(*args):
        calls.append(args)
        return solve_scene(*args)

    solve_scene = workers.solve_scene
    monkeypatch.setattr(workers, "solve_scene", solve)
    assert call(*quick, "--no-cache", "--quiet").code in (0, 1)
    assert 0 < len(calls) <= sum(one["cases_most"] for one in plan["phases"])
    assert len(calls) > plan["cases"] / 2
