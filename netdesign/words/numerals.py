"""Numbers as a reader of a language writes them: with a point, or with a comma.

Only numbers that the program has just written are set so. What somebody typed stays as
typed, and so does what programs read: JSON, csv, toml and cells that hold numbers.
"""

from __future__ import annotations

import re
from typing import Literal, get_args

Language = Literal["en", "fr", "de"]
LANGUAGES: tuple[Language, ...] = get_args(Language)

_NO_BREAK = "\u00a0"
_MARKS = {
    one: str.maketrans({".": ",", ",": _NO_BREAK, "%": f"{_NO_BREAK}%"})
    for one in ("fr", "de")
}
_DAY = re.compile(r"(\d{4})-(0[1-9]|1[0-2])-(\d\d)")
_MONTHS = (
    *("janvier", "février", "mars", "avril", "mai", "juin", "juillet", "août"),
    *("septembre", "octobre", "novembre", "décembre"),
)


def set_marks(number: str, language: Language) -> str:
    """Number in Python's notation with the marks of a language.

    Examples
    --------
    >>> set_marks("12.50", "en"), set_marks("12.50", "fr"), set_marks("3.8e-16", "de")
    ('12.50', '12,50', '3,8e-16')
    """
    marks = _MARKS.get(language)
    return number.translate(marks) if marks else number


def write_day(day: str, language: Language) -> str:
    """Day in ISO form as a sentence of the language has it; any other text stays.

    Examples
    --------
    >>> write_day("2018-02-01", "de"), write_day("2018-02-17", "fr").split()
    ('01.02.2018', ['17', 'février', '2018'])
    """
    found = _DAY.fullmatch(day)
    if found is None or language == "en":
        return day
    year, month, number = found.groups()
    if language == "de":
        return f"{number}.{month}.{year}"
    first = f"{int(number)}er" if number == "01" else f"{int(number)}"
    return _NO_BREAK.join((first, _MONTHS[int(month) - 1], year))
