"""Defaults from ``netdesign.toml``: below the command line and the environment.

Order of precedence: option > environment variable > file given by ``--config`` >
``netdesign.toml`` beside the site file > default of the program. The file has one
table for each command that reads it, with the long names of its options as keys::

    [check]
    accuracy = 0.005
    standard = ["nf-p-95-304-style"]
    html = false

An environment variable is named after the command and the option as it is typed:
``NETDESIGN_CHECK_STANDARD``. One that begins so and names no option is refused, as a
key of the file is: a profile that was meant must not end as the default. The language
alone has a variable for all commands, too: ``NETDESIGN_LANGUAGE``.

A command speaks the language that is found by the same order, also where its line
cannot be parsed. Of the variables, that of one command stands above that of all.
"""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterable, Mapping, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import Any

import click

from netdesign.commands.usage import UsageRefusal
from netdesign.edge.causes import explain
from netdesign.edge.given_files import is_there, list_faults, read_toml
from netdesign.outcome import ContentError
from netdesign.words.catalogue import LANGUAGES, Language
from netdesign.words.message import Message, say

CONFIG_NAME = "netdesign.toml"
ENVIRONMENT_PREFIX = "NETDESIGN"
COMPLETE_VARIABLE = "_NETDESIGN_COMPLETE"
LANGUAGE_VARIABLE = "NETDESIGN_LANGUAGE"
_START = f"{ENVIRONMENT_PREFIX}_"
# Variables of no single command.
_OF_ALL = (
    LANGUAGE_VARIABLE,
    *("NETDESIGN_CORE", "NETDESIGN_STORE", "NETDESIGN_TRACEBACK"),
)
_OF_TESTS = ("NETDESIGN_SUITE_", "NETDESIGN_FUZZ_")


class ConfiguredCommand(click.Command):
    """A command whose defaults may come from a file; it gains ``--config``."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.params.append(
            click.Option(
                ["--config"],
                type=click.Path(path_type=Path, dir_okay=False),
                expose_value=False,
                help=f"File with defaults [{CONFIG_NAME} beside the input, if there].",
            )
        )

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the defaults first: which file holds them depends on the arguments."""
        typed, _, _ = self.make_parser(ctx).parse_args(list(args))
        path = _find_file(self, typed)
        if path is not None:
            ctx.default_map = _read_defaults(self, ctx, path)
        return super().parse_args(ctx, args)


def accept_variables(name: str, command: click.Command) -> None:
    """Let every option of a command, and of those below, be a variable of its name."""
    for param in command.params:
        if isinstance(param, click.Option) and param.envvar is None:
            names = [one for one in param.opts if one.startswith("--")]
            of_all = [LANGUAGE_VARIABLE] if "--language" in names else []
            # the strongest first
            param.envvar = [*(_name_variable(name, one) for one in names), *of_all]
    if isinstance(command, click.Group):
        for below, one in command.commands.items():
            accept_variables(f"{name}_{below}", one)


def require_known_variables(name: str, command: click.Command) -> None:
    """Refuse a variable that names a command and none of its options.

    Raises
    ------
    UsageError
        With the name that it is near to, if there is one.
    """
    known = _list_variables(name, command)
    start = _name_variable(name, "")
    for variable in sorted(os.environ):
        if variable.startswith(start) and variable not in known:
            raise UsageRefusal(_suggest(variable, variable, known))


def find_idle_variables(
    name: str, command: click.Command, names: Iterable[str]
) -> list[Message]:
    """Tell of variables that begin as ours do and that nothing reads.

    Parameters
    ----------
    name : str
        Of the command that runs.
    command : click.Command
        The same.
    names : iterable of str
        Of all commands; their variables may be there for other runs.
    """
    starts = (*(_name_variable(one, "") for one in names), *_OF_TESTS)
    known = _list_variables(name, command)
    return [
        _describe_idle(
            variable, _name_variable(name, variable.removeprefix(_START)), known
        )
        for variable in sorted(os.environ)
        if variable.startswith(_START)
        and variable not in _OF_ALL
        and not variable.startswith(starts)
    ]


def _describe_idle(variable: str, own: str, known: Sequence[str]) -> Message:
    if own in known:
        return say("usage.idle_variable_near", variable=variable, near=own)
    return say("usage.idle_variable", variable=variable)


