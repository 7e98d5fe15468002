"""Document to write into, a company's template or an empty one; its bytes."""

from __future__ import annotations

import io
import zipfile
import zlib
from datetime import datetime
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from netdesign.edge.input_files import read_bounded
from netdesign.outcome import OutputError
from netdesign.report.document.styles import add_missing, shape_all
from netdesign.words.message import say

if TYPE_CHECKING:
    from docx.document import Document


_NEEDED = ("docx", "PIL", "matplotlib")  # the last two for drawings without SVG
_MOST_BYTES = 20 * 2**20
# What zipfile, the XML parser and python-docx raise on a file that is no document.
_DAMAGE = (
    *(ArithmeticError, AttributeError, EOFError, LookupError, OSError, RuntimeError),
    *(SyntaxError, TypeError, ValueError, zipfile.BadZipFile, zlib.error),
)
# Relations of a document that hold without a place in its text.
_KEPT = (
    *("styles", "stylesWithEffects", "settings", "webSettings", "theme", "fontTable"),
    *("numbering", "header", "footer", "footnotes", "endnotes"),
)
_TYPES = "[Content_Types].xml"
_TEMPLATE = b"wordprocessingml.template.main+xml"
_DOCUMENT = b"wordprocessingml.document.main+xml"
_A4_MM = (210.0, 297.0)
_MARGIN_MM, _UPRIGHT_MM, _EDGE_MM = 15.0, 12.0, 6.0


def require_docx() -> None:
    """Refuse a wish for a document before anything is solved.

    Raises
    ------
    OutputError
        If a library is not installed: they are an extra, ``netdesign[docx]``.
    """
    if not all(map(find_spec, _NEEDED)):
        raise OutputError(say("program.no_python_docx"))


def read_template(path: Path) -> bytes:
    """Content of a template that a document can be written into.

    Raises
    ------
    OutputError
        If it cannot be read, or is no docx.
    """
    require_docx()
    from docx.opc.exceptions import OpcError

    try:
        content = read_bounded(path, _MOST_BYTES)
        open_document(content)
    except (*_DAMAGE, OpcError) as error:
        raise OutputError(say("program.no_template", file=str(path))) from error
    return content


def open_document(template: bytes | None) -> Document:
    """Empty document; a template keeps styles, page, header and footer."""
    import docx

    if template is None:
        document = docx.Document()
        _set_paper(document)
    else:
        document = docx.Document(io.BytesIO(_make_document(template)))
        if document.element.body.sectPr is None:
            document.element.body.get_or_add_sectPr()
            _set_paper(document)
        _drop_text(document)
    add_missing(document)
    if template is None:
        shape_all(document)
    return document


def _make_document(content: bytes) -> bytes:
    """Package of a document; that of a template (.dotx) differs by its type."""
    with zipfile.ZipFile(io.BytesIO(content)) as source:
        declared = source.read(_TYPES)
        if _TEMPLATE not in declared:
            return content
        buffer = io.BytesIO()
        with zipfile.ZipFile(buffer, "w") as target:
            for entry in source.infolist():
                part = source.read(entry)
                if entry.filename == _TYPES:
                    part = part.replace(_TEMPLATE, _DOCUMENT)
                target.writestr(entry.filename, part)
    return buffer.getvalue()


def _set_paper(document: Document) -> None:
    from docx.shared import Mm

    section = document.sections[0]
    section.page_width, section.page_height = (Mm(side) for side in _A4_MM)
    section.left_margin = section.right_margin = Mm(_MARGIN_MM)
    section.top_margin = section.bottom_margin = Mm(_UPRIGHT_MM)
    section.header_distance = section.footer_distance = Mm(_EDGE_MM)


def _drop_text(document: Document) -> None:
    """Take out the text of a template, which may be that of an older report.

    Pictures, links and comments of that text go with it: they would be sent along.
    """
    body = document.element.body
    for element in list(body):
        if element is not body.sectPr:
            body.remove(element)
    for name, relation in list(document.part.rels.items()):
        if relation.reltype.rpartition("/")[2] not in _KEPT:
            del document.part.rels[name]


_ZIP_TIME = (1980, 1, 1, 0, 0, 0)
_MOST_SIGNS = 255  # of a property of a document


def set_properties(
    document: Document, *, title: str, subject: str, author: str, created: datetime
) -> None:
    """Properties of a document; those of its template are replaced."""
    known = document.core_properties
    known.title, known.subject = title[:_MOST_SIGNS], subject[:_MOST_SIGNS]
    known.author = known.last_modified_by = author[:_MOST_SIGNS]
    known.comments = known.keywords = known.category = ""
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
