"""Standard output as a terminal or a pipe has it: its width, and lines of text."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Iterable
from typing import TYPE_CHECKING

from netdesign.edge.output import spell

if TYPE_CHECKING:
    from rich.console import Console

_PIPE = 160  # columns of an output that is no terminal, where no line is folded


def open_console(*, err: bool = False) -> Console:
    """Standard output or error, as wide as the terminal; wide in a pipe or a file."""
    from rich.console import Console

    console = Console(stderr=err)
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width, console.soft_wrap = _PIPE, True
    return console


def print_lines(lines: Iterable[str], console: Console, indent: int = 0) -> None:
    """Print sentences; on a terminal each is folded between words.

    Parameters
    ----------
    lines : iterable of str
        Sentences, without line ends.
    console : rich.console.Console
        Where they are printed.
    indent : int
        Blanks before the second and each later line of a sentence.
    """
    from rich.text import Text

    width = max(console.width, 2 * indent + 1)
    for line in lines:
        text = spell(line, console.encoding)
        folded = [text]
        if not console.soft_wrap:
            folded = textwrap.wrap(
                text,
                width,
                subsequent_indent=" " * indent,
                break_on_hyphens=False,
            ) or [""]
        for part in folded:
            console.print(Text(part), soft_wrap=True)
