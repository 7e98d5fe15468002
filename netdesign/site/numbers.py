"""Numbers from cells: strict, so that no value is ever guessed."""

from __future__ import annotations

import re

from netdesign.site.diagnostics import Refusal

# Digits are capped so that a float holds every number exactly as it was typed.
_PLAIN = re.compile(r"[+-]?[0-9]{1,15}(?:[.,][0-9]{1,15})?")
# One to three digits, a separator, three digits: a thousand or a fraction? A
# leading zero settles it: nobody writes 0,450 for 450.
_AMBIGUOUS = re.compile(r"([+-]?[1-9][0-9]{0,2})[.,]([0-9]{3})")
_LARGEST = 1e15

_ACCEPTED = "a number cell, or text such as 2.5 or 2,5 without unit or spaces"


def parse_number(value: object) -> float | Refusal:
    """Take the number of a cell, or say why there is none.

    A number cell is taken as it is, however it is displayed. Text is a number
    only with digits, a sign and one decimal point or comma.

    Parameters
    ----------
    value : object
        What the cell holds: number, text, truth value or date.

    Returns
    -------
    float or Refusal
        The number in the unit of its column, or the reason against it. Text
        such as ``1,234`` is refused with both of its readings.
    """
    if isinstance(value, bool):
        return Refusal("is a truth value, not a number", _ACCEPTED)
    if isinstance(value, int | float):
        return _check_size(value)
    if isinstance(value, str):
        return _parse_text(value.strip())
    return Refusal(
        "is a date or time, not a number", "a number; give the cell a number format"
    )


def _check_size(value: float) -> float | Refusal:
    # Written in the positive, so that NaN fails; integers may exceed any float.
    if -_LARGEST < value < _LARGEST:
        return float(value)
    return Refusal("is not a usable number", _ACCEPTED)


def _parse_text(text: str) -> float | Refusal:
    if ambiguous := _AMBIGUOUS.fullmatch(text):
        whole, digits = ambiguous.groups()
        return Refusal(
            f"is ambiguous: {whole}.{digits} or {whole}{digits}",
            "a number cell, or text with another count of decimals",
        )
    if _PLAIN.fullmatch(text):
        return float(text.replace(",", "."))
    return Refusal("is not a number", _ACCEPTED)
