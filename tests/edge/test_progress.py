"""Progress of a run: nothing is silent, nothing is promised too early."""

import re
from functools import lru_cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.edge.progress import Phase, RunProgress
from netdesign.solving import workers
from netdesign.solving.solve import solve_scene
from tests.make import write_tiny

solve_once = lru_cache(maxsize=None)(solve_scene)


COUNT = st.integers(0, 7)
WAVES = st.lists(st.tuples(st.integers(1, 9), st.integers(0, 3)), max_size=4)
PHASES = st.lists(st.tuples(COUNT, COUNT, WAVES), min_size=1, max_size=4)


def run_made_up(drawn, show):
    """Solve waves of cases in each phase, of which some stick and are not solved."""
    phases = [
        Phase(key=f"p{k}", words=f"phase {k}", cases=cases, pieces=pieces)
        for k, (cases, pieces, _) in enumerate(drawn)
    ]
    last = Phase(key="reports", words="reports", cases=0)
    progress = RunProgress([*phases, last], show)
    for phase, (_, pieces, waves) in zip(phases, drawn, strict=True):
        progress.enter(phase.key)
        for asked, lost in waves:
            progress.ask(range(asked))
            for _ in range(max(1, asked - lost)):
                progress.count_case()
        for _ in range(pieces):
            progress.count_piece()
    progress.enter("reports")


@given(drawn=PHASES)
def test_no_count_is_zero_before_the_last_solve_ends(drawn):
    """However wrong the expectations were, and whatever phase it is in."""
    shown = []
    run_made_up(drawn, shown.append)
    number = sum(max(1, a - lost) for *_, waves in drawn for a, lost in waves)
    before = [one for one in shown if one.phase != "reports"]
    assert all(one.open >= 1 for one in before)
    assert (shown[-1].done, shown[-1].open) == (number, 0)
    assert [one.done for one in shown] == sorted(one.done for one in shown)
    for one in before:
        assert "0 to go" not in re.findall(r"\b\d+ to go", str(one.line))


# --- the program ---------------------------------------------------------------------


@pytest.fixture
def solves(monkeypatch):
    """Settings of all cases that are solved."""
    seen = []

    def solve(scene, settings):
        seen.append(settings)
        return solve_once(scene, settings)

    monkeypatch.setattr(workers, "solve_scene", solve)
    return seen


QUICK = ("--accuracy", "0.1", "--jobs", "1", "--no-cache")


def test_a_quiet_run_says_nothing(call, tmp_path, solves):
    write_tiny(tmp_path / "site.xlsx")
    ended = call("check", "site.xlsx", *QUICK, "--json", "--quiet")
    assert (ended.code, ended.err) == (0, "")
    assert solves
