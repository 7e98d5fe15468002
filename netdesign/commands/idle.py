"""Options without effect beside the others: refused where typed, told of variables.

A file of defaults may hold them until what they belong to is asked for.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path

import click
from click.core import ParameterSource

from netdesign.commands.language import tell
from netdesign.commands.usage import UsageRefusal
from netdesign.words.catalogue import Language
from netdesign.words.message import Message, say

_EXAMPLE, _CLUSTER = "--example", "--executor"
_TYPED, _SET = ParameterSource.COMMANDLINE, ParameterSource.ENVIRONMENT


def refuse_without(
    names: Sequence[str], needed: tuple[str, ...], language: Language
) -> None:
    """Refuse options of the command that runs, which belong to one not given.

    Parameters
    ----------
    names : sequence of str
        Of their parameters.
    needed : tuple of str
        Options of which one would give them an effect.
    language : str
        Of the note on variables: they may be there for other runs.

    Raises
    ------
    UsageRefusal
        If one of them was typed.
    """
    _refuse(
        names,
        lambda options: say("usage.idle_without", options=options, needed=needed),
        language,
    )


def refuse_delimiter(*paths: Path | None, language: Language) -> None:
    """Refuse ``--delimiter`` where no csv file is read; None is the example's workbook.

    Raises
    ------
    UsageRefusal
        If it was typed.
    """
    from netdesign.site.cells.spreadsheet import is_text

    if any(path is not None and is_text(path) for path in paths):
        return
    file = _EXAMPLE if paths[-1] is None else paths[-1].name
    _refuse(
        ["delimiter"],
        lambda options: say("usage.idle_in_workbook", options=options, file=file),
        language,
    )


def refuse_jobs(executor: str, language: Language) -> None:
    """Refuse ``--jobs`` beside a cluster, which has its own processes.

    Raises
    ------
    UsageRefusal
        If it was typed.
    """
    if executor:
        _refuse(
            ["jobs"],
            lambda options: say("usage.idle_beside", options=options, other=_CLUSTER),
            language,
        )


def _refuse(
    names: Sequence[str],
    explain: Callable[[tuple[str, ...]], Message],
    language: Language,
) -> None:
    """Refuse options where typed; where variables set them, tell that of these."""
    context = click.get_current_context()
    found = [one for one in context.command.params if one.name in names]
    typed = tuple(
        max(one.opts, key=len) for one in found if _is_from(one, _TYPED, context)
    )
    if typed:
        raise UsageRefusal(explain(typed))
    variables = tuple(
        next(filter(os.environ.get, one.envvar or ()), "")
        for one in found
        if _is_from(one, _SET, context)
    )
    if variables:
        tell(say("cli.note", text=explain(variables)), language, err=True)


def _is_from(
    option: click.Parameter, source: ParameterSource, context: click.Context
) -> bool:
    return context.get_parameter_source(option.name or "") is source
