"""Options of the commands, from ``options.toml``."""

from __future__ import annotations

import math
import os
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from netdesign.commands.running import UsageRefusal, ValueRefusal
from netdesign.words.message import say

DEFAULT_FOLDER = "netdesign-out"
DELIMITERS = {"tab": "\t", "\\t": "\t", "comma": ",", "semicolon": ";"}


def check_delimiter(
    context: click.Context, option: click.Parameter, value: str | None
) -> str:
    """Sign between the columns of a csv file, or its name."""
    sign = DELIMITERS.get(value or "", value or "")
    is_mark = sign == "\t" or (sign.isprintable() and not sign.isalnum())
    if len(sign) > 1 or sign == '"' or not is_mark:
        raise ValueRefusal(say("usage.delimiter", text=sign), context, option)
    return sign


def read_instead(
    context: click.Context | None,
    option: click.Parameter | None,
    texts: Sequence[str],
) -> dict[str, str]:
    """Read texts ``CELL=TEXT`` into texts by cell.

    Raises
    ------
    ValueRefusal
        If a text has another form, or a cell comes twice.
    """
    from netdesign.site.declared_sheet import split_replacement

    instead: dict[str, str] = {}
    for text in texts:
        replacement = split_replacement(text)
        if replacement is None:
            raise ValueRefusal(say("what_if.form", text=text), context, option)
        cell, now = replacement
        if cell in instead:
            raise ValueRefusal(say("what_if.twice", cell=cell), context, option)
        instead[cell] = now
    return instead


def read_scopes(
    context: click.Context | None,
    option: click.Parameter | None,
    texts: Sequence[str],
) -> tuple[str, ...]:
    """Read scopes of a study from texts such as ``anchors,siting``.

    Raises
    ------
    ValueRefusal
        If a text names no scope.
    """
    from netdesign.study.scopes import SCOPES

    scopes = [scope.strip() for text in texts for scope in text.split(",")]
    for scope in scopes:
        if scope not in tuple(SCOPES):
            message = say("usage.scope", text=scope, accepted=tuple(map(str, SCOPES)))
            raise ValueRefusal(message, context, option)
    return tuple(dict.fromkeys(scopes))


@dataclass(frozen=True, slots=True)
class TypedRange:
    """A range as typed, in the engineer's unit; ``count`` may be left out."""

    low: float
    high: float
    count: int | None = None


class RangeType(click.ParamType):  # type: ignore[type-arg]  # generic in click 8.5 only
    """Reads ``low:high[:n]``; each refusal names the text and the accepted form."""

    name = "low:high[:n]"

    def convert(
        self,
        value: object,
        param: click.Parameter | None,
        ctx: click.Context | None,
    ) -> TypedRange:
        """Read a range.

        Raises
        ------
        click.BadParameter
            If it is malformed, reversed or empty.
        """
        text = str(value)
        try:
            low, high, *samples = text.split(":")
            span = TypedRange(float(low), float(high), *map(int, samples))
        except (ValueError, TypeError):
            span = TypedRange(math.nan, math.nan)
        faults = {
            "usage.range_form": not (
                math.isfinite(span.low) and math.isfinite(span.high)
            ),
            "usage.range_reversed": span.low > span.high,
            "usage.range_empty": span.low == span.high,
            "usage.range_samples": span.count is not None
            and not 2 <= span.count <= 1000,
        }
        for key, is_fault in faults.items():
            if is_fault:
                raise ValueRefusal(say(key, text=text), ctx, param)
        return span


class StudyType(click.Path):
    """File of a study, or a folder that holds a study."""

    def convert(
        self,
        value: Any,
        param: click.Parameter | None,
        ctx: click.Context | None,
    ) -> Path:
        """Find the study of a folder: study.json, else its only marked study."""
        from netdesign.edge.input_files import is_there
        from netdesign.edge.output import STUDY_FILE

        path = Path(os.fsdecode(super().convert(value, param, ctx)))
        if not (is_there(path) and path.is_dir()):
            return path
        usual, marked = path / STUDY_FILE, [*path.glob(f"*-{STUDY_FILE}")]
        return marked[0] if len(marked) == 1 and not is_there(usual) else usual


