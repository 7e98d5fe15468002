import re

import pytest

from netdesign.site.columns.all_tables import (
    PROJECT_ITEMS,
    RANGE_QUANTITIES,
    SHEETS,
    load_file,
)
from netdesign.site.columns.fields import split_heading
from netdesign.site.template.workbook import describe_accepted
from netdesign.words.catalogue import LANGUAGES, render
from tests.each import each

TABLES = {
    **{plan.name: plan.fields for plan in SHEETS},
    "quantities": RANGE_QUANTITIES,
    "items": PROJECT_ITEMS,
}

# Signs of the trade, the same in every language.
SIGNS = {
    ("Anchors", "grouting"),
    ("Ropes", "construction"),
    ("Posts", "buckling_curve"),
}


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_text_is_missing_and_none_is_left_over(language):
    words, english = load_file(f"words/{language}"), load_file("words/en")
    for table in ("text", "drawing"):
        assert set(words[table]) == set(english[table])
    for table, texts in english.items():
        assert set(texts) <= set(words[table])
    notes = {name: texts for name, texts in words.items() if name in TABLES}
    assert set(words) == {"text", "drawing", *notes}
    for table, texts in notes.items():
        assert set(texts) <= {field.key for field in TABLES[table]}


@pytest.mark.parametrize("language", LANGUAGES)
def test_words_have_a_name_in_every_language_but_signs_of_the_trade(language):
    for table, fields in TABLES.items():
        for field in fields:
            is_sign = (table, field.key) in SIGNS
            for word in field.words:
                assert isinstance(field.name_word(word), str) is is_sign
                name = render(field.name_word(word), language)
                assert field.spellings[name] == word


def test_an_english_word_is_its_own_name():
    for fields in TABLES.values():
        for field in fields:
            for word in field.words:
                assert render(field.name_word(word), "en") == word


@each("language", LANGUAGES)
@each("table", TABLES)
def test_what_is_written_as_heading_is_read_as_it(language, table):
    for field in TABLES[table]:
        name, unit = split_heading(field.heading_for(language))
        assert name in field.names
        assert unit == field.unit


@each("plan", SHEETS)
def test_sheets_are_found_by_their_name_in_every_language(plan):
    for language in LANGUAGES:
        matching = [one for one in SHEETS if one.matches(plan.name_in(language))]
        assert matching == [plan]


@pytest.mark.parametrize("language", LANGUAGES)
def test_numbers_are_the_same_in_every_language(language):
    for fields in TABLES.values():
        for field in fields:
            told = re.findall(
                r"-?[0-9]+(?:[.,][0-9]+)?", describe_accepted(field, language)
            )
            if field.words or field.bounds[0] == field.bounds[1]:
                continue
            assert "." not in "".join(told[:2]) or language == "en"
            unitless = [float(number.replace(",", ".")) for number in told[:2]]
            assert unitless == pytest.approx(list(field.bounds), rel=1e-9)
