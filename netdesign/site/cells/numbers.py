"""Reads numbers from cells strictly, so that no value is ever guessed."""

from __future__ import annotations

import ast
import operator
import re
import unicodedata
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from netdesign.site.cells.findings import Refusal
from netdesign.words.message import say

DecimalMark = Literal["", ",", "."]

_LARGEST = 1e15  # longer rows of digits are no quantities
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

    def goes_with(self, declared: str) -> bool:
        return self.decimal_mark in ("", declared) and self.separator != declared


def parse_number(value: object, decimal_mark: DecimalMark = "") -> float | Refusal:
    """Read the number of a cell, or give the reason why there is none.

    A number cell is taken as it is, however it is displayed. Text is a number
    only with digits, a sign, one decimal mark and complete groups of thousands.

    Parameters
    ----------
    value : object
        What the cell holds: number, text, truth value or date.
    decimal_mark : str
        Point or comma where it was declared for the whole file; then the other
        sign can only separate thousands.

    Returns
    -------
    float or Refusal
        The number in the unit of its column, or the reason against it. Text
        such as ``1,234`` is refused with both of its readings, unless the mark
        was declared.
    """
    if isinstance(value, bool):
        return Refusal(say("number.truth_value"), _ACCEPTED)
    if isinstance(value, str):
        value = _parse_text(value.strip(), decimal_mark)
    if isinstance(value, Refusal):
        return value
    if not isinstance(value, int | float):
        return Refusal(say("number.date"), say("accepted.number_format"))
    # Written in the positive, so that NaN fails; integers may exceed any float.
    if -_LARGEST < value < _LARGEST:
        return float(value)
    return Refusal(say("number.unusable"), _ACCEPTED)


def _parse_text(text: str, declared: DecimalMark) -> float | Refusal:
    possible = _list_readings(text)
    readings = [
        reading for reading in possible if not declared or reading.goes_with(declared)
    ]
    if len(readings) > 1:
        return Refusal(
            say(
                "number.ambiguous", readings=tuple(reading.text for reading in readings)
            ),
            say("accepted.other_decimals"),
        )
    if possible and not readings:
        accepted = say("accepted.number_with_mark", mark=declared)
        return Refusal(say("number.not_with_mark", mark=declared), accepted)
    if readings:
        return float(readings[0].text)
    if split_range(text):
        return Refusal(say("number.two_numbers"), say("accepted.one_number"))
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


# A format in pieces: quoted and escaped text, currencies in brackets, blanks of a sign
# wide, fillers, conditions and colours, placeholders of digits; the rest is signs.
_PIECE = re.compile(
    r'"(?P<quoted>[^"]*)"|\\(?P<escaped>.)|\[\$(?P<currency>[^\]-]*)[^\]]*\]'
    r"|[_*].|\[[^\]]*\]|(?P<digits>General|E[+-]|[0-9#?.,/@])",
    re.DOTALL,
)
_NUMBER = re.compile(r"\d[\d.,'’\s\u00a0\u202f/]*(?:E[+-]?\d+)?")
_BLANKS = " \u00a0\u202f[]()+-.,"
_UNIT_SIGNS = "%°'′″"


def show_percent(number_format: str) -> bool:
    """Whether a format multiplies by 100; a percent sign in quotes does not."""
    return "%" in _keep_signs(number_format)


def find_format_unit(number_format: str) -> str:
    """Unit, currency or other word that a format of xlsx shows behind a number.

    >>> find_format_unit('0.0" m"')
    'm'
    """
    shown = _PIECE.sub(_show, number_format.partition(";")[0])
    number = _NUMBER.search(shown)
    if number is None:
        return ""
    behind = shown[number.end() :].strip(_BLANKS)
    before = shown[: number.start()].strip(_BLANKS)
    if any(sign.isalpha() or sign in _UNIT_SIGNS for sign in behind):
        return behind
    signs = (sign for sign in behind + before if unicodedata.category(sign) == "Sc")
    return next(signs, "")


def _show(piece: re.Match[str]) -> str:
    if piece["digits"]:
        return "0"
    return piece["quoted"] or piece["escaped"] or piece["currency"] or ""


def _keep_signs(number_format: str) -> str:
    """Signs of a format that control how digits are shown, without its texts."""
    return _PIECE.sub(lambda piece: piece["digits"] or " ", number_format)


