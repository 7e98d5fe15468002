"""Loads of a check in words; the views of checks come anew."""

from __future__ import annotations

from netdesign.report.words import Words, show_text
from netdesign.study.records import CheckRecord
from netdesign.words.names import name


def describe_widths(
    check: CheckRecord, words: Words
) -> tuple[tuple[str, str, str], ...]:
    """Steps from the solved force to the characteristic action of a support."""
    del check, words
    return ()


def describe_load(check: CheckRecord, words: Words) -> str:
    """Governing load of a demand, with both values; "" where there is one alone."""
    coupled, least = (check.read(check.name_force(load)) for load in "cg")
    if least is None:
        return ""
    first = "guideline" if check.governs == "guideline" else "coupled"
    return words(
        f"show.load_{first}",
        coupled=words.show_with_unit("coupled_kN", coupled),
        guideline=words.show_with_unit("guideline_kN", least),
        case=show_text(words.show(name("load_case", check.load_case))),
    )


def show_loads(check: CheckRecord, words: Words) -> str:
    """Loads in short."""
    return describe_load(check, words)
