"""Two studies compared value by value: what counts as the same, and where."""

import random
from dataclasses import replace

import pytest

from netdesign.study.document import compare_values, list_values
from tests.each import each
from tests.report.build_study import build_study

STUDY = build_study(rows=2)
DRAW = random.Random(23)
NUMBERS = [DRAW.uniform(-1.0, 1.0) * 10.0 ** DRAW.uniform(0.0, 6.0) for _ in range(40)]


def count(old, new, **options):
    return len(compare_values(old, new, **options))


@each("number", NUMBERS)
def test_a_number_is_the_same_within_a_millionth(number):
    if abs(number) > 2.0:
        assert count({"force_kN": number}, {"force_kN": number * (1 + 9e-7)}) == 0
        assert count({"force_kN": number}, {"force_kN": number * (1 + 3e-6)}) == 1
    for digit, differs in ((2.0**-51, 0), (3e-12, 1)):
        last = number * (1.0 + digit)
        assert count({"force_kN": number}, {"force_kN": last}, is_exact=True) == differs


@pytest.mark.parametrize(
    ("key", "move", "expected"),
    [
        ("balance_residual", 9e-7, 0),
        ("balance_residual", 1.1e-6, 1),
        ("difference_percent", 9e-5, 0),  # each of two forces by a millionth
        ("difference_percent", 1.1e-4, 1),
    ],
)
def test_what_is_nearly_zero_has_an_absolute_tolerance(key, move, expected):
    assert count({key: 1e-13}, {key: 1e-13 + move}) == expected


@pytest.mark.parametrize(
    ("old", "new"), [(True, 1.0), (1.0, None), ("1.0", 1.0), ("pass", "fail")]
)
def test_values_of_other_kinds_are_never_the_same(old, new):
    assert count({"value": old}, {"value": new}) == 1


def test_members_stand_under_their_ids_and_their_order_counts():
    values = list_values(STUDY)
    assert values["rows.order"] == ", ".join(row.id for row in STUDY.rows)
    turned = replace(STUDY, rows=STUDY.rows[::-1])
    assert [one.place for one in compare_values(STUDY, turned)] == ["rows.order"]
