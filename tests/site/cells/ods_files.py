"""Small ods files written by hand, as no package is needed for them."""

from __future__ import annotations

import datetime
import zipfile
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

NAMES = " ".join(
    f'xmlns:{short}="{long}"'
    for short, long in {
        "office": "urn:oasis:names:tc:opendocument:xmlns:office:1.0",
        "table": "urn:oasis:names:tc:opendocument:xmlns:table:1.0",
        "text": "urn:oasis:names:tc:opendocument:xmlns:text:1.0",
        "style": "urn:oasis:names:tc:opendocument:xmlns:style:1.0",
        "calcext": "urn:org:documentfoundation:names:experimental:calc:xmlns:"
        "calcext:1.0",
    }.items()
)


def write_cell(value: object) -> str:
    """XML of a cell; text that begins with ``<`` is taken as XML already."""
    if value is None:
        return "<table:table-cell/>"
    if isinstance(value, str) and value.startswith("<"):
        return value
    if isinstance(value, bool):
        kind = f'"boolean" office:boolean-value="{str(value).lower()}"'
    elif isinstance(value, int | float):
        kind = f'"float" office:value="{value!r}"'
    elif isinstance(value, datetime.datetime):
        kind = f'"date" office:date-value={quoteattr(value.isoformat())}'
    else:
        kind = '"string"'
    text = escape(str(value))
    return (
        f"<table:table-cell office:value-type={kind}><text:p>{text}</text:p>"
        "</table:table-cell>"
    )


def write_ods(
    path: Path,
    sheets: dict[str, list[list[object]]],
    *,
    styles: str = "",
    attributes: str = "",
) -> Path:
    """Sheets of rows as a file; ``attributes`` go to every table."""
    tables = "".join(
        f"<table:table table:name={quoteattr(name)} {attributes}>"
        + "".join(
            row[0]
            if row and str(row[0]).startswith("<table:table-row")
            else f"<table:table-row>{''.join(map(write_cell, row))}</table:table-row>"
            for row in rows
        )
        + "</table:table>"
        for name, rows in sheets.items()
    )
    content = (
        f'<?xml version="1.0"?><office:document-content {NAMES}>'
        f"<office:automatic-styles>{styles}</office:automatic-styles>"
        f"<office:body><office:spreadsheet>{tables}</office:spreadsheet>"
        "</office:body></office:document-content>"
    )
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("mimetype", "application/vnd.oasis.opendocument.spreadsheet")
        archive.writestr("content.xml", content)
    return path
