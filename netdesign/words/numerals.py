"""Numbers as a reader of a language writes them: with a point, or with a comma.

Only numbers that the program has just written are set so. What somebody typed stays as
typed, and so does what programs read: JSON, csv, toml and cells that hold numbers.
"""

from __future__ import annotations

from typing import Literal, get_args

Language = Literal["en", "fr", "de"]
LANGUAGES: tuple[Language, ...] = get_args(Language)

_NO_BREAK = "\u00a0"
_MARKS = {
    "fr": str.maketrans({".": ",", ",": _NO_BREAK}),
    "de": str.maketrans({".": ",", ",": _NO_BREAK}),
}


def set_marks(number: str, language: Language) -> str:
    """Number in Python's notation with the marks of a language.

    Examples
    --------
    >>> set_marks("12.50", "en"), set_marks("12.50", "fr"), set_marks("3.8e-16", "de")
    ('12.50', '12,50', '3,8e-16')
    """
    return number.translate(_MARKS.get(language, {}))
