"""The site workbook as one table: sheets, headings, units, bounds, defaults."""

from __future__ import annotations

from netdesign.site.dimension_columns import (
    ANCHOR_DIMENSIONS,
    POST_DIMENSIONS,
    ROPE_DIMENSIONS,
    ROW_POSITION,
)
from netdesign.site.fields import Field, SheetPlan
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR
from netdesign.structure.layout import DEFAULT_POST_TILT
from netdesign.units import degree_from_radian

# Chosen low: a tauter net pulls harder on its anchors.
DEFAULT_SLACK = 0.02
DEFAULT_SAMPLES = 3
DEFAULT_INCLINATION_DEG = (25.0, 35.0)


def _reference(key: str, label: str, aliases: tuple[str, ...], sheet: str) -> Field:
    return Field(
        key=key,
        label=label,
        aliases=aliases,
        kind="id",
        refers_to=sheet,
        note=f"id of sheet {sheet}; left empty, the checks of this member are "
        "not proven",
    )


def _resistance(key: str, label: str, aliases: tuple[str, ...]) -> Field:
    return Field(
        key=key,
        label=label,
        aliases=aliases,
        units=("kN",),
        bounds=(1.0, 5000.0),
        note="characteristic; left empty, the checks that need it are not proven",
    )


# Bounds are a little wider than what is built; they catch slips of unit and comma.
NETS = SheetPlan(
    name="Nets",
    aliases=("Filets", "Netze"),
    required=True,
    one_of=("snow_thickness", "snow_height"),
    fields=(
        Field(
            key="id",
            label="id",
            aliases=("net row", "row", "rangée", "filet", "Werkreihe", "Netzreihe"),
            kind="id",
            required=True,
            note="name of the net row; used once",
        ),
        Field(
            key="slope_angle",
            label="slope angle",
            aliases=("slope", "pente", "angle de pente", "Hangneigung"),
            units=("deg", "%"),
            bounds=(10.0, 75.0),
            required=True,
            note="against the horizontal",
        ),
        Field(
            key="snow_thickness",
            label="snow thickness",
            aliases=(
                "snow thickness normal to slope",
                "épaisseur",
                "épaisseur de neige",
                "Schneemächtigkeit",
                "Schneemaechtigkeit",
            ),
            units=("m",),
            bounds=(0.1, 10.0),
            note="normal to the slope; fill this or the vertical height, not both",
        ),
        Field(
            key="snow_height",
            label="snow height vertical",
            aliases=(
                "snow height",
                "vertical snow height",
                "hauteur verticale",
                "hauteur de neige verticale",
                "Schneehöhe",
                "Schneehoehe",
            ),
            units=("m",),
            bounds=(0.1, 15.0),
            note="vertical; fill this or the thickness, not both",
        ),
        Field(
            key="upslope_length",
            label="upslope length",
            aliases=("longueur amont", "Länge bergwärts", "Hanglänge"),
            units=("m",),
            bounds=(1.0, 200.0),
            required=True,
            note="snowpack that the net carries, along the slope up to the next row",
        ),
        Field(
            key="ground_law",
            label="ground law",
            aliases=("ground", "loi de sol", "conditions au sol", "Bodengesetz"),
            kind="word",
            required=True,
            words={
                "free": ("free glide", "libre", "glissement libre", "frei"),
                "no-slip": ("rough", "sans glissement", "kein Gleiten", "rau"),
                "sliding": ("glissement", "glissant", "gleitend", "Gleiten"),
            },
            note="free: the snow glides freely; no-slip: it does not move on the "
            "ground; sliding: give a slip length or a glide factor",
        ),
        Field(
            key="slip_length",
            label="slip length",
            aliases=("stagnation depth", "longueur de glissement", "Gleitlänge"),
            units=("m",),
            bounds=(0.001, 200.0),
            note="only for sliding ground, instead of a glide factor",
        ),
        Field(
            key="glide_factor",
            label="glide factor",
            aliases=("glide factor N", "facteur de glissement", "Gleitfaktor"),
            units=("-",),
            bounds=(1.0, LARGEST_GLIDE_FACTOR),
            note="N of the guidelines; only for sliding ground, instead of a slip "
            "length",
        ),
        Field(
            key="net_height",
            label="net height",
            aliases=("net height normal to slope", "hauteur du filet", "Netzhöhe"),
            units=("m",),
            bounds=(0.5, 10.0),
            required=True,
            note="normal to the slope, from foot to head",
        ),
        Field(
            key="net_stiffness",
            label="net stiffness",
            aliases=("raideur du filet", "rigidité du filet", "Netzsteifigkeit"),
            units=("kN/m",),
            bounds=(100.0, 1_000_000.0),
            required=True,
            note="force per metre of width at unit strain",
        ),
        Field(
            key="slack",
            label="slack",
            aliases=("mou", "surlongueur", "Überlänge"),
            units=("-",),
            bounds=(0.0, 0.3),
            default=DEFAULT_SLACK,
            note="unstressed length of the net over its chord, minus 1",
        ),
        Field(
            key="post_spacing",
            label="post spacing",
            aliases=("entraxe", "entraxe des poteaux", "Stützenabstand"),
            units=("m",),
            bounds=(0.5, 15.0),
            required=True,
            note="along the row; the width that loads one anchor",
        ),
        Field(
            key="post_tilt",
            label="post tilt",
            aliases=("inclinaison du poteau", "Stützenneigung"),
            units=("deg",),
            bounds=(-30.0, 45.0),
            default=degree_from_radian(DEFAULT_POST_TILT),
            note="from the slope normal, head downslope positive",
        ),
        Field(
            key="uphill_anchor_distance",
            label="uphill anchor distance",
            aliases=("distance de l'ancrage amont", "Abstand bergseitiger Anker"),
            units=("m",),
            bounds=(0.0, 50.0),
            note="upslope of the net's foot, along the slope; left empty, it follows "
            "from the net height",
        ),
        Field(
            key="downhill_anchor_distance",
            label="downhill anchor distance",
            aliases=("distance de l'ancrage aval", "Abstand talseitiger Anker"),
            units=("m",),
            bounds=(0.0, 50.0),
            note="downslope of the post's base, along the slope; left empty, it "
            "follows from the net height",
        ),
        _reference(
            "foot_anchor", "foot anchor", ("ancrage de pied", "Fußanker"), "Anchors"
        ),
        _reference(
            "uphill_anchor",
            "uphill anchor",
            ("ancrage amont", "bergseitiger Anker"),
            "Anchors",
        ),
        _reference(
            "downhill_anchor",
            "downhill anchor",
            ("ancrage aval", "talseitiger Anker"),
            "Anchors",
        ),
        _reference(
            "uphill_guy",
            "uphill guy",
            ("hauban amont", "bergseitiges Abspannseil"),
            "Ropes",
        ),
        _reference(
            "downhill_guy",
            "downhill guy",
            ("hauban aval", "talseitiges Abspannseil"),
            "Ropes",
        ),
        _reference("post", "post", ("poteau", "Stütze"), "Posts"),
        *ROW_POSITION,
    ),
)

