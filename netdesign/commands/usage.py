"""Sentences of the commands, and refusals of command lines."""

from __future__ import annotations

import click

from netdesign.edge.input_files import make_printable
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message


def speak() -> Language:
    """Language of the running command; English outside of commands."""
    context = click.get_current_context(silent=True)
    language: Language = context.params.get("language", "en") if context else "en"
    return language


def tell(
    message: Message | str, language: Language | None = None, *, err: bool = False
) -> None:
    """Print a message in the language of the command, or in ``language``.

    Control characters in the message are made visible.
    """
    click.echo(make_printable(render(message, language or speak())), err=err)


class UsageRefusal(click.UsageError):
    """A command line that is refused, with a message."""

    def __init__(self, message: Message | str) -> None:
        super().__init__(str(message), click.get_current_context(silent=True))


class ValueRefusal(click.BadParameter):
    """A value of an option that is refused, with a message."""

    def __init__(
        self,
        message: Message,
        ctx: click.Context | None = None,
        param: click.Parameter | None = None,
    ) -> None:
        super().__init__(str(message), ctx, param)
