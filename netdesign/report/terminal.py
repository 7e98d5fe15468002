"""Summary of a study -> a terminal; nothing else of the study is needed."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

_NARROW = 100  # consoles of fewer columns: no bands, cases below their checks
_PIPE = 160  # columns of an output that is no terminal, where no line is folded
_STYLES = {
    "pass": "green",
    "fail": "bold red",
    "not-proven": "yellow",
    "declared": "cyan",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Headings:
    """Headings of the table of net rows, in the language of the summary."""

    row: str
    verdict: str
    check: str
    utilisation: str
    utilisation_band: str
    demand: str
    resistance: str
    case: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RowLine:
    """One net row with its governing check, in words.

    Attributes
    ----------
    style : str
        Of the verdict: "pass", "fail", "not-proven" or "declared".
    check_and_case : str
        Governing check with its case below, for narrow consoles.
    band : str
        Of the utilisation; "" where there is none.
    """

    id: str
    verdict: str
    style: str
    check: str
    check_and_case: str
    utilisation: str
    band: str
    demand: str
    resistance: str
    case: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Summary:
    """Plain texts of a study, for a terminal; a store can keep them.

    Attributes
    ----------
    mark : str
        Mark of a what-if; "" of the site as built.
    lines : tuple of str
        Reasons, loads, counts, assumed values and notes, below the table.
    overall, meaning : str
        What stands before and behind the verdict of the whole.
    style : str
        Of that verdict, as in `RowLine`.
    changes : tuple of str
        What would flip each check, where that was asked for.
    """

    headings: Headings
    rows: tuple[RowLine, ...]
    mark: str
    legend: str
    lines: tuple[str, ...]
    overall: str
    verdict: str
    style: str
    meaning: str
    changes: tuple[str, ...] = ()


def open_console() -> Console:
    """Standard output, as wide as the terminal; wide in a pipe or a file."""
    from rich.console import Console

    console = Console()
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = _PIPE
    return console


def print_summary(summary: Summary, console: Console) -> None:
    """Print one line per net row, then reasons and assumed values, then changes.

    Colour, width and destination are those of ``console``; texts of the site
    are never read as markup.
    """
    from rich.text import Text

    if summary.mark:
        console.print(Text(summary.mark, style="bold"), soft_wrap=True)
    if summary.rows:
        console.print(_build_table(summary, is_narrow=console.width < _NARROW))
        console.print(Text(summary.legend), style="dim", soft_wrap=True)
    print_lines(summary.lines, console)
    overall = Text(summary.overall).append_text(_word(summary))
    console.print(overall.append(f" - {summary.meaning}"), soft_wrap=True)
    print_lines(summary.changes, console)


def print_lines(lines: tuple[str, ...], console: Console) -> None:
    """Print lines of text, which the terminal may wrap."""
    from rich.text import Text

    for line in lines:
        console.print(Text(line), soft_wrap=True)


def _build_table(summary: Summary, *, is_narrow: bool) -> Table:
    from rich.table import Table

    headings = summary.headings
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(headings.row, overflow="fold", min_width=4)
    table.add_column(headings.verdict, no_wrap=True)
    table.add_column(headings.check, overflow="fold", min_width=13)
    ratio = headings.utilisation if is_narrow else headings.utilisation_band
    table.add_column(ratio, no_wrap=True)
    for heading in (headings.demand, headings.resistance):
        table.add_column(heading, justify="right", no_wrap=True)
    if not is_narrow:
        table.add_column(headings.case, no_wrap=True)
    for row in summary.rows:
        table.add_row(*_list_cells(row, is_narrow=is_narrow))
    return table


def _list_cells(row: RowLine, *, is_narrow: bool) -> list[Text]:
    from rich.text import Text

    if is_narrow:
        texts = [row.check_and_case, row.utilisation, row.demand, row.resistance]
    else:
        ratio = f"{row.utilisation} ({row.band})" if row.band else row.utilisation
        texts = [row.check, ratio, row.demand, row.resistance, row.case]
    return [Text(row.id), _word(row), *map(Text, texts)]


def _word(shown: RowLine | Summary) -> Text:
    from rich.text import Text

    return Text(shown.verdict, style=_STYLES[shown.style])