RANGE = RangeType()
STUDY = StudyType(path_type=Path)
_KINDS = {
    "file": click.Path(path_type=Path, dir_okay=False),
    "folder": click.Path(path_type=Path, file_okay=False),
    "path": click.Path(path_type=Path),
    "range": RANGE,
    "study": STUDY,
}
_NUMBERS = {"number": click.FloatRange, "count": click.IntRange}
_READERS = {
    reader.__name__: reader for reader in (check_delimiter, read_instead, read_scopes)
}


class ShortHelpCommand(click.Command):
    """A command whose help shows the usual options; ``--help-all`` shows all."""

    def format_options(
        self, ctx: click.Context, formatter: click.HelpFormatter
    ) -> None:
        """Write the options that ``options.toml`` names for the command, or all."""
        shown = _load_tables()["help"].get(self.name)
        records = [
            record
            for option in self.get_params(ctx)
            if isinstance(option, click.Option)
            and (ctx.meta.get(_HELP_ALL) or shown is None or _is_shown(option, shown))
            and (record := option.get_help_record(ctx))
        ]
        with formatter.section("Options"):
            formatter.write_dl(records)


_HELP_ALL = "netdesign.help_all"  # where a context remembers that all are asked for


def _is_shown(option: click.Option, shown: Sequence[str]) -> bool:
    names = [name.removeprefix("--") for name in option.opts]
    return any(name in (*shown, "help", "help-all") for name in names)


def _show_all(context: click.Context, _: click.Parameter, asked: bool) -> None:
    if asked and not context.resilient_parsing:
        context.meta[_HELP_ALL] = True
        click.echo(context.get_help(), color=context.color)
        context.exit()


def take_options(command: str) -> Callable[[Any], Any]:
    """Decorator that gives a command the options that ``options.toml`` has for it."""

    def add(function: Any) -> Any:
        if command in _load_tables()["help"]:
            function = click.option(
                "--help-all",
                is_flag=True,
                is_eager=True,
                expose_value=False,
                callback=_show_all,
                help="Show all options and exit.",
            )(function)
        for name, table in reversed([*_list_options(_load_tables()[command])]):
            function = _build_option(name, table)(function)
        return function

    return add


@lru_cache
def _load_tables() -> dict[str, Any]:
    file = files("netdesign.commands") / "options.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def _list_options(options: Mapping[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Names and tables of options; a group is replaced by its options."""
    tables = _load_tables()
    for name, table in options.items():
        if table.get("group") is True:
            yield from _list_options(tables["group"][name])
        else:
            yield name, {**tables["shared"].get(name, {}), **table}


def _build_option(name: str, table: dict[str, Any]) -> Callable[[Any], Any]:
    kind, limits = table.pop("is", "text"), table.pop("limits", ())
    names = [f"--{name}/--no-{name}" if kind == "switch" else f"--{name}"]
    names += [table.pop("as")] if "as" in table else []
    of_click: dict[str, Any] = {"show_default": "default" in table, **table}
    if kind == "flag":
        of_click["is_flag"] = True
    elif kind == "switch":
        of_click["show_default"] = False
    elif kind in _KINDS:
        of_click["type"] = _KINDS[kind]
    elif kind in _NUMBERS:
        of_click["type"] = _NUMBERS[kind](*limits)
    if words := of_click.pop("one_of", None):
        of_click["type"] = click.Choice(words)
    if name == "language":
        of_click["callback"] = _remember_language
    if reader := of_click.pop("by", None):
        of_click["callback"] = _READERS[reader]
    return click.option(*names, **of_click)


def _remember_language(
    context: click.Context, _: click.Parameter, language: str
) -> str:
    """Keep the language for messages that are printed after the command ended."""
    context.meta["language"] = language
    return language


def refuse_without(names: Sequence[str], *needed: str) -> None:
    """Refuse options of the running command that have no effect without another.

    Defaults of a file are not refused: they may be there for other runs.

    Parameters
    ----------
    names : sequence of str
        Of their parameters.
    *needed : str
        Options that would give them an effect.

    Raises
    ------
    UsageRefusal
        If such an option was typed.
    """
    context = click.get_current_context()
    typed = tuple(
        max(option.opts, key=len)
        for option in context.command.params
        if option.name in names
        and context.get_parameter_source(option.name) is ParameterSource.COMMANDLINE
    )
    if typed:
        raise UsageRefusal(say("usage.idle_without", options=typed, needed=needed))
