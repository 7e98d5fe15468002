"""Files of a study, and their contents."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from netdesign.edge.json_text import list_fields
from netdesign.outcome import OutputError
from netdesign.report.blocks import write_csv
from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.solving.workers import ProcessPool
    from netdesign.study.records import Study


# Files of a study by their kinds.
NAMES = {
    "html": "report.html",
    "pdf": "report.pdf",
    "docx": "report.docx",
    "xlsx": "report.xlsx",
    "csv": "cases.csv",
}
# Signs that make a spreadsheet program read a text as a formula.
_FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportStyle:
    """Language, extent and look of the reports; the numbers do not depend on them."""

    language: Language = "en"
    has_annexes: bool = False
    is_verified: bool = False  # a stored study was solved again in this run


# Made by other processes, which first read the study: so this one makes the workbook,
# which takes longest.
_APART = (".html", ".docx")


def render_files(
    plan: Mapping[Path, Study], style: ReportStyle, pool: ProcessPool | None = None
) -> dict[Path, bytes]:
    """Contents of all files.

    Parameters
    ----------
    plan : mapping of Path to Study
        What is shown in each file, whose suffix says what it is.
    style : ReportStyle
        Language, extent and look.
    pool : ProcessPool, optional
        Makes some of the files, while this process makes the others.
    """
    begun = {
        path: pool.begin(render_kind, path.suffix, study, style)
        for path, study in plan.items()
        if pool is not None and _is_apart(path, plan)
    }
    contents: dict[Path, bytes] = {}
    for path, study in plan.items():
        page = contents.get(path.with_suffix(".html"))
        if path.suffix == ".pdf" and page:
            contents[path] = _print_page(page)
        elif path not in begun:
            contents[path] = render_kind(path.suffix, study, style)
    return contents | {path: finish() for path, finish in begun.items()}


def _is_apart(path: Path, plan: Mapping[Path, Study]) -> bool:
    """Another process makes a file: no only one, and no page that is printed, too."""
    is_printed = path.suffix == ".html" and path.with_suffix(".pdf") in plan
    return path.suffix in _APART and len(plan) > 1 and not is_printed


def render_kind(kind: str, study: Study, style: ReportStyle) -> bytes:
    """Content of one file of a study, independent of the others.

    Another process can make it, for function, arguments and result can be pickled.

    Parameters
    ----------
    kind : str
        Suffix of the file, as ``.xlsx``; modules of the others are not imported.
    study : Study
        What is shown.
    style : ReportStyle
        Language, extent and look.
    """
    return _KINDS[kind](study, style)


def _render_page(study: Study, style: ReportStyle) -> bytes:
    from netdesign.report.page import render_html

    page = render_html(
        *(study, style.language),
        has_annexes=style.has_annexes,
        is_verified=style.is_verified,
    )
    return page.encode()


def require_pdf() -> None:
    """Refuse a wish for a PDF before anything is solved.

    Raises
    ------
    OutputError
        If the library is not installed: it is an extra, ``netdesign[pdf]``.
    """
    if find_spec("weasyprint") is None:
        raise OutputError(say("program.no_weasyprint"))


def _render_pdf(study: Study, style: ReportStyle) -> bytes:
    return _print_page(_render_page(study, style))


def _print_page(page: bytes) -> bytes:
    """A4 document of a page of ours."""
    require_pdf()
    import weasyprint

    document: bytes = weasyprint.HTML(string=page.decode()).write_pdf()
    return document


def _render_docx(study: Study, style: ReportStyle) -> bytes:
    from netdesign.report.document.styles import require_docx
    from netdesign.report.document.word import render_document

    require_docx()
    return render_document(
        *(study, style.language),
        has_annexes=style.has_annexes,
        is_verified=style.is_verified,
    )


def _render_xlsx(study: Study, style: ReportStyle) -> bytes:
    from netdesign.report.workbook.excel import render_workbook

    return render_workbook(study, style.language, is_verified=style.is_verified)


def _render_csv(study: Study, style: ReportStyle) -> bytes:
    """All cases of all net rows, one a line; units are part of the headings.

    Missing forces of failed cases stay missing; outcome and reason say why.
    """
    lines: list[dict[str, Any]] = []
    for row in study.rows:
        for record in row.cases:
            fields = list_fields(record)
            point = list_fields(fields.pop("case"))
            reason = render(record.reason, style.language) if record.reason else ""
            texts = {"outcome": fields["outcome"], "reason": reason}
            fields |= {key: _disarm(text) for key, text in texts.items()}
            lines.append({"net_row": _disarm(row.id), **point, **fields})
    headings = list(dict.fromkeys(key for line in lines for key in line))
    return write_csv(headings, [[line.get(key) for key in headings] for line in lines])


def _disarm(text: str) -> str:
    """Text that no spreadsheet program reads as a formula."""
    return f"'{text}" if text.startswith(_FORMULA_STARTS) else str(text)


def _render_json(study: Study, _: ReportStyle) -> bytes:
    from netdesign.study.document import write_document

    return write_document(study).encode()


_KINDS: dict[str, Callable[[Study, ReportStyle], bytes]] = {
    ".html": _render_page,
    ".pdf": _render_pdf,
    ".docx": _render_docx,
    ".xlsx": _render_xlsx,
    ".csv": _render_csv,
    ".json": _render_json,
}
