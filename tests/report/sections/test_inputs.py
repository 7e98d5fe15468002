"""Inputs of a row: typed, understood, and how the one follows from the other."""

from dataclasses import replace

import pytest

from netdesign.checks import list_standards, load_standard
from netdesign.report.sections.annexes import build_provenance
from netdesign.report.sections.basis import build_inputs, name_profile
from netdesign.report.words import Words
from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.model import InputEcho
from netdesign.snow.creep_law import BOUTILLIER_2004
from netdesign.study.record_provenance import name_law
from netdesign.words.catalogue import LANGUAGES, set_marks
from netdesign.words.message import say
from tests.each import each
from tests.report.build_study import build_study

SLIP = InputEcho(
    label=say("column.Nets.slip_length"),
    unit="m",
    text="2.713",
    value=38.0,
    cell="Nets!H2",
    derivation=say(
        "column.slip_of_table",
        thickness=2.8417,
        glide=2.713,
        low=2.6728,
        high=2.8377,
        start=12.5,
        end=16.0,
        law="boutillier-2004",
    ),
)
FORMULA = "2.8417 m · (12.5 + (2.713 − 2.6728) / (2.8377 − 2.6728) · (16 − 12.5)), "


STUDY = build_study(rows=1)


def show_input(echo, words):
    """Cell of an input of a row that has no other."""
    (row,) = STUDY.rows
    study = replace(STUDY, rows=[replace(row, inputs=[echo])])
    *_, line = build_inputs(study, words).rows
    assert line[0].text.startswith(words.show(echo.label))
    return line[-1]


def test_inputs_of_the_end_of_a_row_do_not_hide_those_inside():
    """Both have the same name; what two rows share stands once, before the rows."""
    study, words = build_study(), Words("en")
    of_place = {
        place: InputEcho(
            label=say(f"column.{place}.foot_anchor"),
            unit="",
            text=text,
            value=text,
            cell="A1",
        )
        for place, text in (("Nets", "A28"), ("Ends", "A40"))
    }
    rows = [replace(row, inputs=[*of_place.values()]) for row in study.rows]
    lines = build_inputs(replace(study, rows=rows), words).rows
    shown = [[cell.text for cell in line[2:]] for line in lines[-2:]]
    none = [""] * len(study.rows)
    assert shown == [["A28", *none], ["A40", *none]]
    assert lines[-1][0].text != lines[-2][0].text


@pytest.mark.parametrize("language", ["en", "fr", "de"])
def test_a_derived_input_shows_its_formula_with_numbers(language):
    shown = show_input(SLIP, Words(language))
    assert set_marks(FORMULA.rstrip(", "), language) in shown.note
    assert shown.note.endswith("boutillier-2004")
    assert set_marks(SLIP.text, "en") in shown.text


def test_any_other_input_shows_what_was_typed():
    typed = InputEcho(
        label=say("column.Nets.slack"), unit="-", text="0,03", value=0.03, cell="A1"
    )
    assert show_input(typed, Words("en")).text == "0,03 → 0.03"
    assert not show_input(typed, Words("en")).note


WORDS = [
    (field, word) for plan in SHEETS for field in plan.fields for word in field.words
]


@each("language", ["en", "fr", "de"])
@each("field, word", WORDS)
def test_a_word_of_a_column_is_shown_in_the_readers_language(field, word, language):
    echo = InputEcho(label=field.name, unit="", text="x", value=word, cell="A1")
    words = Words(language)
    shown = show_input(echo, words)
    named = field.name_word(word)
    assert shown.text == (named if isinstance(named, str) else words.show(named))


@each("language", LANGUAGES)
@each("profile", list_standards())
def test_the_provenance_names_profile_and_law_as_the_pages_do(profile, language):
    standard, words = load_standard(profile), Words(language)
    study = build_study(rows=1)
    record = replace(
        study.profile, id=profile, title=standard.title, edition=standard.edition
    )
    settings = {"creep_law": name_law(BOUTILLIER_2004)}
    provenance = replace(study.provenance, settings=settings)
    study = replace(study, profile=record, provenance=provenance)
    told = {line[0].text: line[1].text for line in build_provenance(study, words).rows}
    title = name_profile(study, words)
    assert told[words("heading.limit_profile")].endswith(title)
    assert profile in told[words("heading.limit_profile")]
    is_english = language == "en"
    assert ("written for netdesign" in title) is is_english
    assert any(name_law(BOUTILLIER_2004) == one for one in told.values()) is is_english
