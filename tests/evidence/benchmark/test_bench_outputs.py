"""Benchmarks on a terminal and as a drawing."""

import re
import xml.etree.ElementTree as ElementTree

from rich.console import Console

from netdesign.evidence.benchmark.against import _describe
from netdesign.evidence.benchmark.attempts import Attempt, write_errors, write_stress
from netdesign.evidence.benchmark.precision import (
    Row,
    draw_work_precision,
    print_bench,
    write_bench,
)
from netdesign.evidence.table import show_document
from netdesign.words.catalogue import load_texts
from netdesign.words.message import say

AGAINST = dict.fromkeys(("this", "other", "core", "python", "processors")) | {
    "rows": [_describe("row", "wall", {"this": ["why"], "other": ["why"]})]
}
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
ASKED = [{"accuracy": 0.0037, "median_s": 0.0113, "p95_s": 0.071}]


def compared(number, **more) -> Attempt:
    """Attempt that was held against a finer mesh."""
    return Attempt(number=number, kind="converged", cpu_s=1, **more)


def printed(show, document) -> list[list[str]]:
    """Words of every line that a function shows of a document."""
    console = Console(width=200)
    with console.capture() as captured:
        show(document, console)
    return [re.split(r"  +", line.strip()) for line in captured.get().splitlines()]


def test_rows_on_a_terminal():
    lines = printed(print_bench, write_bench(ROWS, ASKED))
    first = next(line for line in lines if line[0] == "paper-30")
    assert first == [
        *("paper-30", "steady", "fast", "100", "500", "0.0125", "0.01", "0.02", "20"),
        *("5", "1.5"),
    ]
    assert len(first) == len(lines[0])
    assert ["0.0037", "0.0113", "0.071"] in lines
    assert ["times faster", "8"] in lines
    assert ["time grows as unknowns to the power of", "1"] in lines
    assert ["error falls as h to the power of", "2"] in lines


def test_a_stress_test_on_a_terminal():
    attempts = [
        Attempt(number=0, kind="converged", cpu_s=0.5, balance=1e-10),
        Attempt(number=1, kind="failed", reason="[diverged] wholly"),
        Attempt(number=2, kind="refused before", reason="too low"),
    ]
    lines = printed(show_document, write_stress(attempts, 4))
    for line in (
        ["scenes", "3"],
        ["seed", "4"],
        ["converged", "1"],
        ["promise", "FAIL"],
    ):
        assert line in lines
    assert ["too low", "before solving", "1"] in lines
    assert ["1", "[diverged] wholly"] in lines
    assert ["time, median [s]", "-"] in lines


def test_honesty_on_a_terminal():
    attempts = [
        compared(0, true_error=0.001, stated_error=0.002, is_inside=True),
        compared(1, true_error=0.02, stated_error=0.01),
        compared(2, reason="finer mesh: diverged"),
    ]
    lines = printed(show_document, write_errors(attempts, 1, 0.005))
    assert ["compared with a finer mesh", "2"] in lines
    assert ["share inside the stated error [-]", "0.3333"] in lines
    assert ["share below the accuracy [-]", "0.3333"] in lines
    assert ["1", "0.02", "0.01"] in lines  # outside
    assert ["2", "finer mesh: diverged"] in lines


# Of use to programs alone: what made a document, a scene's file.
FOR_PROGRAMS = {"schema", "tables"}


def list_keys(value):
    """Keys of a document and of all that is in it."""
    if isinstance(value, list):
        return set().union(*map(list_keys, value))
    if isinstance(value, dict):
        inner = {key: one for key, one in value.items() if key not in FOR_PROGRAMS}
        return set(inner).union(*map(list_keys, inner.values()))
    return set()


def test_every_key_of_a_document_has_a_name():
    """A key without one is not shown."""
    documents = [
        write_stress(ATTEMPTS, 4),
        write_errors(FINDINGS, 1, 0.005),
        *write_bench(ROWS, ASKED)["rows"],
        write_bench(ROWS, ASKED)["summary"],
        AGAINST,
    ]
    named = {key for key in load_texts("en") if key.startswith("bench_value.")}
    assert {f"bench_value.{key}" for key in list_keys(documents)} == named


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
    compared(1, true_error=0.0213, stated_error=0.01),
    compared(2, reason=FINER),
]
