"""A heading is the one column of that name, or none; a guess is only sure alone."""

import unicodedata

from hypothesis import given, settings
from hypothesis import strategies as st

from netdesign.site.columns.all_tables import list_unclear
from netdesign.site.columns.fields import normalise
from netdesign.site.lists.ask import rank_targets
from netdesign.site.lists.targets import GROUPS, list_targets
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.make import name_heading
from tests.site.columns.fields import PLANS, QUANTITIES

NAMES = [
    (table, field.key, name)
    for table, plan in PLANS.items()
    for field in plan.fields
    for name in field.raw_names
]


@each("table", sorted(PLANS))
def test_a_heading_of_a_csv_in_cp1252_is_the_same_column(table):
    """Signs that this encoding lacks are lost there: Greek letters and indices."""
    for field in PLANS[table].fields:
        for language in LANGUAGES:
            heading = name_heading(field, language)
            lost = heading.encode("cp1252", "replace").decode("cp1252")
            fitted = heading.replace("δ", "d").replace("φ", "f").replace("₁", "1")
            assert PLANS[table].find(lost).key == field.key
            assert PLANS[table].find(fitted).key == field.key


@each(
    "table, heading, meant",
    [
        ("rows", "slope ψ [deg]", "slope_angle"),
        ("rows", "  HANGNEIGUNG ψ (°) ", "slope_angle"),
        ("rows", "Entraxe des montants b", "post_spacing"),
        ("net_types", "effective height D_K", "net_height"),
        ("net_types", "flèche câble infé-\nrieur [%]", "lower_sag"),  # of old templates
        ("net_types", "câble supé-\nrieur", "ridge_rope"),
        ("rows", "Neigung [°]", None),
        ("rows", "uphill anchor (old)", None),  # behind a word no unit stands
        ("rows", "zul. Ankerkraft [kN]", None),
        ("rows", "post spacing b, in m", None),
        ("rows", "x" * 101, None),
    ],
)
def test_a_heading_is_its_whole_name(table, heading, meant):
    found = PLANS[table].find(heading)
    assert (found and found.key) == meant


@st.composite
def written(draw):
    """A known heading as somebody else writes it."""
    table, key, name = draw(st.sampled_from(NAMES))
    text = draw(st.sampled_from([name, name.upper(), name.title(), f"  {name} "]))
    if draw(st.booleans()):
        text = unicodedata.normalize("NFD", text)
    if draw(st.booleans()):
        text = text.replace(" ", draw(st.sampled_from(["  ", "\n", "-", "_", " "])))
    return table, key, text + draw(st.sampled_from(["", " [m]", " (kN)", " [°]"]))


@settings(max_examples=500)
@given(written())
def test_case_accents_punctuation_and_units_do_not_count(drawn):
    table, key, text = drawn
    assert PLANS[table].find(text).key == key


@settings(max_examples=500)
@given(written(), st.sampled_from(["min", "zul.", "of", "x", "Nord", "HK", "adm."]))
def test_a_word_more_is_another_heading(drawn, word):
    table, _, text = drawn
    for other in (f"{word} {text}", f"{text} {word}"):
        field = PLANS[table].find(other)
        assert field is None or normalise(other.split("[")[0]) in field.names


# Table, heading, its unit, the guess that is taken, and one that is ranked
@each(
    "table, heading, unit, taken, ranked",
    [
        ("rows", "Netzsteifigkeiten [kN/m]", "kN/m", "net_stiffness", "net_stiffness"),
        ("rows", "Abstände der Stützen [m]", "m", "post_spacing", "post_spacing"),
        ("rows", "Hext lotrecht [m]", "m", None, "snow.vertical"),
        ("anchor_types", "zul. Zugglied [kN]", "kN", None, "tendon"),
        ("anchor_types", "Zugglieder [m]", "m", None, None),  # no resistance's unit
        ("anchor_types", "Zugglieder [kN]", "kN", None, "tendon"),
    ],
)
def test_a_guess_is_taken_where_it_is_sure_and_its_unit_fits(
    table, heading, unit, taken, ranked
):
    listed, target = rank_targets(heading, unit, list_targets(table))
    assert (target and target.name) == taken
    assert ranked is None or ranked in {one.name for one, _ in listed}
    assert all(unit in one.field.units for one, _ in listed)


@settings(max_examples=300)
@given(st.sampled_from(NAMES), st.sampled_from(["zul.", "zulässige", "allowable"]))
def test_without_its_own_name_a_heading_is_never_taken_for_an_allowable_one(one, word):
    table, _, name = one
    targets = list_targets(table) if table in GROUPS else ()
    for heading in (f"{word} {name}", f"{name} adm.", f"{name} admissible"):
        assert rank_targets(heading, "", targets)[1] is None


@each("sheet, table", [("Nets", "net_types"), ("Anchors", "anchor_types")])
def test_no_heading_of_a_list_is_sure_and_unclear_at_once(sheet, table):
    names = {name for field in QUANTITIES[sheet] for name in field.names}
    assert names.isdisjoint(list_unclear(table))
