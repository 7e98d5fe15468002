"""Tells faults of the program, after all that could be solved was."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping

import click

from netdesign.commands.language import tell
from netdesign.edge.given_files import make_printable
from netdesign.fault import EXIT_CODE, Fault
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

_SHOWN = 20  # cases of one fault
TRACEBACK = "NETDESIGN_TRACEBACK"  # a variable that asks for the whole way


def tell_faults(
    faults: Mapping[Fault, Collection[str]], language: Language = "en"
) -> int:
    """Tell each fault with its cases and their net rows, on stderr.

    Parameters
    ----------
    faults : mapping of Fault to collection of str
        What failed, and the ids of the net rows that it befell.
    language : str
        Of what is told; a fault's own words are the program's.

    Returns
    -------
    int
        Exit code; 0 without any fault.
    """
    alike: dict[str, dict[Fault, Collection[str]]] = {}
    for fault, rows in faults.items():
        alike.setdefault(str(fault), {})[fault] = rows
    for cases in alike.values():
        _tell_alike(cases, language)
    if not faults:
        return 0
    if not os.environ.get(TRACEBACK):
        tell(say("cli.fault_trace", variable=TRACEBACK), language, err=True)
    return EXIT_CODE


def _tell_alike(faults: Mapping[Fault, Collection[str]], language: Language) -> None:
    """The same fault in some cases: its text once, and the way to the first."""
    first = next(iter(faults))
    lines: list[Message | str] = [say("cli.fault", fault=str(first))]
    cases = [
        _name_case(tuple(sorted(rows)), one.case)
        for one, rows in faults.items()
        if one.case
    ]
    lines += cases[:_SHOWN]
    if cases[_SHOWN:]:
        lines.append(say("cli.fault_cases", count=len(cases) - _SHOWN))
    if os.environ.get(TRACEBACK):
        lines.append(first.trace)
    text = "\n".join(render(line, language) for line in lines)
    click.echo(make_printable(text), err=True)


def _name_case(rows: tuple[str, ...], case: str) -> Message:
    if not rows:
        return say("cli.fault_case", case=case)
    key = "cli.fault_rows" if len(rows) > 1 else "cli.fault_row"
    return say(key, rows=rows, case=case)
