"""The document: what the page says, as Word has it."""

import io
import os
import re
import subprocess
import zipfile
from contextlib import suppress

import pytest

docx = pytest.importorskip("docx")


from netdesign.report.document.word import render_document  # noqa: E402
from netdesign.report.page import render_html  # noqa: E402
from netdesign.words.catalogue import load_texts  # noqa: E402
from tests.each import each  # noqa: E402
from tests.hostile.test_texts_in_outputs import ATTACKS, spoilt_study  # noqa: E402
from tests.programs import REQUIRED, convert  # noqa: E402
from tests.report.build_study import build_study  # noqa: E402
from tests.report.document.reading import (  # noqa: E402
    W,
    list_parts,
    list_tables,
    open_word,
    squeeze,
)
from tests.report.reading import PageReader  # noqa: E402

STUDY = build_study()
LANGUAGES = ("en", "fr", "de")
BLIP = "{http://schemas.microsoft.com/office/drawing/2016/SVG/main}svgBlip"


@pytest.fixture(scope="module")
def content():
    return render_document(STUDY, "fr")


@pytest.mark.long
@each("language", LANGUAGES)
@each("has_annexes", [False, True])
def test_every_cell_of_the_page_is_in_the_document(has_annexes, language):
    page = PageReader(render_html(STUDY, language, has_annexes=has_annexes))
    shown = render_document(STUDY, language, has_annexes=has_annexes)
    cells = {squeeze(c) for t in list_tables(shown) for line in t for c in line}
    of_page = {
        squeeze(cell)
        for tables in page.tables.values()
        for table in tables
        for line in table
        for cell in line
    }
    numbers = {cell for cell in of_page if re.fullmatch(r"[-+]?\d[\d.,]*", cell)}
    assert len(numbers) > 15
    assert numbers - cells == set()
    whole = [read_cells(table, language) for table in list_tables(shown)]
    for section, (first, *others) in filter(lambda one: one[1], page.tables.items()):
        if section != "annex-checks":  # a line of its own for each step there
            for table in (first, *(others if section != "decision" else ())):
                assert read_cells(filter(any, table), language) in whole, section


def read_cells(table, language):
    """Cells of a table but the words of verdicts, which the document has not."""
    texts = load_texts(language).items()
    verdicts = [squeeze(text) for key, text in texts if key.startswith("verdict.")]
    word = "|".join(map(re.escape, sorted(verdicts, key=len, reverse=True)))
    return [[re.sub(word, "", squeeze(cell), count=1) for cell in x] for x in table]


def test_every_picture_is_a_drawing_with_a_fallback_and_words(content):
    document = open_word(content)
    parts = document.part.related_parts
    drawings = list(document.element.body.iter(f"{W}drawing"))
    assert len(drawings) >= len(STUDY.rows)
    for drawing in drawings:
        (words,) = (one.get("descr") for one in drawing.iter() if "docPr" in one.tag)
        assert len(words) > 10
        (svg,) = (value for one in drawing.iter(BLIP) for value in one.attrib.values())
        assert parts[svg].blob.startswith(b"<svg")
        assert parts[svg].content_type == "image/svg+xml"
        (png,) = (
            one.attrib.values()[0]
            for one in drawing.iter()
            if one.tag.endswith("}blip")
        )
        assert parts[png].blob.startswith(b"\x89PNG")


@pytest.mark.long
def test_equal_studies_give_equal_bytes(content):
    assert render_document(STUDY, "fr") == content
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        assert {one.date_time[0] for one in archive.infolist()} == {1980}
    known = open_word(content).core_properties
    assert known.created.isoformat()[:10] == STUDY.provenance.started[:10]


@pytest.fixture(scope="module")
def expected():
    """Parts of the document of a study whose texts attack nobody."""
    return set(list_parts(render_document(spoilt_study("plain"))))


@pytest.mark.parametrize(
    "place",
    [
        pytest.param(k, marks=() if k % 4 == 0 else pytest.mark.long)
        for k in range(len(ATTACKS))
    ],
)
def test_a_document_of_hostile_texts_opens_and_holds_them_as_text(place, expected):
    parts = list_parts(render_document(spoilt_study(ATTACKS[place])))
    document = parts["word/document.xml"].decode()
    told = re.findall('w:instr="([^"]*)"', document)
    assert told == []  # no field
    assert set(parts) == expected
    assert not any(b'TargetMode="External"' in one for one in parts.values())
    shown = "".join(re.findall("<w:t[^>]*>([^<]*)<", document))
    assert all(sign.isprintable() or sign == "\u00a0" for sign in shown)


@pytest.mark.long
def test_libreoffice_opens_it(tmp_path):
    """In three languages, all converted to PDF in one run."""
    made = {
        name: render_document(STUDY, name, has_annexes=name == "en")
        for name in LANGUAGES
    }
    for name, content in made.items():
        (tmp_path / f"{name}.docx").write_bytes(content)
    with suppress(subprocess.CalledProcessError):
        convert("pdf", tmp_path, *(tmp_path / f"{name}.docx" for name in made))
    written = sorted(path.stem for path in tmp_path.glob("*.pdf"))
    if not written and not os.environ.get(REQUIRED):
        pytest.skip("LibreOffice has no Writer: nothing was opened in it")
    assert written == sorted(made)
    for path in tmp_path.glob("*.pdf"):
        assert len(re.findall(rb"/Type\s*/Page\b", path.read_bytes())) > 1
