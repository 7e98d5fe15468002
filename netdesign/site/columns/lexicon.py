"""Meaning of a heading in one sheet: one field, several that it may be, or none.

A heading is taken only where everything in it agrees: its name in each language, its
symbols, the group that it stands under. Else it is asked for.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache

from netdesign.site.columns.all_tables import load_file
from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    LONGEST_HEADING,
    Field,
    SheetPlan,
    normalise,
    normalise_unit,
    split_heading,
)

# Without brackets these are as often names as units: N is newton and glide factor.
_SHORT = ("n", "t", "c", "d", "h", "j", "1", "-", "–", "—", "a")
_BRACKETS = re.compile(r"[\[(]([^\[\]()]*)[\])]")
_BEHIND = re.compile(
    r"(?:(?:[,:]|\s(?:en|in))\s*(?=\S{1,6}\s*$)"
    # without a sign before it only what is no word
    r"|\s(?=\S*[°%/]\S*\s*$|(?:[cm]?m|kn|[km]pa|gon|deg)\s*$))(\S+)\s*$",
    re.IGNORECASE,
)
_WORD = re.compile(r"[^\W_]+")
_SYMBOL = re.compile(
    r"(?<![^\s,;:(\[/|])([^\W\d_]{1,4}(?:_[^\W\d_]{1,3})?)(?![^\s,;:)\]/|])"
)
# What stands between two languages, the surest first; a stroke may also be part of
# a name: "Frottement neige/filet".
_BETWEEN = (r"\n|\s+[/|–—-]\s+|;", r"\n|\s+[/|–—-]\s+|;|/")
_NUMBER_SIGN = re.compile("[Nn][°º]|#")  # names the ids; a plain N is a glide factor
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
    sense : frozenset of str or None
        What its words say, whatever their language and order; None where a word is
        unknown.
    """

    name: str
    symbols: frozenset[str]
    sense: frozenset[str] | None = None

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
    """Unit of a heading, in brackets or at its end; empty where there is none.

    Two units that differ are both given: together they are none that anybody knows.

    >>> find_unit("Dk (rechtwinklig) [m]"), find_unit("Pente (deg) [%]")
    ('m', 'deg, %')
    >>> find_unit("Dichte kg/m³"), find_unit("snow height, cm"), find_unit("Tag h")
    ('kg/m3', 'cm', '')
    """
    bracketed = [normalise_unit(one) for one in _BRACKETS.findall(text)]
    known = dict.fromkeys(one for one in bracketed if one in KNOWN_UNITS)
    if known:
        return ", ".join(known)
    behind = _match_unit_behind(text)
    return normalise_unit(behind[1]) if behind else ""


def _match_unit_behind(text: str) -> re.Match[str] | None:
    """Unit without brackets at the end of a heading, unless it is too short for one."""
    behind = _BEHIND.search(text)
    is_unit = behind and normalise_unit(behind[1]) in KNOWN_UNITS
    return behind if behind and is_unit and behind[1].casefold() not in _SHORT else None


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


def has_no_part(text: str) -> bool:
    """A heading stands for what no check needs.

    >>> has_no_part("Remarques :"), has_no_part("Remarques N")
    (True, False)
    """
    words = load_file("signs")["no_part"]["words"]
    return normalise(text) in set(map(normalise, words))


def list_symbols(key: str) -> tuple[str, ...]:
    """Symbols of the trade for a quantity; none where it has none.

    >>> list_symbols("glide_factor")
    ('N',)
    """
    return tuple(load_file("signs")["symbols"].get(key, ()))


def says_length(text: str) -> bool:
    """A heading of a post speaks of its length, not of its buckling length.

    >>> says_length("Stützenlänge [m]"), says_length("Knicklänge [m]")
    (True, False)
    """
    sense = read_part(_remove_units(text)).sense or frozenset()
    return sense - {"post"} == {"length"}


def says_sag(text: str) -> bool:
    """A heading speaks of sag, which is several times the slack.

    >>> says_sag("Flèche du filet"), says_sag("Mou")
    (True, False)
    """
    words = load_file("signs")["sag"]["words"]
    return any(fold(word) in fold(text) for word in words)


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


def _remove_units(text: str) -> str:
    kept = _BRACKETS.sub(
        lambda found: "" if normalise_unit(found[1]) in KNOWN_UNITS else found[0], text
    ).strip()
    behind = _match_unit_behind(kept)
    return kept[: behind.start()] if behind else kept


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
    is_one = len(re.split(_BETWEEN[-1], rest)) == 1  # in one language
    sense = find_sense(rest) if is_one else None
    return Part(fold(rest), frozenset(found.values()), sense)


