"""No text of an input is ever more than text in an output."""

import dataclasses
import io
import json
import re
import zipfile
from enum import Enum
from functools import cache
from html.parser import HTMLParser

import openpyxl
import pytest
from rich.console import Console

from netdesign.report.files import ReportStyle, render_kind
from netdesign.report.page import render_html
from netdesign.report.terminal import print_summary
from netdesign.report.workbook.excel import render_workbook
from netdesign.site.reader import read_site
from netdesign.site.template.annotate import annotate_workbook
from netdesign.study.document import compute_digest, read_document, write_document
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.message import Message, say
from tests.report.build_study import build_study

ATTACKS = (
    "=cmd|'/c calc'!A0",
    "Summary!$A$1",
    "+1+1",
    "-2+3",
    "@SUM(1)",
    "\t=1+1",
    '<script>alert("x")</script>',
    "<img src=x onerror=alert(1)>",
    "<svg onload=alert(1)><foreignObject/></svg>",
    "]]></style><script>1</script><!--",
    "{{ 7 * 7 }}{% raw %}{0}{what}%s",
    "\x1b[31mred\x1b]0;title\x07\x1b[2J",
    "\x9b31mred",
    "abc\u202egnp.exe\u2066",
    r"$\frac{1}{$ \unknown_{",
    "&[Picture]&G&L",
    "é" * 32_767,
)
QUOTED = re.compile(r'(?<=,)"(?:[^"]|"")*"(?=\))')
# Set by the program, compared with words of its own, or of a form that is checked.
KEPT = {"schema", "member", "mode", "quantity", "anchor", "started", "status", "id"}
KEPT |= {"sense", "governs", "symbol", "formula", "kind", "unit", "position"}


def attack(value, text, key=""):
    """The same value with ``text`` behind all that somebody may have typed."""
    if isinstance(value, Enum):
        return value
    if isinstance(value, Message):
        given = value.arguments.items()
        return say(value.key, **{name: attack(one, text, name) for name, one in given})
    if dataclasses.is_dataclass(value):
        return type(value)(
            **{
                field.name: attack(getattr(value, field.name), text, field.name)
                for field in dataclasses.fields(value)
            }
        )
    if isinstance(value, list | tuple):
        return type(value)(attack(one, text, key) for one in value)
    if isinstance(value, str) and key not in KEPT:
        return text
    return value


@cache
def spoilt_study(text):
    study = attack(build_study(), text)
    rows = [
        dataclasses.replace(row, id=f"{text}{k}") for k, row in enumerate(study.rows)
    ]
    return dataclasses.replace(study, rows=rows)


@pytest.fixture(
    params=[
        pytest.param(one, id=str(k), marks=() if k % 4 == 0 else pytest.mark.long)
        for k, one in enumerate(ATTACKS)
    ]
)
def text(request):
    return request.param


class TagReader(HTMLParser):
    def __init__(self):
        super().__init__()
        self.tags, self.attributes = set(), set()

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}


@pytest.fixture(scope="module")
def plain():
    """What a page of texts that attack nobody has."""
    reader = TagReader()
    reader.feed(render_html(spoilt_study("plain")))
    return reader


def test_a_page_holds_tags_of_the_program_alone(text, plain):
    """The same tags and attributes whatever the texts are; none that acts."""
    language = LANGUAGES[len(text) % len(LANGUAGES)]
    page = render_html(spoilt_study(text), language)
    reader = TagReader()
    reader.feed(page)
    assert reader.tags <= plain.tags
    assert reader.attributes <= plain.attributes
    assert not plain.tags & {"script", "foreignobject", "iframe", "object", "embed"}
    assert not any(name.startswith("on") for name in plain.attributes)
    assert all(sign.isprintable() or sign in "\n\t\u00a0" for sign in page)


@cache
def make_workbook(text):
    return render_workbook(spoilt_study(text))


@cache
def list_formulas(text):
    """Formulas of the workbook by part; it has no link."""
    with zipfile.ZipFile(io.BytesIO(make_workbook(text))) as archive:
        parts = {n: archive.read(n).decode() for n in archive.namelist()}
    assert not any("externalLink" in name for name in parts)
    assert not any("hyperlink" in parts[n] for n in parts if "/_rels/" in n)
    shown = {n: xml for n, xml in parts.items() if "/_rels/" not in n}
    # A cell is compared with the text that it had: between quotes, so text alone.
    bare = {n: QUOTED.sub('""', xml) for n, xml in shown.items()}
    return {n: re.findall(r"<(?:c:)?f>(.*?)<", xml) for n, xml in bare.items()}


@pytest.mark.long
def test_a_workbook_holds_formulas_of_the_program_alone(text):
    """The same formulas whatever the texts are, and no link at all."""
    assert list_formulas(text) == list_formulas("plain")


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:.* extension is not supported")  # of openpyxl
def test_a_workbook_of_hostile_texts_opens(text):
    content = make_workbook(text)
    assert "Decision" in openpyxl.load_workbook(io.BytesIO(content)).sheetnames


@pytest.mark.long
def test_a_terminal_is_not_steered(text):
    shown = io.StringIO()
    console = Console(file=shown, width=200, color_system=None, force_terminal=True)
    print_summary(spoilt_study(text), console, explain=True)
    assert all(sign.isprintable() or sign == "\n" for sign in shown.getvalue())


def test_json_keeps_every_text_and_shows_no_control_sign(text):
    study = spoilt_study(text)
    document = write_document(study)
    assert all(sign.isprintable() or sign == "\n" for sign in document)
    assert json.loads(document)["project"]["name"] == text
    sealed = dataclasses.replace(study, digest=compute_digest(study))
    assert read_document(document) == sealed


def test_lines_of_cases_begin_with_no_formula(text):
    for line in (
        render_kind(".csv", spoilt_study(text), ReportStyle()).decode().splitlines()[1:]
    ):
        assert not line.lstrip('"').startswith(("=", "+", "-", "@", "\t"))


def test_findings_and_annotated_copy_hold_text_alone(tmp_path, text):
    """A cell, a heading and an id of a csv file with the text in them."""
    path = tmp_path / "site.csv"
    quoted = '"' + text[:9000].replace('"', '""') + '"'
    path.write_text(f"id;slope angle [deg];{quoted}\n{quoted};{quoted};1\n", "utf-8")
    with pytest.raises(Exception, match=r"site\.csv") as caught:
        read_site(path)
    assert all(sign.isprintable() or sign == "\n" for sign in str(caught.value))
    content = annotate_workbook(path, caught.value.findings)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        sheets = [archive.read(n) for n in archive.namelist() if "worksheets/s" in n]
    assert sheets
    assert not any(b"<f>" in xml for xml in sheets)
