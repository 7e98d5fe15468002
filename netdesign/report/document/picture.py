"""A drawing in a document: SVG, with a PNG for programs that show none.

The SVG is named by svgBlip, an extension of Word (namespace below, described in
Microsoft's Open Specification MS-ODRAWXML). Programs without it show the PNG.
"""

from __future__ import annotations

import io
from html import escape
from typing import TYPE_CHECKING

from netdesign.edge.given_files import make_printable
from netdesign.report.drawing.raster import read_size, read_title, render_png

if TYPE_CHECKING:
    from docx.document import Document

_EMU = 12700  # of a point
_DRAWING = "http://schemas.openxmlformats.org/drawingml/2006"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006"
_SPACES = (
    f'xmlns:wp="{_DRAWING}/wordprocessingDrawing" xmlns:a="{_DRAWING}/main" '
    f'xmlns:pic="{_DRAWING}/picture" xmlns:r="{_OFFICE}/relationships"'
)
_SVG_SPACE = "http://schemas.microsoft.com/office/drawing/2016/SVG/main"
_SVG_EXTENSION = "{96DAC541-7B7A-43D3-8B79-37D633B846F1}"


def write_picture(
    document: Document, svg: str, number: int, most_pt: tuple[float, float]
) -> str:
    """Run with a drawing, as WordprocessingML; both files go into the document.

    Parameters
    ----------
    document : docx.document.Document
        Takes the files.
    svg : str
        Of ours.
    number : int
        Of the picture, from 1.
    most_pt : tuple of float
        Largest width and height; the drawing is made smaller, never larger [pt].
    """
    size = read_size(svg)
    scale = min(1.0, most_pt[0] / size[0], most_pt[1] / size[1])
    wide, high = (round(scale * side * _EMU) for side in size)
    png, _ = document.part.get_or_add_image(io.BytesIO(render_png(svg)))
    words = escape(make_printable(read_title(svg)))
    extent = f'cx="{wide}" cy="{high}"'
    return (
        f'<w:r><w:drawing {_SPACES}><wp:inline distT="0" distB="0" distL="0" distR="0">'
        f'<wp:extent {extent}/><wp:docPr id="{number}" name="Picture {number}" '
        f'descr="{words}"/><wp:cNvGraphicFramePr><a:graphicFrameLocks '
        f'noChangeAspect="1"/></wp:cNvGraphicFramePr><a:graphic><a:graphicData '
        f'uri="{_DRAWING}/picture"><pic:pic><pic:nvPicPr><pic:cNvPr id="{number}" '
        f'name="Picture {number}"/><pic:cNvPicPr/></pic:nvPicPr><pic:blipFill>'
        f'<a:blip r:embed="{png}"><a:extLst><a:ext uri="{_SVG_EXTENSION}">'
        f'<asvg:svgBlip xmlns:asvg="{_SVG_SPACE}" '
        f'r:embed="{_add_svg(document, svg, number)}"/></a:ext></a:extLst></a:blip>'
        f"<a:stretch><a:fillRect/></a:stretch></pic:blipFill><pic:spPr><a:xfrm>"
        f'<a:off x="0" y="0"/><a:ext {extent}/></a:xfrm><a:prstGeom prst="rect">'
        f"<a:avLst/></a:prstGeom></pic:spPr></pic:pic></a:graphicData></a:graphic>"
        f"</wp:inline></w:drawing></w:r>"
    )


def _add_svg(document: Document, svg: str, number: int) -> str:
    """Id of the relation to the drawing's own file."""
    from docx.opc.constants import RELATIONSHIP_TYPE
    from docx.opc.packuri import PackURI
    from docx.opc.part import Part

    name = PackURI(f"/word/media/drawing{number}.svg")
    part = Part(name, "image/svg+xml", svg.encode(), document.part.package)
    return document.part.relate_to(part, RELATIONSHIP_TYPE.IMAGE)
