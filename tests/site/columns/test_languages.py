import re

import pytest

from netdesign.site.columns.all_tables import PROJECT_ITEMS, RANGE_QUANTITIES, SHEETS
from netdesign.site.columns.fields import LANGUAGES, normalise, split_heading
from netdesign.site.columns.languages import load_words
from netdesign.site.template.notes_sheet import describe_accepted, describe_field

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
    words, english = load_words(language), load_words("en")
    for table in ("text", "drawing"):
        assert set(words[table]) == set(english[table])
    missing, idle = [], []
    for table, fields in TABLES.items():
        keys = {field.key for field in fields}
        idle += [key for key in words[table] if key not in keys]
        for field in fields:
            given = words[table].get(field.key, {})
            wanted = {"note"} & set(english[table].get(field.key, ()))
            missing += [f"{table}.{field.key}.{key}" for key in wanted - set(given)]
            is_sign = (table, field.key) in SIGNS
            wanted_words = set() if is_sign else set(field.words)
            assert set(given.get("words", ())) == wanted_words, field.key
    assert (missing, idle) == ([], [])
    assert set(words) == {"text", "drawing", *TABLES}


def test_an_english_word_is_its_own_first_spelling():
    for fields in TABLES.values():
        for field in fields:
            for word, names in field.wording("en").words.items():
                assert names[0] == word


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("table", TABLES)
def test_what_is_written_as_heading_is_read_as_it(language, table):
    for field in TABLES[table]:
        name, unit = split_heading(field.heading_for(language))
        assert name in field.names
        assert unit == field.unit


@pytest.mark.parametrize("plan", SHEETS, ids=lambda plan: plan.name)
def test_sheets_are_found_by_their_name_in_every_language(plan):
    for language in LANGUAGES:
        matching = [one for one in SHEETS if one.matches(plan.name_in(language))]
        assert matching == [plan]


@pytest.mark.parametrize("language", LANGUAGES)
def test_numbers_are_the_same_in_every_language(language):
    for fields in TABLES.values():
        for field in fields:
            told = re.findall(r"-?[0-9.,]+", describe_accepted(field, language))
            if field.words or field.bounds[0] == field.bounds[1]:
                continue
            assert "." not in "".join(told[:2]) or language == "en"
            unitless = [float(number.replace(",", ".")) for number in told[:2]]
            assert unitless == pytest.approx(list(field.bounds), rel=1e-9)


def test_a_text_that_a_language_lacks_is_english(monkeypatch):
    from dataclasses import replace

    slope = TABLES["Nets"][1]
    bare = replace(slope, wordings={"en": slope.wording("en")})
    assert bare.heading_for("fr") == "slope angle [deg]"
    assert describe_field(bare, "fr").startswith("against the horizontal\naccepté: ")


def test_another_english_name_tells_no_language():
    """Every language uses min or max."""
    ranges = next(plan for plan in SHEETS if plan.name == "Ranges")
    quantity = next(one for one in ranges.fields if one.key == "quantity")
    label = quantity.wording("fr").label
    assert ranges.find_language([normalise(label), normalise("min")]) == "fr"
