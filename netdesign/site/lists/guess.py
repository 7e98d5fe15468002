"""Guesses at what a heading means: the names that are written most alike."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass

from rapidfuzz.fuzz import token_sort_ratio

from netdesign.site.columns.all_tables import is_allowable
from netdesign.site.columns.fields import Field

# Measured on 220 headings of eight lists: a wrong one reaches 83, a meaningless one 87,
# and two columns of ours are 90 alike.
_SURE, _APART = 92.0, 5.0
_LEAST, _MOST_LISTED = 40.0, 3
_WORD = re.compile(r"[^\W_]+")
_BRACKET = re.compile(r"[\[(][^\[\]()]*[\])]\s*$")


@dataclass(frozen=True, slots=True)
class Guess:
    """Fields that a heading may mean.

    Attributes
    ----------
    ranked : tuple of Field and float
        The likeliest first, with how alike their names are, of 100.
    field : Field or None
        The one that may be taken; None where only an engineer knows.
    """

    ranked: tuple[tuple[Field, float], ...]
    field: Field | None


def guess(text: str, unit: str, fields: Iterable[Field]) -> Guess:
    """Guess at a heading by the likeness of its words to known names.

    Parameters
    ----------
    text : str
        The heading as typed.
    unit : str
        Its unit; empty where it has none, which then excludes no field.
    fields : iterable of Field
        What it may mean.

    Returns
    -------
    Guess
        An allowable value is never taken for a resistance.
    """
    plain = _list_words(_BRACKET.sub("", text) or text)
    scores = [
        (one, max(token_sort_ratio(plain, _list_words(name)) for name in one.raw_names))
        for one in fields
        if _fits(unit, one)
    ]
    scores.sort(key=lambda one: -one[1])
    best, second = [*(score for _, score in scores), 0.0, 0.0][:2]
    is_sure = best >= _SURE and best - second >= _APART and not is_allowable(text)
    listed = [one for one in scores if one[1] >= _LEAST]
    return Guess(tuple(listed[:_MOST_LISTED]), scores[0][0] if is_sure else None)


def _fits(unit: str, field: Field) -> bool:
    return not unit or unit in (field.units or ("-",))


def _list_words(text: str) -> str:
    """Words without case and accents."""
    decomposed = unicodedata.normalize("NFKD", text.casefold())
    letters = "".join(one for one in decomposed if not unicodedata.combining(one))
    return " ".join(_WORD.findall(letters))
