import math
import re
from dataclasses import replace
from operator import ge, le, lt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.outcome import EXIT_CODES, SolveError, Verdict
from netdesign.quantities import QUANTITIES
from netdesign.report import words
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.study.record_provenance import name_law
from netdesign.words.catalogue import LANGUAGES
from tests.each import each


def test_every_verdict_has_its_own_word_and_sign():
    assert set(words.VERDICTS) == set(Verdict)
    for language in LANGUAGES:
        told = words.Words(language)
        shown = [words.show_verdict(verdict, told) for verdict in Verdict]
        for read in ("word", "symbol", "style", "meaning"):
            assert len({getattr(one, read) for one in shown}) == len(Verdict)


def test_exit_codes_are_those_of_the_interface():
    assert {
        Verdict.PASS: 0, Verdict.FAIL: 1, Verdict.NOT_PROVEN: 4, Verdict.DECLARED: 6
    } == EXIT_CODES  # fmt: skip
    assert EXIT_CODES[Verdict.NOT_PROVEN] == SolveError.exit_code


@pytest.mark.parametrize("value", [None, math.nan, math.inf])
def test_a_missing_number_is_never_zero_or_empty(value):
    assert words.ENGLISH.show_number("demand_kN", value) == "-"
    assert words.ENGLISH.show_with_unit("demand_kN", value) == "-"


def test_text_loses_control_characters_and_line_breaks():
    assert words.show_text("a\x1b[31m\nb\x00") == "a [31m b"
    assert words.show_text(" \n ") == "-"


def apply_format(code, value):
    """Positive number as a spreadsheet shows it by a format with conditions."""
    for section in code.split(";"):
        condition, places = re.fullmatch(r"(?:\[(.*)\])?([0.]+)", section).groups()
        sign, end = re.fullmatch(r"(\D+)([\d.]+)", condition or ">=0").groups()
        if {">=": ge, "<=": le, "<": lt}[sign](value, float(end)):
            return f"{value:.{len(places.partition('.')[2])}f}"
    raise AssertionError(code)


@each("key", QUANTITIES)
def test_a_cell_of_a_workbook_shows_the_digits_of_the_text(key):
    form = QUANTITIES[key]
    if form.decimals is None or form.scientific:
        whole = f"0.{'0' * (form.decimals or 0)}E+00"
        assert form.number_format == ("General" if form.decimals is None else whole)
        return
    sizes = np.random.default_rng(3).uniform(-2.0, 4.0, 200)
    for value in (*np.power(10.0, sizes), 0.9951, 1.0049, 0.995, 9.996, 99.96, 100.0):
        shown = words.ENGLISH.show_number(key, float(value)).removeprefix(">")
        assert apply_format(form.number_format, float(value)) == shown


@given(force=st.floats(0.01, 999.0), part=st.floats(0.0, 1.0))
def test_forces_have_three_digits_and_a_minimum_is_never_rounded_down(force, part):
    shown = words.ENGLISH.show_number("demand_kN", force)
    assert abs(float(shown) - force) <= max(0.0051, 0.0051 * force)
    least = float(words.ENGLISH.show_minimum(force))
    assert least >= force * (1.0 - 1e-11)
    assert least <= force * 1.011 + 0.011
    smaller = float(words.ENGLISH.show_minimum(part * force))
    assert smaller <= least


@each("value", [0.9951, 0.9996, 1.00001, 1.0004, 1.0049])
def test_a_utilisation_that_is_not_one_does_not_read_as_one(value):
    """Three decimals where two would read 1.00; beyond 1 never as a pass."""
    shown = words.ENGLISH.show_number("utilisation", value)
    assert len(shown.removeprefix(">")) == len("1.000")
    assert (value > 1) == (shown.startswith(">") or float(shown) > 1)


@pytest.mark.parametrize("law", CREEP_LAWS.values(), ids=str)
def test_the_source_of_a_creep_law_is_told_in_the_language(law):
    """Laws of somebody's own keep their words."""
    stored = name_law(law)
    told = {
        words.show_own(words.Words(language), stored): language
        for language in LANGUAGES
    }
    assert len(told) == len(LANGUAGES)
    assert told[stored] == "en"
    assert all(text.startswith(f"{law.name} (") for text in told)
    own = name_law(replace(law, source="our own tests"))
    assert words.show_own(words.Words("de"), own) == f"{law.name} (our own tests)"


@pytest.mark.parametrize(
    ("ids", "count", "name"),
    [
        ("R1", 1, "Net row R1"),
        ("Row 1", 1, "Row 1"),
        ("row 1, row 2", 2, "row 1, row 2"),
        ("Werkreihe 3", 1, "Werkreihe 3"),
        ("Rowan 2, R5", 2, "Net rows Rowan 2, R5"),
    ],
)
def test_a_row_is_not_called_a_row_twice(ids, count, name):
    assert words.name_row(ids, words.Words("en"), count) == name
