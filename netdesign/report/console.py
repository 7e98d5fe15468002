"""Standard output as a terminal or a pipe has it: its width, and lines of text."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console

_PIPE = 160  # columns of an output that is no terminal, where no line is folded


def open_console() -> Console:
    """Standard output, as wide as the terminal; wide in a pipe or a file."""
    from rich.console import Console

    console = Console()
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = _PIPE
    return console


def print_lines(lines: Iterable[str], console: Console) -> None:
    """Print lines of text, which the terminal may wrap."""
    from rich.text import Text

    for line in lines:
        console.print(Text(line), soft_wrap=True)
