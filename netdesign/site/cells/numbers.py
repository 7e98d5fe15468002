"""Numbers from cells: strict, so that no value is ever guessed."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from netdesign.site.cells.findings import Refusal
from netdesign.words.message import say

DecimalMark = Literal["", ",", "."]

# A float holds so many digits; programs that write csv add up to five decimals more,
# which change nothing. Longer rows of digits are no quantities.
_MOST_DIGITS = 15
_MOST_DECIMALS = 20
_LARGEST = 1e15
# What separates groups of thousands and nothing else: spaces, also the narrow and
# the unbreakable ones of French, and the apostrophes of Switzerland.
_GROUP_SIGNS = " \u00a0\u202f\u2009'\u2019"
_PLAIN = re.compile(r"([+-]?)([0-9]+)(?:([.,])([0-9]+))?")
_GROUPED = re.compile(
    rf"([+-]?)([1-9][0-9]{{0,2}}(?:([.,{_GROUP_SIGNS}])[0-9]{{3}})(?:\3[0-9]{{3}})*)"
    r"(?:([.,])([0-9]+))?"
)

_ACCEPTED = say("accepted.number_cell")


@dataclass(frozen=True, slots=True)
class _Reading:
    """One meaning of a text: its digits, and what the marks stand for."""

    sign: str
    whole: str
    decimals: str
    decimal_mark: str
    separator: str  # of thousands

    @property
    def text(self) -> str:
        digits = f"{self.whole}.{self.decimals}" if self.decimals else self.whole
        return self.sign + digits

    @property
    def is_short(self) -> bool:
        is_whole = len(self.whole) <= _MOST_DIGITS
        return is_whole and len(self.decimals) <= _MOST_DECIMALS

    def goes_with(self, declared: str) -> bool:
        return self.decimal_mark in ("", declared) and self.separator != declared


def parse_number(value: object, decimal_mark: DecimalMark = "") -> float | Refusal:
    """Take the number of a cell, or say why there is none.

    A number cell is taken as it is, however it is displayed. Text is a number
    only with digits, a sign, one decimal mark and complete groups of thousands.

    Parameters
    ----------
    value : object
        What the cell holds: number, text, truth value or date.
    decimal_mark : str
        Point or comma where it was declared for the whole file; then the other
        one can only separate thousands.

    Returns
    -------
    float or Refusal
        The number in the unit of its column, or the reason against it. Text
        such as ``1,234`` is refused with both of its readings, unless the mark
        was declared.
    """
    if isinstance(value, bool):
        return Refusal(say("number.truth_value"), _ACCEPTED)
    if isinstance(value, int | float):
        return _check_size(value)
    if isinstance(value, str):
        return _parse_text(value.strip(), decimal_mark)
    return Refusal(say("number.date"), say("accepted.number_format"))


def _check_size(value: float) -> float | Refusal:
    # Written in the positive, so that NaN fails; integers may exceed any float.
    if -_LARGEST < value < _LARGEST:
        return float(value)
    return Refusal(say("number.unusable"), _ACCEPTED)


def _parse_text(text: str, declared: DecimalMark) -> float | Refusal:
    possible = _list_readings(text)
    readings = [one for one in possible if not declared or one.goes_with(declared)]
    if len(readings) > 1:
        return Refusal(
            say("number.ambiguous", readings=tuple(one.text for one in readings)),
            say("accepted.other_decimals"),
        )
    if possible and not readings:
        accepted = say("accepted.number_with_mark", mark=declared)
        return Refusal(say("number.not_with_mark", mark=declared), accepted)
    if readings and readings[0].is_short:
        return float(readings[0].text)
    if readings:
        rule = say("number.many_digits", most=_MOST_DIGITS)
        return Refusal(rule, say("accepted.fewer_digits"))
    return Refusal(say("number.not_a_number"), _ACCEPTED)


def _list_readings(text: str) -> list[_Reading]:
    """Every number that a text may mean."""
    readings: list[_Reading] = []
    if plain := _PLAIN.fullmatch(text):
        sign, whole, mark, decimals = plain.groups(default="")
        readings.append(_Reading(sign, whole, decimals, mark, ""))
    if grouped := _GROUPED.fullmatch(text):
        sign, whole, separator, mark, decimals = grouped.groups(default="")
        if mark != separator:
            whole = whole.replace(separator, "")
            readings.append(_Reading(sign, whole, decimals, mark, separator))
    return readings
