"""Meaning of a heading in one sheet: the field of that name, several, or none.

A heading is known by its whole name, in which case, accents and punctuation do not
count. Nothing is made of its words: what is no name is asked for by ``netdesign map``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from netdesign.site.columns.all_tables import load_file
from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    LONGEST_HEADING,
    Field,
    SheetPlan,
    normalise,
    split_heading,
)

_NUMBER_SIGN = re.compile("[Nn][°º]|#")  # names the ids; a plain N is a glide factor

# Answers to a heading: it is not to be read; it is not yet answered.
IGNORE, UNANSWERED = "ignore", "?"


def has_no_part(text: str) -> bool:
    """A heading stands for what no check needs.

    >>> has_no_part("Remarques :"), has_no_part("Remarques N")
    (True, False)
    """
    words = load_file("heading_words")["no_part"]["words"]
    return normalise(text) in set(map(normalise, words))


def is_allowable(text: str) -> bool:
    """A heading speaks of an allowable value, which is no resistance.

    >>> is_allowable("zul. Ankerkraft [kN]"), is_allowable("Ankerkraft [kN]")
    (True, False)
    """
    stems = tuple(load_file("heading_words")["allowable"]["stems"])
    return any(normalise(word).startswith(stems) for word in text.split())


def says_sag(text: str) -> bool:
    """A heading speaks of sag, which is several times the slack.

    >>> says_sag("Flèche du filet"), says_sag("Mou")
    (True, False)
    """
    words = load_file("heading_words")["sag"]["words"]
    return any(normalise(word) in normalise(text) for word in words)


@dataclass(frozen=True, slots=True)
class Meaning:
    """Meaning of a heading, and what it follows from.

    Attributes
    ----------
    field : Field or None
        The one field that it means; None where it is unknown, unclear or ignored.
    readings : tuple of Field
        Where it is unclear, the fields that it may mean.
    answer : str
        Text of the answer to it; empty where none was needed or none is there.
    unit : str
        That of the answer; empty where it gives none.
    """

    field: Field | None = None
    readings: tuple[Field, ...] = ()
    answer: str = ""
    unit: str = ""

    @property
    def is_ignored(self) -> bool:
        """Somebody answered that it is not to be read."""
        return self.answer == IGNORE


UNKNOWN = Meaning()


@dataclass(frozen=True, slots=True)
class Lexicon:
    """Names of the fields of one sheet, or of the quantities that its lines may name.

    Attributes
    ----------
    fields : mapping of str to Field
        By key.
    names : mapping of str to str
        Key of the field by normalised heading.
    unclear : mapping of str to frozenset of str
        Keys of the fields that a normalised heading may mean; it is asked for.
    """

    fields: Mapping[str, Field]
    names: Mapping[str, str]
    unclear: Mapping[str, frozenset[str]]

    @classmethod
    def of(cls, fields: Iterable[Field], plan: SheetPlan) -> Lexicon:
        """Lexicon of some fields of a sheet, or of its items."""
        by_key = {field.key: field for field in fields}
        names = {name: key for key, one in by_key.items() for name in one.names}
        unclear = {
            normalise(heading): frozenset(keys).intersection(by_key)
            for heading, keys in plan.unclear.items()
        }
        return cls(by_key, names, unclear)

    def match(self, text: str) -> Meaning:
        """Meaning of a heading, which may have a unit in brackets behind its name."""
        typed = text.strip()
        if "id" in self.fields and _NUMBER_SIGN.fullmatch(typed):
            return Meaning(self.fields["id"])
        whole = normalise(typed) if len(typed) <= LONGEST_HEADING else ""
        if whole in self.names or whole in self.unclear:
            return self._conclude(whole)
        own, bracket = split_heading(typed)
        found = self._conclude(own)
        # Behind a number a bracket is a unit; an unknown one is told elsewhere.
        is_unit = not bracket or bracket in KNOWN_UNITS
        if found.field and not (is_unit or found.field.units):
            return Meaning(readings=(found.field,))
        return found

    def _conclude(self, name: str) -> Meaning:
        if name in self.names:
            return Meaning(self.fields[self.names[name]])
        keys = self.unclear.get(name, frozenset())
        return Meaning(
            readings=tuple(one for key, one in self.fields.items() if key in keys)
        )
