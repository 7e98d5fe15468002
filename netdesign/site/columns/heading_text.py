"""The text of a heading: its names, its symbols, its unit.

Offices write one quantity in many ways: ``hauteur du filet Dk``, ``Netzhöhe DK [m]``,
``Entraxe poteaux, en m``, and in two languages at once, with a stroke between.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from netdesign.site.columns.synonyms import load_synonyms
from netdesign.site.columns.unit_names import KNOWN_UNITS, normalise_unit

LONGEST_HEADING = 100
# Without brackets these are as often names as units: N is newton and glide factor.
_SHORT = ("n", "t", "c", "d", "h", "j", "1", "-", "–", "—", "a")
_BRACKETS = re.compile(r"[\[(]([^\[\]()]*)[\])]")
_BEHIND = re.compile(r"(?:[,:]|\s(?:en|in))\s*(\S{1,6})\s*$")
_WORD = re.compile(r"[^\W_]+")
_SYMBOL = re.compile(
    r"(?<![^\s,;:(\[/|])([^\W\d_]{1,4}(?:_[^\W\d_]{1,3})?)(?![^\s,;:)\]/|])"
)
# What stands between two languages, the surest first; a stroke may also be part of
# a name: "Frottement neige/filet".
_BETWEEN = (r"\n|\s+[/|–—-]\s+|;", r"\n|\s+[/|–—-]\s+|;|/")
# Wherever a word may stand apart from the others: "de / high", "high (de)", "de, high".
_APART = re.compile(r"\s+[–—-]\s+|[\n/|,;:()\[\]]")


@dataclass(frozen=True, slots=True)
class Part:
    """One name of a heading, in one language.

    Attributes
    ----------
    name : str
        Folded name without symbols; may be empty. Small words count where they are all
        that it has: "de" is a heading of its own.
    symbols : frozenset of str
        Symbols of the trade beside it, such as ``Dk``.
    """

    name: str
    symbols: frozenset[str]

    @property
    def whole(self) -> str:
        """Name with its symbols."""
        return "|".join((self.name, *sorted(self.symbols)))


@lru_cache(maxsize=8192)
def fold(text: str) -> str:
    """Fold a name so that case, accents, umlauts, articles and signs do not count.

    >>> fold("Hauteur du filet"), fold("Stuetzen-Abstand") == fold("Stützenabstand")
    ('hauteurfilet', True)
    """
    words = (word for word in _list_words(text) if word not in _small_words())
    joined = "".join(words)
    for pair in ("ae", "oe", "ue"):
        joined = joined.replace(pair, pair[0])
    return joined


def find_unit(text: str) -> str:
    """Unit of a heading, in brackets or behind a comma; empty where there is none.

    Two units that differ are both given: together they are none that anybody knows.

    >>> find_unit("Dk (rechtwinklig) [m]"), find_unit("Pente (deg) [%]")
    ('m', 'deg, %')
    """
    bracketed = [normalise_unit(one) for one in _BRACKETS.findall(text)]
    known = dict.fromkeys(one for one in bracketed if one in KNOWN_UNITS)
    if known:
        return ", ".join(known)
    behind = _BEHIND.search(text)
    unit = normalise_unit(behind[1]) if behind else ""
    return unit if unit in KNOWN_UNITS and behind and not _is_short(behind[1]) else ""


def split_languages(text: str) -> Iterator[tuple[Part, ...]]:
    """Parts of a heading: first all of it as one name, then cut between languages.

    A small word that stands apart says something of its own: all of it as one name
    would drop the word, and take "de / high" for "high".
    """
    plain = text.strip()
    if len(plain) > LONGEST_HEADING:
        return
    without_units = _remove_units(plain)
    if not find_words_apart(without_units):
        yield (read_part(without_units),)
    for between in _BETWEEN:
        pieces = [one for one in re.split(between, without_units) if one.strip()]
        if len(pieces) > 1:
            yield tuple(map(read_part, pieces))


def is_small(text: str) -> bool:
    """A text has nothing but articles and prepositions.

    >>> is_small("de"), is_small("de la"), is_small("high"), is_small("-")
    (True, True, False, False)
    """
    return bool(_WORD.search(text)) and not fold(text)


def find_words_apart(text: str) -> tuple[str, ...]:
    """Pieces of a heading that would not count in a name: small words, "?".

    >>> find_words_apart("de / high"), find_words_apart("hauteur de filet / -")
    (('de',), ())
    """
    pieces = [one.strip() for one in _APART.split(text) if one.strip(" -–—")]
    named = [
        one
        for one in pieces
        if _WORD.search(one) or normalise_unit(one) not in KNOWN_UNITS
    ]
    return tuple(one for one in named if not fold(one)) if len(named) > 1 else ()


def _is_short(unit: str) -> bool:
    return unit.casefold() in _SHORT


def _remove_units(text: str) -> str:
    kept = _BRACKETS.sub(
        lambda found: "" if normalise_unit(found[1]) in KNOWN_UNITS else found[0], text
    ).strip()
    behind = _BEHIND.search(kept)
    is_unit = behind and not _is_short(behind[1])
    if behind and is_unit and normalise_unit(behind[1]) in KNOWN_UNITS:
        return kept[: behind.start()]
    return kept


@lru_cache(maxsize=8192)
def read_part(text: str) -> Part:
    """Name and symbols of a text without units."""
    symbols = _known_symbols()
    found = {
        sign: sign.replace("_", "")
        for sign in _SYMBOL.findall(text)
        if sign.replace("_", "") in symbols
    }
    if not found and is_small(text):
        return Part("".join(_list_words(text)), frozenset())
    rest = _SYMBOL.sub(lambda one: "" if one[1] in found else one[0], text)
    return Part(fold(rest), frozenset(found.values()))


def _list_words(text: str) -> list[str]:
    """Words without case and accents."""
    plain = text.replace("⊥", " perp ").casefold()
    decomposed = unicodedata.normalize("NFKD", plain)
    letters = "".join(one for one in decomposed if not unicodedata.combining(one))
    return _WORD.findall(letters)


@lru_cache(maxsize=1)
def _small_words() -> frozenset[str]:
    words = load_synonyms("signs")["small"]["words"]
    return frozenset(words)


@lru_cache(maxsize=1)
def _known_symbols() -> frozenset[str]:
    tables = load_synonyms("signs")
    listed = (tables["symbols"], tables["alone"], tables["unclear"])
    return frozenset(
        one for table in listed for names in table.values() for one in names
    )
