"""Optional columns: dimensions that resistances follow from, place in the row."""

from __future__ import annotations

from netdesign.resistance.catalogue import list_terminations, load_catalogue
from netdesign.site.columns.fields import Field
from netdesign.site.columns.unit_names import (
    AREAS,
    DIAMETERS,
    FORCES,
    GROUND_STRESSES,
    LENGTHS,
    SECOND_MOMENTS,
    STRENGTHS,
)

_CATALOGUE = load_catalogue()


def _number(
    key: str,
    units: tuple[str, ...],
    bounds: tuple[float, float],
    note: str = "",
) -> Field:
    return Field(key=key, units=units, bounds=bounds, note=note)


def _word(key: str, words: tuple[str, ...], note: str = "") -> Field:
    return Field(
        key=key,
        kind="word",
        words={word: () for word in words},
        note=note,
    )


_GROUND = _CATALOGUE["bond"]["ground"]
# Where anchors are tested; the catalogue has no bond stress of these.
_TESTED_IN = ("scree", "gneiss", "rock")
_INSTEAD = "with the columns beside it, instead of a"

ROW_POSITION = (
    _number(
        "post_base_distance",
        LENGTHS,
        (-20.0, 20.0),
        "downslope of the net's foot, along the slope; instead of the post tilt",
    ),
    _number(
        "gap",
        LENGTHS,
        (0.0, 100.0),
        "free distance beside the row, for the end effect; left empty, the ends of "
        "the row are taken as free",
    ),
    _number(
        "altitude",
        ("m",),
        (0.0, 6000.0),
        "above sea level, for the density of the guideline's load cases; left empty, "
        "it is taken with the largest factor for altitude",
    ),
    _word(
        "row_end",
        ("free", "continuous"),
        "continuous: the nets go on at both ends of the row, into the neighbour; left "
        "empty, its ends are judged as free",
    ),
    Field(
        key="neighbour",
        kind="text",
        note="id of the net row that this one goes on into; two with a comma",
    ),
)
ANCHOR_DIMENSIONS = (
    _number(
        "bar_diameter",
        DIAMETERS,
        (10.0, 100.0),
        f"{_INSTEAD} tendon resistance; less what corrosion may take",
    ),
    _number("bar_strength", STRENGTHS, (200.0, 2000.0), "f_y or f_0.2"),
    _number(
        "drill_diameter",
        DIAMETERS,
        (30.0, 300.0),
        f"{_INSTEAD} pull-out resistance; basis: computed",
    ),
    _number("bond_length", LENGTHS, (0.5, 30.0)),
    _word(
        "ground",
        (*_GROUND, *_TESTED_IN),
        "where the type was tested or computed; left empty, no other type is offered "
        "without asking; for the least bond stress of the catalogue: "
        + "; ".join(f"{name}: {entry['text']}" for name, entry in _GROUND.items()),
    ),
    _word(
        "grouting",
        ("A", "B", "C", "D"),
        "A gravity (if left empty), B pressure, C one injection after, D repeated",
    ),
    Field(
        key="test_count",
        kind="count",
        bounds=(1.0, 1000.0),
        note=f"{_INSTEAD} pull-out resistance; basis: tested; the profile's "
        "correlation factors apply",
    ),
    _number("test_least", FORCES, (1.0, 5000.0)),
    _number("test_mean", FORCES, (1.0, 5000.0)),
)
ROPE_DIMENSIONS = (
    _number(
        "rope_diameter",
        DIAMETERS,
        (6.0, 60.0),
        f"{_INSTEAD} minimum breaking force",
    ),
    _word("construction", tuple(_CATALOGUE["rope"]["construction"])),
    _number("grade", STRENGTHS, (1500.0, 2200.0), "1570, 1770, 1960, 2160"),
    _word(
        "termination",
        tuple(list_terminations()),
        "the weaker end; clips (if left empty)",
    ),
)
POST_DIMENSIONS = (
    _number(
        "area",
        AREAS,
        (1.0, 500.0),
        f"{_INSTEAD} compression resistance",
    ),
    _number(
        "second_moment",
        SECOND_MOMENTS,
        (1.0, 100_000.0),
        "about the weak axis",
    ),
    _number(
        "buckling_length",
        LENGTHS,
        (0.5, 12.0),
        "length of the post between its hinges",
    ),
    _number("yield_strength", STRENGTHS, (200.0, 700.0)),
    _word(
        "buckling_curve",
        tuple(_CATALOGUE["buckling"]["curve"]),
        "of EN 1993-1-1; d (if left empty)",
    ),
    _number(
        "bearing",
        FORCES,
        (1.0, 5000.0),
        "of the ground under the base plate, characteristic, across the plate; left "
        "empty, its check is not proven",
    ),
    _number(
        "plate_length",
        LENGTHS,
        (0.05, 5.0),
        f"{_INSTEAD} bearing resistance",
    ),
    _number("plate_width", LENGTHS, (0.05, 5.0)),
    _number(
        "bearing_stress",
        GROUND_STRESSES,
        (20.0, 20_000.0),
        "characteristic resistance of the ground",
    ),
)
