"""Study -> docx: the blocks of the page, as it shows them on paper."""

from __future__ import annotations

from typing import Any

from netdesign.report.document import styles
from netdesign.report.document.markup import POINT, list_runs, parse, write_runs
from netdesign.report.document.template import open_document, pack, set_properties
from netdesign.report.document.writer import Writer, write_field
from netdesign.report.sections.whole import Detail, build_report, title_pages
from netdesign.report.words import Words, show_text
from netdesign.study.records import Study
from netdesign.words.catalogue import Language


def render_document(
    study: Study,
    language: Language = "en",
    detail: Detail = "full",
    template: bytes | None = None,
) -> bytes:
    """Document of a study; the same study and template give the same bytes.

    Parameters
    ----------
    study : Study
        What is shown.
    language : str
        ``en``, ``fr`` or ``de``.
    detail : str
        ``summary`` leaves out the pages of net rows and the annexes.
    template : bytes, optional
        Docx whose styles, page, header and footer are kept.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    words = Words(language)
    running = title_pages(study, words)
    document = open_document(template)
    styles.set_language(document, language)
    to = Writer(document=document, words=words)
    _write_footer(to, running)
    to.write(build_report(study, words, detail))
    set_properties(
        document,
        title=words("heading.anchor_check"),
        subject=running,
        author=show_text(study.project.author),
        started=study.provenance.started,
    )
    return pack(document)


def _write_footer(to: Writer, running: str) -> None:
    """Running title, section and page; a template's own footer stays."""
    document = to.document
    section: Any = document.sections[-1]
    if not section.footer.is_linked_to_previous:
        return
    section.footer.is_linked_to_previous = False
    paragraph = section.footer.paragraphs[0]
    paragraph.style = document.styles[styles.SMALL]
    right = round(POINT * to.width_pt)
    tab = "<w:r><w:tab/></w:r>"
    runs = (
        write_runs(list_runs(running))
        + tab
        + write_field("STYLEREF 1")
        + tab
        + write_field("PAGE", "1")
        + write_runs(list_runs(" / "))
        + write_field("NUMPAGES", "1")
    )
    look = (
        f'<w:tabs><w:tab w:val="center" w:pos="{right // 2}"/>'
        f'<w:tab w:val="right" w:pos="{right}"/></w:tabs>'
    )
    filled = parse(f"<w:p><w:pPr>{look}</w:pPr>{runs}</w:p>")
    named: Any = paragraph._p.get_or_add_pPr()
    named.append(filled[0][0])
    for run in list(filled)[1:]:
        paragraph._p.append(run)
