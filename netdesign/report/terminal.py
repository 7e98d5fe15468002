"""Study -> a compact summary on a terminal."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from netdesign.report.view.row_tables import describe_flip, is_far_from_limit
from netdesign.report.view.whole import ReportView, RowView, build_view
from netdesign.report.words import (
    MISSING,
    VerdictWords,
    Words,
    show_check,
    show_text,
)
from netdesign.study.records import ChangeRecord, Study
from netdesign.words.catalogue import Language

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

_NARROW = 100  # consoles of fewer columns: no bands, cases below their checks
_PIPE = 160  # columns of an output that is no terminal, where no line is folded
_STYLES = {
    "pass": "green",
    "fail": "bold red",
    "not-proven": "yellow",
    "declared": "cyan",
}


def open_console() -> Console:
    """Standard output, as wide as the terminal; wide in a pipe or a file."""
    from rich.console import Console

    console = Console()
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = _PIPE
    return console


def print_summary(
    study: Study,
    console: Console,
    language: Language = "en",
    view: ReportView | None = None,
) -> None:
    """Print one line per net row, then reasons and assumed values.

    Colour, width and destination are those of ``console``; texts of the site
    are never read as markup. ``view`` is that of the study, if it is known.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    from rich.table import Table
    from rich.text import Text

    words, view = Words(language), view or build_view(study, language)
    is_narrow = console.width < _NARROW
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(words("heading.net_row"), overflow="fold", min_width=4)
    table.add_column(words("heading.verdict"), no_wrap=True)
    table.add_column(words("heading.governing_check"), overflow="fold", min_width=13)
    ratio = "heading.utilisation" if is_narrow else "show.utilisation_band"
    table.add_column(words(ratio), no_wrap=True)
    for heading in ("heading.demand", "heading.resistance"):
        table.add_column(words(heading), justify="right", no_wrap=True)
    if not is_narrow:
        table.add_column(words("heading.case"), no_wrap=True)
    none = words("heading.no_check")
    for row in view.rows:
        table.add_row(*_list_cells(row, none, is_narrow=is_narrow))
    if view.mark:
        console.print(Text(view.mark, style="bold"), soft_wrap=True)
    if view.rows:
        console.print(table)
        legend = Text(view.legend)
        console.print(legend, style="dim", soft_wrap=True)
    for line in _list_lines(view, words):
        console.print(Text(line), soft_wrap=True)
    overall = Text(words("show.overall", verdict="")).append_text(_word(view.verdict))
    console.print(overall.append(f" - {view.verdict.meaning}"), soft_wrap=True)


def print_changes(study: Study, console: Console, language: Language = "en") -> None:
    """Print what would flip each failing, unproven or close check."""
    from rich.text import Text

    words = Words(language)
    for row in study.rows:
        for check in row.checks:
            place = words(
                "show.row_and_check",
                row=row.id,
                check=show_check(words, check),
                verdict=words(f"verdict.{check.verdict}"),
            )
            for change in check.changes:
                told = _describe_change(change, words)
                text = words("show.label", label=place, text=told)
                console.print(Text(show_text(text)), soft_wrap=True)
    checks = [check for row in study.rows for check in row.checks]
    if not any(check.changes for check in checks):
        is_far = all(map(is_far_from_limit, checks))
        console.print(words("show.no_change" if is_far else "show.no_change_alone"))


def _describe_change(change: ChangeRecord, words: Words) -> str:
    text = describe_flip(change, words)
    if change.bound is not None:
        text = words("show.passes_with", change=text)
    if change.solves == 1:
        text = words("show.after_one_solve", change=text)
    elif change.solves:
        text = words("show.after_solves", change=text, count=change.solves)
    if change.note is None:
        return text
    return words("show.with_note", text=text, note=words.show(change.note))


def _list_cells(row: RowView, none: str, *, is_narrow: bool) -> list[Text]:
    from rich.text import Text

    check = row.governing
    if check is None:
        texts = [none, *[MISSING] * 4]
    else:
        ratio, band = check.utilisation, check.band
        has_band = not is_narrow and band != MISSING
        texts = [
            f"{check.title}\n{check.case_short}" if is_narrow else check.title,
            f"{ratio} ({band})" if has_band else ratio,
            check.demand,
            check.resistance,
            check.case_short,
        ]
    shown = texts[:-1] if is_narrow else texts
    return [Text(row.id), _word(row.verdict), *map(Text, shown)]


def _list_lines(view: ReportView, words: Words) -> list[str]:
    def name(label: str, text: str) -> str:
        return words("show.label", label=label, text=text)

    lines = [name(row.id, reason) for row in view.rows for reason in row.reasons]
    lines = lines or [words("show.reasons_none")]
    lines += [
        name(words("show.label", label=row.id, text=row.governing.title), load)
        for row in view.rows
        if row.governing and (load := row.governing.load)
    ]
    lines += [name(label, text) for label, text in view.counts]
    lines += [name(words("heading.declared_elsewhere"), one) for one in view.declared]
    assumed = view.assumed_line or words("show.none")
    notes = [words("show.note", note=note) for note in view.notes]
    return [*lines, words("show.assumed_line", values=assumed), *notes]


def _word(verdict: VerdictWords) -> Text:
    from rich.text import Text

    return Text(verdict.word, style=_STYLES[verdict.style])
