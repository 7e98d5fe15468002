"""A heading is taken for one field or asked for, however it is written."""

import unicodedata

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from netdesign.site.columns.all_tables import (
    NETS,
    RANGES,
    READ_LANGUAGES,
    SHEETS,
    load_file,
)
from netdesign.site.columns.fields import normalise_unit
from netdesign.site.columns.lexicon import Lexicon, find_unit, fold, read_part
from tests.each import each

LISTS = [(plan, plan.fields) for plan in SHEETS]
LISTS += [(plan, plan.items) for plan in SHEETS if plan.items]
LEXICA = {plan.name: Lexicon.of(plan.fields, plan) for plan in SHEETS}
NAMES = [
    (plan.name, field.key, name)
    for plan in SHEETS
    for field in plan.fields
    for name in field.raw_names
]
SMALL = ("de", "du", "la", "le", "der", "die", "des", "di", "della", "the", "of")


@each("plan, fields", LISTS)
def test_no_heading_stands_for_two_fields_when_small_words_are_dropped(plan, fields):
    owners = {}
    for field in fields:
        for name in field.raw_names:
            owners.setdefault(read_part(name).whole, set()).add(field.key)
    assert {name: keys for name, keys in owners.items() if name and len(keys) > 1} == {}


@each("plan, fields", LISTS)
def test_no_heading_is_sure_and_unclear_at_once(plan, fields):
    sure = {read_part(name).whole for field in fields for name in field.raw_names}
    keys = {field.key for field in fields}
    unclear = {
        read_part(name).whole
        for name, meant in plan.unclear.items()
        if keys.intersection(meant)
    }
    assert sure & unclear == set()


@pytest.mark.parametrize("language", READ_LANGUAGES)
def test_synonyms_are_of_fields_that_there_are(language):
    keys = {plan.name: {field.key for field in plan.fields} for plan in SHEETS}
    keys["Ranges"] = {*keys["Ranges"], "span"}
    keys["quantities"] = {field.key for field in RANGES.items}
    keys["sheets"] = {plan.name for plan in SHEETS}
    tables = load_file(f"headings/{language}")
    for table, entries in tables.items():
        if table in keys:
            assert set(entries) <= keys[table]
    for plan in SHEETS:
        known = keys[plan.name] | {field.key for field in plan.items}
        assert set(tables["unclear"].get(plan.name, {})) <= known


def test_no_sheet_name_stands_for_two_sheets():
    owners = {}
    for plan in SHEETS:
        for name in plan.raw_names:
            owners.setdefault(fold(name), set()).add(plan.name)
    assert {name: plans for name, plans in owners.items() if len(plans) > 1} == {}


@st.composite
def written(draw):
    """A known heading as somebody else writes it."""
    sheet, key, name = draw(st.sampled_from(NAMES))
    text = draw(st.sampled_from([name, name.upper(), name.title(), f"  {name} "]))
    if draw(st.booleans()):
        text = unicodedata.normalize("NFD", text)
    if draw(st.booleans()):
        text = text.replace(" ", draw(st.sampled_from(["  ", "\n", "-", "_", " "])))
    if draw(st.booleans()):
        text = f"{draw(st.sampled_from(SMALL))} {text}"
    unit = draw(st.sampled_from(["", " [m]", " (kN)", ", en m", " [°]"]))
    return sheet, key, text + unit


@settings(max_examples=800)
@given(written())
def test_a_heading_written_otherwise_is_the_same_or_asked_for(drawn):
    sheet, key, text = drawn
    field = LEXICA[sheet].match(text).field
    assert field is None or field.key == key


@settings(max_examples=800)
@given(st.sampled_from(NAMES), st.sampled_from(NAMES))
def test_two_headings_in_one_cell_are_taken_only_if_they_agree(one, other):
    lexicon = LEXICA[one[0]]
    match = lexicon.match(f"{one[2]} / {other[2]}")
    alone = lexicon.match(other[2])
    readings = {field.key for field in (alone.field, *alone.readings) if field}
    if match.field is not None and one[1] not in readings:
        # not cut in two: the whole is a name of its own
        whole = f"{one[2]} / {other[2]}"
        assert lexicon.match(whole.replace("/", " ")).field == match.field
    if alone.field and alone.field.key != one[1]:
        assert match.field is None


APART = (" / ", "/", "\n", " - ", " – ", "; ", " | ", ", ")
WORDS_ALONE = load_file("signs")["small"]["words"]


