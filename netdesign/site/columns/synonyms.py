"""Further headings of the workbook, by language, from ``synonyms/*.toml``.

They are data: an office's way of writing is added there, and a test says where one
heading would stand for two fields. Italian is read, though the program does not speak
it.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import lru_cache
from importlib.resources import files
from typing import Any

LANGUAGES = ("en", "fr", "de", "it")


@lru_cache(maxsize=5)
def load_synonyms(name: str) -> Mapping[str, Any]:
    """Tables of one language, or those of ``signs``."""
    file = files(__package__) / "synonyms" / f"{name}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def find_headings_of(table: str, key: str) -> tuple[str, ...]:
    """Further headings of a field, in every language."""
    tables = (load_synonyms(language) for language in LANGUAGES)
    return tuple(name for one in tables for name in one.get(table, {}).get(key, ()))


def find_sheet_names(sheet: str) -> tuple[str, ...]:
    """Further names of a sheet, in every language."""
    return find_headings_of("sheets", sheet)


def find_words_of(key: str) -> Mapping[str, tuple[str, ...]]:
    """Further spellings of the words of a field, in every language."""
    found: dict[str, tuple[str, ...]] = {}
    for language in LANGUAGES:
        for word, names in load_synonyms(language)["words"].get(key, {}).items():
            found[word] = (*found.get(word, ()), *names)
    return found


def find_unclear_of(sheet: str) -> Mapping[str, tuple[str, ...]]:
    """Headings that may mean several fields of a sheet, with the keys of these."""
    found: dict[str, tuple[str, ...]] = {}
    for language in LANGUAGES:
        for key, names in load_synonyms(language)["unclear"].get(sheet, {}).items():
            for name in names:
                found[name] = (*found.get(name, ()), key)
    return found
