"""A view in another language: words of ours are replaced, all else stays."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from html import escape, unescape
from typing import Any, TypeVar

from netdesign.report.language import Words
from netdesign.report.view.check_view import CheckView, Step, Worked
from netdesign.report.view.table import Cell, Column, Table
from netdesign.report.view.whole import EXPLANATION, ReportView, RowView, build_view
from netdesign.report.words import VerdictWords
from netdesign.study.records import Study

Translate = Callable[[str], str]
View = TypeVar("View")

# Fields that hold words of ours; the others hold numbers, keys, or what somebody typed.
_WORDS: dict[type, tuple[str, ...]] = {
    Table: ("caption", "empty"),
    Column: ("heading",),
    VerdictWords: ("word", "meaning"),
    CheckView: ("title", "resistance_basis", "band", "reason"),
    Step: ("numbers", "result"),
    Worked: ("title", "needed"),
    RowView: (
        *("counts", "reasons", "unloaded", "flips", "searched"),
        *("guideline_sentence", "notes"),
    ),
    ReportView: ("counts", "scope", "notes", "profile_title"),
}
_TEXT = re.compile(r"(?<=>)[^<>]+(?=</text>)")
_LABEL = re.compile(r'(?<= aria-label=")[^"]+(?=")')


def show_study(study: Study, words: Translate) -> ReportView:
    """All that page, workbook and terminal print about a study, in a language.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    view = build_view(study)
    return view if is_english(words) else translate_view(view, words)


def is_english(words: Translate) -> bool:
    """Every text stays as it is."""
    return isinstance(words, Words) and words.language == "en"


def translate_view(view: View, words: Translate) -> View:
    """View with its words in another language, and the labels of its project.

    Parameters
    ----------
    view : ReportView, or a part of it
        As ``build_view`` gives it.
    words : callable
        Text to text.
    """
    shown: Any = view
    if isinstance(view, Cell):
        return replace(shown, text=words(view.text)) if view.is_words else view
    if isinstance(view, tuple):
        return tuple(translate_view(part, words) for part in shown)  # type: ignore[return-value]
    if not is_dataclass(view):
        return view
    ours = _WORDS.get(type(view), ())
    changed = {
        one.name: _translate_texts(getattr(view, one.name), words)
        if one.name in ours
        else translate_view(getattr(view, one.name), words)
        for one in fields(view)
    }
    if isinstance(view, ReportView):
        changed["identification"] = tuple(
            (words(label), words(text) if label == "Limit profile" else text)
            for label, text in view.identification
        )
        changed["verification"] = tuple(
            (words(label), words(text) if text == EXPLANATION else text)
            for label, text in view.verification
        )
    translated: View = replace(shown, **changed)
    return translated


def _translate_texts(texts: Any, words: Translate) -> Any:
    """A text, or a tuple of texts of any depth."""
    if isinstance(texts, str):
        return words(texts)
    return tuple(_translate_texts(text, words) for text in texts)


def translate_drawing(svg: str, words: Translate) -> str:
    """Drawing with its texts in another language: in an SVG text stays text."""
    if is_english(words):
        return svg

    def exchange(match: re.Match[str]) -> str:
        return escape(words(unescape(match[0])))

    return _LABEL.sub(exchange, _TEXT.sub(exchange, svg))
