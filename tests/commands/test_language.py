"""Commands in French and German: the language is found, and no English is told."""

import html
import json
import re

import openpyxl
import pytest

from netdesign.checks import list_standards
from netdesign.site.columns.all_tables import FINDINGS_SHEETS, SHEETS
from tests.program import call_program
from tests.short_example import write_short_example
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


@pytest.mark.parametrize("profile", list_standards())
def test_a_limit_profile_is_shown_in_the_language(call, language, profile):
    ended = call("standards", "show", profile, "--language", language)
    assert ended.code == 0
    titles = r"„[^“]*“|«[^»]*»|\w+([._]\w+)+"  # of documents and of values
    assert find_english(re.sub(titles, " ", ended.out)) == set()
    english = call("standards", "show", profile, "--language", "en")
    assert len(english.out.splitlines()) == len(ended.out.splitlines())


@pytest.mark.parametrize(
    "arguments",
    [
        ["check"],
        ["check", "none.xlsx"],
        ["check", "none.xlsx", "--standard", "eurocod"],
        ["check", "--example", "--accuracy", "5"],
        ["check", "--example", "--jobs", "many"],
        ["check", "--example", "--no-such-option"],
        ["check", "--example", "--delimiter", "ab"],
        ["check", "one.xlsx", "--annotate", "two.csv"],
        ["check", "--example", "--executor", "spark", "--out", "new"],
        ["envelope"],
        ["envelope", "scene.toml"],
        ["envelope", "scene.toml", "--density", "5:3"],
        ["envelope", "scene.toml", "--density", "3:5:7", "--friction", "3:5"],
        ["solve", "scene.toml"],
        ["solve", "bad.toml"],
        ["report", "study.json"],
        ["report", "bad.toml"],
        ["diff", "study.json", "study.json"],
        ["verify", "--study", "study.json"],
        ["verify", "--jobs", "2"],
        ["standards", "show", "eurocod"],
        ["standards", "validate", "."],
        ["standards", "copy", "eurocode", "new folder"],
        ["standards", "shwo"],
        ["chek"],
    ],
)
def test_refusals_speak_the_language(call, tmp_path, language, arguments):
    (tmp_path / "bad.toml").write_text('[slope]\nangle_deg = "steep"\n[snow]\nx = 1\n')
    ended = call(*arguments, "--language", language)
    assert ended.code in (2, 3)
    assert find_english(ended.out + ended.err) == set()
    told = {"fr": r"[Ee]rreur|constat", "de": "Fehler|Befund"}[language]
    assert re.search(told, ended.err)


@pytest.mark.parametrize(
    "way",
    [
        "--language {}",
        "--language={}",
        "--language en --language {}",
        "variable",
        "file",
    ],
)
def test_the_language_is_found_where_options_are(
    call, tmp_path, monkeypatch, language, way
):
    options = way.format(language).split() if way.startswith("--") else []
    if way == "variable":
        monkeypatch.setenv("NETDESIGN_CHECK_LANGUAGE", language)
    if way == "file":
        (tmp_path / "netdesign.toml").write_text(f'[check]\nlanguage = "{language}"\n')
    ended = call("check", "none.xlsx", *options)
    assert {"fr": "n'existe pas", "de": "gibt es"}[language] in ended.err


def test_an_option_overrules_a_variable_and_a_variable_the_file(
    call, tmp_path, monkeypatch
):
    (tmp_path / "netdesign.toml").write_text('[check]\nlanguage = "fr"\n')
    monkeypatch.setenv("NETDESIGN_CHECK_LANGUAGE", "de")
    assert "gibt es" in call("check", "none.xlsx").err
    assert "does not exist" in call("check", "none.xlsx", "--language", "en").err


def test_an_unknown_language_is_refused_in_english(call):
    ended = call("check", "--example", "--language", "it")
    assert ended.code == 2
    assert "Invalid value for '--language'" in ended.err


SCENE = f"""{SMALL_SCENE}
[solve]
accuracy = 0.05
horizon_days = 3
"""
# Keys of documents, which are the same in all languages.
KEYS = re.compile(r"\b\w+_(kN_per_m|kg_m3|deg)\b")