_TYPE_ID = Field(
    key="id",
    label="id",
    aliases=("type", "Typ"),
    kind="id",
    required=True,
    note="name of the type, as sheet Nets uses it",
)

# The keys of the resistances are the modes of `model.MEMBER_MODES`.
ANCHORS = SheetPlan(
    name="Anchors",
    aliases=("Ancrages", "Anker"),
    fields=(
        _TYPE_ID,
        _resistance(
            "tendon",
            "tendon resistance",
            ("tendon", "résistance de l'armature", "Zugglied", "Stahltragkraft"),
        ),
        _resistance(
            "pull_out",
            "pull-out resistance",
            ("pull-out", "résistance à l'arrachement", "Ausziehwiderstand"),
        ),
        Field(
            key="basis",
            label="basis",
            aliases=("base", "justification", "Grundlage"),
            kind="word",
            words={
                "tested": ("test", "essai", "essais", "geprüft", "Versuch"),
                "computed": ("calcul", "calculé", "berechnet"),
            },
            note="how the pull-out resistance is known",
        ),
        *ANCHOR_DIMENSIONS,
    ),
)
ROPES = SheetPlan(
    name="Ropes",
    aliases=("Câbles", "Haubans", "Seile"),
    fields=(
        _TYPE_ID,
        _resistance(
            "rope",
            "minimum breaking force",
            ("breaking force", "charge de rupture minimale", "Mindestbruchkraft"),
        ),
        *ROPE_DIMENSIONS,
    ),
)
POSTS = SheetPlan(
    name="Posts",
    aliases=("Poteaux", "Stützen"),
    fields=(
        _TYPE_ID,
        _resistance(
            "compression",
            "compression resistance",
            ("compression", "résistance en compression", "Druckwiderstand"),
        ),
        *POST_DIMENSIONS,
    ),
)

