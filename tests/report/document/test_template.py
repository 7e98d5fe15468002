"""What is no template is one clear refusal, before anything is solved."""

import io
import zipfile

import pytest

docx = pytest.importorskip("docx")

from netdesign.errors import OutputError  # noqa: E402
from netdesign.report.document import template  # noqa: E402
from netdesign.report.document.template import read_template, require_docx  # noqa: E402
from netdesign.words.catalogue import render  # noqa: E402


def write_document():
    buffer = io.BytesIO()
    docx.Document().save(buffer)
    return buffer.getvalue()


def spoil(content, part, old, new):
    """The same package with a text of one part replaced."""
    buffer = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(content)) as source,
        zipfile.ZipFile(buffer, "w") as target,
    ):
        for name in source.namelist():
            text = source.read(name)
            target.writestr(name, text.replace(old, new) if name == part else text)
    return buffer.getvalue()


WHOLE = write_document()
MAIN = b"wordprocessingml.document.main+xml"
SPOILT = {
    "empty.docx": b"",
    "page.docx": b"<html>Word</html>",
    "cut.docx": WHOLE[:9000],
    "site.docx": spoil(WHOLE, "word/document.xml", b"</w:body>", b""),
    "letter.dotx": spoil(
        WHOLE, "[Content_Types].xml", MAIN, b"wordprocessingml.template.main+xml"
    ),
    "nothing.docx": spoil(WHOLE, "_rels/.rels", b"officeDocument", b"else"),
}


@pytest.mark.parametrize("name", SPOILT)
def test_a_file_that_is_no_document_is_refused_by_its_name(tmp_path, name):
    (tmp_path / name).write_bytes(SPOILT[name])
    with pytest.raises(OutputError) as caught:
        read_template(tmp_path / name)
    for language, word in (("en", "template"), ("fr", "modèle"), ("de", "Vorlage")):
        told = render(caught.value.message, language)
        assert name in told
        assert word in told


def test_a_template_that_is_not_there_or_too_large_is_refused(tmp_path, monkeypatch):
    with pytest.raises(OutputError, match=r"none\.docx"):
        read_template(tmp_path / "none.docx")
    (tmp_path / "own.docx").write_bytes(WHOLE)
    assert read_template(tmp_path / "own.docx") == WHOLE
    monkeypatch.setattr(template, "_MOST_BYTES", len(WHOLE) - 1)
    with pytest.raises(OutputError, match="20 MB"):
        read_template(tmp_path / "own.docx")


def test_without_the_library_the_wish_is_refused(monkeypatch):
    monkeypatch.setattr(template, "find_spec", lambda _name: None)
    with pytest.raises(OutputError, match=r"pip install 'netdesign\[docx\]'"):
        require_docx()
