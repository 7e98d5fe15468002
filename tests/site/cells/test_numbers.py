import datetime
import math

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
        ("0." + "3" * 21, 1 / 3),  # to the last bit that a float has
    ],
)
def test_numbers_and_clear_text_are_taken(value, number):
    assert parse_number(value) == number


NO_NUMBER = [
    *("0,45O", "3 m", ".5", "5.", "1e3", "--1", "1,234,5", "1.234,567.8"),
    *("12 34", "1 2345", "1.234 567", "0 123", "1 234.567,8", "1,23,456"),
    *("", "nan", "inf", "−3", "٣", "2,5;", "=1", "0x10", "1_000"),
]
RANGES = ["4000 - 20000", "270 bis 431", "0,27–0,43", "3 à 4,7"]
LONG = ["9" * 40, "1" * 16 + ",5"]
TIMES = [datetime.datetime(2026, 5, 2), datetime.timedelta(days=1)]
AGAINST_MARK = [("2.5", ","), ("2,5", "."), ("0.450", ","), ("1.234,5", ".")]


@each(
    "value, mark, rule",
    [
        ("1,234", "", "is ambiguous: 1.234 or 1234"),
        ("1.234", "", "is ambiguous: 1.234 or 1234"),
        ("-12,500", "", "is ambiguous: -12.500 or -12500"),
        *((text, "", "is not a number") for text in NO_NUMBER),
        *((text, "", "holds two numbers") for text in RANGES),
        *((text, "", "is not a usable number") for text in LONG),
        (True, "", "is a truth value, not a number"),
        *((value, "", "is a date or time, not a number") for value in TIMES),
        *((x, "", "is not a usable number") for x in (math.nan, math.inf, 10**400)),
        *(
            (text, mark, f'is not a number with the decimal mark "{mark}"')
            for text, mark in (*AGAINST_MARK, ("1,234,567", ","))
        ),
    ],
)
def test_what_is_no_clear_number_is_refused(value, mark, rule):
    refusal = parse_number(value, mark)
    assert isinstance(refusal, Refusal)
    assert str(refusal.rule) == rule
    assert str(refusal.accepted) or rule != "holds two numbers"
