"""Inputs of a row: typed, understood, and how the one follows from the other."""

from dataclasses import replace

import pytest

from netdesign.report.sections.basis import build_inputs
from netdesign.report.words import Words
from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.model import InputEcho
from netdesign.words.catalogue import set_marks
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


@pytest.mark.parametrize("language", ["en", "fr", "de"])
def test_a_derived_input_shows_its_formula_with_numbers(language):
    words = Words(language)
    shown = show_input(SLIP, words)
    assert set_marks(FORMULA.rstrip(", "), language) in shown.note
    assert shown.note.endswith("boutillier-2004")
    assert words.write_formula(SLIP.text) in shown.text


def test_any_other_input_shows_what_was_typed():
    typed = InputEcho(
        label=say("column.Nets.slack"), unit="-", text="3 %", value=0.03, cell="A1"
    )
    assert show_input(typed, Words("en")).text == "3 % → 0.03"
    assert not show_input(typed, Words("en")).note
    same = replace(typed, text="0,030")  # another mark is no other way
    assert show_input(same, Words("en")).text == "0.03"


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
