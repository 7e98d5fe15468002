import json

from netdesign.solving import workers

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
