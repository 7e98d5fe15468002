"""No English in what any command tells or writes in French and German."""

import re

import pytest

from tests.commands.every_command import COMMANDS, read_texts, run_all
from tests.words.english import list_vocabulary, list_words

pytestmark = pytest.mark.long
NAMES = re.compile(
    r"netdesign \w+|--[a-z-]+|\S*\w[._/\\]\w\S*|\b[A-Z_]{3,}\b"  # commands, files, keys
    r"|\b[\w]+(-[\w]+)*-\d{4,5}(-style)?\b|\bnf-p-95-304-style\b"  # profiles
    r"|\b(?:[AB]|HEB)\d+-\w+|\bpiles-in-tension-da2\b"  # types of the example; a choice
    r"|\blaw-[a-z]+(-[a-z…]+)*|\bown\b|\b[0-9a-f]{16,}\b"  # cases, a folder, digests
    r"|\bTab\. "  # tables of standards
    r"|\w+…"  # words for which a terminal has no room
    r"|\bsame Höhe|\bPlan\b"  # end of a divided German heading; a German word
    r"|(?i:\b(?:numpy|scipy|scikit-fem|python|example|six)\b)",  # programs, the example
    re.MULTILINE,
)


@pytest.fixture(scope="module", params=["fr", "de"])
def told(request, tmp_path_factory):
    """Texts by their source, and the words of English that the language has not."""
    folder = tmp_path_factory.mktemp(request.param)
    with pytest.MonkeyPatch.context() as patch:
        texts = run_all(folder, request.param, patch)
    assert len(texts) == len(COMMANDS)
    texts |= {
        str(path.relative_to(folder)): read_texts(path)
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.parent.name != "own"
    }
    english = list_vocabulary("en") - list_vocabulary(request.param)
    assert len(english) > 1000
    return texts, english


def test_no_command_tells_english(told):
    texts, english = told
    found = {
        source: sorted(list_words(NAMES.sub(" ", text)) & english)
        for source, text in texts.items()
    }
    assert {source: words for source, words in found.items() if words} == {}


def test_enough_was_read(told):
    """A reader that finds nothing would find no English."""
    texts, _ = told
    long = ["check", "out/report.html", "out/report.docx", "out/report.xlsx",
            "site.xlsx", "marked.xlsx"]  # fmt: skip
    assert {one for one in long if len(list_words(texts[one])) < 30} == set()
    assert [one for one, text in texts.items() if "Traceback" in text] == []


def test_numbers_have_a_comma(told):
    """Points stay in versions, clauses, cells and what was typed."""
    texts, _ = told
    for source in ("check", "what if", "diff"):
        text = re.sub(r"--accuracy \S+", " ", texts[source])  # as it is typed
        numbers = re.findall(r"(?<![\w.])-?\d+\.\d+(?![\w.-])", text)
        assert (source, numbers) == (source, [])
        assert re.search(r"\d,\d", texts[source])
