"""Defaults of a command from ``netdesign.toml`` beside its input.

The file has one table for each command that reads it, with the long names of its
options as keys; what is typed overrules it::

    [check]
    accuracy = 0.005
    standard = ["nf-p-95-304-style"]
    html = false
"""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from netdesign.commands.options import ShortHelpCommand
from netdesign.commands.running import UsageRefusal
from netdesign.edge.input_files import explain, is_there, list_faults, read_toml
from netdesign.outcome import ContentError
from netdesign.words.message import Message, say

CONFIG_NAME = "netdesign.toml"


class ConfiguredCommand(ShortHelpCommand):
    """A command whose defaults may come from a file beside its input."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the defaults first, since the arguments decide where their file is."""
        typed, _, _ = self.make_parser(ctx).parse_args(list(args))
        path = _find_file(self, typed)
        if path is not None:
            ctx.default_map = _read_defaults(self, ctx, path)
        return super().parse_args(ctx, args)


def _find_file(command: click.Command, typed: Mapping[str, Any]) -> Path | None:
    beside = [
        Path(value).parent / CONFIG_NAME
        for param in command.params
        if isinstance(param, click.Argument)
        and isinstance(value := typed.get(param.name or ""), str)
    ]
    return next((path for path in beside if is_there(path) and path.is_file()), None)


def _read_defaults(
    command: click.Command, ctx: click.Context, path: Path
) -> dict[str, Any]:
    try:
        tables = read_toml(path)
    except (OSError, ValueError) as error:
        raise UsageRefusal(
            say("file.no_toml", file=str(path), cause=explain(error))
        ) from None
    group = ctx.find_root().command
    commands = [
        name
        for name, command in getattr(group, "commands", {}).items()
        if isinstance(
            command, ConfiguredCommand
        )  # tables of others would never be read
    ]
    faults = [
        _suggest(f"{path}: [{name}]", name, commands)
        for name in tables
        if commands and name not in commands
    ]
    table = tables.get(command.name or "", {})
    if not isinstance(table, dict):
        message = say("config.not_a_table", path=str(path), command=command.name or "")
        faults, table = [*faults, message], {}
    options = _name_options(command)
    defaults: dict[str, Any] = {}
    for key, value in table.items():
        place = f"{path}: [{command.name}] {key}"
        if key not in options:
            faults.append(_suggest(place, key, list(options)))
            continue
        word = _read_value(ctx, options[key], value, place)
        if isinstance(word, Message):
            faults.append(word)
        else:
            defaults[options[key].name or ""] = word
    if faults:
        raise UsageRefusal(list_faults(faults))
    return defaults


def _read_value(
    ctx: click.Context, option: click.Option, value: object, place: str
) -> object:
    """Value as on a command line, or a message where there is none."""
    if "\\x00" in repr(value):  # no command line can hold NUL
        return say("config.zero_character", place=place, value=repr(value))
    try:
        word = _write_as_typed(option, value)
        option.type_cast_value(ctx, word)
    except (click.BadParameter, ValueError, OverflowError) as error:
        shown = f"{value!r:.200}"
        return say("config.bad_value", place=place, value=shown, reason=_explain(error))
    return word


def _write_as_typed(option: click.Option, value: object) -> object:
    """Value as on a command line: words, or a truth value for a flag.

    Raises
    ------
    ValueError
        If no command line can hold the value.
    """
    if isinstance(value, list) and option.multiple:
        if any(isinstance(word, list) for word in value):
            raise ContentError(say("config.no_fit"))
        return [_write_as_typed(option, word) for word in value]
    if isinstance(value, bool) and option.is_flag:
        return value
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ContentError(say("config.no_fit"))
    return str(value)


def _name_options(command: click.Command) -> dict[str, click.Option]:
    """Options by their long names without dashes; the file names these alone."""
    return {
        name.removeprefix("--"): param
        for param in command.params
        if isinstance(param, click.Option)
        for name in param.opts
        if name.startswith("--")
    }


def _explain(error: Exception) -> Message | str:
    if isinstance(error, click.BadParameter):
        return error.format_message()
    return explain(error)


def _suggest(place: str, word: str, accepted: list[str]) -> Message:
    near = difflib.get_close_matches(word, accepted, n=1)
    if not near:
        return say("config.unknown", place=place)
    return say("config.unknown_near", place=place, near=near[0])
