"""Formulas as text: written, read again, refused; in a spreadsheet."""

import io
from random import Random

import openpyxl
import pytest
from hypothesis import given as draws
from hypothesis import settings
from hypothesis import strategies as st

from netdesign.calculation.quantity import at_value, cos, largest, leaf
from netdesign.calculation.steps import (
    PRINTED,
    SPREADSHEET,
    list_named,
    require_formula,
    translate,
    write_formula,
)
from netdesign.outcome import ContentError
from tests.calculation.drawn import draw_calculation, find_size
from tests.calculation.evaluate import read_formula
from tests.each import each
from tests.report.reading import recalculate

SEEDS = st.integers(0, 2**40)
KNOWN = {"a": leaf("a", 2.0, "kN", ""), "b": leaf("b", 3.0, "-", "")}


@draws(SEEDS)
@settings(max_examples=150)
def test_a_formula_that_is_read_again_gives_the_same(seed):
    named = list_named(draw_calculation(Random(seed)))
    known = {one.symbol: one for one in named}
    for one in named:
        text = write_formula(one)
        assert bool(text) is bool(one.operation)
        if text:
            again = read_formula(text, known)
            size = 1e-12 * find_size(one)
            ends = (one.low, one.value, one.high)
            assert (again.low, again.value, again.high) == pytest.approx(
                ends, rel=1e-12, abs=size
            )
            assert again.dimension == one.dimension


REFUSED = [
    *("", " ", "a +", "a b", "a = b", "a; b", "(a", "x", "a + x", "a\0"),
    *("a.value", "a.__class__", "().__class__.__bases__", "a[0]", "f'{a}'"),
    *("__import__('os')", "open('x')", "print(a)", "eval('1')", "exit()"),
    *("[a for a in a]", "(x for x in b)", "{a: b}", "lambda: a", "a if b else a"),
    *("a ** b", "9 ** 9 ** 9", "a // b", "a % b", "a @ b", "b << 99999", "-a", "+a"),
    *("a < b", "a and b", "not a", "a, b", "*a", "a := b", "'a'", "b'a'", "...", "1j"),
    *("True", "None", "True + b", "max()", "max(*a)", "max(a, key=b)", "sin(b, b)"),
    *("sqrt()", "sqrt(a, a)", "at_value(a, a)", "max(a)(a)", "max.x(a)", "cos"),
    *("9" * 400, "1" + "0" * 400 + " * a", "a" * 501, "a + " * 200 + "a"),
    *("(" * 240 + "a" + ")" * 240, "max(" * 90 + "a"),
    *("1e999", "b * 1e999"),
    *("\ud800", "a\n+b", "0x", "1_", "await a", "yield"),
]


@each("text", REFUSED)
def test_what_is_no_formula_of_known_quantities_is_refused(text):
    with pytest.raises(ContentError):
        require_formula(text, KNOWN)


NEARLY = st.text("ab019.+-*/(),e_ \tmaxsqrtμ[]{}:='\"\\\n", max_size=60)


@draws(NEARLY | st.text(max_size=40))
@settings(max_examples=400)
def test_any_text_is_a_formula_or_refused(text):
    try:
        require_formula(text, KNOWN)
    except ContentError:
        return
    assert translate(text, PRINTED)


@pytest.mark.parametrize("call", ["max", "min"])
def test_one_alone_is_the_largest_of_itself(call):
    assert read_formula(f"{call}(a)", KNOWN).value == 2.0


def test_a_formula_as_it_is_printed():
    a, b = KNOWN["a"], KNOWN["b"]
    angle = leaf("β", 30.0, "deg", "")
    made = largest(a * (b + 0.5) / 2 - a, at_value(a + a) * b, a * cos(angle))
    text = translate(write_formula(made), PRINTED)
    assert text == "max(a · (b + 0.5) / 2 − a; (a + a) · b; a · cos(β))"


def list_known(count):
    random = Random(2026)
    while count:
        made = draw_calculation(random)
        if made.is_known:
            count -= 1
            yield made


def test_a_spreadsheet_works_out_the_same(tmp_path):
    """Low end, value and high end of each quantity of many calculations."""
    workbook = openpyxl.Workbook()
    sheet, expected = workbook.active, []
    for made in list_known(150):
        rows = {}
        for one in list_named(made):
            rows[one.symbol] = len(expected) + 1
            ends = (one.low, one.value, one.high)
            expected.append(ends)
            sheet.append([one.symbol, *write_cells(one, ends, rows)])
    buffer = io.BytesIO()
    workbook.save(buffer)
    filled = recalculate({"drawn": buffer.getvalue()}, tmp_path)["drawn"]
    again = openpyxl.load_workbook(io.BytesIO(filled), data_only=True).active
    found = [row[1:] for row in again.iter_rows(values_only=True)]
    assert len(found) == len(expected) > 400
    for cells, ends in zip(found, expected, strict=True):
        assert cells == pytest.approx(ends, rel=1e-9, abs=1e-9)


def write_cells(one, ends, rows):
    if not one.operation:
        return ends
    return [
        "="
        + translate(
            write_formula(one),
            SPREADSHEET,
            lambda symbol, to: f"{'CDB'[to]}{rows[symbol]}",
            end,
        )
        for end in (-1, 0, 1)
    ]
