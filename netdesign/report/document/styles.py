"""Empty document in our look: paper, styles, properties; its bytes."""

from __future__ import annotations

import io
import zipfile
from datetime import datetime
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from netdesign.outcome import OutputError
from netdesign.words.catalogue import Language
from netdesign.words.message import say

if TYPE_CHECKING:
    from docx.document import Document

TITLE, HEADING, SUBHEADING, CAPTION = "Title", "Heading 1", "Heading 2", "Caption"
TEXT, ITEM, SMALL, CELL = "Normal", "List Bullet", "netdesign small", "netdesign cell"
VERDICT, TABLE = "netdesign verdict", "netdesign table"

# Size [pt], bold, space above and below [pt], stays with what follows.
_LOOKS: dict[str, tuple[float, bool, float, float, bool]] = {
    TITLE: (17.0, True, 0.0, 4.0, True),
    HEADING: (14.0, True, 6.0, 2.0, True),
    SUBHEADING: (9.5, True, 4.0, 1.0, True),
    CAPTION: (7.5, False, 4.0, 1.0, True),
    TEXT: (8.5, False, 0.0, 2.0, False),
    ITEM: (7.5, False, 0.0, 0.5, False),
    SMALL: (7.5, False, 0.0, 2.0, False),
    CELL: (7.5, False, 0.0, 0.0, False),
    VERDICT: (16.0, True, 4.0, 3.0, True),
}
NAMES = (*_LOOKS, TABLE)
_NEEDED = ("docx", "PIL", "matplotlib")  # the last two for drawings without SVG
_A4_MM = (210.0, 297.0)
_MARGIN_MM, _UPRIGHT_MM, _EDGE_MM = 15.0, 12.0, 6.0
_ZIP_TIME = (1980, 1, 1, 0, 0, 0)
_MOST_SIGNS = 255  # of a property of a document
_INK = "1B1E22"
_FONT = "Arial"
_LOCALES = {"en": "en-GB", "fr": "fr-FR", "de": "de-DE"}


def require_docx() -> None:
    """Refuse a wish for a document before anything is solved.

    Raises
    ------
    OutputError
        If a library is not installed: they are an extra, ``netdesign[docx]``.
    """
    if not all(map(find_spec, _NEEDED)):
        raise OutputError(say("program.no_python_docx"))


def open_document(language: Language) -> Document:
    """Empty document on A4 with our styles; its text is of a language."""
    import docx
    from docx.enum.style import WD_STYLE_TYPE

    document = docx.Document()
    _set_paper(document)
    for name in _LOOKS:
        if name not in document.styles:
            document.styles.add_style(name, WD_STYLE_TYPE.PARAGRAPH)
        style = document.styles[name]
        _shape(style, name)
        _set_font(style)
    _add_table_style(document)
    _set_language(document, language)
    return document


def _set_paper(document: Document) -> None:
    from docx.shared import Mm

    section = document.sections[0]
    section.page_width, section.page_height = (Mm(side) for side in _A4_MM)
    section.left_margin = section.right_margin = Mm(_MARGIN_MM)
    section.top_margin = section.bottom_margin = Mm(_UPRIGHT_MM)
    section.header_distance = section.footer_distance = Mm(_EDGE_MM)


def _set_language(document: Document, language: Language) -> None:
    """Language of all text, for spelling and for readers aloud."""
    from docx.oxml import OxmlElement
    from docx.oxml.ns import qn

    look = document.styles[TEXT].element.get_or_add_rPr()
    element = OxmlElement("w:lang")
    element.set(qn("w:val"), _LOCALES[language])
    look.append(element)


def _shape(style: Any, name: str) -> None:
    from docx.shared import Pt, RGBColor

    size, is_bold, above, below, keeps = _LOOKS[name]
    style.font.size, style.font.bold = Pt(size), is_bold
    style.font.italic = False
    style.font.color.rgb = RGBColor.from_string(_INK)
    form = style.paragraph_format
    form.space_before, form.space_after = Pt(above), Pt(below)
    form.keep_with_next = keeps
    if name in (HEADING, SUBHEADING):
        _set_level(style, 0 if name == HEADING else 1)


def _set_level(style: Any, level: int) -> None:
    """Outline level, by which readers aloud find a heading."""
    from docx.oxml import parse_xml

    from netdesign.report.document.markup import NAMESPACE

    look = style.element.get_or_add_pPr()
    if look.find("{*}outlineLvl") is None:
        look.append(parse_xml(f'<w:outlineLvl {NAMESPACE} w:val="{level}"/>'))


def _set_font(style: Any) -> None:
    """One font for every script; that of a theme would win over a named one."""
    from docx.oxml import parse_xml

    from netdesign.report.document.markup import NAMESPACE

    look = style.element.get_or_add_rPr()
    for old in look.findall("{*}rFonts"):
        look.remove(old)
    names = " ".join(f'w:{s}="{_FONT}"' for s in ("ascii", "hAnsi", "cs", "eastAsia"))
    look.insert(0, parse_xml(f"<w:rFonts {NAMESPACE} {names}/>"))


def _add_table_style(document: Document) -> None:
    """Thin lines between rows, a stronger one below the headings."""
    from docx.oxml import parse_xml

    from netdesign.report.document.markup import NAMESPACE

    def line(side: str, eighths: int, colour: str) -> str:
        size = f'w:sz="{eighths}" w:space="0"'
        return f'<w:{side} w:val="single" {size} w:color="{colour}"/>'

    document.styles.element.append(
        parse_xml(
            f'<w:style {NAMESPACE} w:type="table" w:customStyle="1" '
            f'w:styleId="netdesignTable"><w:name w:val="{TABLE}"/><w:uiPriority '
            f'w:val="99"/><w:tblPr><w:tblBorders>{line("top", 6, _INK)}'
            f"{line('bottom', 6, _INK)}{line('insideH', 4, 'D3D7DC')}</w:tblBorders>"
            f'</w:tblPr><w:tblStylePr w:type="firstRow"><w:tcPr><w:tcBorders>'
            f"{line('bottom', 6, _INK)}</w:tcBorders></w:tcPr></w:tblStylePr></w:style>"
        )
    )


def set_properties(
    document: Document, *, title: str, subject: str, author: str, created: datetime
) -> None:
    """Properties of a document."""
    known = document.core_properties
    known.title, known.subject = title[:_MOST_SIGNS], subject[:_MOST_SIGNS]
    known.author = known.last_modified_by = author[:_MOST_SIGNS]
    known.comments = ""
    known.created = known.modified = created
    known.revision = 1


def pack(document: Document) -> bytes:
    """Bytes of a document, its parts without the time of writing."""
    written, buffer = io.BytesIO(), io.BytesIO()
    document.save(written)
    with (
        zipfile.ZipFile(written) as source,
        zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as target,
    ):
        for name in source.namelist():
            part = zipfile.ZipInfo(name, _ZIP_TIME)
            part.compress_type = zipfile.ZIP_DEFLATED
            target.writestr(part, source.read(name))
    return buffer.getvalue()
