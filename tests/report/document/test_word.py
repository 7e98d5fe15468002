"""The document: what the page says, as Word has it."""

import io
import os
import random
import re
import subprocess
import zipfile
from contextlib import suppress
from dataclasses import replace

import pytest

docx = pytest.importorskip("docx")


from netdesign.report.document.word import render_document  # noqa: E402
from netdesign.report.page.html import render_html  # noqa: E402
from netdesign.report.sections.checks import list_lines, part_lines  # noqa: E402
from netdesign.report.words import Words, show_verdict  # noqa: E402
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
from tests.report.drawing.drawn import build_monitoring  # noqa: E402
from tests.report.reading import PageReader  # noqa: E402

STUDY = build_study()
LANGUAGES = ("en", "fr", "de")
BLIP = "{http://schemas.microsoft.com/office/drawing/2016/SVG/main}svgBlip"


@pytest.fixture(scope="module", params=LANGUAGES)
def language(request):
    return request.param


@pytest.fixture(scope="module")
def content(language):
    return render_document(STUDY, language)


@pytest.mark.long
def test_every_check_stands_in_the_document_with_its_numbers(content, language):
    """Verdict, demand, resistance and utilisation of each, at its place."""
    words, tables = Words(language), list_tables(content)
    head = [words("heading.check"), words("heading.type")]
    of_rows = [one for one in tables if one[0][:2] == head]
    assert len(of_rows) == len(STUDY.rows)
    found, whole = 0, " ".join(one.text for one in open_word(content).paragraphs)
    for row, table in zip(STUDY.rows, of_rows, strict=True):
        lines = [cells for cells in table[1:] if len(cells) > 1]
        alone, beside = part_lines(list(list_lines(row.checks)))
        for line in (one for of_member in beside.values() for one in of_member):
            assert line.describe(words) in whole
            found += len(line.checks)
        for line, cells in zip(alone, lines, strict=True):
            assert line.name(words) in cells[0]
            first = line.checks[0]
            assert cells[2] == words.show_number("resistance_kN", first.resistance_kN)
            for check, place in ((line.inside, cells[3:5]), (line.end, cells[5:7])):
                if check is None:
                    assert place == ["-", "-"]
                    continue
                found += 1
                demand = words.show_number("demand_kN", check.demand_kN)
                used = words.show_number("utilisation", check.used)
                assert [place[0], place[1].split(" (")[0]] == [demand, used]
    assert found == sum(x.is_of_force for row in STUDY.rows for x in row.checks) > 10


@pytest.mark.long
@pytest.mark.parametrize(
    ("language", "detail"), [("de", "full"), ("fr", "full"), ("en", "full")]
)
def test_every_cell_of_the_page_is_in_the_document(detail, language):
    page = PageReader(render_html(STUDY, language, detail))
    shown = render_document(STUDY, language, detail)
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


def test_sections_stand_in_the_order_of_the_page(content, language):
    t = Words(language)
    headings = [
        p.text.replace("\u00a0", " ")
        for p in open_word(content).paragraphs
        if p.style.name == "Heading 1"
    ]
    shown = [show_verdict(row.verdict, t) for row in STUDY.rows]
    rows = [
        f"{t('heading.net_row')} {row.id} {one.symbol} {one.word}"
        for row, one in zip(STUDY.rows, shown, strict=True)
    ]
    annexes = [
        f"annex_{one}" for one in ("checks", "model", "profile", "quality", "verify")
    ]
    assert headings == [
        *(t(f"heading.{one}") for one in ("basis", "schedule")),
        *rows,
        *(
            t(f"heading.{one}").replace("\u00a0", " ")
            for one in ("inputs_of_rows", *annexes)
        ),
    ]


def test_verdicts_are_bold_and_numbers_to_the_right(content, language):
    document = open_word(content)
    verdict = next(
        p for p in document.paragraphs if p.style.name == "netdesign verdict"
    )
    shown = show_verdict(STUDY.verdict, Words(language))
    assert verdict.text == f"{shown.symbol}\u00a0{shown.word}"
    assert all(run.bold for run in verdict.runs)
    cells = [cell for table in document.tables for cell in table._tbl.iter(f"{W}tc")]
    right = [cell for cell in cells if cell.find(f".//{W}jc") is not None]
    assert len(right) > 100
    assert all(cell.find(f".//{W}jc").get(f"{W}val") == "right" for cell in right)


def test_every_table_with_headings_repeats_them(content):
    tables = open_word(content).tables
    repeated = [table._tbl.find(f".//{W}tblHeader") is not None for table in tables]
    # identification, limit profile, how to verify
    assert repeated.count(False) == 3
    for table in tables:
        assert all(
            line.find(f".//{W}cantSplit") is not None for line in table._tbl.tr_lst
        )


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


def test_contents_list_every_section_and_are_a_field(content):
    document = open_word(content)
    lines = [p for p in document.paragraphs if p.style.name == "toc 1"]
    headings = [p for p in document.paragraphs if p.style.name == "Heading 1"]
    links = [p._p.find(f"{W}hyperlink") for p in lines]
    assert ["".join(x.text for x in link.iter(f"{W}t")) for link in links] == [
        p.text for p in headings
    ]
    marks = [p._p.find(f"{W}bookmarkStart").get(f"{W}name") for p in headings]
    assert [link.get(f"{W}anchor") for link in links] == marks
    assert "TOC" in "".join(x.text for x in lines[0]._p.iter(f"{W}instrText"))


