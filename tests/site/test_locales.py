"""An imported number is the one typed, or it is refused: three locales.

The typed text is made by rule from a decimal number, as spreadsheet programs show it
in English, French, German and Swiss; the truth is that decimal number.
"""

from decimal import Decimal

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from netdesign.site.cells.findings import Refusal
from netdesign.site.cells.numbers import parse_number

# decimal mark, signs that may separate thousands
LOCALES = {
    "en": (".", (",",)),
    "fr": (",", (" ", "\u00a0", "\u202f")),
    "de": (",", (".",)),
    "de_CH": (".", ("'", "\u2019")),
}


@st.composite
def typed_numbers(draw):
    """A decimal number, and the text that someone types for it in a locale."""
    digits = draw(st.integers(min_value=0, max_value=10**9))
    decimals = draw(st.integers(min_value=0, max_value=6))
    sign = draw(st.sampled_from(["", "-", "+"]))
    number = Decimal(digits).scaleb(-decimals)
    mark, separators = LOCALES[draw(st.sampled_from(sorted(LOCALES)))]
    text = f"{number:.{decimals}f}"
    whole, _, rest = text.partition(".")
    if draw(st.booleans()):
        whole = f"{int(whole):,}".replace(",", draw(st.sampled_from(separators)))
    spaces = draw(st.sampled_from(["", " ", "\t"]))
    typed = f"{spaces}{sign}{whole}{mark + rest if rest else ''}{spaces}"
    return typed, (-number if sign == "-" else number), mark


def is_taken_or_refused(typed_number):
    """It is read as the number that was typed, or not at all."""
    typed, truth, _ = typed_number
    understood = parse_number(typed)
    return isinstance(understood, Refusal) or understood == float(truth)


@pytest.mark.long
@settings(max_examples=1000)
@given(typed_numbers())
def test_with_the_decimal_mark_declared_every_number_is_taken(typed_number):
    typed, truth, mark = typed_number
    assert parse_number(typed, mark) == float(truth)


@settings(max_examples=300)
@given(typed_numbers())
def test_without_it_only_what_has_two_readings_is_refused(typed_number):
    typed, _, _ = typed_number
    text = typed.strip().lstrip("+-")
    marks = [sign for sign in text if sign in ".,"]
    is_unclear = len(marks) == 1 and len(text.split(marks[0])[1]) == 3
    assert is_taken_or_refused(typed_number)
    if isinstance(parse_number(typed), Refusal):
        assert is_unclear
        assert len(text.split(marks[0])[0]) <= 3
