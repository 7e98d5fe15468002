import json

import pytest

from netdesign.commands import dry_run


@pytest.mark.parametrize("jobs", [1, 3])
def test_the_time_is_that_of_one_case_times_their_number(call, monkeypatch, jobs):
    monkeypatch.setattr(dry_run, "_measure_case", lambda _site, _run: 0.5)
    ended = call("check", "--example", "--dry-run", "--json", "--jobs", jobs)
    plan = json.loads(ended.out)
    assert (ended.code, plan["net_rows"], plan["cases"]) == (0, 7, 7 * 55)
    assert plan["predicted_s"] == pytest.approx(0.5 * 7 * 55 / jobs)


def test_a_case_is_solved_to_know_its_time(call, tmp_path):
    ended = call("check", "--example", "--dry-run", "--json", "--accuracy", "0.1")
    assert json.loads(ended.out)["predicted_s"] > 0
    assert list(tmp_path.iterdir()) == []
