"""Tutorial and usage in French and German: built as the English ones."""

import re
from pathlib import Path

import pytest

import netdesign

FOLDER = Path(netdesign.__file__).parent
PAGES = ("TUTORIAL", "USAGE")
BLOCK = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)#\s]+)?(#[^)]*)?\)")


def read(page, language=""):
    name = f"{page}.{language}.md" if language else f"{page}.md"
    return (FOLDER / name).read_text(encoding="utf-8")


def list_headings(text):
    return re.findall(r"^(#+) (.*)$", BLOCK.sub("", text), re.MULTILINE)


def write_anchor(heading):
    plain = re.sub(r"[^\w\s-]", "", heading.casefold())
    return "#" + re.sub(r"\s", "-", plain)


@pytest.mark.parametrize("language", ["fr", "de"])
@pytest.mark.parametrize("page", PAGES)
def test_a_page_is_built_as_the_english_one(page, language):
    english, own = read(page), read(page, language)
    levels = [[level for level, _ in list_headings(x)] for x in (english, own)]
    assert levels[0] == levels[1]
    assert BLOCK.findall(english) == BLOCK.findall(own)
    rows = [sum(ln.startswith("|") for ln in x.splitlines()) for x in (english, own)]
    assert rows[0] == rows[1]


@pytest.mark.parametrize("language", ["fr", "de"])
@pytest.mark.parametrize("page", PAGES)
def test_every_link_of_a_page_leads_somewhere(page, language):
    for file, anchor in LINK.findall(BLOCK.sub("", read(page, language))):
        if file.startswith("http"):
            continue
        target = FOLDER / (file or f"{page}.{language}.md")
        assert target.exists(), file
        if anchor and target.suffix == ".md":
            headings = list_headings(target.read_text(encoding="utf-8"))
            assert anchor in {write_anchor(one) for _, one in headings}, anchor
