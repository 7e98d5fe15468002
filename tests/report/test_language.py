"""Languages of the reports: what is translated, what never is, what is missing."""

import re

import pytest

from netdesign.checks import load_standard
from netdesign.report.language import LANGUAGES, Words, load_words
from netdesign.report.page.html import render_html
from netdesign.report.translation import translate_drawing, translate_view
from netdesign.report.view.table import Cell
from netdesign.report.workbook.excel import render_workbook
from netdesign.study.record_guideline import _SENTENCES
from netdesign.words.message import say
from tests.report.build_study import SCRIPT, build_study

GUIDELINE_SENTENCES = {kind: str(say(key)) for kind, key in _SENTENCES.items()}

# Not translated: texts of the made-up study, which no solver and no profile writes.
MADE_UP = (
    *("The demand exceeds the resistance.", "The demand stays within the resistance."),
    *("1 of the cases has no result.", "No resistance is given in Anchors!E7."),
    "Downhill anchor, pull-out: no resistance is given.",
    "25° to 35° lies within 25° to 35°.",
    *("Slope angle", "Snow height", "Ground", "Slack", "Remark", "jobs"),
    *("Setting: jobs", "Partial factor of snow pressure"),
    *("Partial factor of a tendon", "Partial factor of a tested anchor"),
    *("NF P 95-304 style profile, 1992", "secondary literature, see NOTES.md"),
    *("Smallest inclination of the net", "Largest inclination of the net"),
    *(
        "type =1+1 of the workbook has 900 kN",
        "type =1+1 of the workbook has 900 kN, now 480 kN",
    ),
)
WORD = re.compile(r"[^\W\d_]{4}")
SHIPPED = ("nf-p-95-304-style", "eurocode", "onr-24805-style", "swiss-guideline-2007")


def ask_all():
    """Every text that the reports of a study ask a language for."""
    asked = {}

    class Listener(Words):
        def __call__(self, text):
            asked[text] = None
            return text

    render_html(build_study(), Listener())
    render_workbook(build_study(), Listener())
    return list(asked)


@pytest.mark.parametrize("language", ["fr", "de"])
def test_no_text_of_the_program_is_missing(language):
    words = load_words(language)
    missing = [
        text
        for text in ask_all()
        if WORD.search(text) and SCRIPT not in text and words.find(text) is None
    ]
    assert set(missing) <= set(MADE_UP)


@pytest.mark.parametrize("language", ["fr", "de"])
def test_default_profile_and_guideline_are_translated(language):
    words = load_words(language)
    texts = [value.text for value in load_standard(SHIPPED[0]).listed]
    texts += [value.source for value in load_standard(SHIPPED[0]).listed]
    texts += GUIDELINE_SENTENCES.values()
    assert [text for text in texts if words.find(text) is None] == []


def test_languages_hold_the_same_texts():
    french, german = load_words("fr"), load_words("de")
    assert set(french.texts) == set(german.texts)
    assert len(french.patterns) == len(german.patterns) > 50


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_missing_text_stays_english(language):
    text = "relative density = 0.43: nobody has translated this"
    assert load_words(language)(text) == text


@pytest.mark.parametrize(
    ("english", "french"),
    [
        ("1 NOT PROVEN, 10 PASS", "1 NON PROUVÉ, 10 SATISFAIT"),
        ("0.842 to 0.871", "0.842 à 0.871"),
        ("Demand [kN]", "Sollicitation [kN]"),
        ("Foot anchor, pull-out", "Ancrage de pied, arrachement"),
        ("post spacing at most 2.4 m, now 4 m",
         "entraxe des poteaux au plus 2.4 m, actuellement 4 m"),
        ("Coupled solve: 400 kg/m³, φ 45°, θ 35°",
         "Calcul couplé\u00a0: 400 kg/m³, φ 45°, θ 35°"),
        ("foot_anchor.tendon: The member is slack in every case and needs no "
         "resistance.",
         "foot_anchor.tendon\u00a0: L'élément est détendu dans tous les cas et n'a pas "
         "besoin de résistance."),
    ],
)  # fmt: skip
def test_sentences_keep_numbers_symbols_and_keys(english, french):
    assert load_words("fr")(english) == french


