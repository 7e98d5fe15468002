"""Styles of a document: those that the template has, ours for what it lacks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from netdesign.words.catalogue import Language

if TYPE_CHECKING:
    from docx.document import Document

TITLE, HEADING, SUBHEADING, CAPTION = "Title", "Heading 1", "Heading 2", "Caption"
TEXT, ITEM, SMALL, CELL = "Normal", "List Bullet", "netdesign small", "netdesign cell"
VERDICT, TABLE = "netdesign verdict", "netdesign table"

# Size [pt], bold, space above and below [pt], stays with what follows.
_LOOKS: dict[str, tuple[float, bool, float, float, bool]] = {
    TITLE: (17.0, True, 0.0, 4.0, True),
    HEADING: (14.0, True, 0.0, 2.0, True),
    SUBHEADING: (9.5, True, 4.0, 1.0, True),
    CAPTION: (7.5, False, 4.0, 1.0, True),
    TEXT: (8.5, False, 0.0, 2.0, False),
    ITEM: (7.5, False, 0.0, 0.5, False),
    SMALL: (7.5, False, 0.0, 2.0, False),
    CELL: (7.5, False, 0.0, 0.0, False),
    VERDICT: (16.0, True, 4.0, 3.0, True),
}
NAMES = (*_LOOKS, TABLE)
_OWN = "netdesign"  # beginning of the names that are ours
_INK = "1B1E22"
_FONT = "Arial"
_LOCALES = {"en": "en-GB", "fr": "fr-FR", "de": "de-DE"}


def add_missing(document: Document) -> None:
    """Give a document each style that it lacks."""
    for name in _LOOKS:
        if _find(document, name) is None:
            _shape(_add(document, name), name)
    if _find(document, TABLE) is None:
        _add_table_style(document)


def _find(document: Document, name: str) -> Any:
    """Style of a name; programs write those of Word in capitals or without."""
    from docx.enum.style import WD_STYLE_TYPE

    kind = WD_STYLE_TYPE.TABLE if name == TABLE else WD_STYLE_TYPE.PARAGRAPH
    wanted = {name.lower(), _name_own(name).lower()}
    for style in document.styles:
        if style.type == kind and str(style.name).lower() in wanted:
            return style
    return None


def _add(document: Document, name: str) -> Any:
    """New style of a paragraph, its name and id unlike those of any other one."""
    from docx.enum.style import WD_STYLE_TYPE

    known = {str(style.name).lower() for style in document.styles}
    ids = {style.style_id for style in document.styles}
    if name.lower() in known:  # it is one of letters, say
        name = _name_own(name)
    is_built_in = not name.startswith(_OWN)
    kind = WD_STYLE_TYPE.PARAGRAPH
    style: Any = document.styles.add_style(name, kind, builtin=is_built_in)
    if style.style_id in ids:
        style.element.styleId = _name_own(name).replace(" ", "")
    return style


def _name_own(name: str) -> str:
    return name if name.startswith(_OWN) else f"{_OWN} {name}"


def shape_all(document: Document) -> None:
    """Our look for every style, in a document without a template."""
    for name in _LOOKS:
        style = _find(document, name)
        _shape(style, name)
        _set_font(style)


def find_id(document: Document, name: str) -> str:
    """Id by which paragraphs and tables name a style."""
    return str(_find(document, name).style_id)


def set_language(document: Document, language: Language) -> None:
    """Language of all text, for spelling and for readers aloud."""
    from docx.oxml import OxmlElement
    from docx.oxml.ns import qn

    look = _find(document, TEXT).element.get_or_add_rPr()
    for old in look.findall(qn("w:lang")):
        look.remove(old)
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