_TYPED = r"[+-]?(?:[\d.,'’\s\u00a0\u202f\u2009]*\d)"
_WITH_UNIT = re.compile(rf"({_TYPED})\s*([^\d\s.,'’+-].*)")
# The ends have no sign, so that no dash is taken for a minus, nor a minus for a dash.
_END = r"\d(?:[\d.,'’\u00a0\u202f\u2009]*\d)?"
_END_UNIT = r"[^\d\s.,'’+–—÷-][^\d\s]*\d?|"
_RANGE = re.compile(
    rf"(?:(?:de|von|from|da)\s+)?({_END})\s*({_END_UNIT})\s*"
    rf"(?:-|–|—|÷|\.\.\.?|…|à|a|bis|to)\s*({_END})\s*({_END_UNIT})",
    re.IGNORECASE,
)


def split_unit(text: str) -> tuple[str, str]:
    """Split a text into its number and the unit behind it, both as typed.

    >>> split_unit("3,0 m"), split_unit("12 500"), split_unit("about 3 m")
    (('3,0', 'm'), ('12 500', ''), ('about 3 m', ''))
    """
    match = _WITH_UNIT.fullmatch(text.strip())
    return (match[1].strip(), match[2].strip()) if match else (text, "")


def split_range(text: str) -> tuple[str, str, str] | None:
    """Low end, high end and unit of a range in a cell; None without a range.

    >>> split_range("250-450"), split_range("20° à 35°"), split_range("-5-10")
    (('250', '450', ''), ('20', '35', '°'), None)
    """
    match = _RANGE.fullmatch(text.strip())
    if match is None:
        return None
    low, low_unit, high, high_unit = (part.strip() for part in match.groups())
    if low_unit and low_unit != high_unit:
        return None
    return low, high, high_unit


_PAIR = r"(\d{3,4})\s?/\s?\d{3,4}"  # yield and ultimate strength
_GRADE = re.compile(
    rf"(?:[A-Za-z]+\s?)?{_PAIR}|[SB]\s?(\d{{3,4}})(?:\s?[A-Z][A-Z\d+]{{0,5}}|\+[A-Z]+)?"
)
_LEAST_GRADE = 200.0  # [MPa]; "St 37" is of another kind


def read_grade(value: object) -> float | None:
    """Yield strength that a steel grade names [MPa]; None for any other text.

    >>> read_grade("S 355 J2"), read_grade("500/550"), read_grade("GEWI")
    (355.0, 500.0, None)
    """
    match = _GRADE.fullmatch(value.strip()) if isinstance(value, str) else None
    strength = float(match[1] or match[2]) if match else 0.0
    return strength if strength >= _LEAST_GRADE else None


_DOTTED = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})\b(.*)", re.DOTALL)


def read_moment(text: str) -> datetime:
    """Date, perhaps with a time: ISO 8601, or day, month and year with points.

    Points are never American, so nothing is guessed.

    Raises
    ------
    ValueError
        If the text is no date.

    Examples
    --------
    >>> read_moment("1.11.2023 06:00").isoformat()
    '2023-11-01T06:00:00'
    """
    dotted = _DOTTED.fullmatch(text.strip())
    if dotted:
        day, month, year, rest = dotted.groups()
        text = f"{year}-{int(month):02}-{int(day):02}{rest}"
    return datetime.fromisoformat(text.strip())


def is_moment(text: str) -> bool:
    """Whether a text is a date, as `read_moment` takes it."""
    try:
        read_moment(text)
    except ValueError:
        return False
    return True


_LONGEST_FORMULA = 300
_OPERATORS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


def compute_constant(formula: str) -> float | None:
    """Result of a formula that sums and multiplies numbers; None of any other.

    >>> compute_constant("=2*(3+4)"), compute_constant("=B2/4")
    (14.0, None)
    """
    text = formula.removeprefix("=").strip()
    if len(text) > _LONGEST_FORMULA:
        return None
    with suppress(ArithmeticError, LookupError, SyntaxError, TypeError, ValueError):
        return _evaluate(ast.parse(text, mode="eval").body)
    return None


def _evaluate(node: ast.AST) -> float:
    match node:
        case ast.Constant(value=int() | float() as number):
            return float(number)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_evaluate(operand)
        case ast.BinOp(left=left, op=sign, right=right):
            result: float = _OPERATORS[type(sign)](_evaluate(left), _evaluate(right))
            return result
    raise TypeError(node)
