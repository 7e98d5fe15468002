"""Study -> a compact summary on a terminal."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING

from netdesign.report.translation import show_study
from netdesign.report.view.row_tables import describe_flip
from netdesign.report.view.whole import ReportView, RowView
from netdesign.report.words import (
    MISSING,
    VERDICTS,
    VerdictWords,
    name_check,
    show_text,
)
from netdesign.study.records import ChangeRecord, Study

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

_LEGEND = "Design values in kN. Case: density kg/m3 / friction deg / inclination deg."
_NARROW = 100  # consoles of fewer columns: no bands, cases below their checks
_PIPE = 160  # columns where the output is no terminal: nobody has to fold it
_STYLES = {"pass": "green", "fail": "bold red", "not-proven": "yellow"}


def open_console() -> Console:
    """Standard output, as wide as the terminal; wide in a pipe or a file."""
    from rich.console import Console

    console = Console()
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = _PIPE
    return console


def print_summary(
    study: Study, console: Console, words: Callable[[str], str] = str
) -> None:
    """Print one line per net row, then reasons and assumed values.

    Colour, width and destination are those of ``console``; texts of the site
    are never read as markup. ``words`` puts ours into another language.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    from rich.table import Table
    from rich.text import Text

    view = show_study(study, words)
    is_narrow = console.width < _NARROW
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(words("Net row"), overflow="fold", min_width=4)
    table.add_column(words("Verdict"), no_wrap=True)
    table.add_column(words("Governing check"), overflow="fold", min_width=13)
    ratio = "Utilisation" if is_narrow else "Utilisation (low to high)"
    table.add_column(words(ratio), no_wrap=True)
    for heading in ("Demand", "Resistance"):
        table.add_column(words(heading), justify="right", no_wrap=True)
    if not is_narrow:
        table.add_column(words("Case"), no_wrap=True)
    none = words("none: no check was made")
    for row in view.rows:
        table.add_row(*_list_cells(row, none, is_narrow=is_narrow))
    if view.rows:
        console.print(table)
        console.print(words(_LEGEND), style="dim", soft_wrap=True)
    for line in _list_lines(view, words):
        console.print(Text(line), soft_wrap=True)
    overall = Text(f"{words('Verdict')}{words(': ')}").append_text(_word(view.verdict))
    console.print(overall.append(f" - {view.verdict.meaning}"), soft_wrap=True)


def print_changes(
    study: Study, console: Console, words: Callable[[str], str] = str
) -> None:
    """Print for every failing, unproven or close check what would flip it."""
    from rich.text import Text

    for row in study.rows:
        for check in row.checks:
            place = f"{row.id} {words(name_check(check))}"
            place += f" ({words(VERDICTS[check.verdict].word)})"
            for change in check.changes:
                text = f"{place}: {_describe_change(change, words)}"
                console.print(Text(show_text(text)), soft_wrap=True)
    if not any(check.changes for row in study.rows for check in row.checks):
        console.print(words("No check fails, is unproven or is close to its limit."))


def _describe_change(change: ChangeRecord, words: Callable[[str], str]) -> str:
    passes = f"{words('passes with')} " if change.bound is not None else ""
    text = f"{passes}{words(describe_flip(change))}"
    if change.solves:
        unit = "solve" if change.solves == 1 else "solves"
        text += f"; {change.solves} {words(unit)}"
    return f"{text} ({words(str(change.note))})" if change.note else text


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


def _list_lines(view: ReportView, words: Callable[[str], str]) -> list[str]:
    lines = [f"{row.id}: {reason}" for row in view.rows for reason in row.reasons]
    lines = lines or [words("Reasons: none")]
    lines += [f"{label}{words(': ')}{text}" for label, text in view.counts]
    title = words("Assumed: confirm in your copy of the standard")
    colon = words(": ")
    notes = [f"{words('Note')}{colon}{note}" for note in view.notes]
    return [*lines, f"{title}{colon}{view.assumed_line or words('none')}", *notes]


def _word(verdict: VerdictWords) -> Text:
    from rich.text import Text

    return Text(verdict.word, style=_STYLES[verdict.style])
