"""Options without effect beside the others: refused where typed, told of variables.

A file of defaults may hold them until what they belong to is asked for.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from netdesign.commands.language import tell
from netdesign.commands.usage import UsageRefusal
from netdesign.words.catalogue import Language
from netdesign.words.message import say

_EXAMPLE = "--example"


def refuse_idle(
    names: Sequence[str], reason: str, language: Language, **told: Any
) -> None:
    """Refuse options of the command that runs, which would have no effect.

    Parameters
    ----------
    names : sequence of str
        Of their parameters.
    reason : str
        Key below ``usage`` of the sentence, which takes ``options`` and ``told``.
    language : str
        Of the note on variables: they may be there for other runs.

    Raises
    ------
    UsageRefusal
        If one of them was typed.
    """
    context = click.get_current_context()
    found = [one for one in context.command.params if one.name in names]
    sources = {one.name: context.get_parameter_source(one.name or "") for one in found}
    typed = [
        max(one.opts, key=len)
        for one in found
        if sources[one.name] is ParameterSource.COMMANDLINE
    ]
    if typed:
        raise UsageRefusal(say(f"usage.{reason}", options=tuple(typed), **told))
    variables = [
        next(filter(os.environ.get, one.envvar or ()), "")
        for one in found
        if sources[one.name] is ParameterSource.ENVIRONMENT
    ]
    if variables:
        idle = say(f"usage.{reason}", options=tuple(variables), **told)
        tell(say("cli.note", text=idle), language, err=True)


def refuse_idle_delimiter(*paths: Path | None, language: Language) -> None:
    """Refuse ``--delimiter`` where no csv file is read; None is the example's workbook.

    Raises
    ------
    UsageRefusal
        If it was typed.
    """
    from netdesign.site.cells.spreadsheet import is_text

    if not any(path is not None and is_text(path) for path in paths):
        file = _EXAMPLE if paths[-1] is None else paths[-1].name
        refuse_idle(["delimiter"], "idle_in_workbook", language, file=file)


def refuse_idle_jobs(executor: str, language: Language) -> None:
    """Refuse ``--jobs`` beside a cluster, which has its own processes.

    Raises
    ------
    UsageRefusal
        If it was typed.
    """
    if executor:
        refuse_idle(["jobs"], "idle_beside", language, other="--executor")
