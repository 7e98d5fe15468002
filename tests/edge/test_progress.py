"""Progress of a run: nothing is silent, nothing is promised too early."""

import math
import os
import re
import subprocess
import sys
from functools import lru_cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.edge import progress as progress_module
from netdesign.edge.progress import Phase, RunProgress, Wave, show_phases
from netdesign.solving import workers
from netdesign.solving.solve import solve_scene
from tests.short_example import write_short_example

solve_once = lru_cache(maxsize=None)(solve_scene)


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


COUNT = st.integers(0, 7)
WAVES = st.lists(st.tuples(st.integers(1, 9), st.integers(0, 3)), max_size=4)
PHASES = st.lists(
    st.tuples(COUNT, st.floats(0.2, 150.0), COUNT, WAVES), min_size=1, max_size=4
)


def run_made_up(drawn, clock, show):
    """Solve waves of cases in each phase, of which some stick and are not solved."""
    phases = [
        Phase(key=f"p{k}", words=f"phase {k}", cases=cases, cost=cost, pieces=pieces)
        for k, (cases, cost, pieces, _) in enumerate(drawn)
    ]
    last = Phase(key="reports", words="reports", cases=0, seconds=2.0)
    progress = RunProgress([*phases, last], show, clock)
    for phase, (_, cost, pieces, waves) in zip(phases, drawn, strict=True):
        progress.enter(phase.key)
        for asked, lost in waves:
            progress.ask(asked)
            for _ in range(max(1, asked - lost)):
                clock.now += 0.37 * cost
                progress.count_case()
            if not pieces:
                progress.report_wave(Wave(rows_open=1, cases_waiting=0, gap=0.5))
        for _ in range(pieces):
            progress.count_piece()
    progress.enter("reports")


@given(drawn=PHASES)
def test_no_count_is_zero_before_the_last_solve_ends(drawn):
    """However wrong the expectations were, and whatever phase it is in."""
    shown, clock = [], Clock()
    run_made_up(drawn, clock, shown.append)
    number = sum(max(1, a - lost) for *_, waves in drawn for a, lost in waves)
    before = [one for one in shown if one.stage != "reports"]
    assert all(one.open >= 1 for one in before)
    assert (shown[-1].done, shown[-1].open) == (number, 0)
    assert [one.done for one in shown] == sorted(one.done for one in shown)
    for one in before:
        assert one.seconds is None or (math.isfinite(one.seconds) and one.seconds > 0)
        assert "0 to go" not in re.findall(r"\b\d+ to go", str(one.line))


@given(cases=st.integers(3, 60), later=st.integers(1, 60), cost=st.floats(0.5, 150.0))
def test_the_time_left_counts_the_phases_to_come(cases, later, cost):
    """With cases as expected, it is what then passes."""
    shown, clock = [], Clock()
    phases = [
        Phase(key="a", words="first", cases=cases, cost=0.5),
        Phase(key="b", words="second", cases=later, cost=cost),
        Phase(key="c", words="reports", cases=0, seconds=4.0),
    ]
    progress = RunProgress(phases, shown.append, clock)
    left = []
    for phase, number in (("a", cases), ("b", later)):
        progress.enter(phase)
        progress.ask(number)
        for _ in range(number):
            clock.now += 0.8 * (0.5 if phase == "a" else cost)
            progress.count_case()
            left.append((shown[-1].seconds, clock.now))
    end = clock.now + 4.0
    known = [(seconds, now) for seconds, now in left if seconds is not None]
    assert len(known) >= len(left) - 2
    assert all(now + seconds == pytest.approx(end) for seconds, now in known)


def test_there_is_no_way_back_to_an_earlier_phase():
    shown = []
    phases = [Phase(key=key, words=key, cases=5) for key in "abc"]
    progress = RunProgress(phases, shown.append)
    for key in ("c", "a", "b", "c", "nowhere"):
        progress.enter(key)
    assert [one.stage for one in shown] == ["c"]


def test_a_wave_gives_gap_and_rows_and_corrects_the_count():
    shown = []
    phases = [
        Phase(key="a", words="search", cases=110),
        Phase(key="b", words="", cases=40),
    ]
    progress = RunProgress(phases, shown.append, Clock())
    progress.report_wave(Wave(rows_open=2, cases_waiting=9, gap=math.inf))
    assert "no bound yet, 2 rows open" in str(shown[-1].line)
    progress.report_wave(Wave(rows_open=1, cases_waiting=3, gap=0.0234))
    assert (
        str(shown[-1].line) == "search: 0 solved, about 49 to go; gap 2.3 %, 1 row open"
    )
    progress.report_wave(Wave(rows_open=0, cases_waiting=0, gap=0.0))
    assert str(shown[-1].line) == "search: 0 solved, about 40 to go"


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
LINE = re.compile(r"(.+?): (\d+) solved(?:, about (\d+) to go)?(?:; .*)?")