RANGE_QUANTITIES: tuple[Field, ...] = (
    Field(
        key="density",
        label="density",
        aliases=("snow density", "masse volumique", "densité", "Dichte"),
        units=("kg/m3",),
        bounds=(100.0, 900.0),
        required=True,
    ),
    Field(
        key="friction_angle",
        label="friction angle",
        aliases=("friction", "angle de frottement", "Reibungswinkel"),
        units=("deg",),
        bounds=(0.0, 45.0),
        required=True,
    ),
    Field(
        key="inclination",
        label="net inclination",
        aliases=("inclination", "inclinaison du filet", "Netzneigung"),
        units=("deg",),
        bounds=(0.0, 60.0),
    ),
)
# The cells below low and high are read as the quantity of their line.
RANGES = SheetPlan(
    name="Ranges",
    aliases=("Plages", "Bereiche"),
    required=True,
    fields=(
        Field(
            key="quantity",
            label="quantity",
            aliases=("grandeur", "Größe", "Groesse"),
            kind="text",
            required=True,
            note="density, friction angle or net inclination (default 25 to 35 deg)",
        ),
        Field(
            key="unit",
            label="unit",
            aliases=("units", "unité", "Einheit"),
            kind="text",
            note="kg/m3 or deg; may stand in brackets behind the quantity instead",
        ),
        Field(
            key="low",
            label="low",
            aliases=("minimum", "min", "von"),
            required=True,
            note="least value, in the unit of the row",
        ),
        Field(
            key="high",
            label="high",
            aliases=("maximum", "max", "bis"),
            required=True,
            note="largest value, in the unit of the row",
        ),
        Field(
            key="samples",
            label="samples",
            aliases=("count", "nombre", "Anzahl"),
            kind="count",
            bounds=(1.0, 25.0),
            note="number of values from low to high; left empty: 3",
        ),
    ),
)

PROJECT_ITEMS: tuple[Field, ...] = (
    Field(key="name", label="name", aliases=("projet", "Projekt"), kind="text"),
    Field(key="number", label="number", aliases=("numéro", "Nummer"), kind="text"),
    Field(key="author", label="author", aliases=("auteur", "Bearbeiter"), kind="text"),
    Field(
        key="checker", label="checker", aliases=("vérificateur", "Prüfer"), kind="text"
    ),
    Field(
        key="revision", label="revision", aliases=("révision", "Revision"), kind="text"
    ),
    Field(key="standard", label="standard", aliases=("norme", "Norm"), kind="text"),
)
PROJECT = SheetPlan(
    name="Project",
    aliases=("Projet", "Projekt"),
    fields=(
        Field(
            key="item",
            label="name",
            aliases=("item", "rubrique", "Angabe"),
            kind="text",
            required=True,
        ),
        Field(key="value", label="value", aliases=("valeur", "Wert"), kind="text"),
    ),
)

SHEETS: tuple[SheetPlan, ...] = (PROJECT, NETS, RANGES, ANCHORS, ROPES, POSTS)
