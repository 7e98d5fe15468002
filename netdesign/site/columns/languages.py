"""Texts of the site workbook in its three languages, from ``words/*.toml``."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from importlib.resources import files
from typing import Any

from netdesign.site.columns.fields import Field, Language, SheetPlan, Wording

_TRANSLATED = ("fr", "de")  # English stands in columns.py, beside the fields


@lru_cache(maxsize=3)
def load_words(language: str) -> Mapping[str, Any]:
    """Tables of a language's file, by sheet, then field."""
    file = files(__package__) / "words" / f"{language}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def load_text(language: Language) -> Mapping[str, str]:
    """General texts of the workbook; a missing one in English."""
    return {**load_words("en")["text"], **load_words(language)["text"]}


def word_field(field: Field, table: str) -> Field:
    """Give a field its texts in the other languages; ``table`` names its sheet."""
    found = {
        language: _read_wording(load_words(language)[table][field.key], field)
        for language in _TRANSLATED
        if field.key in load_words(language).get(table, {})
    }
    return replace(field, wordings=found, table=table)


def word_plan(plan: SheetPlan) -> SheetPlan:
    """Give a sheet and its fields their texts in the other languages."""
    names = {
        language: load_words(language)[plan.name]["name"]
        for language in _TRANSLATED
        if plan.name in load_words(language)
    }
    fields = tuple(word_field(field, plan.name) for field in plan.fields)
    return replace(plan, names=names, fields=fields)


def _read_wording(texts: Mapping[str, Any], field: Field) -> Wording:
    return Wording(
        label=texts.get("label", field.label),
        aliases=tuple(texts.get("aliases", ())),
        note=texts.get("note", field.note),
        words={word: tuple(names) for word, names in texts.get("words", {}).items()},
    )
