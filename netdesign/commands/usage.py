"""Refusals of a command line: ours as messages, those of click told in our words."""

from __future__ import annotations

import io
import sys
from typing import Any

import click
from click.core import ParameterSource

from netdesign.commands.help_texts import load_help
from netdesign.edge.given_files import make_printable
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say


def speak() -> Language:
    """Language of the command that runs; English outside of any."""
    context = click.get_current_context(silent=True)
    found: Language = context.params.get("language", "en") if context else "en"
    return found


def tell(
    message: Message | str, language: Language | None = None, *, err: bool = False
) -> None:
    """Print a message in the language of the command, unless it is another one.

    Words that somebody gave cannot steer the terminal.
    """
    click.echo(make_printable(render(message, language or speak())), err=err)


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


class LanguageGroup(click.Group):
    """A group that refuses an unknown command with a message."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command; refuse a name that is none."""
        try:
            return super().resolve_command(ctx, args)
        except click.exceptions.NoSuchCommand as error:
            told = say("usage.no_command", command=args[0])
            if near := error.possibilities:
                told = say("usage.no_command_near", command=args[0], near=near[0])
            raise UsageRefusal(told, ctx) from None


def describe_refusal(
    error: click.ClickException,
    language: Language,
    command: click.Command | None = None,
) -> str:
    """Text of a refusal with the line on usage above it, as click has them."""
    if language == "en" or isinstance(error, click.exceptions.NoArgsIsHelpError):
        error.show(shown := io.StringIO())
        return shown.getvalue()
    reason = render(explain_usage(error, command), language)
    if isinstance(error, click.MissingParameter):
        reason = load_help(language).translate_signs(reason)
    told = [say("usage.error", reason=reason)]
    context = getattr(error, "ctx", None)
    if context is not None:
        told = [*_describe_usage(context, language), *told]
    return "".join(f"{render(one, language)}\n" for one in told)


def _describe_usage(context: click.Context, language: Language) -> list[Message]:
    command = context.command
    pieces = " ".join(command.collect_usage_pieces(context))
    line = f"{context.command_path} {load_help(language).translate_signs(pieces)}"
    lines = [say("usage.usage", line=line)]
    if command.get_help_option(context) is not None:
        option = context.help_option_names[-1]
        lines.append(say("usage.try", command=context.command_path, option=option))
    return lines


def explain_usage(
    error: click.ClickException, command: click.Command | None = None
) -> Message | str:
    """Reason why click refuses a command line, in our words.

    ``command`` is the one that was called, which not every error holds.
    """
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
        return _explain_option(error.option_name, command)
    _, extra = _parse_again(getattr(error, "ctx", None))
    if extra:
        return say("usage.extra", count=len(extra), words=tuple(extra))
    return say("usage.not_understood", words=" ".join(sys.argv[1:]))


def _explain_option(name: str, command: click.Command | None) -> Message:
    """An option without the value that it needs, or with one that it does not take."""
    for one, mark, value in (word.partition("=") for word in sys.argv[1:]):
        if mark and one == name:
            return say("usage.option_takes_none", option=name, value=value)
    params = command.params if command else []
    option = next((one for one in params if name in one.opts), None)
    accepted = _name_accepted(option.type if option else None)
    if accepted is None:
        return say("usage.option_needs_value", option=name)
    return say("usage.option_needs_accepted", option=name, accepted=accepted)


def _explain_value(error: click.BadParameter) -> Message:
    name = _name(error)
    if isinstance(error, ValueRefusal):
        return say("usage.bad_value_told", name=name, reason=error.told)
    accepted = _name_accepted(error.param.type if error.param else None)
    if accepted is None:
        return say("usage.bad_value", name=name)
    value = _find_value(error)
    if value is None:
        return say("usage.bad_value_accepted", name=name, accepted=accepted)
    return say("usage.bad_typed_value", name=name, value=value, accepted=accepted)


def _find_value(error: click.BadParameter) -> str | None:
    """Value that click refuses, which its error does not hold; None if it is unknown.

    A value from a file of defaults is named where that file is told.
    """
    option, context = error.param, error.ctx
    if option is None or context is None:
        return None
    typed, _ = _parse_again(context)
    value, source = option.consume_value(context, typed)
    if source not in (ParameterSource.COMMANDLINE, ParameterSource.ENVIRONMENT):
        return None
    values = value if isinstance(value, list | tuple) else (value,)
    return next((str(one) for one in values if _is_refused(option, one, context)), None)


def _is_refused(option: click.Parameter, value: object, context: click.Context) -> bool:
    try:
        option.type(value, param=option, ctx=context)
    except click.BadParameter:
        return True
    return False


def _parse_again(context: click.Context | None) -> tuple[dict[str, Any], list[str]]:
    """Words of a command line by the options that they were typed for, and the rest."""
    chain: list[click.Context] = []
    while context is not None:
        chain, context = [context, *chain], context.parent
    typed: dict[str, Any] = {}
    words = list(sys.argv[:])
    for one in chain:  # the first word is the name of the command
        try:
            typed, words, _ = one.command.make_parser(one).parse_args(words[1:])
        except click.UsageError:
            return {}, []
    return typed, words


def _name_accepted(kind: Any) -> Message | str | None:
    if isinstance(kind, click.Choice):
        return ", ".join(map(str, kind.choices))
    if isinstance(kind, click.types.IntParamType):
        return say("usage.whole_number", limits=_name_limits(kind))
    if isinstance(kind, click.types.FloatParamType):
        return say("usage.number", limits=_name_limits(kind))
    if isinstance(kind, click.Path):
        return say("usage.file" if kind.file_okay else "usage.folder")
    return None


def _name_limits(kind: Any) -> Message | str:
    """Limits of a number as they can be typed: with a point in any language."""
    low, high = getattr(kind, "min", None), getattr(kind, "max", None)
    if low is None:
        return ""
    if high is None:
        return say("usage.least", low=f"{low:g}")
    return say("usage.between", low=f"{low:g}", high=f"{high:g}")


def _name(error: click.BadParameter) -> str:
    """Name of the option or argument, as it is typed."""
    if error.param is None:
        return ""
    hint = error.param.get_error_hint(error.ctx) if error.ctx else error.param.name
    return str(hint)
