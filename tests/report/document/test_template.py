"""What is no template is one clear refusal, before anything is solved."""

import io
import re
import zipfile

import pytest

docx = pytest.importorskip("docx")

from netdesign.outcome import OutputError  # noqa: E402
from netdesign.report.document import template  # noqa: E402
from netdesign.report.document.template import read_template, require_docx  # noqa: E402
from netdesign.report.document.word import render_document  # noqa: E402
from tests.report.build_study import build_study  # noqa: E402
from tests.report.document.reading import list_parts  # noqa: E402


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
WHOLE_STYLES = list_parts(WHOLE)["word/styles.xml"]
STUDY = build_study(rows=1)
MAIN = b"wordprocessingml.document.main+xml"
SPOILT = {
    "empty.docx": b"",
    "page.docx": b"<html>Word</html>",
    "cut.docx": WHOLE[:9000],
    "site.docx": spoil(WHOLE, "word/document.xml", b"</w:body>", b""),
    "letter.dotm": spoil(
        WHOLE, "[Content_Types].xml", MAIN, b"template.macroEnabledTemplate.main+xml"
    ),
    "nothing.docx": spoil(WHOLE, "_rels/.rels", b"officeDocument", b"else"),
}


STYLES, TYPES = "word/styles.xml", "[Content_Types].xml"
# Templates as offices have them: without styles, with names in small letters as some
# programs write them, with a style of letters where one of paragraphs is meant, with
# the id of ours under another name, without a page, and a true template.
BARE = {
    "no-styles.docx": re.sub(b"<w:style .*</w:style>", b"", WHOLE_STYLES, flags=re.S),
    "small.docx": WHOLE_STYLES.replace(b'"List Bullet"', b'"list bullet"'),
    "large.docx": WHOLE_STYLES.replace(b'"heading 1"', b'"HEADING 1"'),
    "letters.docx": re.sub(
        b'w:type="paragraph"([^>]*w:styleId="Caption")',
        rb'w:type="character"\1',
        WHOLE_STYLES,
    ),
    "own-names.docx": WHOLE_STYLES.replace(b'"heading 2"', b'"Abschnitt"'),
}


def make_packages():
    """Packages by name, each with what it lacks or names otherwise."""
    made = {}
    for name, text in BARE.items():
        made[name] = spoil(WHOLE, STYLES, WHOLE_STYLES, text)
        assert made[name] != WHOLE
    page = re.search(b"<w:sectPr.*</w:sectPr>", list_parts(WHOLE)["word/document.xml"],
                     re.S)  # fmt: skip
    made["no-page.docx"] = spoil(WHOLE, "word/document.xml", page[0], b"")
    kind = b"wordprocessingml.template.main+xml"
    made["letter.dotx"] = spoil(WHOLE, TYPES, MAIN, kind)
    return made


@pytest.mark.parametrize("name", [*BARE, "no-page.docx", "letter.dotx"])
def test_a_template_may_lack_what_a_report_needs(name, tmp_path):
    (tmp_path / name).write_bytes(make_packages()[name])
    template = read_template(tmp_path / name)
    first = render_document(STUDY, "de", template=template)
    parts = list_parts(first)
    assert MAIN in parts[TYPES]
    known = re.findall(rb'w:styleId="([^"]*)"', parts[STYLES])
    names = [
        one.lower() for one in re.findall(rb'<w:name w:val="([^"]*)"', parts[STYLES])
    ]
    assert len(known) == len(set(known))
    assert len(names) == len(set(names))
    used = set(
        re.findall(rb'<w:[pt](?:bl)?Style w:val="([^"]*)"', parts["word/document.xml"])
    )
    assert used <= set(known)
    assert len(used) >= 8


@pytest.mark.parametrize("name", SPOILT)
def test_a_file_that_is_no_document_is_refused_by_its_name(tmp_path, name):
    (tmp_path / name).write_bytes(SPOILT[name])
    with pytest.raises(OutputError) as caught:
        read_template(tmp_path / name)
    assert f"{name} is no template" in str(caught.value)


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
    with pytest.raises(OutputError, match=r"pip install \"netdesign\[docx\]\""):
        require_docx()