@pytest.mark.parametrize("language", ["fr", "de"])
def test_an_unknown_sentence_is_never_translated_by_half(language):
    text = "nobody knows this text about 220 to 525 kg/m3 of snow"
    assert load_words(language)(text) == text


NOTES = [
    'a.xlsx › Nets › Q3: "weather" is no known heading: the column is not read; '
    "accepted: a known heading",
    'a.xlsx › Nets › Q3: "hight" is no known heading: the column is not read; '
    'accepted: a known heading (nearest: "net height [m]")',
    'a.xlsx › Nets › A9: "see the survey of 2023" is a note below the table: it is '
    "not read",
    "a.xlsx › Old: the sheet has no part in the check: it is not read",
    "a.xlsx › Nets: the sheet is hidden; it was read all the same",
    'a.xlsx › Nets › A4: "R3" is in a hidden row; it was read all the same',
    'a.xlsx › Nets › C1: "slack" is in a hidden column; it was read all the same',
    'a.xlsx › Nets › Z3: "7" stands below no heading: the column is not read',
    'a.xlsx › Nets › A1: "Survey" stands above the headings: the line is not read',
    "net row W2: layer densities of 221.7 to 525.5 kg/m3 reach outside the 367 to 917 "
    "kg/m3 for which the creep law boutillier-2004 is given",
    "net row W2: its 2 layers of mean density 304.4 kg/m3 keep their proportions; "
    "their mean follows the range of density",
    "relative density = 0.436205: the creep law gagliardini-1997 has 3a = 4715 < 2b = "
    "8120 there; snow compressed along one axis would shrink sideways: use another "
    "set or denser snow",
]


@pytest.mark.parametrize("language", ["fr", "de"])
@pytest.mark.parametrize("note", NOTES)
def test_notes_of_the_importer_are_translated_whole(language, note):
    shown = load_words(language)(note)
    left = {"read", "known", "reach", "keep", "their", "below", "hidden", "column"}
    assert not left & set(re.findall(r"\w+", shown))
    for part in re.findall(r"[\d.]{3,}|a\.xlsx › \w+", note):
        assert part in shown


@pytest.mark.parametrize("language", ["fr", "de"])
def test_no_line_of_a_text_can_begin_with_a_sign_of_punctuation(language):
    texts = load_words(language).texts.values()
    assert [text for text in texts if re.search(" [:;?!%»]", text)] == []


@pytest.mark.parametrize("profile", SHIPPED)
def test_titles_of_the_shipped_profiles_are_translated(profile):
    standard = load_standard(profile)
    title = f"{standard.title}, {standard.edition}"
    assert load_words("fr").find(title) is not None
    assert load_words("de").find(title) is not None


def test_what_somebody_typed_is_never_translated():
    words = load_words("fr")
    assert words("Post") == "Poteau"
    assert translate_view(Cell(text="Post"), words).text == "Post"
    assert translate_view(Cell(text="Post", is_words=True), words).text == "Poteau"
    page = render_html(build_study(), words)
    assert 'lang="fr"' in page
    assert "Couloir 1" in page
    assert "<script" not in page


def test_hostile_gaps_stay_text():
    words = load_words("fr")
    text = "no resistance is given for {what} {0} \\1, cell <b>"
    assert (
        words(text) == "aucune résistance n'est donnée pour {what} {0} \\1, cellule <b>"
    )
    long = "a to b, " * 5000
    assert words(long) == long


def test_texts_of_drawings_are_translated_and_escaped():
    svg = (
        '<svg aria-label="Member forces over the ranges"><text x="1">Post</text></svg>'
    )
    shown = translate_drawing(svg, lambda text: f"<{text}>")
    assert 'aria-label="&lt;Member forces over the ranges&gt;"' in shown
    assert "&lt;Post&gt;</text>" in shown
