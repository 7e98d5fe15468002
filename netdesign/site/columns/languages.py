"""Texts of the site workbook in its three languages, from ``words/*.toml``.

Names of sheets and columns are not among them: refusals and reports tell them too,
so they stand in ``netdesign/words``.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from importlib.resources import files
from typing import Any

from netdesign.site.columns.fields import Field, Language, SheetPlan, Wording
from netdesign.site.columns.synonyms import (
    find_headings_of,
    find_sheet_names,
    find_unclear_of,
    find_words_of,
)
from netdesign.words.catalogue import render

# English stands in all_tables.py, beside the fields
_TRANSLATED: tuple[Language, ...] = ("fr", "de")


@lru_cache(maxsize=3)
def load_words(language: str) -> Mapping[str, Any]:
    """Tables of a language's file, by sheet, then field."""
    file = files(__package__) / "words" / f"{language}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def load_text(language: Language) -> Mapping[str, str]:
    """General texts of the workbook; a missing one in English."""
    return {**load_words("en")["text"], **load_words(language)["text"]}


def word_field(field: Field, table: str) -> Field:
    """Field with its texts in the other languages; ``table`` names its sheet."""
    own = replace(field, table=table)
    found: dict[str, Wording] = {
        language: _read_wording(load_words(language)[table][field.key], own, language)
        for language in _TRANSLATED
        if field.key in load_words(language).get(table, {})
    }
    return replace(
        own,
        label=render(own.name, "en"),
        wordings=found,
        synonyms=find_headings_of(table, field.key),
        further_words=find_words_of(field.key) if field.words else {},
    )


def word_plan(plan: SheetPlan) -> SheetPlan:
    """Sheet and its fields with their texts in the other languages."""
    names: dict[str, str] = {
        language: render(plan.title, language) for language in _TRANSLATED
    }
    return replace(
        plan,
        names=names,
        aliases=(*plan.aliases, *find_sheet_names(plan.name)),
        fields=tuple(word_field(field, plan.name) for field in plan.fields),
        unclear=_join(plan.unclear, find_unclear_of(plan.name)),
    )


def _join(
    one: Mapping[str, tuple[str, ...]], other: Mapping[str, tuple[str, ...]]
) -> dict[str, tuple[str, ...]]:
    """Unclear headings of two tables, with the fields that either gives."""
    names = dict.fromkeys((*one, *other))
    return {
        name: tuple(dict.fromkeys((*one.get(name, ()), *other.get(name, ()))))
        for name in names
    }


def _read_wording(
    texts: Mapping[str, Any], field: Field, language: Language
) -> Wording:
    return Wording(
        label=render(field.name, language),
        aliases=tuple(texts.get("aliases", ())),
        note=texts.get("note", field.note),
        words={word: tuple(names) for word, names in texts.get("words", {}).items()},
    )
