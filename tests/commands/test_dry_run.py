import json

from netdesign.solving import workers
from tests.make import write_rows

# Seven rows of an approved net, and one whose slack is searched, too.
SEARCH = 7 * 61 + 95


def test_a_dry_run_counts_rows_and_cases_and_solves_nothing(
    call, tmp_path, monkeypatch
):
    solved = []
    monkeypatch.setattr(workers, "solve_scene", lambda *given: solved.append(given))
    ended = call("check", "--example", "--dry-run", "--json")
    assert ended.code == 0
    plan = json.loads(ended.out)
    assert (plan["net_rows"], plan["cases"]) == (8, SEARCH)
    told = call("check", "--example", "--dry-run")
    assert told.code == 0
    assert str(SEARCH) in told.out
    assert all(text in told.out for text in plan["questions"])
    assert solved == []
    assert list(tmp_path.iterdir()) == []


def test_about_as_much_is_solved_as_was_said(call, tmp_path, monkeypatch):
    """Of a row that passes narrowly."""
    path, calls = tmp_path / "site.xlsx", []
    write_rows(path, ["R4"], leans=True)
    quick = ("check", path, "--accuracy", "0.05", "--jobs", "1", "--json")
    plan = json.loads(call(*quick, "--dry-run").out)

    def solve(*args):
        calls.append(args)
        return solve_scene(*args)

    solve_scene = workers.solve_scene
    monkeypatch.setattr(workers, "solve_scene", solve)
    assert call(*quick, "--no-cache", "--quiet").code in (0, 1)
    assert plan["cases"] / 2 < len(calls) <= 5 * plan["cases"]
