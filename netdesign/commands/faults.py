"""Tells faults of the program, after all that could be solved was."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping

import click

from netdesign.fault import EXIT_CODE, Fault
from netdesign.given_files import make_printable

TRACEBACK = "NETDESIGN_TRACEBACK"  # a variable that asks for the whole way


def tell_faults(faults: Mapping[Fault, Collection[str]]) -> int:
    """Tell each fault with its case and net rows, on stderr.

    Parameters
    ----------
    faults : mapping of Fault to collection of str
        What failed, and the ids of the net rows that it befell.

    Returns
    -------
    int
        Exit code; 0 without any fault.
    """
    for fault, rows in faults.items():
        click.echo(_describe(fault, sorted(rows)), err=True)
    if not faults:
        return 0
    if not os.environ.get(TRACEBACK):
        click.echo(f"({TRACEBACK}=1 shows the whole way to it)", err=True)
    return EXIT_CODE


def _describe(fault: Fault, rows: Collection[str]) -> str:
    text = f"internal error, please report it: {fault}"
    if fault.case:
        text += f"; {_name_rows(rows)}{fault.case}"
    if os.environ.get(TRACEBACK):
        text += f"\n{fault.trace}"
    return make_printable(text)


def _name_rows(rows: Collection[str]) -> str:
    if not rows:
        return ""
    return f"net row{'s' if len(rows) > 1 else ''} {', '.join(rows)}: "
