"""What is cited is listed in REFERENCES.md; documents that are named exist."""

import re
from functools import cache
from pathlib import Path

import pytest

from tests.each import each

ROOT = Path(__file__).resolve().parent.parent
REFERENCES = ROOT / "netdesign" / "REFERENCES.md"
FACTS = ROOT / "tests" / "verification" / "FACTS.md"

NAME = r"[A-Z][a-zà-ÿ]+(?:-[A-Z][a-z]+)?"
AUTHORS = re.compile(
    rf"\b({NAME}(?: and {NAME}| et al\.)?),? \(?((?:1[89]|20)\d\d)(?![\d-])"
)
DESIGNATION = re.compile(
    r"\b(EN \d{4,5}(?:-\d+)*|NF P \d\d-\d{3}|ONR \d{5}|UV-\d{4}|FHWA-NHI-\d\d-\d{3})"
)
ADDRESS = re.compile(r"\b[a-z]+(?:-[a-z]+)*\.(?:com|info|us|de)\b")
DOCUMENT = re.compile(r"\b[\w-]+(?:\.(?:fr|de))?\.md\b")
SECTIONS = re.compile(r"FACTS\.md, sections? (\d+)(?: and (\d+))?")

# A place or a month before a year is no author.
NO_AUTHORS = {"December 1992", "Bern 2007", "Paris 2013"}
NO_AUTHORS |= {"Chamonix 1995", "Egilsstadir 2008", "Hafelekar 2006"}  # measured nets
NO_AUTHORS |= {"Ice 2012"}  # the manual of Elmer/Ice, listed by its author
NO_DOCUMENT = {"REMARKS.md"}  # a file's wrong name, in a test
# Translations repeat what the texts cite.
TRANSLATIONS = ("netdesign/report/languages", "netdesign/site/columns/words")
TRANSLATIONS += ("netdesign/words/de", "netdesign/words/fr")


def read(path):
    """Text without the line ends and comment signs that part a citation."""
    return re.sub(r"\s*\n[\s#>|]*", " ", path.read_text(encoding="utf-8"))


def list_texts():
    for folder in ("netdesign", "standards", "tests"):
        for path in sorted((ROOT / folder).rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            if path.suffix not in (".py", ".md", ".toml"):
                continue
            if not name.startswith(TRANSLATIONS) and path != Path(__file__).resolve():
                yield name, path
    yield "README.md", ROOT / "README.md"


DOCUMENTS_ELSEWHERE = {"licences.md"}  # of .ci


@cache
def read_texts():
    """Texts of all files by name."""
    return {name: read(path) for name, path in list_texts()}


@cache
def read_citing():
    """Texts by name without the list itself, each with what it cites."""
    texts = {n: x for n, x in read_texts().items() if n != "netdesign/REFERENCES.md"}
    return {name: (text, find_citations(text)) for name, text in texts.items()}


ENTRIES = [
    re.sub(r"\s+", " ", entry)
    for entry in re.findall(
        r"^- (\*\*.+?)(?=^- |^## |\Z)",
        REFERENCES.read_text(encoding="utf-8"),
        flags=re.MULTILINE | re.DOTALL,
    )
]
KEYS = {
    key.rstrip(".") for entry in ENTRIES for key in re.findall(r"\*\*(.+?)\*\*", entry)
}


def find_citations(text):
    """Works that a text names: by authors and year, by designation, by address."""
    by_authors = {f"{names} {year}" for names, year in AUTHORS.findall(text)}
    return (by_authors - NO_AUTHORS) | set(DESIGNATION.findall(text))


def test_every_citation_is_listed():
    unknown = {name: cited - KEYS for name, (_, cited) in read_citing().items()}
    assert {name: one for name, one in unknown.items() if one} == {}


def test_every_page_that_data_rest_on_is_listed():
    unknown = {
        name: set(ADDRESS.findall(text)) - KEYS
        for name, (text, _) in read_citing().items()
        if name.endswith(".toml")
    }
    assert {name: one for name, one in unknown.items() if one} == {}


def test_every_entry_is_cited():
    cited = set().union(*(cited for _, cited in read_citing().values()))
    texts = [text for text, _ in read_citing().values()]
    assert [x for x in KEYS - cited if not any(x in text for text in texts)] == []


@each("entry", ENTRIES)
def test_every_entry_says_its_doi_or_that_there_is_none(entry):
    assert re.search(r"DOI 10\.\d{4,}/\S|DOI unknown|No DOI", entry)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("after Zwinger et al. (2007), as coded", {"Zwinger et al. 2007"}),
        ("(Dubrule 1983).", {"Dubrule 1983"}),
        ("Walker and Ni (2011), Anderson", {"Walker and Ni 2011"}),
        ("EN 1993-1-11:2006 and ONR 24810", {"EN 1993-1-11", "ONR 24810"}),
        ("AFNOR, December 1992; boutillier-2004; EN 2", set()),
    ],
)
def test_citations_are_found(text, found):
    assert find_citations(text) == found


def test_every_document_that_is_named_is_in_the_repository():
    there = {Path(name).name for name in read_texts()} | DOCUMENTS_ELSEWHERE
    lost = {
        name: set(DOCUMENT.findall(text)) - NO_DOCUMENT - there
        for name, text in read_texts().items()
    }
    assert {name: one for name, one in lost.items() if one} == {}


def test_every_section_of_the_facts_that_is_cited_is_there():
    headings = re.findall(r"^## (\d+) ", FACTS.read_text("utf-8"), flags=re.MULTILINE)
    assert headings == [str(k + 1) for k in range(len(headings))]
    lost = {
        name: {one for pair in SECTIONS.findall(text) for one in pair} - {"", *headings}
        for name, text in read_texts().items()
    }
    assert {name: one for name, one in lost.items() if one} == {}