@settings(max_examples=800)
@given(
    st.sampled_from(NAMES),
    st.sampled_from([*WORDS_ALONE, "?", "..."]),
    st.sampled_from(APART),
    st.booleans(),
)
def test_a_small_word_apart_is_no_word_of_the_name_beside_it(one, word, sign, is_first):
    sheet, _, name = one
    lexicon = LEXICA[sheet]
    text = f"{word}{sign}{name}" if is_first else f"{name}{sign}{word}"
    alone, match = lexicon.match(word).field, lexicon.match(text)
    if match.field is not None:
        assert alone == match.field


# The heading of sheet Ranges, the field that it is, the fields that are asked for
@each(
    "heading, key, readings, contrary",
    [
        ("de / high", None, {"low", "high"}, ""),
        ("high/de", None, {"low", "high"}, ""),
        ("von\nmax", None, {"low", "high"}, ""),
        ("à / low", None, {"low", "high"}, ""),
        ("des / high", None, {"high"}, "des"),
        ("? / high", None, {"high"}, "?"),
        ("the high (de)", None, set(), ""),
        ("de, high", None, set(), ""),
        ("xyz / high", None, set(), ""),
        ("de / von", "low", set(), ""),
        ("von / min", "low", set(), ""),
        ("à / bis", "high", set(), ""),
        ("valeur maximale / to", "high", set(), ""),
        ("high / -", "high", set(), ""),
    ],
)
def test_both_sides_of_a_heading_mean_one_field(heading, key, readings, contrary):
    match = LEXICA["Ranges"].match(heading)
    assert (match.field and match.field.key) == key
    assert {one.key for one in match.readings} == readings
    assert match.contrary == contrary


def test_a_small_word_means_no_other_field_than_its_group():
    ranges, nets = LEXICA["Ranges"], LEXICA["Nets"]
    assert ranges.match("de", "high").field is None
    assert ranges.match("high", "de").field.key == "high"
    assert ranges.match("de", "minimum").field.key == "low"
    assert nets.match("de", "hauteur verticale").field is None


# Heading, symbol or group beside it, and what is asked for
@each(
    "heading, group, contrary",
    [
        ("Netzhöhe HK", "", "HK"),
        ("hauteur du filet Hk [m]", "", "Hk"),
        ("Schneehöhe D", "", "D"),
        ("épaisseur de neige H [m]", "", "H"),
        ("épaisseur [m]", "Filet", "Filet"),
        ("longueur amont [m]", "Ancrages", "Ancrages"),
        ("Dk [m]", "Neige", "Neige"),
        ("Dk/Hk [m]", "", "Hk"),
        ("Ancrage amont (ancien)", "", "ancien"),
    ],
)
def test_a_symbol_or_group_of_another_quantity_is_asked_for(heading, group, contrary):
    match = LEXICA["Nets"].match(heading, group)
    assert match.field is None
    assert match.is_unclear
    assert match.contrary == contrary


@each(
    "heading",
    [
        *("HK [m]", "Hk", "H", "D [m]", "N", "hauteur", "Höhe H"),
        *("Werkhöhe", "hauteur d'ouvrage [m]", "altezza rete [m]", "Neigung [°]"),
        *("snow depth [m]", "altezza neve", "longueur", "distance", "amont", "Seil"),
        *("Schneehöhe rechtwinklig [m]", "post height [m]", "Stützenhöhe"),
    ],
)
def test_what_may_be_several_quantities_is_asked_for(heading):
    match = LEXICA["Nets"].match(heading)
    assert match.field is None
    assert match.readings


@each(
    "heading",
    [
        *("Hauteur de poteau [m]", "Entraxe rangées [m]", "Pente filet [°]", "Dk min"),
        *("longueur amont du hauban [m]", "Raideur câble [kN/m]", "D vertical [m]"),
        *("Anker bergseitig Länge [m]", "Dk Hk", "Poids N", "inclinaison filet [°]"),
        *("épaisseur de glace [m]", "résistance Rd [kN]", "Masse"),
        *("hauteur de neige (normale à la pente) [m]", "net height vertical [m]"),
        *("Schneehöhe (hangnormal) [m]", "Dk min. vertical", "post type old"),
    ],
)
def test_a_heading_with_a_word_more_is_not_taken(heading):
    assert LEXICA["Nets"].match(heading).field is None


