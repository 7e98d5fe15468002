"""Annex of the limit profile: every value with its status and source."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

from netdesign.report.blocks.block import Paragraph, Part, section
from netdesign.report.blocks.table import (
    Cell,
    Table,
    given_cell,
    name_columns,
    text_cell,
)
from netdesign.report.words import Words, show_own, show_text, show_unit
from netdesign.study.records import ProfileRecord, Study
from netdesign.words.names import name

_ASSUMED = "assumed"  # status of a value that nobody has confirmed


def show_profile(study: Study, words: Words) -> Part:
    """Annex with the values of the profile; sources that recur have numbers."""
    numbered, sources = _number_sources(build_profile(study, words))
    return section(
        "annex-profile",
        words("heading.annex_profile"),
        Paragraph(text=name_profile(study, words)),
        numbered.shown("profile"),
        *(Paragraph(text=source, look="small") for source in sources),
    )


def build_profile(study: Study, words: Words) -> Table:
    """Values of the limit profile."""
    keys = ("clause", "value_of", "value", "unit", "status", "source")
    headings = [words(f"heading.{key}") for key in keys]
    return Table(
        caption=words("caption.every_value"),
        columns=name_columns(headings, numbers=(words("heading.value"),)),
        rows=tuple(
            (
                text_cell(value.clause),
                text_cell(show_own(words, value.text)),
                given_cell(words, value.value),
                text_cell(show_unit(value.unit)),
                text_cell(words.show(name("status", value.status))),
                text_cell(show_own(words, value.source)),
            )
            for value in study.profile.values
        ),
        empty=words("show.none"),
    )


def _number_sources(table: Table) -> tuple[Table, tuple[str, ...]]:
    """The table with a number for each source that several values have, and those."""
    counts = Counter(cells[-1].text for cells in table.rows)
    shared = [source for source, count in counts.items() if count > 1]
    numbers = {source: f"[{k}]" for k, source in enumerate(shared, 1)}
    rows = tuple(
        (*cells[:-1], Cell(text=numbers.get(cells[-1].text, cells[-1].text)))
        for cells in table.rows
    )
    told = tuple(f"{number} {source}" for source, number in numbers.items())
    return replace(table, rows=rows), told


def name_profile(study: Study, words: Words) -> str:
    """Title and edition of the limit profile."""
    return show_own(words, f"{study.profile.title}, {study.profile.edition}")


def count_assumed(study: Study) -> tuple[int, int]:
    """Values of the profile that nobody has confirmed, and all of them."""
    values = study.profile.values
    return sum(one.status == _ASSUMED for one in values), len(values)


def list_below_one(profile: ProfileRecord, words: Words) -> tuple[str, ...]:
    """Factors below 1, each with the reason that the profile gives."""
    return tuple(
        words(
            "show.label",
            label=f"{show_own(words, value.text)} = "
            f"{words.show_quantity(value.value, value.unit)}",
            text=words("note.below_one", reason=show_text(value.reason_below_one)),
        )
        for value in profile.values
        if value.reason_below_one
    )
