"""Benchmarks on a terminal and as a drawing."""

import re
import xml.etree.ElementTree as ElementTree
from functools import partial

import pytest
from rich.console import Console

from netdesign.evidence.benchmark.bench_figure import draw_work_precision
from netdesign.evidence.benchmark.bench_table import (
    print_errors,
    print_lines,
    print_rows,
    print_stress,
)
from netdesign.evidence.benchmark.figure_table import print_figure
from netdesign.evidence.benchmark.honesty import Finding, write_errors
from netdesign.evidence.benchmark.rows import Row
from netdesign.evidence.benchmark.stress import Attempt, write_stress
from netdesign.report.words import Words
from netdesign.words.catalogue import load_texts
from netdesign.words.message import say
from tests.words.english import list_vocabulary, list_words

ROWS = [
    Row(
        scene=scene,
        method="steady",
        path=path,
        elements=elements,
        degrees_of_freedom=5 * elements,
        wall_s=seconds * elements / 100.0,
        error=error,
        stated_error=2.0 * error,
        linear_solves=20,
        rounds=5,
        peak_mb=1.5,
    )
    for scene in ("paper-30", "layered")
    for elements, error in ((100, 0.01), (200, 0.005), (400, 0.0025))
    for path, seconds in (("fast", 0.0125), ("reference", 0.1))
]


def printed(show, *arguments) -> str:
    console = Console(width=100, record=True, quiet=True)
    console.quiet = False
    with console.capture() as captured:
        show(*arguments, console)
    return captured.get()


def test_rows_on_a_terminal():
    text = printed(print_rows, ROWS)
    first = next(line for line in text.splitlines() if line.startswith("paper-30"))
    assert first.split() == [
        *("paper-30", "steady", "fast", "100", "12.5", "1.000", "2.000", "20", "1.5")
    ]
    assert "8.0 times faster than plain scikit-fem on the same mesh" in text
    assert "time grows as unknowns^1.00" in text
    assert "h^2.0" in text


def test_a_stress_test_on_a_terminal():
    attempts = [
        Attempt(number=0, kind="converged", cpu_s=0.5, balance=1e-10),
        Attempt(number=1, kind="failed", reason="[diverged] wholly"),
        Attempt(number=2, kind="refused before", reason="too low"),
    ]
    text = printed(print_stress, write_stress(attempts, 4))
    assert "3 scenes of seed 4: 1 converged, 1 failed" in text
    assert "refused before, 1: too low" in text
    assert "FAILED 1: [diverged] wholly" in text
    assert "median - s" in text


def test_honesty_on_a_terminal():
    findings = [
        Finding(
            number=0, true_error=0.001, stated_error=0.002, is_inside=True, cpu_s=1
        ),
        Finding(number=1, true_error=0.02, stated_error=0.01, cpu_s=1),
        Finding(number=2, missing="finer mesh: diverged"),
    ]
    text = printed(print_errors, write_errors(findings, 1, 0.005))
    assert "2 of 3 scenes compared" in text
    assert "inside the stated one: 33.3%; below the accuracy of 0.005: 33.3%" in text
    assert "outside: scene 1, true 2.00%, stated 1.00%" in text
    assert "not compared: scene 2, finer mesh: diverged" in text


def test_plot():
    svg = draw_work_precision(ROWS)
    root = ElementTree.fromstring(svg)
    words = [element.text for element in root.iter() if element.tag.endswith("text")]
    assert {"fast path", "scikit-fem, same meshes"} <= set(words)
    assert "run time [ms]" in words
    assert draw_work_precision(ROWS) == svg


def test_plot_of_histories():
    words = draw_work_precision([ROWS[0]])
    assert "transient" not in words


FINER = say("bench.finer_mesh", reason="...")
ATTEMPTS = [
    Attempt(number=0, kind="converged", cpu_s=0.5, balance=1e-10),
    Attempt(number=1, kind="failed", reason=say("bench.balance", residual=0.25)),
    Attempt(number=2, kind="refused before", reason=FINER),
    Attempt(number=3, kind="refused while solving", reason=say("bench.yes")),
]
FINDINGS = [
    Finding(number=1, true_error=0.0213, stated_error=0.01, cpu_s=1),
    Finding(number=2, missing=FINER),
]
FIGURE = {
    "what": say("bench.row_what"),
    "reach": say("bench.row_reach"),
    "reached": True,
    **dict.fromkeys(
        (
            key.partition(".")[2]
            for key in load_texts("en")
            if key.startswith("bench_value.")
        ),
        1.25,
    ),
    "first": {"wall_s": 2.5},
    "is_closed": False,
}


@pytest.mark.parametrize("language", ["fr", "de"])
def test_every_table_in_a_language(language):
    """No word of English, and no decimal point, besides names and what others said."""
    words = Words(language)
    documents = (
        (print_rows, ROWS),
        (print_stress, write_stress(ATTEMPTS, 4, 0.005, language)),
        (print_errors, write_errors(FINDINGS, 1, 0.005, language)),
        (print_lines, LINES),
    )
    told = [printed(partial(show, words=words), one) for show, one in documents]
    print_figure(FIGURE, told.append, words)
    told += ElementTree.fromstring(draw_work_precision(ROWS, words)).itertext()
    english = list_vocabulary("en") - list_vocabulary(language)
    text = re.sub(r"scikit-fem|paper-\d+|layered", "", "\n".join(told))
    assert list_words(text) & english == set()
    assert re.findall(r"\d\.\d", text) == []
    assert len(re.findall(r"\d,\d", text)) > 60


LINES = {
    "lines": 2,
    "points": 9,
    "solved": 17,
    "refused": 1,
    "jumps": 1,
    "bends": 0,
    "largest_jump": 1.25,
    "largest_true_over_stated": None,
    "share_outside": 0.0312,
    "compared": 4,
    "without_truth": 1,
    "of_lines": [
        {
            "number": 1,
            "parameter": "N",
            "jumps": [{"place": 3, "end": "T", "relative": 0.031, "over_stated": 1.25}],
            "missing": ["..."],
        }
    ],
}
