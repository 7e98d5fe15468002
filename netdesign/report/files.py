"""Files of a study, and their contents."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from netdesign.words.catalogue import Language

if TYPE_CHECKING:
    from netdesign.report.view.whole import Detail, ReportView
    from netdesign.study.records import Study


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportStyle:
    """Language, detail and look of the reports; the numbers do not depend on them."""

    language: Language = "en"
    detail: Detail = "full"
    template: bytes | None = None  # docx that report.docx is written into


def list_reports(
    *, html: bool, excel: bool, csv: bool, pdf: bool = False, docx: bool = False
) -> list[str]:
    """Names of the wanted reports."""
    wanted = {
        "report.html": html,
        "report.pdf": pdf,
        "report.docx": docx,
        "report.xlsx": excel,
        "cases.csv": csv,
    }
    return [name for name, is_wanted in wanted.items() if is_wanted]


def name_files(
    folder: Path | None, profiles: Sequence[str], names: Sequence[str]
) -> list[list[Path]]:
    """Paths of each study's files; several profiles get a folder each.

    Without a folder there are none.
    """
    if folder is None:
        return [[] for _ in profiles]
    several = len(profiles) > 1
    return [
        [(folder / profile if several else folder) / name for name in names]
        for profile in profiles
    ]


def render_files(
    studies: Sequence[Study],
    paths: Sequence[Sequence[Path]],
    style: ReportStyle | None = None,
    views: Sequence[ReportView] = (),
) -> dict[Path, bytes]:
    """Contents of all files; the suffix says what each of them is.

    ``views`` are those of the studies in the language of the style, if they are known.
    """
    contents: dict[Path, bytes] = {}
    known: Sequence[ReportView | None] = views or [None] * len(studies)
    for study, of_study, view in zip(studies, paths, known, strict=True):
        wanted = {path.suffix for path in of_study}
        rendered = _render(study, wanted, style or ReportStyle(), view)
        contents |= {path: rendered[path.suffix] for path in of_study}
    return contents


def _render(
    study: Study, wanted: Set[str], style: ReportStyle, view: ReportView | None
) -> dict[str, bytes]:
    """Wanted formats of a study; modules of the others are not imported."""
    rendered: dict[str, bytes] = {}
    if view is None and wanted & {".html", ".pdf", ".xlsx", ".docx"}:
        from netdesign.report.view.whole import build_view

        view = build_view(study, style.language)
    if wanted & {".html", ".pdf"}:
        from netdesign.report.page.html import render_html

        page = render_html(study, style.language, style.detail, view)
        rendered[".html"] = page.encode()
    if ".pdf" in wanted:
        from netdesign.report.page.pdf import render_pdf

        rendered[".pdf"] = render_pdf(page)
    if ".docx" in wanted:
        from netdesign.report.document.word import render_document

        rendered[".docx"] = render_document(
            study, style.language, style.detail, view, style.template
        )
    if ".xlsx" in wanted:
        from netdesign.report.workbook.excel import render_workbook

        rendered[".xlsx"] = render_workbook(study, style.language, view)
    if ".csv" in wanted:
        from netdesign.report.view.case_table import render_cases

        rendered[".csv"] = render_cases(study, style.language)
    if ".json" in wanted:
        from netdesign.study.document import write_document

        rendered[".json"] = write_document(study).encode()
    return rendered
