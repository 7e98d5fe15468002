"""Summary of a study -> a terminal; nothing else of the study is needed."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

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
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RowLine:
    """One net row with its governing check, in words.

    ``style`` of the verdict is "pass", "fail", "not-proven" or "declared"; ``reason``
    is "" of a pass.
    """

    id: str
    verdict: str
    style: str
    check: str
    utilisation: str
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Summary:
    """Plain texts of a study, for a terminal; a store can keep them.

    Attributes
    ----------
    mark : str
        Mark of a what-if; "" of the site as built.
    lines : tuple of str
        Counts, and what is open, below the table.
    overall, meaning : str
        What stands before and behind the verdict of the whole.
    style : str
        Of that verdict, as in `RowLine`.
    changes : tuple of str
        What ``--explain`` adds.
    """

    headings: Headings
    rows: tuple[RowLine, ...]
    mark: str
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
    """Print one line per net row, the verdict, what is open, and explanations.

    Colour, width and destination are those of ``console``; texts of the site
    are never read as markup.
    """
    from rich.text import Text

    if summary.mark:
        console.print(Text(summary.mark, style="bold"), soft_wrap=True)
    if summary.rows:
        console.print(_build_table(summary))
    overall = Text(summary.overall).append_text(_word(summary))
    console.print(overall.append(f" - {summary.meaning}"), soft_wrap=True)
    print_lines(summary.lines, console)
    print_lines(summary.changes, console)


def print_lines(lines: tuple[str, ...], console: Console) -> None:
    """Print lines of text, which the terminal may wrap."""
    from rich.text import Text

    for line in lines:
        console.print(Text(line), soft_wrap=True)


def _build_table(summary: Summary) -> Table:
    from rich.table import Table

    headings = summary.headings
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(headings.row, overflow="fold", min_width=4)
    table.add_column(headings.verdict, no_wrap=True)
    table.add_column(headings.check, overflow="fold", min_width=13)
    table.add_column(headings.utilisation, justify="right", no_wrap=True)
    table.add_column(headings.reason, overflow="fold")
    for row in summary.rows:
        table.add_row(*_list_cells(row))
    return table


def _list_cells(row: RowLine) -> list[Text]:
    from rich.text import Text

    texts = [row.check, row.utilisation, row.reason]
    return [Text(row.id), _word(row), *map(Text, texts)]


def _word(shown: RowLine | Summary) -> Text:
    from rich.text import Text

    return Text(shown.verdict, style=_STYLES[shown.style])