@each(
    "heading, group, key",
    [
        ("hauteur du filet Dk", "", "net_height"),
        ("D_K [m]", "", "net_height"),
        ("ψ (°)", "Terrain", "slope_angle"),
        ("Entraxe poteaux, en m", "", "post_spacing"),
        ("amont", "Ancrages", "uphill_anchor"),
        ("amont", "Haubans", "uphill_guy"),
        ("Stuetzen-Abstand a", "", "post_spacing"),
        ("Altezza rete DK\nNetzhöhe DK [m]", "", "net_height"),
        ("Distanza a monte / Länge bergwärts", "", "upslope_length"),
        ("Netz-Steifigkeit EA [kN/m]", "", "net_stiffness"),
        ("Extremschneehöhe Hext [m]", "", "snow_height"),
        ("Pfostenprofil", "", "post"),
        ("hauteur de neige extrême", "", "snow_height"),
    ],
)
def test_headings_of_offices_are_taken(heading, group, key):
    field = LEXICA["Nets"].match(heading, group).field
    assert field is not None
    assert field.key == key


def test_units_stand_in_brackets_or_behind_a_comma():
    texts = ["Dk (perp.) [m]", "Entraxe, en cm", "Länge in m", "facteur N", "a: kN/m"]
    assert [find_unit(text) for text in texts] == ["m", "cm", "m", "", "kN/m"]


def test_italian_has_every_required_column():
    required = {field.key for field in NETS.fields if field.required}
    table = load_file("headings/it")
    asked_for = {"net_height"}  # taken with its symbol DK, or as normal to the slope
    assert required - asked_for <= set(table["Nets"])
    assert asked_for <= set(table["unclear"]["Nets"])


@each(
    "quantity",
    [
        *("Neigung [°]", "inclinaison", "Bodenreibung", "frottement neige/sol [°]"),
        *("Reibung Schnee/Boden", "Attrito", "H", "D [m]", "N", "Neigung ψ"),
        *("masse volumique φ", "neige"),
    ],
)
def test_quantities_that_may_be_others_are_asked_for(quantity):
    match = Lexicon.of(RANGES.items, RANGES).match(quantity)
    assert match.field is None
    assert match.readings


@each(
    "quantity",
    [
        *("densité relative", "Hangneigung", "inclinaison du terrain [°]", "angle φ"),
        *("Reibungswinkel Boden φ", "angle de frottement du sol", "Dichte Eis"),
    ],
)
def test_quantities_of_something_else_are_not_taken(quantity):
    assert Lexicon.of(RANGES.items, RANGES).match(quantity).field is None


OFFICES = [  # as three offices write them
    ("Nets", "Höhenlage", "altitude"),
    ("Nets", "Seehöhe", "altitude"),
    ("Nets", "elevation", "altitude"),
    ("Nets", "elevation [m a.s.l.]", "altitude"),
    ("Nets", "altitude moyenne", "altitude"),
    ("Nets", "Altitude [m NGF]", "altitude"),
    ("Nets", "quota [m s.l.m.]", "altitude"),
    ("Nets", "terrain slope", "slope_angle"),
    ("Nets", "terrain inclination", "slope_angle"),
    ("Nets", "row ID", "id"),
    ("Nets", "post c/c", "post_spacing"),
    ("Nets", "Pfostenabstand", "post_spacing"),
    ("Nets", "wirksame Werkhöhe Dk", "net_height"),
    ("Nets", "hauteur efficace Dk", "net_height"),
    ("Anchors", "Stab-Ø", "bar_diameter"),
    ("Anchors", "bar dia.", "bar_diameter"),
    ("Anchors", "Nenndurchmesser", "bar_diameter"),
    ("Anchors", "Bohrloch-Ø", "drill_diameter"),
    ("Ropes", "Nenndurchmesser", "rope_diameter"),
    ("Posts", "A", "area"),
    ("Posts", "Iz", "second_moment"),
    ("Posts", "Wz", "section_modulus"),
    ("Nets", "tilt of post from normal [deg]", "post_tilt"),
    ("Nets", "upslope anchor dist. [m]", "uphill_anchor_distance"),
    ("Nets", "guys per side", "guy_count"),
    ("Nets", "snow length above net [m]", "upslope_length"),
    ("Anchors", "borehole dia. [mm]", "drill_diameter"),
    ("Anchors", "strata", "ground"),
    ("Anchors", "grout", "grouting"),
    ("Anchors", "total drill length [m]", "drilled_length"),
    ("Tests", "max. load [kN]", "force"),
    ("Ropes", "Mark", "id"),
    ("Ropes", "dia. [mm]", "rope_diameter"),
    ("Ropes", "end fitting", "termination"),
    ("Posts", "effective length [m]", "buckling_length"),
    ("Posts", "allowable bearing [MPa]", "bearing_stress"),
]


@each("sheet, heading, key", OFFICES)
def test_headings_of_offices_are_known(sheet, heading, key):
    assert LEXICA[sheet].match(heading).field.key == key


