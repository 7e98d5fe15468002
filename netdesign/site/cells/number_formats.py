"""Signs that a number format shows beside a number: a unit, a per cent sign."""

from __future__ import annotations

import re
import unicodedata

# A format in pieces: quoted and escaped text, blanks of a sign's width and fillers,
# conditions, colours and currencies in brackets, placeholders of digits, the rest.
_PIECE = re.compile(
    r'"(?P<quoted>[^"]*)"|\\(?P<escaped>.)|(?P<filler>[_*].)'
    r"|\[(?P<bracket>[^\]]*)\]|(?P<general>General)|(?P<digits>E[+-]|[0-9#?.,/@])"
    r"|(?P<sign>.)",
    re.DOTALL,
)
_SECTION = re.compile(r'(?:"[^"]*"|\\.|\[[^\]]*\]|[^;"\\\[]|.)*?(?:;|$)', re.DOTALL)
_THOUSANDS = re.compile(r"[0#?],+(?![0#?,])")  # a comma behind the digits divides
_NUMBER = re.compile(r"\d[\d.,'’\s\u00a0\u202f/]*(?:E[+-]?\d+)?")
_BLANKS = " \u00a0\u202f[]()+-.,"
_UNIT_SIGNS = "%°'′″"


def show_percent(number_format: str) -> bool:
    """A format multiplies by 100; a percent sign in quotes does not."""
    return "%" in _keep_signs(number_format)


def show_thousands(number_format: str) -> bool:
    """A format divides by 1000, as a comma behind the digits does."""
    return bool(_THOUSANDS.search(_keep_signs(number_format)))


def find_format_unit(number_format: str, value: float) -> str:
    """Unit, currency or other word that a format of xlsx shows beside a number.

    Parameters
    ----------
    number_format : str
        As the file has it: ``0.0" m"``, ``#,##0\\ [$€-407];...``.
    value : float
        Its sign chooses among the sections of the format.

    Returns
    -------
    str
        As it is shown; empty where there is none.

    >>> find_format_unit('0.0" m"', 3.5)
    'm'
    """
    shown = "".join(
        "0" if piece["digits"] or piece["general"] else _show(piece)
        for piece in _PIECE.finditer(_choose_section(number_format, value))
    )
    return find_text_unit(shown)


def find_text_unit(shown: str) -> str:
    """Unit or word that stands behind a number as it is shown, or its currency.

    >>> find_text_unit("3,50 m")
    'm'
    """
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
    if piece["bracket"] is not None:  # of [$€-407] the euro, of [Red] nothing
        bracket = piece["bracket"]
        return bracket[1:].partition("-")[0] if bracket.startswith("$") else ""
    return piece["quoted"] or piece["escaped"] or piece["sign"] or ""


def _keep_signs(number_format: str) -> str:
    """Format without its texts: what is left steers how digits are shown."""
    return "".join(
        piece["digits"] or piece["sign"] or " "
        for piece in _PIECE.finditer(number_format)
    )


def _choose_section(number_format: str, value: float) -> str:
    """Section for positive, negative or zero numbers; the first where none is."""
    found = [one[0] for one in _SECTION.finditer(number_format) if one[0]]
    sections = [one.removesuffix(";") for one in found] or [""]
    place = 0 if value > 0 else 1 if value < 0 else 2
    return sections[place] if place < min(len(sections), 3) else sections[0]
