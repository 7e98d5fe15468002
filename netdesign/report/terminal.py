"""Study -> a compact summary on a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from netdesign.report.row_tables import describe_change
from netdesign.report.view import ReportView, RowView, build_view
from netdesign.report.words import (
    MISSING,
    VERDICTS,
    VerdictWords,
    name_check,
    show_text,
)
from netdesign.study import Study

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

_LEGEND = "Design values in kN. Case: density kg/m3 / friction deg / inclination deg."
_STYLES = {"pass": "green", "fail": "bold red", "not-proven": "yellow"}


def print_summary(study: Study, console: Console) -> None:
    """Print one line per net row, then reasons and assumed values.

    Colour, width and destination are those of ``console``; texts of the site
    are never read as markup.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    from rich.table import Table
    from rich.text import Text

    view = build_view(study)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for heading in (
        "Net row",
        "Verdict",
        "Governing check",
        "Utilisation (low to high)",
    ):
        table.add_column(heading, overflow="fold", no_wrap=heading == "Verdict")
    for heading in ("Demand", "Resistance"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("Case", no_wrap=True)
    for row in view.rows:
        table.add_row(*_list_cells(row))
    if view.rows:
        console.print(table)
        console.print(_LEGEND, style="dim", soft_wrap=True)
    for line in _list_lines(view):
        console.print(Text(line), soft_wrap=True)
    overall = Text("Verdict: ").append_text(_word(view.verdict))
    console.print(overall.append(f" - {view.verdict.meaning}"), soft_wrap=True)


def print_changes(study: Study, console: Console) -> None:
    """Print for every failing, unproven or close check what would flip it."""
    from rich.text import Text

    for row in study.rows:
        for check in row.checks:
            for change in check.changes:
                words = VERDICTS[check.verdict].word
                passes = "passes with " if change.bound is not None else ""
                text = f"{row.id} {name_check(check)} ({words}): {passes}"
                text += describe_change(change)
                if change.now is not None:
                    text += f", now {change.now:.6g} {change.unit}"
                text += f"; {change.solves} solves" if change.solves else ""
                text += f" ({change.note})" if change.note else ""
                console.print(Text(show_text(text)), soft_wrap=True)
    if not any(check.changes for row in study.rows for check in row.checks):
        console.print("No check fails, is unproven or is close to its limit.")


def _list_cells(row: RowView) -> list[Text]:
    from rich.text import Text

    check = row.governing
    if check is None:
        texts = ["none: no check was made", *[MISSING] * 4]
    else:
        ratio = check.utilisation
        texts = [
            check.title,
            f"{ratio} ({check.band})" if check.band != MISSING else ratio,
            check.demand,
            check.resistance,
            check.case_short,
        ]
    return [Text(row.id), _word(row.verdict), *map(Text, texts)]


def _list_lines(view: ReportView) -> list[str]:
    lines = [f"{row.id}: {reason}" for row in view.rows for reason in row.reasons]
    lines = lines or ["Reasons: none"]
    lines += [f"{label}: {text}" for label, text in view.counts]
    title = "Assumed, confirm in your copy of the standard"
    notes = [f"Note: {note}" for note in view.notes]
    return [*lines, f"{title}: {view.assumed_line}", *notes]


def _word(verdict: VerdictWords) -> Text:
    from rich.text import Text

    return Text(verdict.word, style=_STYLES[verdict.style])
