"""Measurements on a terminal and on a page: digits, verdicts, what has no name."""

import pytest
from rich.console import Console

from netdesign.evidence.table import (
    FORCES,
    TEXTS,
    show_document,
    tabulate,
)
from netdesign.evidence.verification.case import VerificationCase
from netdesign.evidence.verification.pack import print_cases


def shown(show, *arguments):
    console = Console(width=120)
    with console.capture() as captured:
        show(*arguments, console)
    return [" ".join(line.split()) for line in captured.get().splitlines()]


def a_case(got):
    return VerificationCase(
        id="slab-shear",
        kind="closed form",
        reference="mirror",
        mark="here",
        expected=309.674,
        got=got,
        tolerance=1e-3,
    )


def test_cases_with_five_digits_and_their_verdict():
    lines = shown(print_cases, [a_case(309.681), a_case(320.0)])
    assert lines[1] == (
        "slab-shear closed form nodal forces mirror with the mesh "
        "309.67 309.68 2.3e-05 - pass"
    )
    assert lines[2].endswith("0.033 - FAIL")
    assert lines[3] == "closed form: 1 of 2 pass"


def test_what_has_no_name_is_not_shown():
    document = {
        "schema": "netdesign.stress/1",
        "median_s": 0.123456,
        "pass": False,
        "slowest": [{"scene": 7, "tables": {"slope": {}}}],
        "failures": [],
    }
    lines = shown(show_document, document)
    assert len(lines) == 5  # two numbers, a table of one row under its name
    assert lines[0].endswith("0.1235")
    assert lines[-1] == "7"


def test_a_page_has_few_digits_and_its_file_all():
    columns = [("verify_table.id", TEXTS), ("θ [°]", FORCES)]
    table = tabulate("c", columns, [("a", 123456.7), ("", None)])
    assert [column.heading for column in table.columns] == ["Case", "θ [°]"]
    full, empty = table.rows
    assert [cell.text for cell in full] == ["a", "123"]
    assert [cell.number for cell in full] == [None, pytest.approx(123.4567)]
    assert [cell.text for cell in empty] == ["-", "-"]
