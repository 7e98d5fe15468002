"""Texts of each language by key, and messages rendered in them.

A language is a folder of TOML files, one for each area, whose tables give the first
part of a key: ``[check]`` with ``no_resistance = "..."`` is ``check.no_resistance``. A
gap is ``{name}``, or ``{name:.2f}`` for a number that is rounded; ``{{`` is a brace.
A number has the decimal mark of the language; an argument that is text stays as it is.
Of a list, what stands behind the colon joins its parts: ``{names: or }``; a sentence
that becomes part of another loses its full stop by ``{reason:clause}``; a day in ISO
form is written as the language has it by ``{day:date}``; a count brings its noun along,
``{count:# row|# rows}``.
Every language has every key with the same gaps; a test says so.
"""

from __future__ import annotations

import re
import string
import tomllib
from collections.abc import Iterator, Mapping
from functools import cache, lru_cache
from importlib.resources import files
from types import MappingProxyType
from typing import Any

from netdesign.words.message import Message
from netdesign.words.numerals import LANGUAGES as LANGUAGES
from netdesign.words.numerals import Language as Language
from netdesign.words.numerals import set_marks, write_day

_CLAUSE, _DATE, _ONE_OR_MANY = "clause", "date", "|"
_GAP = re.compile(r"(\{[^{}]*\})")
_TABLE = re.compile(r"^\[([\w-]+)", re.MULTILINE)  # first name in its heading
_BEFORE_SIGN = re.compile(r" (?=[:;?!%»])|(?<=«) ")  # French sets these apart


def render(message: Message | str, language: Language) -> str:
    """Text of a message in a language; somebody else's words stay.

    Raises
    ------
    KeyError
        If no text has this key, or an argument lacks: a fault of the program.
    """
    if isinstance(message, str):
        return message
    return _Gaps(language).vformat(
        load_texts(language)[message.key], (), message.arguments
    )


class _Gaps(string.Formatter):
    """Fills the gaps of one language's text."""

    def __init__(self, language: Language) -> None:
        self.language = language

    def convert_field(self, value: Any, conversion: str | None) -> Any:
        """An argument before it is text: ``!r`` is a number to its last digit."""
        text = super().convert_field(value, conversion)
        is_number = conversion and isinstance(value, int | float)
        return set_marks(text, self.language) if is_number else text

    def format_field(self, value: Any, format_spec: str) -> str:
        """An argument as text: words of ours in the language of the whole."""
        if format_spec == _CLAUSE:
            return self.format_field(value, "").rstrip(".")
        if isinstance(value, str) and format_spec.startswith(_DATE):
            return write_day(value, self.language)
        if isinstance(value, int) and _ONE_OR_MANY in format_spec:
            return self._count(value, *format_spec.split(_ONE_OR_MANY))
        if isinstance(value, Message):
            return render(value, self.language)
        if isinstance(value, tuple):
            inner = _DATE if format_spec.startswith(_DATE) else ""
            format_spec = format_spec.removeprefix(inner)
            parts = (self.format_field(one, inner) for one in value)
            joint = format_spec or ", "
            return (_set_apart(joint) if self.language == "fr" else joint).join(parts)
        text = str(super().format_field(value, format_spec))
        return (
            set_marks(text, self.language) if isinstance(value, int | float) else text
        )

    def _count(self, count: int, one: str, many: str) -> str:
        """Noun with its number: French has the singular for none, too."""
        is_one = count == 1 or (count == 0 and self.language == "fr")
        return (one if is_one else many).replace("#", self.format_field(count, ""))


def load_texts(language: Language) -> Mapping[str, str]:
    """All texts of a language by key."""
    return _Texts(language)


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
    found: dict[str, tuple[str, ...]] = {}
    for file in sorted(folder.iterdir(), key=lambda one: one.name):
        content = file.read_text(encoding="utf-8")
        for table in dict.fromkeys(_TABLE.findall(content)):
            found[table] = (*found.get(table, ()), content)
    return MappingProxyType(found)


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


def list_gaps(text: str) -> frozenset[str]:
    """Names of the arguments that a text asks for."""
    return frozenset(name for _, name, _, _ in string.Formatter().parse(text) if name)
