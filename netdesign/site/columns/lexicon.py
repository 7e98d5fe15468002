"""Meaning of a heading in one sheet: one field, several that it may be, or none.

A heading is taken only where everything in it agrees: its name in each language, its
symbols, the group that it stands under. Else it is asked for.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache

from netdesign.site.columns.fields import Field, SheetPlan, normalise, split_heading
from netdesign.site.columns.heading_text import (
    Part,
    find_unit,
    find_words_apart,
    fold,
    is_small,
    read_part,
    split_languages,
)
from netdesign.site.columns.synonyms import load_synonyms
from netdesign.site.columns.unit_names import KNOWN_UNITS

_Keys = frozenset[str]  # of fields; with _UNCLEAR among them never one for sure
_NOTHING: _Keys = frozenset()
_UNCLEAR: _Keys = frozenset(("?",))
_NARROW = frozenset(("post", "anchor", "guy"))  # groups of parts of a net row


@dataclass(frozen=True, slots=True)
class Match:
    """Meaning of a heading.

    Attributes
    ----------
    field : Field or None
        The one field that it means.
    readings : tuple of Field
        Where it is unclear, the fields that it may mean; perhaps none.
    contrary : str
        Where it is unclear because two parts differ, the part that says otherwise: a
        symbol of another quantity, or the group above.
    """

    field: Field | None = None
    readings: tuple[Field, ...] = ()
    contrary: str = ""

    @property
    def is_unclear(self) -> bool:
        """The heading has to be asked for."""
        return bool(self.readings or self.contrary)


UNKNOWN = Match()


@dataclass(frozen=True, slots=True)
class Lexicon:
    """Names of the fields of one sheet, or of the quantities that its lines may name.

    Attributes
    ----------
    fields : mapping of str to Field
        By key.
    names : mapping of str to frozenset of str
        Keys of the fields by normalised heading; several where it is unclear.
    folded : mapping of str to frozenset of str
        The same by folded heading, with its symbols.
    """

    fields: Mapping[str, Field]
    names: Mapping[str, _Keys]
    folded: Mapping[str, _Keys]

    @classmethod
    def of(cls, fields: Iterable[Field], plan: SheetPlan) -> Lexicon:
        """Lexicon of some fields of a sheet, or of its items."""
        by_key = {field.key: field for field in fields}
        names: dict[str, _Keys] = {}
        folded: dict[str, _Keys] = {}
        for heading, keys in plan.unclear.items():
            known = frozenset(keys).intersection(by_key)
            if known:
                names[normalise(heading)] = known | _UNCLEAR
                _add(folded, read_part(heading), known | _UNCLEAR)
        for key, field in by_key.items():
            names |= dict.fromkeys(field.names, frozenset((key,)))
        for key, field in by_key.items():
            for name in field.raw_names:
                # a name as typed is surer than one of which only the core is alike
                _add(folded, read_part(name), frozenset((key,)), is_sure=True)
        return cls(by_key, names, folded)

    def match(self, text: str, group: str = "") -> Match:
        """Meaning of a heading, under the text of a group or none."""
        grouped = self._match_grouped(text, group) if group else _NOTHING
        if grouped:
            return self._conclude(grouped)
        found = self._match_alone(text)
        if found.field and group and not self._may_stand_under(group, text):
            return Match(readings=(found.field,), contrary=group)
        return found

    def _may_stand_under(self, group: str, text: str) -> bool:
        """A group is about the subject of a heading; "de" stands not under "high"."""
        field, above = self._match_alone(text).field, self._match_alone(group).field
        is_other = is_small(text) and above not in (None, field)
        return field is not None and not is_other and _goes_with(field, group)

    def _match_grouped(self, text: str, group: str) -> _Keys:
        own, _ = split_heading(text)
        above, _ = split_heading(group)
        for name in (above + own, own + above):
            if name in self.names:
                return self.names[name]
        if is_small(text) or is_small(group):  # beside the other it would not count
            return _NOTHING
        for whole in (f"{group} {text}", f"{text} {group}"):
            parts = next(split_languages(whole), ())
            if len(parts) != 1:  # names of two languages
                continue
            keys, contrary = self._find(parts[0])
            if keys and not contrary:
                return keys
        return _NOTHING

    def _match_alone(self, text: str) -> Match:
        own, bracket = split_heading(text)
        before = re.split(r"[\[(]", text)[0]  # where its signs do not count: "? / high"
        if own in self.names and not find_words_apart(before):
            found = self._conclude(self.names[own])
            field = found.field
            if field and not self._may_stand_behind(bracket, field):
                return Match(readings=(field,), contrary=bracket)
            return found
        readings = _NOTHING
        for parts in split_languages(text):
            known = [self._find(part) for part in parts]
            if all(keys for keys, _ in known):
                return self._agree(known)
            readings = readings.union(*(keys for keys, _ in known))
        apart = find_words_apart(text)  # as a word more, it would leave a column unread
        if apart and readings:
            return self._conclude(readings | _UNCLEAR, apart[0])
        return UNKNOWN

    def _may_stand_behind(self, bracket: str, field: Field) -> bool:
        """A bracket says nothing else: a unit, or the same field once more.

        Behind a number it can only be a unit; that a unit is unknown is told elsewhere.
        """
        keys = self.names.get(normalise(bracket), _NOTHING)
        is_same = field.key in keys
        return not bracket or bool(field.units) or bracket in KNOWN_UNITS or is_same

    def _agree(self, known: list[tuple[_Keys, str]]) -> Match:
        """Meaning that all parts of a heading share."""
        every = [keys for keys, _ in known]
        contrary = next((sign for _, sign in known if sign), "")
        common = frozenset.intersection(*every)
        if contrary or not common - _UNCLEAR:
            return self._conclude(frozenset.union(_UNCLEAR, *every), contrary)
        return self._conclude(common)

    def _find(self, part: Part) -> tuple[_Keys, str]:
        """Fields that a part may mean, and the symbol that says otherwise."""
        if not part.name:
            return self._find_symbols(part.symbols)
        if part.whole in self.folded:
            return self.folded[part.whole], ""
        keys = self.folded.get(part.name, _NOTHING)
        for symbol in sorted(part.symbols) if keys else ():
            meant, is_clear = _find_meant(symbol)
            if keys.isdisjoint(meant):
                return keys, symbol
            keys &= meant if is_clear else meant | _UNCLEAR
        return keys, ""

    def _find_symbols(self, symbols: frozenset[str]) -> tuple[_Keys, str]:
        """Fields that a part of nothing but a symbol may mean.

        Also the symbol, where it stands for a quantity that no field is.
        """
        if len(symbols) != 1:
            return _NOTHING, ""
        symbol, *_ = symbols
        meant, is_clear = _find_meant(symbol)
        if is_clear:
            return meant.intersection(self.fields), ""
        table = load_synonyms("signs")["unclear"]
        keys = frozenset(key for key, names in table.items() if symbol in names)
        known = keys.intersection(self.fields)
        contrary = "" if known.intersection(meant) else symbol
        return (known | _UNCLEAR, contrary) if known else (_NOTHING, "")

    def _conclude(self, keys: _Keys, contrary: str = "") -> Match:
        fields = tuple(one for key, one in self.fields.items() if key in keys)
        if len(fields) == 1 and not keys & _UNCLEAR:
            return Match(field=fields[0])
        return Match(readings=fields, contrary=contrary)


def _add(
    folded: dict[str, _Keys], part: Part, keys: _Keys, *, is_sure: bool = False
) -> None:
    if part.name:
        before = _NOTHING if is_sure else folded.get(part.whole, _NOTHING)
        folded[part.whole] = before | keys


def _find_meant(symbol: str) -> tuple[_Keys, bool]:
    """Fields that a symbol stands for, and whether it is clear without a name."""
    tables = load_synonyms("signs")
    found = frozenset(
        key for key, names in tables["symbols"].items() if symbol in names
    )
    is_clear = any(symbol in names for names in tables["alone"].values())
    return found, is_clear


def _goes_with(field: Field, group: str) -> bool:
    """A field may stand under a group, which is not about another subject."""
    topics = _find_topics(group)
    own = {topic for topic in load_synonyms("signs")["topics"] if topic in field.key}
    if not own:
        return topics.isdisjoint(_NARROW)
    return not topics or not topics.isdisjoint(own)


@lru_cache(maxsize=256)
def _find_topics(group: str) -> frozenset[str]:
    words = {fold(word) for word in group.split()}
    topics = load_synonyms("signs")["topics"]
    return frozenset(
        topic for topic, names in topics.items() if words & set(map(fold, names))
    )


def unit_of(text: str, group: str = "") -> str:
    """Unit in the brackets of a heading, or in those of its group."""
    return split_heading(text)[1] or find_unit(text) or split_heading(group)[1]
