import datetime
from decimal import Decimal

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from netdesign.site.cells.findings import Refusal
from netdesign.site.cells.numbers import parse_number
from tests.each import each


@each(
    "value, number",
    [
        (45, 45.0),
        (0.05, 0.05),
        (1.234, 1.234),
        ("2.5", 2.5),
        ("2,5", 2.5),
        ("  2,5 ", 2.5),
        ("-12,75", -12.75),
        ("+3", 3.0),
        ("0,450", 0.45),
        ("1234,567", 1234.567),
        ("1,2345", 1.2345),
        # groups of thousands, where nothing else can be meant
        ("1.234,5", 1234.5),
        ("1,234.5", 1234.5),
        ("1.234.567", 1234567.0),
        ("1 234", 1234.0),
        ("12 345,25", 12345.25),
        ("1\u00a0234,5", 1234.5),
        ("-1\u202f234", -1234.0),
        ("1'234.5", 1234.5),
        ("1’234’567", 1234567.0),
    ],
)
def test_numbers_and_clear_text_are_taken(value, number):
    assert parse_number(value) == number


@pytest.mark.parametrize(
    ("text", "readings"),
    [
        ("1,234", "1.234 or 1234"),
        ("1.234", "1.234 or 1234"),
        ("-12,500", "-12.500 or -12500"),
    ],
)
def test_a_thousand_or_a_fraction_is_refused_with_both_readings(text, readings):
    refusal = parse_number(text)
    assert isinstance(refusal, Refusal)
    assert str(refusal.rule) == f"is ambiguous: {readings}"


@each(
    "text",
    [
        *("0,45O", "3 m", ".5", "5.", "1e3", "--1", "1,234,5", "1.234,567.8"),
        *("12 34", "1 2345", "1.234 567", "0 123", "1 234.567,8", "1,23,456"),
        *("", "nan", "inf", "−3", "٣", "2,5;", "=1", "0x10", "1_000"),
    ],
)
def test_other_text_is_refused(text):
    refusal = parse_number(text)
    assert isinstance(refusal, Refusal)
    assert str(refusal.rule) == "is not a number"


@pytest.mark.parametrize(
    "text", ["4000 - 20000", "270 bis 431", "0,27–0,43", "3 à 4,7"]
)
def test_a_range_is_no_number(text):
    refusal = parse_number(text)
    assert str(refusal.rule) == "holds two numbers"
    assert str(refusal.accepted)


@each(
    "value, rule",
    [
        (True, "is a truth value, not a number"),
        (datetime.datetime(2026, 5, 2), "is a date or time, not a number"),
        (datetime.timedelta(days=1), "is a date or time, not a number"),
        (float("nan"), "is not a usable number"),
        (float("inf"), "is not a usable number"),
        (10**400, "is not a usable number"),
    ],
)
def test_values_that_are_no_numbers_are_refused(value, rule):
    refusal = parse_number(value)
    assert isinstance(refusal, Refusal)
    assert str(refusal.rule) == rule


@settings(max_examples=200)
@given(
    st.decimals(min_value=-99999, max_value=99999, places=2),
    st.sampled_from([".", ","]),
)
def test_what_is_typed_with_two_decimals_is_what_is_read(number, separator):
    typed = f"{number:.2f}".replace(".", separator)
    assert parse_number(typed) == float(number)


@pytest.mark.parametrize("text", ["9" * 40, "0." + "3" * 21, "1" * 16 + ",5"])
def test_more_digits_than_are_kept_are_refused_as_such(text):
    assert str(parse_number(text).rule) == "has more than 15 digits in a row"


@given(st.floats(min_value=1e-3, max_value=1e5), st.sampled_from([".", ","]))
@settings(max_examples=200)
def test_floats_as_programs_write_them_are_read_to_the_last_bit(number, mark):
    assert parse_number(repr(number).replace(".", mark), mark) == number


@each(
    "text, mark, number",
    [
        ("1,234", ",", 1.234),
        ("1,234", ".", 1234.0),
        ("1.234", ",", 1234.0),
        ("1.234", ".", 1.234),
        ("1 234,5", ",", 1234.5),
        ("1.234.567", ",", 1234567.0),
        ("12", ",", 12.0),
    ],
)
def test_a_declared_decimal_mark_settles_what_is_ambiguous(text, mark, number):
    assert parse_number(text, mark) == number


@pytest.mark.parametrize(
    ("text", "mark"),
    [("2.5", ","), ("2,5", "."), ("0.450", ","), ("1.234,5", "."), ("1,234,567", ",")],
)
def test_a_number_against_the_declared_decimal_mark_is_refused(text, mark):
    refusal = parse_number(text, mark)
    assert isinstance(refusal, Refusal)
    assert str(refusal.rule) == f'is not a number with the decimal mark "{mark}"'


@settings(max_examples=300)
@given(st.text(alphabet="0123456789.,+- eEO m'", max_size=9))
def test_text_without_groups_is_read_as_its_one_meaning_or_refused(text):
    number = parse_number(text)
    if not isinstance(number, Refusal) and text.count(".") + text.count(",") < 2:
        plain = text.strip().replace(",", ".").replace(" ", "").replace("'", "")
        assert number == float(Decimal(plain))
