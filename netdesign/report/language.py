"""Texts of the reports in other languages: English sentence -> sentence.

English stands in the code, where it is read beside what it describes; the other
languages in ``languages/*.toml``. A missing text stays English.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.resources import files
from typing import Literal

from netdesign.site.columns.all_tables import SHEETS

Language = Literal["en", "fr", "de"]
LANGUAGES: tuple[Language, ...] = ("en", "fr", "de")

_LONGEST = 1000  # longer texts are somebody's, not ours
_GAP = re.compile(r"\{(\w+)(!?)\}")
_NUMBER = r"[\d.]+"
_WITH_UNIT = re.compile(r"(?P<stem>.+?) (?P<unit>\[[^\]]*\])")
_BAND = re.compile(r"(?<=[\d°%]) to (?=[>\d-])")
_SENTENCE = re.compile(r"[^\W\d_]{2,} +[^\W\d_]{3,}")  # two words in a row
_BEFORE_SIGN = re.compile(r" (?=[:;?!%»])")  # French sets these apart from the word


@dataclass(frozen=True, slots=True)
class _Pattern:
    """A sentence with gaps; a gap ``{name!}`` holds words of ours."""

    matches: re.Pattern[str]
    words: tuple[str, ...]
    target: str
    letters: int  # of its own


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Words:
    """Texts in one language.

    Attributes
    ----------
    language : str
        ``en``, ``fr`` or ``de``.
    texts : mapping of str to str
        English text to text; empty for English.
    patterns : tuple
        Sentences with gaps, those with the most letters of their own first.
    """

    language: Language = "en"
    texts: Mapping[str, str] = field(default_factory=dict)
    patterns: tuple[_Pattern, ...] = ()

    def __call__(self, text: str) -> str:
        """Text in this language, or as it is."""
        if self.language == "en":
            return text
        found = self.find(text)
        return text if found is None else found

    def find(self, text: str) -> str | None:
        """Text in this language; None where it is missing."""
        if text in self.texts:
            return self.texts[text]
        if len(text) > _LONGEST:
            return None
        found = self._match(text) or self._translate_stem(text)
        return found or self._translate_parts(text) or self._translate_band(text)

    def _match(self, text: str) -> str | None:
        for pattern in self.patterns:
            match = pattern.matches.fullmatch(text)
            gaps = match.groupdict() if match else {}
            known = {name: self.find(gaps[name]) for name in pattern.words if gaps}
            if match and None not in known.values():
                return _fill(pattern.target, {**gaps, **known})
        return None

    def _translate_stem(self, text: str) -> str | None:
        """``Demand [kN]``: the unit stays."""
        match = _WITH_UNIT.fullmatch(text)
        stem = self.find(match["stem"]) if match else None
        return f"{stem} {match['unit']}" if match and stem is not None else None

    def _translate_parts(self, text: str) -> str | None:
        """Lists and ``place: sentence``, if every part or the sentence is known."""
        for mark in ("; ", ", "):
            parts = text.split(mark)
            if len(parts) > 1:
                found = [self.find(part) for part in parts]
                known = [part for part in found if part is not None]
                if len(known) == len(parts):
                    return mark.join(known)
        head, mark, tail = text.partition(": ")
        sentence = self.find(tail) if mark else None
        return None if sentence is None else f"{self(head)}{self(': ')}{sentence}"

    def _translate_band(self, text: str) -> str | None:
        if _SENTENCE.search(text):  # never half of one
            return None
        shown, count = _BAND.subn(f" {self.texts['to']} ", text)
        return shown if count else None


def _fill(target: str, gaps: Mapping[str, str | None]) -> str:
    return _GAP.sub(lambda gap: gaps[gap[1]] or "", target)


@lru_cache(maxsize=3)
def load_words(language: Language) -> Words:
    """Texts of a language, from its file and from the words of the site workbook."""
    if language == "en":
        return Words()
    file = files(__package__) / "languages" / f"{language}.toml"
    groups = tomllib.loads(file.read_text(encoding="utf-8"))
    texts = _list_labels(language)
    for group in groups.values():
        texts |= {text: _keep_together(target) for text, target in group.items()}
    patterns = [
        _build_pattern(text, target)
        for text, target in texts.items()
        if _GAP.search(text)
    ]
    patterns.sort(key=lambda one: -one.letters)
    return Words(language=language, texts=texts, patterns=tuple(patterns))


def _keep_together(text: str) -> str:
    """Text in which no line begins with a colon or a question mark."""
    return _BEFORE_SIGN.sub("\u00a0", text)


def _list_labels(language: Language) -> dict[str, str]:
    """Names of the inputs, as the site workbook has them."""
    return {
        field.label: field.wordings[language].label
        for plan in reversed(SHEETS)  # a net row's fields count more than a type's
        for field in plan.fields
        if language in field.wordings
    }


def _build_pattern(text: str, target: str) -> _Pattern:
    parts = _GAP.split(text)  # text, name, mark, text, name, mark, ..., text
    expression = re.escape(parts[0])
    for name, rest in zip(parts[1::3], parts[3::3], strict=True):
        inside = _NUMBER if name in ("n", "m") else ".+?"
        expression += f"(?P<{name}>{inside}){re.escape(rest)}"
    words = tuple(name for name, mark in _GAP.findall(text) if mark)
    return _Pattern(re.compile(expression), words, target, len(_GAP.sub("", text)))
