"""Marks of a study: a what-if with its cells, or a stored one that is not verified."""

from __future__ import annotations

from dataclasses import replace

from netdesign.edge.output import PART_MARK, STUDY_FILE, WHAT_IF_MARK
from netdesign.report.blocks import Table, key_columns, text_cell
from netdesign.report.words import (
    MISSING,
    VerdictWords,
    Words,
    show_member,
    show_text,
    show_verdict,
)
from netdesign.site.model import Site
from netdesign.study.records import Study
from netdesign.study.sizing import SizedCell


def name_study(study: Study) -> str:
    """Name of a study's file, as ``check`` writes it."""
    mark = WHAT_IF_MARK if study.what_if else ""
    return f"{mark}{PART_MARK if study.left_out else ''}{STUDY_FILE}"


def mark_verdict(study: Study, words: Words) -> VerdictWords:
    """Verdict of a study in words; that of a what-if is never read without its mark."""
    plain = show_verdict(study.verdict, words)
    if study.left_out:
        rest = words("left_out.meaning", rows=words.join(list(study.left_out)))
        plain = replace(
            plain,
            word=words("left_out.verdict", verdict=plain.word),
            meaning=f"{plain.meaning} {rest}",
        )
    if not study.what_if:
        return plain
    cells = words.join(
        words(
            "show.label",
            label=show_text(cell.cell),
            text=show_text(f"{cell.was or MISSING} → {cell.now}"),
        )
        for cell in study.what_if
    )
    return replace(
        plain,
        word=words("what_if.verdict", verdict=plain.word),
        meaning=words("what_if.meaning", meaning=plain.meaning, cells=cells),
    )


def describe_overall(study: Study, words: Words) -> str:
    """Verdict of a study in one line, with what it means."""
    verdict = mark_verdict(study, words)
    return f"{words('show.overall', verdict=verdict.word)} - {verdict.meaning}"


def title_pages(study: Study | Site, words: Words) -> str:
    """Line that runs along with pages, and stands above a terminal's rows.

    It says what none of them may leave open.
    """
    project = study.project
    texts = (project.number, project.name, project.revision)
    title = " · ".join(show_text(text) for text in texts if text)
    return mark_title(study, title, words)


def mark_title(study: Study | Site, title: str, words: Words) -> str:
    """Title behind the marks of a what-if and of a part of a site."""
    marks = [words("what_if.mark")] if study.what_if else []
    marks += [words("left_out.mark")] if study.left_out else []
    return " · ".join(text for text in (*marks, title) if text)


def name_kind(study: Study, words: Words, *, is_verified: bool) -> str:
    """First line of a report; of a stored study it says whether it was solved again."""
    kind = words("heading.anchor_check")
    if not study.digest:  # made in this run
        return kind
    key = "standing.verified" if is_verified else "standing.not_verified"
    return f"{words(key)} · {kind}"


def build_what_if(study: Study, words: Words) -> Table:
    """Cells that are read otherwise than the workbook has them."""
    keys = ("what_if.cell", "what_if.was", "what_if.now")
    return Table(
        caption=words("what_if.caption"),
        columns=key_columns(words, "", keys),
        rows=tuple(
            (text_cell(cell.cell), text_cell(cell.was), text_cell(cell.now))
            for cell in study.what_if
        ),
    )


def describe_sized(cell: SizedCell, words: Words) -> str:
    """Line on the smallest type that was found, or that none was."""
    place = {
        "row": show_text(cell.row_id),
        "member": show_member(words, cell.column),
        "cell": cell.cell,
        "was": cell.was or MISSING,
    }
    if not cell.cell:
        return words("what_if.no_cell", **place)
    if not cell.now:
        text = words("what_if.no_type", **place, count=cell.tried)
        if not cell.left_out:
            return text
        left_out = words("what_if.other_ground", count=cell.left_out)
        return words.join((text, left_out))
    used = words.show_number("utilisation", cell.used)
    return words("what_if.type", **place, now=cell.now, used=used)
