"""Commands by name, each imported when it is first asked for: a run needs one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping
from importlib import import_module

import click

from netdesign.commands.config import accept_variables
from netdesign.commands.help import tell_help


class CommandTable(MutableMapping[str, click.Command]):
    """Commands of the program; their names are known before they are imported."""

    def __init__(self, functions: Mapping[str, str]) -> None:
        """Keep the names, and of each the function in the module of that name."""
        self._functions = dict(functions)
        self._commands: dict[str, click.Command] = {}

    def __getitem__(self, name: str) -> click.Command:
        """Return a command, its options as variables, its help in every language."""
        if name not in self._commands:
            function = self._functions[name]
            found = getattr(import_module(f"netdesign.commands.{name}"), function)
            accept_variables(name, found)
            tell_help(found)
            self._commands[name] = found
        return self._commands[name]

    def __setitem__(self, name: str, command: click.Command) -> None:
        """Add a command."""
        self._functions.setdefault(name, "")
        self._commands[name] = command

    def __delitem__(self, name: str) -> None:
        """Take a command away."""
        del self._functions[name]
        self._commands.pop(name, None)

    def __contains__(self, name: object) -> bool:
        """Tell whether there is such a command, without its import."""
        return name in self._functions

    def __iter__(self) -> Iterator[str]:
        """Go through the names."""
        return iter(self._functions)

    def __len__(self) -> int:
        """Count the commands."""
        return len(self._functions)
