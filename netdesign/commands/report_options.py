"""Options that say which reports are written, and how."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import language_option

if TYPE_CHECKING:
    from netdesign.report.files import ReportStyle

_DETAIL_HELP = (
    "Of report.html, report.docx: summary leaves out what only a reviewer of a "
    "row needs; figures unfolds every figure of the checks, also on paper."
)


def report_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options; `list_wanted` and `choose_style` take their values."""
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
            "--template",
            type=click.Path(path_type=Path),
            metavar="FILE.docx",
            help="Write report.docx into it: its styles, header and footer stay.",
        ),
        click.option(
            "--docx/--no-docx", default=False, help="Write report.docx (extra docx)."
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

    A template alone is a wish for a document, too.

    Raises
    ------
    NetDesignError
        If one of them cannot be written on this machine.
    """
    from netdesign.report.files import list_reports

    names = ("html", "excel", "csv", "pdf", "docx")
    wanted = {name: options.pop(name) for name in names}
    wanted["docx"] = wanted["docx"] or options["template"] is not None
    if wanted["pdf"]:
        from netdesign.report.page.pdf import require_pdf

        require_pdf()
    if wanted["docx"]:
        from netdesign.report.document.template import require_docx

        require_docx()
    return list_reports(**wanted)


def choose_style(options: dict[str, Any]) -> ReportStyle:
    """Style of the reports; reads the template, before anything is solved.

    Raises
    ------
    NetDesignError
        If the template is no document.
    """
    from netdesign.report.files import ReportStyle

    template: Path | None = options.pop("template")
    content: bytes | None = None
    if template:
        from netdesign.report.document.template import read_template

        content = read_template(template)
    return ReportStyle(**options, template=content)
