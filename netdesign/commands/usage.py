"""Refusals of a command line: ours as messages, those of click told in our words."""

from __future__ import annotations

import difflib
import io
import sys
from typing import Any

import click

from netdesign.commands.help_texts import load_help
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say


class UsageRefusal(click.UsageError):
    """A command line that is refused, with a message."""

    def __init__(self, message: Message, ctx: click.Context | None = None) -> None:
        super().__init__(str(message), ctx)
        self.told = message


class ValueRefusal(click.BadParameter):
    """A value of an option that is refused, with a message."""

    def __init__(
        self,
        message: Message,
        ctx: click.Context | None = None,
        param: click.Parameter | None = None,
    ) -> None:
        super().__init__(str(message), ctx, param)
        self.told = message


class ToldGroup(click.Group):
    """A group that refuses an unknown command with a message."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command; refuse a name that is none."""
        try:
            return super().resolve_command(ctx, args)
        except click.UsageError as error:
            if isinstance(error, click.NoSuchOption):
                raise
            raise UsageRefusal(_refuse_command(args[0], self), ctx) from None


def _refuse_command(word: str, group: click.Group) -> Message:
    near = difflib.get_close_matches(word, list(group.commands), n=1)
    if not near:
        return say("usage.no_command", command=word)
    return say("usage.no_command_near", command=word, near=near[0])


def describe_refusal(error: click.ClickException, language: Language) -> str:
    """Text of a refusal with the line on usage above it, as click has them."""
    if language == "en" or isinstance(error, click.exceptions.NoArgsIsHelpError):
        error.show(shown := io.StringIO())
        return shown.getvalue()
    reason = render(explain_usage(error), language)
    if isinstance(error, click.MissingParameter):
        reason = _tell_signs(reason, language)
    told = [say("usage.error", reason=reason)]
    context = getattr(error, "ctx", None)
    if context is not None:
        told = [*_describe_usage(context, language), *told]
    return "".join(f"{render(one, language)}\n" for one in told)


def _describe_usage(context: click.Context, language: Language) -> list[Message]:
    command = context.command
    pieces = " ".join(command.collect_usage_pieces(context))
    line = f"{context.command_path} {_tell_signs(pieces, language)}"
    lines = [say("usage.usage", line=line)]
    if command.get_help_option(context) is not None:
        option = context.help_option_names[-1]
        lines.append(say("usage.try", command=context.command_path, option=option))
    return lines


def _tell_signs(text: str, language: Language) -> str:
    """Names of arguments as the help of the language has them."""
    told = load_help(language)
    return told.tell_signs(text) if told else text


def explain_usage(error: click.ClickException) -> Message | str:
    """Reason why click refuses a command line, in our words."""
    if isinstance(error, UsageRefusal):
        return error.told
    if isinstance(error, click.MissingParameter):
        return say("usage.missing", name=_name(error))
    if isinstance(error, click.BadParameter):
        return _explain_value(error)
    if isinstance(error, click.NoSuchOption):
        near = tuple(error.possibilities or ())
        if near:
            return say("usage.no_option_near", option=error.option_name, near=near)
        return say("usage.no_option", option=error.option_name)
    if isinstance(error, click.BadOptionUsage):
        return say("usage.option_value", option=error.option_name)
    return say("usage.not_understood", words=" ".join(sys.argv[1:]))


def _explain_value(error: click.BadParameter) -> Message:
    name = _name(error)
    if isinstance(error, ValueRefusal):
        return say("usage.bad_value_told", name=name, reason=error.told)
    accepted = _name_accepted(error.param.type if error.param else None)
    if accepted is None:
        return say("usage.bad_value", name=name)
    return say("usage.bad_value_accepted", name=name, accepted=accepted)


def _name_accepted(kind: Any) -> Message | str | None:
    if isinstance(kind, click.Choice):
        return ", ".join(map(str, kind.choices))
    if isinstance(kind, click.IntRange | click.FloatRange):
        low, high = kind.min, kind.max
        if low is not None and high is not None:
            return say("usage.between", low=low, high=high)
    if isinstance(kind, click.types.IntParamType):
        return say("usage.whole_number")
    if isinstance(kind, click.types.FloatParamType):
        return say("usage.number")
    return say("usage.path") if isinstance(kind, click.Path) else None


def _name(error: click.BadParameter) -> str:
    """Name of the option or argument, as it is typed."""
    if error.param is None:
        return ""
    hint = error.param.get_error_hint(error.ctx) if error.ctx else error.param.name
    return str(hint)
