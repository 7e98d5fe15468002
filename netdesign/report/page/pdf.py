"""Page -> PDF, by a library that is an extra: ``pip install netdesign[pdf]``."""

from __future__ import annotations

from importlib.util import find_spec

from netdesign.outcome import OutputError
from netdesign.words.message import say


def require_pdf() -> None:
    """Refuse a wish for a PDF before anything is solved.

    Raises
    ------
    OutputError
        If the library is not installed.
    """
    if find_spec("weasyprint") is None:
        raise OutputError(say("program.no_weasyprint"))


def render_pdf(page: str) -> bytes:
    """A4 document of a page of ours.

    Raises
    ------
    OutputError
        If the library is not installed.
    """
    require_pdf()
    import weasyprint

    document: bytes = weasyprint.HTML(string=page).write_pdf()
    return document
