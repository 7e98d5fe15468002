"""A heading is the one field of that name, or is asked for; never another."""

import unicodedata

from hypothesis import given, settings
from hypothesis import strategies as st

from netdesign.site.columns.all_tables import RANGES, SHEETS, Lexicon
from netdesign.site.columns.fields import normalise
from netdesign.site.questions import guess
from tests.each import each

LEXICA = {plan.name: Lexicon.of(plan.fields, plan) for plan in SHEETS}
QUANTITIES = Lexicon.of(RANGES.items, RANGES)
LEXICA["quantities"] = QUANTITIES
FIELDS = {name: tuple(one.fields.values()) for name, one in LEXICA.items()}
NAMES = [
    (table, field.key, name)
    for table, fields in FIELDS.items()
    for field in fields
    for name in field.raw_names
]

# Sheet, heading, the field that it is; none where it is unknown, or what it may be
HEADINGS = [
    ("Nets", "slope angle [deg]", "slope_angle"),
    ("Nets", "  HANGNEIGUNG (°) ", "slope_angle"),
    ("Nets", "ψ (°)", "slope_angle"),
    ("Nets", "D_K [m]", "net_height"),
    ("Nets", "Dk (m)", "net_height"),
    ("Nets", "N°", "id"),
    ("Nets", "hauteur verticale (m)", "snow_height"),
    ("Nets", "Pfostenabstand", "post_spacing"),
    ("Nets", "Altitude [m NGF]", "altitude"),
    ("Anchors", "Stab-Ø", "bar_diameter"),
    ("Anchors", "bar dia.", "bar_diameter"),
    ("Posts", "Wz", "section_modulus"),
    ("Ropes", "EA [kN]", "axial_stiffness"),
    ("Nets", "HK [m]", {"snow_height", "net_height"}),
    ("Nets", "D [m]", {"snow_thickness"}),
    ("Nets", "N", {"glide_factor"}),
    ("Nets", "Neigung [°]", {"slope_angle", "post_tilt"}),
    ("Nets", "altezza rete [m]", {"net_height"}),
    ("Nets", "Ancrage amont (ancien)", {"uphill_anchor"}),
    ("Posts", "Länge [m]", {"buckling_length"}),
    ("quantities", "inclinaison", {"inclination"}),
    ("quantities", "Bodenreibung", {"friction_angle", "glide_factor"}),
    ("Nets", "Netzhöhe HK", None),
    ("Nets", "Hauteur de poteau [m]", None),
    ("Nets", "Netzhöhe / hauteur du filet", None),
    ("Nets", "Dk min.", None),
    ("Nets", "Entraxe poteaux, en m", None),
    ("Nets", "zul. Ankerkraft [kN]", None),
    ("Posts", "allowable bearing [MPa]", None),
    ("Posts", "zul. Bodenpressung [kPa]", None),
    ("quantities", "Hangneigung", None),
    ("Ranges", "de / high", None),
]


@each("table, heading, meant", HEADINGS)
def test_a_heading_is_its_exact_name_or_asked_for(table, heading, meant):
    found = LEXICA[table].match(heading)
    assert (found.field and found.field.key) == (
        meant if isinstance(meant, str) else None
    )
    readings = {one.key for one in found.readings}
    assert readings == (meant if isinstance(meant, set) else set())


@each("table", LEXICA)
def test_no_heading_is_sure_and_unclear_at_once(table):
    lexicon = LEXICA[table]
    assert not lexicon.names.keys() & {k for k, keys in lexicon.unclear.items() if keys}


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
    found = LEXICA[table].match(text)
    assert key in {one.key for one in (found.field, *found.readings) if one}


@settings(max_examples=500)
@given(written(), st.sampled_from(["min", "zul.", "of", "x", "Nord", "HK", "adm."]))
def test_a_word_more_is_another_heading(drawn, word):
    table, _, text = drawn
    for other in (f"{word} {text}", f"{text} {word}"):
        field = LEXICA[table].match(other).field
        assert field is None or normalise(other.split("[")[0]) in field.names


# Sheet, heading, its unit, the guess that is taken, and one that is ranked
@each(
    "table, heading, unit, taken, ranked",
    [
        ("Nets", "Netzsteifigkeiten [kN/m]", "kN/m", "net_stiffness", "net_stiffness"),
        ("Nets", "Abstände der Stützen [m]", "m", "post_spacing", "post_spacing"),
        ("Nets", "Hext lotrecht [m]", "m", None, "snow_height"),
        ("Nets", "bay [m]", "m", None, None),
        ("Anchors", "zul. Zugglied [kN]", "kN", None, "tendon"),
        ("Anchors", "Zugglieder [m]", "m", None, None),  # its unit is no resistance's
        ("Anchors", "Zugglieder [kN]", "kN", None, "tendon"),
        ("Posts", "zul. Bodenpressung [kPa]", "kPa", None, "bearing_stress"),
    ],
)
def test_a_guess_is_taken_where_it_is_sure_and_its_unit_fits(
    table, heading, unit, taken, ranked
):
    found = guess(heading, unit, FIELDS[table])
    assert (found.field and found.field.key) == taken
    keys = {field.key for field, _ in found.ranked}
    assert ranked is None or ranked in keys
    units = {one for field, _ in found.ranked for one in field.units}
    assert not found.ranked or unit in units


@settings(max_examples=300)
@given(st.sampled_from(NAMES))
def test_without_its_own_name_a_heading_is_never_taken_for_an_allowable_one(one):
    table, _, name = one
    assert guess(f"zul. {name}", "", FIELDS[table]).field is None
    assert guess(f"{name} admissible", "", FIELDS[table]).field is None