def find_sense(text: str) -> frozenset[str] | None:
    """Sense of a text by its words; None where one is unknown, or there is none.

    >>> find_sense("Abstand der Stützen") == find_sense("post spacing")
    True
    >>> find_sense("Stützenabstand Nord") is None
    True
    """
    words = [one for one in _list_words(text) if one not in _small_words()]
    senses = [_split_word(fold(one)) for one in words]
    if any(one is None for one in senses):
        return None
    return frozenset(sense for one in senses if one for sense in one if sense) or None


@lru_cache(maxsize=8192)
def _split_word(word: str) -> frozenset[str] | None:
    """Senses of the parts of a word, the longest first; None where one is unknown."""
    table = _load_senses()
    if word in table:
        return frozenset((table[word],))
    links = ("", *load_file("thesaurus")["link"]["words"])
    for size in range(len(word) - 1, 1, -1):
        if (start := word[:size]) not in table:
            continue
        for link in links:
            tail = word[size:].removeprefix(link)
            if tail and (others := _split_word(tail)):
                return others | {table[start]}
    return None


@lru_cache(maxsize=1)
def _load_senses() -> Mapping[str, str]:
    """Senses by folded word; an empty one of a word that says nothing."""
    table = load_file("thesaurus")
    words = {"": table["empty"]["words"], **table["words"]}
    return {fold(word): sense for sense, known in words.items() for word in known}


def _list_words(text: str) -> list[str]:
    """Words without case and accents."""
    plain = text.replace("⊥", " perp ").casefold()
    decomposed = unicodedata.normalize("NFKD", plain)
    letters = "".join(one for one in decomposed if not unicodedata.combining(one))
    return _WORD.findall(letters)


@lru_cache(maxsize=1)
def _small_words() -> frozenset[str]:
    words = load_file("signs")["small"]["words"]
    return frozenset(words)


@lru_cache(maxsize=1)
def _known_symbols() -> frozenset[str]:
    tables = load_file("signs")
    listed = (tables["symbols"], tables["alone"], tables["unclear"])
    return frozenset(
        one for table in listed for names in table.values() for one in names
    )


_Sense = frozenset[str]  # of a heading: keys of the thesaurus
_Keys = frozenset[str]  # of fields; with _UNCLEAR among them never one for sure
_NOTHING: _Keys = frozenset()
_UNCLEAR: _Keys = frozenset(("?",))
_NARROW = frozenset(("post", "anchor", "guy"))  # groups of parts of a net row


# Answers to a heading: it is not to be read; it is not yet answered.
IGNORE, UNANSWERED = "ignore", "?"


