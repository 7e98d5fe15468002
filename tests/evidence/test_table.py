"""Measurements on a terminal and on a page: digits, verdicts, what has no name."""

import pytest
from rich.console import Console

from netdesign.evidence.table import (
    FORCES,
    TEXTS,
    numbers,
    show_document,
    tabulate,
)
from netdesign.evidence.verification.case import VerificationCase
from netdesign.evidence.verification.pack import print_cases
from netdesign.report.words import Words


def shown(show, *arguments, language="en"):
    console = Console(width=120)
    with console.capture() as captured:
        show(*arguments, console, Words(language))
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


@pytest.mark.parametrize(("language", "mark"), [("en", "."), ("de", ",")])
def test_what_has_no_name_is_not_shown(language, mark):
    document = {
        "schema": "netdesign.stress/1",
        "median_s": 0.123456,
        "pass": False,
        "slowest": [{"scene": 7, "tables": {"slope": {}}}],
        "failures": [],
    }
    lines = shown(show_document, document, language=language)
    assert len(lines) == 5  # two numbers, a table of one row under its name
    assert lines[0].endswith(f"0{mark}1235")
    assert lines[-1] == "7"


def test_a_page_has_few_digits_and_its_file_all():
    columns = [
        ("verify_table.id", TEXTS),
        ("θ [°]", FORCES),
        ("kN", numbers(".1e")),
    ]
    table = tabulate(
        "c", columns, [("a", 123456.7, 0.04567), ("", None, None)], ENGLISH
    )
    assert [column.heading for column in table.columns] == ["Case", "θ [°]", "kN"]
    full, empty = table.rows
    assert [cell.text for cell in full] == ["a", "123", "4.6e-02"]
    assert [cell.number for cell in full] == [None, pytest.approx(123.4567), 0.04567]
    assert [cell.text for cell in empty] == ["-", "-", "-"]


ENGLISH = Words("en")
