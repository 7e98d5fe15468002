"""The tutorial in French and German: built as the English one."""

import re
from pathlib import Path

import pytest

import netdesign

FOLDER = Path(netdesign.__file__).parent
BLOCK = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)#\s]+)?(#[^)]*)?\)")


def read(name="TUTORIAL.md"):
    return (FOLDER / name).read_text(encoding="utf-8")


def list_headings(text):
    return re.findall(r"^(#+) (.*)$", BLOCK.sub("", text), re.MULTILINE)


def write_anchor(heading):
    plain = re.sub(r"[^\w\s-]", "", heading.casefold())
    return "#" + re.sub(r"\s", "-", plain)


@pytest.mark.parametrize("language", ["fr", "de"])
def test_the_tutorial_is_built_as_the_english_one(language):
    english, own = read(), read(f"TUTORIAL.{language}.md")
    levels = [[level for level, _ in list_headings(x)] for x in (english, own)]
    assert levels[0] == levels[1]
    assert BLOCK.findall(english) == BLOCK.findall(own)
    rows = [sum(ln.startswith("|") for ln in x.splitlines()) for x in (english, own)]
    assert rows[0] == rows[1]


@pytest.mark.parametrize("language", ["fr", "de"])
def test_every_link_of_the_tutorial_leads_somewhere(language):
    name = f"TUTORIAL.{language}.md"
    for file, anchor in LINK.findall(BLOCK.sub("", read(name))):
        if file.startswith("http"):
            continue
        target = FOLDER / (file or name)
        assert target.exists(), file
        if anchor and target.suffix == ".md":
            headings = list_headings(target.read_text(encoding="utf-8"))
            assert anchor in {write_anchor(one) for _, one in headings}, anchor
