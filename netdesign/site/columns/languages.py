"""Texts of the site workbook in its three languages, from ``words/*.toml``.

Names of sheets and columns are not among them: refusals and reports tell them too,
so they stand in ``netdesign/words``.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import lru_cache
from importlib.resources import files
from typing import Any

from netdesign.site.columns.fields import LANGUAGES, Language, Wording
from netdesign.words.catalogue import render
from netdesign.words.message import Message


@lru_cache(maxsize=3)
def load_words(language: str) -> Mapping[str, Any]:
    """Tables of a language's file, by sheet, then field."""
    file = files(__package__) / "words" / f"{language}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def load_text(language: Language) -> Mapping[str, str]:
    """General texts of the workbook; a missing one in English."""
    return {**load_words("en")["text"], **load_words(language)["text"]}


def list_wordings(table: str, key: str, name: Message) -> Mapping[str, Wording]:
    """Texts of a field of this name by language; ``table`` is its sheet or list."""
    return {
        language: _read_wording(
            load_words(language).get(table, {}).get(key, {}), render(name, language)
        )
        for language in LANGUAGES
    }


def _read_wording(texts: Mapping[str, Any], label: str) -> Wording:
    return Wording(
        label=label,
        aliases=tuple(texts.get("aliases", ())),
        note=texts.get("note", ""),
        words={word: tuple(names) for word, names in texts.get("words", {}).items()},
    )
