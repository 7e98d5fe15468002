"""Texts of each language by key, and messages rendered in them.

A language is a folder of TOML files, one for each area, whose tables give the first
part of a key: ``[check]`` with ``no_resistance = "..."`` is ``check.no_resistance``. A
gap is ``{name}``, or ``{name:.2f}`` for a number that is rounded; ``{{`` is a brace.
A number has the decimal mark of the language; an argument that is text stays as it is.
Of a list, what stands behind the colon joins its parts: ``{names: or }``; a sentence
that becomes part of another loses its full stop by ``{reason:clause}``; a day in ISO
form is written as the language has it by ``{day:date}``; a force in kN or kN/m has
three significant digits by ``{load:force}``, rounded up by ``{load:minimum}``; a count
brings its noun along, ``{count:# row|# rows}``. `write_unit` fills ``{unit}``.
A text that a language lacks is shown in English, whole with what it fills in. Reports,
template and findings on the input have every language; `tests/words/test_catalogue.py`
lists the files that are English only.
"""

from __future__ import annotations

import math
import re
import string
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from functools import cache, lru_cache
from importlib.resources import files
from types import MappingProxyType
from typing import Any, Literal, get_args

from netdesign.words.message import Message, say

Language = Literal["en", "fr", "de"]
LANGUAGES: tuple[Language, ...] = get_args(Language)

_NO_BREAK = "\u00a0"
_MARKS = {
    language: str.maketrans({".": ",", ",": _NO_BREAK, "%": f"{_NO_BREAK}%"})
    for language in ("fr", "de")
}
_DEGREE, _POWER = re.compile(" deg(?!C)|deg"), re.compile(r"(?<=[a-z])\d")
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


def write_unit(unit: str) -> str:
    """Unit as an engineer writes it, alone or behind a number.

    Examples
    --------
    >>> write_unit("kg/m3"), write_unit("m/s2"), write_unit("1/100 m")
    ('kg/m³', 'm/s²', '1/100 m')
    >>> write_unit("degC"), "25" + write_unit(" deg")
    ('°C', '25°')
    """
    return _POWER.sub(lambda hit: "⁰¹²³⁴⁵⁶⁷⁸⁹"[int(hit[0])], _DEGREE.sub("°", unit))


def count_force_decimals(force: float) -> int:
    """Number of decimals of a force in kN or kN/m, for three significant digits.

    Examples
    --------
    >>> [count_force_decimals(force) for force in (1234.5, 99.96, 25.0, -3.2)]
    [0, 0, 1, 2]
    """
    return sum(abs(force) < end for end in FORCE_ENDS)


def round_force_up(force: float) -> float:
    """Force that has to be reached, to three significant digits.

    Examples
    --------
    >>> [round_force_up(force) for force in (441.2, 44.01, 4.4, 99.951)]
    [442.0, 44.1, 4.4, 100.0]
    """
    scale = 10.0 ** count_force_decimals(force)
    return math.ceil(force * scale * (1.0 - _LAST_BITS)) / scale


def write_day(day: str, language: Language) -> str:
    """Day in ISO form as a sentence of the language has it; any other text stays.

    Examples
    --------
    >>> write_day("2018-02-01", "de"), write_day("2018-02-17", "fr").split()
    ('01.02.2018', ['17', 'février', '2018'])
    """
    parts = _DAY.fullmatch(day)
    if parts is None or language == "en":
        return day
    year, month, number = parts.groups()
    if language == "de":
        return f"{number}.{month}.{year}"
    first = f"{int(number)}er" if number == "01" else f"{int(number)}"
    return _NO_BREAK.join((first, _MONTHS[int(month) - 1], year))


FORCE_ENDS = (99.95, 9.995)  # below each a force has one decimal more
_LAST_BITS = 1e-12  # relative; of a force that is a round number but for them
_CLAUSE, _DATE, _ONE_OR_MANY = "clause", "date", "|"
_ZEROS = ("+0", "-0")  # a change of nothing has no sign
_FORCE, _MINIMUM = "force", "minimum"
_GAP = re.compile(r"(\{[^{}]*\})")
_TABLE = re.compile(r"^\[([\w-]+)", re.MULTILINE)  # first name in its heading
_FORMATTER = string.Formatter()
_BEFORE_SIGN = re.compile(r" (?=[:;?!%»])|(?<=«) ")  # French sets these apart


def render(message: Message | str, language: Language) -> str:
    """Text of a message in a language; a plain text stays as it is.

    Raises
    ------
    KeyError
        If no text has this key, or an argument lacks: a fault of the program.
    """
    if isinstance(message, str):
        return message
    return fill_text(message.key, message.arguments, language)


def fill_text(key: str, arguments: Mapping[str, Any], language: Language) -> str:
    """Text of a key with its gaps filled; errors as of `render`."""
    language, parts = _open_text(language, key)
    written = []
    for before, name, form, conversion in parts:
        written.append(before)
        if name is not None:
            value = arguments[name]
            if conversion:
                value = _convert(value, conversion, language)
            elif name == "unit" and isinstance(value, str):
                value = write_unit(value)
                if (before, value) == (" ", "°"):  # behind a number
                    written[-1] = ""
            written.append(_fill(value, form or "", language))
    return "".join(written)


@cache
def _open_text(
    language: Language, key: str
) -> tuple[Language, tuple[tuple[str, str | None, str | None, str | None], ...]]:
    """Language in which a text is shown, and its parts.

    A part is what stands before a gap, its name, form and conversion. A gap has one
    argument by its name, and nothing is filled into its form.
    """
    shown: Language = language if key in load_texts(language) else "en"
    return shown, tuple(_FORMATTER.parse(load_texts(shown)[key]))


