"""A what-if is marked on every output, in every language."""

import io
import zipfile
from dataclasses import replace

import pytest
from rich.console import Console

from netdesign.report.document.word import render_document
from netdesign.report.page import render_html
from netdesign.report.terminal import print_summary
from netdesign.report.what_if import mark_verdict, title_pages
from netdesign.report.words import ENGLISH, Words
from netdesign.report.workbook.excel import render_workbook
from netdesign.site.model import ReplacedCell
from netdesign.words.catalogue import LANGUAGES, load_texts
from tests.report.build_study import build_study

BUILT = build_study()
CELL = ReplacedCell(cell="Nets!P8", was="A28-old", now="A40-new")
STUDY = replace(BUILT, what_if=[CELL])


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_output_says_that_it_is_no_site_as_built(language):
    texts, words = load_texts(language), Words(language)
    mark = texts["what_if.mark"]
    shown = mark_verdict(STUDY, words).word
    assert shown != mark_verdict(BUILT, words).word
    assert shown == texts["what_if.verdict"].format(
        verdict=texts[f"verdict.{STUDY.verdict}"]
    )
    assert title_pages(STUDY, words).startswith(mark)
    page = render_html(STUDY, language).replace("&#39;", "'")
    shown = {
        "page": page[page.index("<h1>") :],
        "terminal": print_out(STUDY, language),
    }
    if language == "fr":  # they show the same texts in each language
        document = render_document(STUDY, language)
        book = render_workbook(STUDY, language)
        shown["document"] = unpack(document, "word/document.xml")
        shown["workbook"] = unpack(book, "xl/sharedStrings.xml")
    for name, text in shown.items():
        for said in (mark, CELL.cell, CELL.was, CELL.now):
            assert said in text, (name, said)
    assert page.index(mark) < page.index("</title>")


def unpack(content, part):
    with zipfile.ZipFile(io.BytesIO(content)) as packed:
        return packed.read(part).decode()


def print_out(study, language):
    console = Console(file=io.StringIO(), width=400)
    print_summary(study, console, language)
    return console.file.getvalue()


def test_rows_that_are_left_out_are_named_beside_the_verdict():
    part = replace(BUILT, left_out=["N7", "N8"])
    whole, shown = (mark_verdict(one, ENGLISH) for one in (BUILT, part))
    assert shown.word != whole.word
    assert all(row in shown.meaning for row in part.left_out)


def test_a_site_as_built_has_no_mark():
    mark = ENGLISH("what_if.mark")
    assert mark not in title_pages(BUILT, ENGLISH)
    assert mark not in print_out(BUILT, "en")
    assert mark not in render_html(BUILT)
