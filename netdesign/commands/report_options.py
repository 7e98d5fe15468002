"""Options that say which reports are written, and how."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

from netdesign.commands.options import language_option

_DETAIL_HELP = (
    "Of report.html: summary leaves out what only a reviewer of a row needs; figures "
    "unfolds every figure of the checks, also on paper."
)


def report_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options; ``read_options`` takes their values."""
    for option in (
        language_option("Of the reports; numbers, symbols and keys stay."),
        click.option(
            "--detail",
            type=click.Choice(["summary", "full", "figures"]),
            default="full",
            show_default=True,
            help=_DETAIL_HELP,
        ),
        click.option(
            "--csv/--no-csv", default=False, help="Write cases.csv, all cases."
        ),
        click.option(
            "--pdf/--no-pdf", default=False, help="Write report.pdf (extra pdf)."
        ),
        click.option("--excel/--no-excel", default=True, help="Write report.xlsx."),
        click.option("--html/--no-html", default=True, help="Write report.html."),
    ):
        command = option(command)
    return command


def list_wanted(options: dict[str, Any]) -> list[str]:
    """Names of the wanted reports; takes their options out of ``options``.

    Raises
    ------
    NetDesignError
        If one of them cannot be written on this machine.
    """
    from netdesign.report.files import list_reports
    from netdesign.report.page.pdf import require_pdf

    names = ("html", "excel", "csv", "pdf")
    wanted = {name: options.pop(name) for name in names}
    if wanted["pdf"]:
        require_pdf()
    return list_reports(**wanted)