@pytest.mark.long
def test_equal_studies_give_equal_bytes(content, language):
    assert render_document(STUDY, language) == content
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        assert {one.date_time[0] for one in archive.infolist()} == {1980}
    known = open_word(content).core_properties
    assert known.created.isoformat()[:10] == STUDY.provenance.started[:10]


@pytest.fixture(scope="module")
def expected():
    """Parts of the document of a study whose texts attack nobody."""
    return set(list_parts(render_document(spoilt_study("plain"), detail="summary")))


@pytest.mark.parametrize(
    "place",
    [
        pytest.param(k, marks=() if k % 4 == 0 else pytest.mark.long)
        for k in range(len(ATTACKS))
    ],
)
def test_a_document_of_hostile_texts_opens_and_holds_them_as_text(place, expected):
    parts = list_parts(render_document(spoilt_study(ATTACKS[place]), detail="summary"))
    document = parts["word/document.xml"].decode()
    told = re.findall("<w:instrText[^>]*>([^<]*)<", document)
    assert told == []  # no field but the table of contents of the full report
    assert set(parts) == expected
    assert not any(b'TargetMode="External"' in one for one in parts.values())
    shown = "".join(re.findall("<w:t[^>]*>([^<]*)<", document))
    assert all(sign.isprintable() or sign == "\u00a0" for sign in shown)


def make_template():
    """Template of a company: its own heading, header, footer, text and a link."""
    document = docx.Document()
    document.styles["Heading 1"].font.size = docx.shared.Pt(31)
    document.sections[0].header.paragraphs[0].text = "Bureau Dupré"
    document.sections[0].footer.paragraphs[0].text = "confidential"
    document.sections[0].page_width = docx.shared.Mm(200)
    document.add_paragraph("old report: PASS")
    document.styles["Caption"].delete()
    buffer = io.BytesIO()
    document.save(buffer)
    return buffer.getvalue()


def test_a_template_keeps_its_look_and_loses_its_text():
    content = render_document(STUDY, "fr", "summary", template=make_template())
    document = open_word(content)
    assert document.styles["Heading 1"].font.size.pt == 31
    assert document.sections[0].header.paragraphs[0].text == "Bureau Dupré"
    assert document.sections[0].footer.paragraphs[0].text == "confidential"
    assert document.sections[0].page_width.mm == pytest.approx(200, abs=0.1)
    assert b"old report" not in b"".join(list_parts(content).values())
    assert any(p.style.name.lower() == "caption" for p in document.paragraphs)
    widths = [
        sum(int(one.get(f"{W}w")) for one in table._tbl.iter(f"{W}gridCol"))
        for table in document.tables
    ]
    section = document.sections[0]
    margins = section.left_margin + section.right_margin
    *upright, across = sorted(widths)  # the widest one: inputs of all rows
    assert upright[-1] <= (section.page_width - margins) / 635 + 20
    assert across <= (section.page_height - margins) / 635 + 20


@pytest.mark.long
def test_libreoffice_opens_it(tmp_path):
    """In three languages and a template, all converted to PDF in one run."""
    details = dict(zip(LANGUAGES, ("full", "summary", "summary"), strict=True))
    made = {name: render_document(STUDY, name, details[name]) for name in details}
    made["template"] = render_document(STUDY, "de", "summary", template=make_template())
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


def test_measured_forces_stand_in_the_document_as_a_picture():
    study = build_study(rows=1)
    (row,) = study.rows
    measured = replace(row, monitoring=[build_monitoring(random.Random(5))])
    bare = replace(measured, drawing=None, envelope=None, panel=None, cases=[])
    parts = list_parts(render_document(replace(study, rows=[bare]), "fr", "full"))
    told = re.findall(b'descr="([^"]*)"', parts["word/document.xml"])
    (picture,) = [one.decode() for one in told if b"mesur" in one]
    assert picture.startswith(Words("fr")("drawing.monitoring"))
    kinds = {name.rpartition(".")[2] for name in parts if "/media/" in name}
    assert kinds == {"svg", "png"}


def test_schedule_and_inputs_of_all_rows_stand_on_pages_across(content):
    """Upright pages between them, before and after: each with its own size."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        xml = archive.read("word/document.xml").decode()
    sizes = re.findall(r"<w:pgSz [^>]*>", xml)
    assert ["landscape" in one for one in sizes] == [False, True, False, True, False]
    upright, across = (
        {name: re.search(rf'w:{name}="(\d+)"', one)[1] for name in "wh"}
        for one in sizes[:2]
    )
    assert (across["w"], across["h"]) == (upright["h"], upright["w"])


def test_open_points_are_numbered(content):
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        xml = archive.read("word/document.xml").decode()
    assert re.search(r">1\. <", xml)


def test_each_net_row_begins_a_page(content):
    headings = [
        one for one in open_word(content).paragraphs if one.style.name == "Heading 1"
    ]
    named = [one for one in headings if any(row.id in one.text for row in STUDY.rows)]
    assert len(named) == len(STUDY.rows)
    assert all(one.paragraph_format.page_break_before for one in named)
    others = [one for one in headings if one.text not in {x.text for x in named}]
    assert not any(one.paragraph_format.page_break_before for one in others)