def read_lines(text):
    """Phase, solves done and solves to go of every line."""
    lines = [LINE.fullmatch(line) for line in text.splitlines() if "wrote" not in line]
    assert all(lines), text
    return [(one[1], int(one[2]), int(one[3] or 0)) for one in lines]


@pytest.mark.long
@pytest.mark.parametrize("is_grid", [True, False], ids=["grid", "search"])
def test_every_solve_of_a_check_is_counted_in_its_phase(
    call, tmp_path, monkeypatch, solves, is_grid
):
    write_short_example(tmp_path / "site.xlsx", ["R1", "R7"], is_grid=is_grid)
    monkeypatch.setattr(progress_module, "_SILENCE_S", 0.0)  # a line for each case
    ended = call("check", "site.xlsx", *QUICK, "--json")
    lines = read_lines(ended.err)
    phases = list(dict.fromkeys(phase for phase, _, _ in lines))
    expected = [
        "cases of the grid" if is_grid else "largest forces and their confirmation",
        "other creep laws",
        "reports",
    ]
    assert phases == expected
    assert [number for _, number, _ in lines][-1] == len(solves)
    assert {number for _, number, _ in lines} == set(range(len(solves) + 1))
    for phase, _, left in lines:
        assert (left == 0) == (phase == "reports")
    for what in expected[1:-1]:
        numbers = {number for phase, number, _ in lines if phase == what}
        assert max(numbers) > min(numbers)


def test_a_quiet_run_says_nothing(call, tmp_path, solves):
    write_short_example(tmp_path / "site.xlsx", ["R7"])
    ended = call("check", "site.xlsx", *QUICK, "--json", "--quiet")
    assert (ended.code, ended.err) == (1, "")
    assert solves


def test_plain_lines_are_few(call, tmp_path, solves):
    write_short_example(tmp_path / "site.xlsx", ["R1", "R7"])
    ended = call("check", "site.xlsx", *QUICK, "--json")
    assert len(read_lines(ended.err)) < len(solves) / 4


def test_what_is_known_already_is_counted_too(call, tmp_path, monkeypatch):
    monkeypatch.setenv("NETDESIGN_STORE", str(tmp_path / "cases.sqlite"))
    write_short_example(tmp_path / "site.xlsx", ["R7"])
    options = ("check", "site.xlsx", "--accuracy", "0.1", "--jobs", "1", "--json")
    first = read_lines(call(*options).err)
    assert first[-1] == ("reports", first[-1][1], 0)
    again = read_lines(call(*options, "--explain").err)
    assert again == []  # the net row is known: nothing is solved


@pytest.mark.skipif(sys.platform == "win32", reason="a pseudo-terminal")
def test_a_terminal_shows_one_line_that_ends(tmp_path):
    """As a user sees it: the phases one after the other, and nothing left of them."""
    write_short_example(tmp_path / "site.xlsx", ["R1", "R7"])
    ours, theirs = os.openpty()
    program = "from netdesign.cli import main; main()"
    command = [sys.executable, "-c", program, "check", "site.xlsx", "--json", *QUICK]
    with subprocess.Popen(
        command,
        cwd=tmp_path,
        stdout=subprocess.DEVNULL,
        stderr=theirs,
        env=os.environ | {"TERM": "xterm", "COLUMNS": "80"},
    ) as process:
        os.close(theirs)
        shown = read_all(ours)
    assert process.returncode == 1
    text = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", shown)
    places = [text.index(words) for words in ("cases of the", "other", "reports")]
    assert places == sorted(places)
    lines = re.split(r"[\r\n]+", text)
    assert all(len(line) <= 80 for line in lines)
    assert any(re.search(r"\d+ to go; about \d+ s left", line) for line in lines)
    assert "0 to go" not in re.findall(r"\b\d+ to go", text)
    assert shown.endswith("\x1b[2K")  # the line is gone


def read_all(handle):
    parts = []
    try:
        while part := os.read(handle, 65536):
            parts.append(part)
    except OSError:  # how Linux tells the end of a terminal
        pass
    os.close(handle)
    return b"".join(parts).decode()


def test_nothing_is_shown_quietly(capsys):
    with show_phases(
        [Phase(key="a", words="a", cases=3)], quiet=True, language="en"
    ) as progress:
        progress.count_case()
    assert capsys.readouterr() == ("", "")
