"""In which language a command speaks: decided here, also where it cannot be parsed.

Option > environment variable > ``netdesign.toml`` > English, as all other options. Of
the variables, that of one command (``NETDESIGN_CHECK_LANGUAGE``) stands above that of
all of them (``NETDESIGN_LANGUAGE``).
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from itertools import zip_longest

import click

from netdesign.commands.config import (
    ENVIRONMENT_PREFIX,
    LANGUAGE_VARIABLE,
    read_default,
)
from netdesign.words.catalogue import LANGUAGES, Language, render
from netdesign.words.message import Message

_OPTION = "--language"


def find_language(group: click.Group, words: Sequence[str]) -> Language:
    """Language of a command line; what is no language is refused elsewhere."""
    path, command = find_command(group, words)
    variables = (_name_variable(path), LANGUAGE_VARIABLE)
    told = next(filter(None, map(os.environ.get, variables)), None)
    found = _find_option(words) or told
    if not found and command is not None:
        found = read_default(group, command, list(words[len(path) :]), "language")
    return next((one for one in LANGUAGES if one == found), LANGUAGES[0])


def tell(message: Message | str, language: Language, *, err: bool = False) -> None:
    """Print a message."""
    click.echo(render(message, language), err=err)


def find_command(
    group: click.Group, words: Sequence[str]
) -> tuple[tuple[str, ...], click.Command | None]:
    """Names of the command, as far as they are known, and the command."""
    path: list[str] = []
    command: click.Command = group
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


def _name_variable(path: Sequence[str]) -> str:
    return "_".join((ENVIRONMENT_PREFIX, *path, "LANGUAGE")).upper().replace("-", "_")
