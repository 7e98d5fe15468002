"""Two versions in turns: their runs, what a failure becomes, ratios, what is asked."""

import itertools
import sys
from pathlib import Path

import pytest

from netdesign.evidence.benchmark import against
from netdesign.evidence.benchmark.against import (
    RunFailure,
    Size,
    Timed,
    compare_versions,
    count_runs,
    print_versions,
)
from netdesign.evidence.runner import Time
from netdesign.report.words import Words
from tests.words.english import list_vocabulary, list_words

THIS, OTHER = Path(sys.executable), Path("other-python")
SIZE = Size(short=3, long=2, scenes=("paper-0",))


@pytest.fixture
def timed(monkeypatch):
    """Order of the runs; the other takes 3, 5, 4 s by the processor, this one 2 s."""
    order, others = [], itertools.cycle((3.0, 5.0, 4.0))

    def measure(bench, python):
        order.append((python, bench.has_core))
        taken = 2.0 if python == THIS else next(others)
        return [Time(cpu_s=taken, wall_s=2.0 * taken)]

    def fail(_, python):
        if python == OTHER:
            raise RunFailure("of its own")
        return [Time(cpu_s=0.02, wall_s=0.03)]

    timings = (
        Timed(measure, (("row", "cpu_s", 1.5),)),
        Timed(fail, (("solve", "cpu_s", 0.4),), is_long=True),
    )
    monkeypatch.setattr(against, "TIMED", timings)
    monkeypatch.setattr(against, "read_version", lambda python: f"of {python.name}")
    return order


def test_versions_take_turns_and_the_other_begins_every_second_repeat(timed):
    done = []
    compare_versions(OTHER, SIZE, done.append)
    with_core = [THIS, OTHER, OTHER, THIS, THIS, OTHER]
    assert [python for python, _ in timed] == 2 * with_core
    assert [has_core for _, has_core in timed] == [True] * 6 + [False] * 6
    assert len(done) == count_runs(SIZE) == 2 * 2 * (3 + 2)


def test_medians_and_their_ratio(timed):
    row, _, slow, _ = compare_versions(OTHER, SIZE)["rows"]
    assert row["this"]["cpu_s"] == {"median": 2.0, "least": 2.0, "most": 2.0}
    assert row["other"]["cpu_s"] == {"median": 4.0, "least": 3.0, "most": 5.0}
    assert row["times_faster"] == {"cpu_s": 2.0, "wall_s": 2.0}
    assert not row["reached"]  # 2 s where 1.5 s are asked
    assert slow["reached"]  # without the core it is not slower


def test_a_failure_of_the_other_is_told_and_not_raised(timed):
    document = compare_versions(OTHER, SIZE)
    _, failed, _, without = document["rows"]
    assert failed["other"] == {"failure": "of its own", "cpu_s": None, "wall_s": None}
    assert failed["this"]["cpu_s"]["median"] == 0.02
    assert failed["times_faster"] == {"cpu_s": None, "wall_s": None}
    assert failed["reached"]  # what is asked of this version alone
    assert not without["reached"]  # nobody knows whether it is slower
    assert not document["pass"]


@pytest.mark.parametrize(("language", "mark"), [("en", "."), ("fr", ","), ("de", ",")])
def test_table(timed, capsys, language, mark):
    from rich.console import Console

    print_versions(compare_versions(OTHER, SIZE), Console(width=200), Words(language))
    lines = capsys.readouterr().out.splitlines()
    assert f"0{mark}02" not in "".join(lines)
    assert any("20 (20 " in line for line in lines)  # ms
    asked, other_clock = (line for line in lines if "2 (2 " in line and "4 (3 " in line)
    assert f"1{mark}5" in asked  # 1.5 s of the processor, none of the wall
    assert f"1{mark}5" not in other_clock
    assert sum("of its own" in line for line in lines) == 4  # two clocks, two cores
    if language != "en":
        english = list_vocabulary("en") - list_vocabulary(language)
        told = "\n".join(lines).replace("of its own", "").replace(" of ", "")
        assert list_words(told) & english <= {"numpy", "other", "python"}


def test_a_failure_of_this_version_fails(timed, monkeypatch):
    def fail(*_):
        raise RunFailure("both")

    timings = (Timed(fail, (("grid", "wall_s", 9.0),)),)
    monkeypatch.setattr(against, "TIMED", timings)
    document = compare_versions(OTHER, SIZE)
    assert [row["reached"] for row in document["rows"]] == [False, False]
    assert not document["pass"]
