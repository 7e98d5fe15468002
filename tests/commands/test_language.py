"""Findings and reports in French and German; the language is found."""

import re

import openpyxl
import pytest

from netdesign.site.columns.all_tables import FINDINGS_SHEETS, SHEETS
from tests.program import call_program
from tests.small_scene import SMALL_SCENE
from tests.words.english import find_words

LANGUAGES = ["fr", "de"]
# What a user has typed, and the names of options and columns in files.
TYPED = re.compile(
    r""""[^"]*"|'[^']*'|--[a-z-]+|\b[A-Z_]{3,}\b|/\S+|\S+\.(toml|xlsx|csv)"""
)


def find_english(text):
    """Frequent English words in what was told, without what was typed."""
    return find_words(TYPED.sub(" ", text), ["en"])


@pytest.fixture(params=LANGUAGES, scope="module")
def language(request):
    return request.param


@pytest.fixture(scope="module")
def book(language, tmp_path_factory):
    path = tmp_path_factory.mktemp("example") / "site.xlsx"
    ended = call_program("init", path, "--example", "--language", language)
    assert ended.code == 0
    book = openpyxl.load_workbook(path)
    for sheet in book.worksheets:
        sheet._images.clear()  # else it can be saved but once
    return book


@pytest.fixture
def spoil(call, tmp_path, book, language):
    """Spoils cells of the example in a language, and checks it: ``spoil({...})``."""

    def check(changes, *options):
        cells, kept = {}, {}
        for place, value in changes.items():
            plan, _, cell = place.partition("!")
            name = next(one for one in SHEETS if one.name == plan).name_in(language)
            cells[place] = book[name][cell]
            kept[place] = cells[place].value
            cells[place].value = value
        book.save(tmp_path / "site.xlsx")
        for place, value in kept.items():
            cells[place].value = value
        return call("check", "site.xlsx", "--language", language, *options)

    return check


SPOILT = {
    "a text": {"Nets!B2": "4O"},
    "two readings": {"Nets!C3": "1,234"},
    "out of range": {"Nets!B2": 88},
    "empty": {"Nets!B2": None},
    "an error": {"Nets!B2": "#REF!"},
    "a formula": {"Nets!B2": "=1+1"},
    "a truth value": {"Nets!B2": True},
    "unknown word": {"Nets!F2": "glatt wie Eis"},
    "unknown heading": {"Nets!AA1": "commune"},
    "misspelt heading": {"Nets!B1": "xyz [deg]"},
    "no unit": {"Nets!B1": "pente"},
    "unknown type": {"Nets!P2": "Z9"},
    "double id": {"Nets!A3": "R1", "Nets!A2": "R1"},
    "thickness twice": {"Nets!D2": 3.3, "Nets!C2": 3.0},
    "range turned": {"Ranges!C2": 400, "Ranges!D2": 300},
    "range empty": {"Ranges!C2": None},
    "unknown item": {"Project!A3": "Bauherr"},
    "unknown quantity": {"Ranges!A2": "couleur"},
    "unclear unit": {"Nets!B1": "pente [grad]"},
    "far down": {"Nets!A2500": "R9"},
    "gap": {"Nets!A12": "R9"},
}


@pytest.mark.long
@pytest.mark.parametrize("fault", SPOILT)
def test_a_refused_workbook_is_refused_in_the_language(spoil, language, fault):
    ended = spoil(SPOILT[fault], "--dry-run")
    assert (ended.code, ended.out) == (3, "") if fault != "unknown heading" else True
    assert find_english(ended.out + ended.err) == set()
    words = {"fr": "attendu", "de": "zulässig"}
    if fault == "unknown heading":  # a remark: the column is not read
        words = {"fr": "en-tête connu", "de": "bekannte Überschrift"}
    assert words[language] in ended.err + ended.out


def test_an_annotated_copy_speaks_the_language(spoil, language, tmp_path):
    ended = spoil(SPOILT["a text"], "--annotate", tmp_path / "marked.xlsx")
    assert ended.code == 3
    copy = openpyxl.load_workbook(tmp_path / "marked.xlsx")
    rows = list(copy[FINDINGS_SHEETS[language]].iter_rows(values_only=True))
    told = " ".join(str(text) for row in rows for text in row)
    assert find_english(told) == set()
    assert {"fr": "n'est pas un nombre", "de": "ist keine Zahl"}[language] in told
    cells = next(sheet for sheet in copy.worksheets if sheet.title in told)["B2"]
    assert find_english(cells.comment.text) == set()


@pytest.mark.parametrize(
    "way",
    [
        "--language {}",
        "--language={}",
        "--language en --language {}",
        "file",
    ],
)
def test_the_language_is_found_where_options_are(call, tmp_path, language, way):
    options = way.format(language).split() if way.startswith("--") else []
    if way == "file":
        (tmp_path / "netdesign.toml").write_text(f'[check]\nlanguage = "{language}"\n')
    ended = call("check", "none.xlsx", *options)
    assert {"fr": "n'existe pas", "de": "gibt es"}[language] in ended.err


def test_an_unknown_language_is_refused_in_english(call):
    ended = call("check", "--example", "--language", "it")
    assert ended.code == 2
    assert "Invalid value for '--language'" in ended.err


SCENE = f"""{SMALL_SCENE}
[solve]
accuracy = 0.05
horizon_days = 3
"""


@pytest.fixture
def scene(tmp_path, monkeypatch):
    monkeypatch.setenv("NETDESIGN_STORE", str(tmp_path / "cases.sqlite"))
    (tmp_path / "scene.toml").write_text(SCENE)
    return tmp_path / "scene.toml"
