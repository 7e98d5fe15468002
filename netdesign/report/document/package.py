"""Document -> bytes: equal ones for equal documents, whenever they are written."""

from __future__ import annotations

import io
import zipfile
from datetime import UTC, datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from docx.document import Document

_NO_TIME = datetime(1980, 1, 1)
_ZIP_TIME = (1980, 1, 1, 0, 0, 0)
_MOST_SIGNS = 255  # of a property of a document


def set_properties(
    document: Document, *, title: str, subject: str, author: str, started: str
) -> None:
    """Properties of a document; those of its template are replaced."""
    known = document.core_properties
    known.title, known.subject = title[:_MOST_SIGNS], subject[:_MOST_SIGNS]
    known.author = known.last_modified_by = author[:_MOST_SIGNS]
    known.comments = known.keywords = known.category = ""
    known.created = known.modified = _read_time(started)
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


def _read_time(started: str) -> datetime:
    """Start of the study in UTC without a zone, as documents store it."""
    if not started:
        return _NO_TIME
    time = datetime.fromisoformat(started)
    return time.astimezone(UTC).replace(tzinfo=None) if time.tzinfo else time