@dataclass(frozen=True, slots=True)
class Meaning:
    """Meaning of a heading, and what it follows from.

    Attributes
    ----------
    field : Field or None
        The one field that it means; None where it is unknown, unclear or ignored.
    readings : tuple of Field
        Where it is unclear, the fields that it may mean; perhaps none.
    contrary : str
        Where it is unclear because two parts differ, the part that says otherwise: a
        symbol of another quantity, or the group above.
    answer : str
        Text of the answer to it; empty where none was needed or none is there.
    unit : str
        That of the answer; empty where it gives none.
    """

    field: Field | None = None
    readings: tuple[Field, ...] = ()
    contrary: str = ""
    answer: str = ""
    unit: str = ""

    @property
    def is_unclear(self) -> bool:
        """The heading has to be asked for."""
        return bool(self.readings or self.contrary)

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
    names : mapping of str to frozenset of str
        Keys of the fields by normalised heading; several where it is unclear.
    folded : mapping of str to frozenset of str
        The same by folded heading, with its symbols.
    senses : mapping of frozenset to frozenset of str
        The same by sense, without the noun of the sheet.
    noun : frozenset of str
        That noun, if there is one.
    """

    fields: Mapping[str, Field]
    names: Mapping[str, _Keys]
    folded: Mapping[str, _Keys]
    senses: Mapping[_Sense, _Keys]
    noun: _Sense

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
                part = read_part(heading)
                folded[part.whole] = folded.get(part.whole, known) | known | _UNCLEAR
        for key, field in by_key.items():
            own = frozenset((key,))
            names |= dict.fromkeys(field.names, own)
            # a name as typed is surer than one of which only the core is alike
            folded |= {read_part(name).whole: own for name in field.raw_names}
        nouns = load_file("thesaurus")["nouns"]
        noun = frozenset((nouns[plan.name],)) if plan.name in nouns else _NOTHING
        return cls(by_key, names, folded, _list_senses(by_key, plan, noun), noun)

    def match(self, text: str, group: str = "") -> Meaning:
        """Meaning of a heading, under the text of a group or none."""
        grouped = self._match_grouped(text, group) if group else _NOTHING
        if grouped:
            return self._conclude(grouped)
        found = self._match_alone(text)
        if found.field and group and not self._may_stand_under(group, text):
            return Meaning(readings=(found.field,), contrary=group)
        return found

    def match_by_unit(self, text: str, unit: str) -> Meaning:
        """Meaning of a heading that leaves one word to its unit: "Bar (mm)"."""
        sense = read_part(_remove_units(text)).sense
        own = sense - self.noun if sense else None
        if own and own <= frozenset(load_file("thesaurus")["alone"]["words"]):
            return UNKNOWN
        keys = {
            key
            for full, meant in self.senses.items()
            if own and own < full and len(full) == len(own) + 1
            for key in meant - _UNCLEAR
            if self.fields[key].units and self.fields[key].unit == unit
        }
        return Meaning(self.fields[keys.pop()]) if len(keys) == 1 else UNKNOWN

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

    def _match_alone(self, text: str) -> Meaning:
        own, bracket = split_heading(text)
        if "id" in self.fields and _NUMBER_SIGN.fullmatch(text.strip()):
            return Meaning(self.fields["id"])
        before = re.split(r"[\[(]", text)[0]  # where its signs do not count: "? / high"
        if own in self.names and not find_words_apart(before):
            found = self._conclude(self.names[own])
            field = found.field
            if field and not self._may_stand_behind(bracket, field):
                return Meaning(readings=(field,), contrary=bracket)
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

    def _agree(self, known: list[tuple[_Keys, str]]) -> Meaning:
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
        keys = self.folded.get(part.name, _NOTHING) or self._find_by_sense(part)
        for symbol in sorted(part.symbols) if keys else ():
            meant, is_clear = _find_meant(symbol)
            if keys.isdisjoint(meant):
                return keys, symbol
            keys &= meant if is_clear else meant | _UNCLEAR
        return keys, ""

    def _find_by_sense(self, part: Part) -> _Keys:
        """Fields that say the same in other words."""
        if part.sense is None:
            return _NOTHING
        return self.senses.get(part.sense - self.noun, _NOTHING)

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
        table = load_file("signs")["unclear"]
        keys = frozenset(key for key, names in table.items() if symbol in names)
        known = keys.intersection(self.fields)
        contrary = "" if known.intersection(meant) else symbol
        return (known | _UNCLEAR, contrary) if known else (_NOTHING, "")

    def _conclude(self, keys: _Keys, contrary: str = "") -> Meaning:
        fields = tuple(one for key, one in self.fields.items() if key in keys)
        if len(fields) == 1 and not keys & _UNCLEAR:
            return Meaning(field=fields[0])
        return Meaning(readings=fields, contrary=contrary)


def _list_senses(
    fields: Mapping[str, Field], plan: SheetPlan, noun: _Sense
) -> Mapping[_Sense, _Keys]:
    """Keys of fields by the senses of their names; the noun alone names the id."""
    found: dict[_Sense, _Keys] = {}
    for key, field in fields.items():
        for name in field.raw_names:
            sense = read_part(name).sense
            if sense is not None and not _is_too_little(name):
                found[sense - noun] = found.get(sense - noun, _NOTHING) | {key}
    for heading, keys in plan.unclear.items():
        sense, known = read_part(heading).sense, frozenset(keys).intersection(fields)
        if sense is not None and known and not _is_too_little(heading):
            found.setdefault(sense - noun, known | _UNCLEAR)
    found.pop(frozenset(), None)
    if noun and "id" in fields:
        found[frozenset()] = frozenset(("id",))
    return found


def _is_too_little(name: str) -> bool:
    """A name says one thing that many a heading says, or says it by a symbol."""
    part = read_part(name)
    words = frozenset(load_file("thesaurus")["alone"]["words"])
    sense = part.sense or frozenset()
    return bool(part.symbols) or (len(sense) == 1 and sense <= words)


def _find_meant(symbol: str) -> tuple[_Keys, bool]:
    """Fields that a symbol stands for, and whether it is clear without a name."""
    tables = load_file("signs")
    found = frozenset(
        key for key, names in tables["symbols"].items() if symbol in names
    )
    is_clear = any(symbol in names for names in tables["alone"].values())
    return found, is_clear


def _goes_with(field: Field, group: str) -> bool:
    """A field may stand under a group, which is not about another subject."""
    topics = _find_topics(group)
    own = {topic for topic in load_file("signs")["topics"] if topic in field.key}
    if not own:
        return topics.isdisjoint(_NARROW)
    return not topics or not topics.isdisjoint(own)


@lru_cache(maxsize=256)
def _find_topics(group: str) -> frozenset[str]:
    words = {fold(word) for word in group.split()}
    topics = load_file("signs")["topics"]
    return frozenset(
        topic for topic, names in topics.items() if words & set(map(fold, names))
    )
