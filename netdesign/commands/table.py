"""Commands by name, imported when asked for; help in the language of the run."""

from __future__ import annotations

import sys
from collections import UserDict
from collections.abc import Iterable
from importlib import import_module
from typing import Any

import click

from netdesign.commands.config import accept_variables, find_language
from netdesign.commands.help_texts import HelpTexts, load_help


class LanguageFormatter(click.HelpFormatter):
    """Writes what click has to say in a language."""

    def __init__(self, told: HelpTexts, **widths: Any) -> None:
        super().__init__(**widths)
        self.told = told

    def write_usage(self, prog: str, args: str = "", prefix: str | None = None) -> None:
        """Write the line on usage."""
        start = f"{self.told.tell('Usage')}: " if prefix is None else prefix
        super().write_usage(prog, self.told.translate_signs(args), start)

    def write_heading(self, heading: str) -> None:
        """Write a heading."""
        super().write_heading(self.told.tell(heading))

    def write_text(self, text: str) -> None:
        """Write the paragraphs of a command's help."""
        super().write_text(self.told.translate_paragraphs(text))

    def write_dl(
        self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2
    ) -> None:
        """Write names with their descriptions."""
        told = [
            (self.told.translate_signs(name), self.told.translate_option(text))
            for name, text in rows
        ]
        super().write_dl(told, col_max, col_spacing)


class LanguageContext(click.Context):
    """Context of a command whose help is in the language of the run."""

    def make_formatter(self) -> click.HelpFormatter:
        """Formatter of the help; that of click for English."""
        root = self.find_root().command
        if not isinstance(root, click.Group):  # one command by itself, as tests run it
            return super().make_formatter()
        told = load_help(find_language(root, sys.argv[1:]))
        if told is None:
            return super().make_formatter()
        return LanguageFormatter(
            told, width=self.terminal_width, max_width=self.max_content_width
        )


def print_help(command: click.Command) -> None:
    """Let the help of a command, and of all below it, be in the language of the run."""
    command.context_class = LanguageContext
    for one in getattr(command, "commands", {}).values():
        print_help(one)


class CommandTable(UserDict[str, Any]):
    """Commands of the program; their names are known before they are imported."""

    def __getitem__(self, name: str) -> click.Command:
        """Return a command, its options as variables, its help in every language."""
        if isinstance(self.data[name], str):  # the place of the command
            module, function = self.data[name].split(".")
            found = getattr(import_module(f"netdesign.commands.{module}"), function)
            accept_variables(name, found)
            print_help(found)
            self.data[name] = found
        command: click.Command = self.data[name]
        return command