def _convert(value: Any, conversion: str, language: Language) -> Any:
    """An argument before it is text: ``!r`` is a number to its last digit."""
    text = _FORMATTER.convert_field(value, conversion)
    return set_marks(text, language) if isinstance(value, int | float) else text


def _fill(value: Any, form: str, language: Language) -> str:
    """Argument as text; a message among them in the language of the whole."""
    if form == _CLAUSE:
        return _fill(value, "", language).rstrip(".")
    if isinstance(value, str):
        is_day = form.startswith(_DATE)
        return write_day(value, language) if is_day else format(value, form)
    if isinstance(value, Message):
        return render(value, language)
    if isinstance(value, tuple):
        return _join(value, form, language)
    if isinstance(value, int | float) and _ONE_OR_MANY in form:
        return _count(value, *form.split(_ONE_OR_MANY), language=language)
    if form.endswith(_MINIMUM):
        value = round_force_up(value)
        form = form.removesuffix(_MINIMUM) + _FORCE
    if form.endswith(_FORCE):
        form = f"{form.removesuffix(_FORCE)}.{count_force_decimals(value)}f"
    text = format(value, form)
    if text in _ZEROS:
        return "0"
    return set_marks(text, language) if isinstance(value, int | float) else text


def _join(values: tuple[Any, ...], form: str, language: Language) -> str:
    """List as text; French sets a semicolon between its parts apart."""
    inner = _DATE if form.startswith(_DATE) else ""
    joint = form.removeprefix(inner) or ", "
    parts = (_fill(value, inner, language) for value in values)
    return (_set_apart(joint) if language == "fr" else joint).join(parts)


def _count(count: float, singular: str, plural: str, *, language: Language) -> str:
    """Noun with its number: French has the singular for none, too."""
    is_singular = count == 1 or (count == 0 and language == "fr")
    noun = singular if is_singular else plural
    return noun.replace("#", _fill(count, "", language))


def load_texts(language: Language) -> Mapping[str, str]:
    """All texts that a language has itself, by key."""
    return _Texts(language)


def load_tables(language: Language, tables: Iterable[str]) -> dict[str, str]:
    """Texts of some tables by key, without those of the others."""
    return {
        key: text
        for table in tables
        for key, text in _load_table(language, table).items()
    }


class _Texts(Mapping[str, str]):
    """Texts of a language; a file is parsed when one of its tables is asked for."""

    def __init__(self, language: Language) -> None:
        self._language = language

    def __getitem__(self, key: str) -> str:
        return _load_table(self._language, key.partition(".")[0])[key]

    def __iter__(self) -> Iterator[str]:
        for table in _find_tables(self._language):
            yield from _load_table(self._language, table)

    def __len__(self) -> int:
        return sum(1 for _ in self)


@lru_cache
def _find_tables(language: Language) -> Mapping[str, tuple[str, ...]]:
    """Contents of the files in which a table stands, by its first name."""
    folder = files(__package__) / language
    tables: dict[str, tuple[str, ...]] = {}
    for file in sorted(folder.iterdir(), key=lambda file: file.name):
        content = file.read_text(encoding="utf-8")
        for table in dict.fromkeys(_TABLE.findall(content)):
            tables[table] = (*tables.get(table, ()), content)
    return MappingProxyType(tables)


@cache
def _load_table(language: Language, table: str) -> Mapping[str, str]:
    """Texts of one table by their whole keys."""
    texts: dict[str, str] = {}
    for content in _find_tables(language)[table]:
        for key, text in _list_texts(_parse(content)[table], table):
            if key in texts:
                raise ValueError(f"two texts have the key {key} in {language}")
            texts[key] = keep_together(text) if language == "fr" else text
    return MappingProxyType(texts)


@cache
def _parse(content: str) -> Mapping[str, Any]:
    return MappingProxyType(tomllib.loads(content))


def keep_together(text: str) -> str:
    """Text in which no line begins with a colon or a question mark."""
    return "".join(
        _BEFORE_SIGN.sub("\u00a0", part) if place % 2 == 0 else part
        for place, part in enumerate(_GAP.split(text))
    )


def _set_apart(joint: str) -> str:
    """Sign between two parts as French sets it: with a space before a semicolon."""
    return re.sub(r" ?;", "\u00a0;", joint)


def _list_texts(table: Mapping[str, Any], above: str) -> Iterator[tuple[str, str]]:
    for name, value in table.items():
        key = f"{above}.{name}"
        if isinstance(value, str):
            yield key, value
        else:
            yield from _list_texts(value, key)


@lru_cache(maxsize=1024)
def name(family: str, key: str) -> Message:
    """Name of one of a family: text ``family.key``, or the key as it was given."""
    text = f"{family}.{key}"
    if text in load_texts("en"):
        return say(text)
    return as_given(key.replace("_", " "))


def as_given(text: str) -> Message:
    """Somebody else's words, as they are in every language."""
    return say("text.as_given", text=text)


def name_member(member: str) -> Message:
    """Name of a member or an anchor: ``foot_anchor`` as "Foot anchor"."""
    return name("member", member)


def name_mode(mode: str) -> Message:
    """Name of what a member fails by: ``pull_out`` as "pull-out"."""
    return name("mode", mode)


def name_check(member: str, mode: str, position: str = "") -> Message:
    """Name of a check by its member and mode: "Foot anchor, pull-out".

    That of a row's first and last support says so, and that of the one beside it.
    """
    title = say("check.title", member=name_member(member), mode=name_mode(mode))
    key = {"edge": "check.of_end", "second": "check.of_second"}.get(position)
    return say(key, check=title) if key else title