@pytest.fixture
def scene(tmp_path, monkeypatch):
    monkeypatch.setenv("NETDESIGN_STORE", str(tmp_path / "cases.sqlite"))
    (tmp_path / "scene.toml").write_text(SCENE)
    return tmp_path / "scene.toml"


@pytest.mark.parametrize("method", ["steady", "transient", "staggered"])
def test_a_solution_is_told_in_the_language(call, scene, language, method):
    if method == "staggered":
        fast = SCENE.replace("[snow]", "[snow]\nfluidity_per_MPa3_a = 20.0")
        short = fast.replace("horizon_days = 3", "horizon_days = 0.0005")
        scene.write_text(short.replace("no-slip", "free"))
    ended = call("solve", scene, "--method", method, "--language", language)
    assert ended.code in (0, 4)
    assert find_english(ended.out + ended.err) == set()
    assert {"fr": "du poids", "de": "des Gewichts"}[language] in ended.out


def test_the_page_of_a_solution_tells_each_flag_once(call, scene, language):
    scene.write_text(SCENE.replace("horizon_days = 3", "horizon_days = 0.02"))
    options = ("--method", "transient", "--out", "out", "--language", language)
    assert call("solve", scene, *options).code in (0, 4)
    out = scene.parent / "out"
    document = json.loads((out / "solution.json").read_text(encoding="utf-8"))
    flags = [" ".join(flag.split()) for flag in document["flags"]]
    page = html.unescape((out / "index.html").read_text(encoding="utf-8"))
    assert flags
    assert [" ".join(page.split()).count(flag) for flag in flags] == [1] * len(flags)
    assert find_english(" ".join(flags)) == set()


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("slack = 0.05", "slack = 0.4"),
        ("thickness_m = 2.5", "thickness_m = 2.5\nheight_vertical_m = 3"),
        ("angle_deg = 38", "angle_deg = 95"),
        ('law = "no-slip"', 'law = "sliding"'),
        ('law = "no-slip"', 'law = "glatt"'),
        ("friction_deg = 30", ""),
        ("[net]", "[nets]"),
        ("stiffness_kN_per_m = 8000", 'stiffness_kN_per_m = 8000\nkind = "rigid"'),
        ("density_kg_m3 = 300", "density_kg_m3 = 300\ncreep_law = 'salm'"),
        ("inclination_deg = 30", "inclination_deg = 30\nheight_m = 1"),
    ],
)
def test_a_refused_scene_is_refused_in_the_language(call, scene, language, old, new):
    scene.write_text(SCENE.replace(old, new))
    ended = call("solve", scene, "--language", language)
    assert ended.code in (3, 4)
    told = ended.out + ended.err
    assert find_english(re.sub(r"\b[a-z]+(\.[a-z_A-Z0-9]+)+\b", " ", told)) == set()


def test_an_envelope_is_told_in_the_language(call, scene, language):
    ranges = ("--density", "280:300:2", "--jobs", 1, "--accuracy", 0.05)
    ended = call("envelope", scene, *ranges, "--language", language)
    assert ended.code == 0
    assert find_english(KEYS.sub(" ", ended.out + ended.err)) == set()
    assert {"fr": "grille", "de": "Raster"}[language] in ended.err
    assert {"fr": "calculés", "de": "gerechnet"}[language] in ended.out


@pytest.mark.long
def test_a_check_and_what_is_told_of_its_study_speak_the_language(
    call, tmp_path, monkeypatch, language
):
    monkeypatch.setenv("NETDESIGN_STORE", str(tmp_path / "cases.sqlite"))
    write_short_example(tmp_path / "site.xlsx", ["R7"])
    chosen = ("--language", language)
    options = ("--accuracy", 0.05, "--jobs", 1, "--no-html", "--no-excel")
    ended = call("check", "site.xlsx", *options, *chosen)
    assert ended.code in (0, 1, 4)
    assert find_english(ended.err) == set()  # its terminal page has tests of its own
    study = "netdesign-out/study.json"
    verified = call("verify", "--study", study, "--jobs", 1, *chosen)
    assert verified.code == 0
    assert find_english(verified.out + verified.err) == set()
    same = call("diff", study, study, *chosen)
    assert find_english(same.out) == set()
    refused = call("report", study, "--site", "scene.toml", "--out", "new", *chosen)
    assert refused.code == 3
    assert find_english(refused.err) == set()