def _list_variables(name: str, command: click.Command) -> list[str]:
    """Variables of a command and of those below it."""
    found = [
        variable
        for param in command.params
        for variable in (*(param.envvar or ()), _name_variable(name, param.name or ""))
    ]
    below = command.commands if isinstance(command, click.Group) else {}
    for one, of_group in below.items():
        found += _list_variables(f"{name}_{one}", of_group)
    return found


def _name_variable(command: str, option: str) -> str:
    words = (ENVIRONMENT_PREFIX, command, option.removeprefix("--"))
    return "_".join(words).replace("-", "_").upper()


def _find_file(command: click.Command, typed: Mapping[str, Any]) -> Path | None:
    given = typed.get("config")
    if isinstance(given, str):
        return Path(given)
    beside = [
        Path(value).parent / CONFIG_NAME
        for one in command.params
        if isinstance(one, click.Argument)
        and isinstance(value := typed.get(one.name or ""), str)
    ]
    return next((one for one in beside if is_there(one) and one.is_file()), None)


def _read_language(
    group: click.Command, command: click.Command | None, words: list[str]
) -> Any:
    """Default of the language in the file of a command line; None where there is none.

    What is wrong with the line or its file is told by whoever parses them.
    """
    if not isinstance(command, ConfiguredCommand):
        return None
    context = click.Context(
        command, parent=click.Context(group), info_name=command.name
    )
    try:
        typed, _, _ = command.make_parser(context).parse_args(words)
        path = _find_file(command, typed)
        table = read_toml(path).get(command.name or "", {}) if path else {}
    except (click.UsageError, OSError, ValueError):
        return None
    return table.get("language") if isinstance(table, dict) else None


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
        for name, one in getattr(group, "commands", {}).items()
        if isinstance(one, ConfiguredCommand)  # tables of others would never be read
    ]
    faults = [
        _suggest(f"{path}: [{name}]", name, commands)
        for name in tables
        if commands and name not in commands
    ]
    table = tables.get(command.name or "", {})
    if not isinstance(table, dict):
        told = say("config.not_a_table", path=str(path), command=command.name or "")
        faults, table = [*faults, told], {}
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
    """Value as a command line would give it; a message where it cannot."""
    if "\\x00" in repr(value):  # no command line can hold one
        return say("config.zero_character", place=place, value=repr(value))
    try:
        word = _write_as_typed(option, value)
        option.type_cast_value(ctx, word)
    except (click.BadParameter, ValueError, OverflowError) as error:
        shown = f"{value!r:.200}"
        return say("config.bad_value", place=place, value=shown, reason=_explain(error))
    return word


def _write_as_typed(option: click.Option, value: object) -> object:
    """Value as a command line would give it: words, or a truth value for a flag.

    Raises
    ------
    ValueError
        If no command line can hold it.
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
    """Options by their long names without dashes; the file cannot name another."""
    return {
        name.removeprefix("--"): param
        for param in command.params
        if isinstance(param, click.Option) and param.name != "config"
        for name in param.opts
        if name.startswith("--")
    }


def _explain(error: Exception) -> Message | str:
    if isinstance(error, click.BadParameter):
        return error.format_message()
    return explain(error)


def _suggest(place: str, word: str, known: list[str]) -> Message:
    near = difflib.get_close_matches(word, known, n=1)
    if not near:
        return say("config.unknown", place=place)
    return say("config.unknown_near", place=place, near=near[0])


_OPTION = "--language"


def find_language(group: click.Command, words: Sequence[str]) -> Language:
    """Language of a command line; what is no language is refused elsewhere."""
    path, command = find_command(group, words)
    own = [_name_variable("_".join(path), _OPTION)] if path else []
    variables = [*own, LANGUAGE_VARIABLE]
    told = next(filter(None, map(os.environ.get, variables)), None)
    found = _find_option(words) or told
    found = found or _read_language(group, command, list(words[len(path) :]))
    return next((one for one in LANGUAGES if one == found), LANGUAGES[0])


def find_command(
    group: click.Command, words: Sequence[str]
) -> tuple[tuple[str, ...], click.Command | None]:
    """Names of the command, as far as they are known, and the command."""
    path: list[str] = []
    command = group
    for word in words:
        if not isinstance(command, click.Group) or word not in command.commands:
            break
        path.append(word)
        command = command.commands[word]
    return tuple(path), None if command is group else command


def _find_option(words: Sequence[str]) -> str | None:
    """Value of the last ``--language``, as click takes it."""
    found = None
    for word, following in zip_longest(words, words[1:]):
        name, mark, value = word.partition("=")
        if name == _OPTION:
            found = value if mark else following
    return found
