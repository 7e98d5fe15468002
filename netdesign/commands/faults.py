"""Tells faults of the program, after all that could be solved was."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping

import click

from netdesign.edge.given_files import make_printable
from netdesign.fault import EXIT_CODE, Fault

_SHOWN = 20  # cases of one fault
TRACEBACK = "NETDESIGN_TRACEBACK"  # a variable that asks for the whole way


def tell_faults(faults: Mapping[Fault, Collection[str]]) -> int:
    """Tell each fault with its cases and their net rows, on stderr.

    Parameters
    ----------
    faults : mapping of Fault to collection of str
        What failed, and the ids of the net rows that it befell.

    Returns
    -------
    int
        Exit code; 0 without any fault.
    """
    alike: dict[str, dict[Fault, Collection[str]]] = {}
    for fault, rows in faults.items():
        alike.setdefault(str(fault), {})[fault] = rows
    for cases in alike.values():
        _tell_alike(cases)
    if not faults:
        return 0
    if not os.environ.get(TRACEBACK):
        click.echo(f"({TRACEBACK}=1 shows the whole way to it)", err=True)
    return EXIT_CODE


def _tell_alike(faults: Mapping[Fault, Collection[str]]) -> None:
    """The same fault in some cases: its text once, and the way to the first."""
    first = next(iter(faults))
    lines = [f"internal error, please report it: {first}"]
    cases = [
        f"  {_name_rows(sorted(rows))}{one.case}"
        for one, rows in faults.items()
        if one.case
    ]
    lines += cases[:_SHOWN]
    if cases[_SHOWN:]:
        lines.append(f"  and {len(cases) - _SHOWN} more cases")
    if os.environ.get(TRACEBACK):
        lines.append(first.trace)
    click.echo(make_printable("\n".join(lines)), err=True)


def _name_rows(rows: Collection[str]) -> str:
    if not rows:
        return ""
    return f"net row{'s' if len(rows) > 1 else ''} {', '.join(rows)}: "
