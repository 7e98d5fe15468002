"""Help in the language of the run, as click shows it."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import Any

import click

from netdesign.commands.help_texts import HelpTexts, load_help
from netdesign.commands.language import find_language


class ToldFormatter(click.HelpFormatter):
    """Writes what click has to say in a language."""

    def __init__(self, told: HelpTexts, **widths: Any) -> None:
        super().__init__(**widths)
        self.told = told

    def write_usage(self, prog: str, args: str = "", prefix: str | None = None) -> None:
        """Write the line on usage."""
        start = f"{self.told.tell('Usage')}: " if prefix is None else prefix
        super().write_usage(prog, self.told.tell_signs(args), start)

    def write_heading(self, heading: str) -> None:
        """Write a heading."""
        super().write_heading(self.told.tell(heading))

    def write_text(self, text: str) -> None:
        """Write the paragraphs of a command's help."""
        super().write_text(self.told.tell_paragraphs(text))

    def write_dl(
        self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2
    ) -> None:
        """Write names with their descriptions."""
        told = [
            (self.told.tell_signs(name), self.told.tell_option(text))
            for name, text in rows
        ]
        super().write_dl(told, col_max, col_spacing)


class ToldContext(click.Context):
    """Context of a command whose help is in the language of the run."""

    def make_formatter(self) -> click.HelpFormatter:
        """Formatter of the help; that of click for English."""
        root = self.find_root().command
        if not isinstance(root, click.Group):  # one command by itself, as tests run it
            return super().make_formatter()
        told = load_help(find_language(root, sys.argv[1:]))
        if told is None:
            return super().make_formatter()
        return ToldFormatter(
            told, width=self.terminal_width, max_width=self.max_content_width
        )


def tell_help(command: click.Command) -> None:
    """Let the help of a command, and of all below it, be in the language of the run."""
    command.context_class = ToldContext
    for one in getattr(command, "commands", {}).values():
        tell_help(one)