@pytest.mark.parametrize("heading", ["Werkabstand", "Reihenabstand"])
def test_a_heading_that_is_not_sure_is_asked_for(heading):
    meaning = LEXICA["Nets"].match(heading)
    assert meaning.field is None
    assert meaning.readings


@each("unit", ["m ü. M.", "m ü.A.", "m NGF", "m a.s.l.", "m s.l.m.", "m asl", "müM"])
def test_metres_above_the_sea_are_metres(unit):
    assert normalise_unit(unit) == "m"
    heading = LEXICA["Nets"].match(f"Altitude [{unit}]")
    assert heading.field.key == "altitude"


def test_millinewtons_stay_what_nobody_guesses():
    assert normalise_unit("mN") == "mN"
    assert normalise_unit("mN/m") == "mN/m"


@each(
    "name", ["Nets A", "Nets 2", "Nets North", "Filets Ouest", "Netze Süd", "Nets III"]
)
def test_a_sheet_for_each_structure_holds_net_rows(name):
    nets = next(one for one in SHEETS if one.name == "Nets")
    assert nets.is_structure(name)
    assert not nets.is_structure("Nets old")


@pytest.mark.parametrize(
    ("sheet", "name"),
    [
        *(("Anchors", "Anchor schedule"), ("Ropes", "Rope schedule")),
        *(("Posts", "Post schedule"), ("Tests", "Pull tests")),
    ],
)
def test_schedules_are_known(sheet, name):
    assert [one.name for one in SHEETS if one.matches(name)] == [sheet]


@pytest.mark.parametrize(
    ("sheet", "key", "headings"),
    [
        ("Nets", "post_spacing", ["Abstand Pfosten", "distance between posts"]),
        ("Nets", "ridge_rope", ["Tragseil oben", "top rope", "câble supérieur"]),
        ("Nets", "downhill_anchor_distance", ["Abstand tals. Anker"]),
        ("Nets", "post_count", ["Pfosten Anzahl", "count of posts", "nbre poteaux"]),
        ("Anchors", "drill_diameter", ["Hole dia.", "Ø trou", "Durchmesser Bohrung"]),
        ("Anchors", "test_least", ["essai mini", "min. test", "Versuch min."]),
        ("Ropes", "rope_diameter", ["Durchmesser", "wire dia."]),
        ("Ropes", "id", ["Seil", "cable"]),
        ("Posts", "id", ["Stütze", "poteau"]),
    ],
)
def test_other_words_in_another_order_say_the_same(sheet, key, headings):
    for heading in headings:
        assert LEXICA[sheet].match(heading).field.key == key, heading


@pytest.mark.parametrize(
    ("sheet", "heading"),
    [
        ("Nets", "Neigung"),
        ("Nets", "Abstand"),
        ("Nets", "Länge Stütze Nord"),
        ("Nets", "Stützen-Nr."),
        ("Anchors", "Festigkeit Anker"),
        ("Anchors", "longueur"),
        ("Posts", "Breite oben"),
        ("Tests", "design force"),
        ("Tests", "Bemessungskraft"),
        ("Ropes", "working load"),
        ("Anchors", "design resistance of the ground"),
    ],
)
def test_what_says_too_little_or_more_is_not_taken(sheet, heading):
    assert LEXICA[sheet].match(heading).field is None


def test_no_sense_is_of_two_fields_but_where_it_is_asked():
    for name, lexicon in LEXICA.items():
        for sense, keys in lexicon.senses.items():
            if len(keys) > 1 and "?" not in keys:
                assert (name, sorted(keys)) in TWO_OF_A_SENSE, sorted(sense)


TWO_OF_A_SENSE = [
    ("Project", ["item", "value"]),
    ("Nets", ["ground", "ground_law"]),
    ("Anchors", ["bond_length", "drilled_length"]),
    ("Anchors", ["id", "kind"]),
]


@pytest.mark.parametrize(
    ("sheet", "heading", "unit", "key"),
    [
        ("Anchors", "Bar (mm)", "mm", "bar_diameter"),
        ("Anchors", "Drill (mm)", "mm", "drill_diameter"),
        ("Anchors", "Bond (m)", "m", "bond_length"),
        ("Anchors", "Scellement (m)", "m", "bond_length"),
        ("Anchors", "Test (kN)", "kN", None),
        ("Anchors", "Länge (m)", "m", None),
        ("Anchors", "Bar (m)", "m", None),
        ("Nets", "Snow (m)", "m", None),
        ("Nets", "Post (m)", "m", None),
    ],
)
def test_a_word_and_a_unit_say_enough_where_one_column_alone_has_both(
    sheet, heading, unit, key
):
    found = LEXICA[sheet].match_by_unit(heading, unit).field
    assert (found and found.key) == key
