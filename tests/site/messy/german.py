"""A German office's workbook: a row of units, centimetres of snow, groups in bold.

``ROWS`` was written by hand from the plan: per row id and field what was meant, in
the first unit of the field.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import openpyxl

from tests.site.messy.sheets import fill

if TYPE_CHECKING:
    from pathlib import Path

_GROUPS: list[object] = [
    *("Werk", None, "Gelände", None, None, "Schnee", None, "Netz", None, None),
    *("Stützen", None, None, "Verankerung", None, None, "Abspannung"),
]
_HEADINGS: list[object] = [
    *("Werk-Nr.", "Abschnitt", "Hangneigung ψ", "Neigung", "Länge bergwärts"),
    *("Schneehöhe lotrecht", "Bodengleiten", "Netzhöhe DK", "Netzsteifigkeit"),
    *("Überlänge", "Stützenabstand a", "Stützenneigung", "Stützentyp"),
    *("Fußanker", "Anker bergseitig", "Anker talseitig"),
    *("Seil bergseitig", "Seil talseitig", "Gleitfaktor N", "Bemerkung"),
]
_UNITS: list[object] = [
    *("-", None, "°", "%", "m", "cm", None, "m", "kN/m", "%", "m", "°"),
    *(None, None, None, None, None, None, "-", None),
]
_EAST: list[list[object]] = [
    [
        *("W 01", "Ost", "38,0", "78", "16,50", 330, "gleitet", "3,0", "9.500"),
        *("3", "3,5", "0", "Rohr 168", "GEWI 32", "GEWI 32", "GEWI 28"),
        *("SL 20", "SL 18", "1,80", None),
    ],
    [
        *("W 02", "Ost", "39,5", "82", "17", 345, "gleitet", "3,0", "9.500"),
        *("3", "3,5", "0", "Rohr 168", "GEWI 32", "GEWI 32", "GEWI 28"),
        *("SL 20", "SL 18", "1,80", "Fels anstehend"),
    ],
]
_WEST: list[list[object]] = [
    [
        *("W 03", "West", "35,0", "70", "21,0", "310 cm", "kein Gleiten", 3, 9500),
        *(2.5, "4,00", -5, "Rohr 168", "GEWI 28", "GEWI 32", "GEWI 28"),
        *("SL 20", "SL 18", None, None),
    ],
    [
        *("W 04", "West", 41, 87, 15, 285, "freies Gleiten", 2.5, 9500),
        *(2.5, 4, -5, "Rohr 140", "GEWI 28", "GEWI 28", "GEWI 28"),
        *("SL 18", "SL 18", None, "Zufahrt nur Sommer"),
    ],
    [
        *("W 05", "West", 40.5, 85, 15.2, 290, "freies Gleiten", "2,5 m", 9500),
        *(2.5, "4,0 m", -5, "Rohr 140", "GEWI 28", "GEWI 28", "GEWI 28"),
        *("SL 18", "SL 18", None, None),
    ],
]


def build(path: Path) -> None:
    """Write the workbook."""
    book = openpyxl.Workbook()
    nets = book.active
    nets.title = "2 Netzreihen"
    fill(
        nets,
        [
            ["Lawinenverbauung Kreuzgraben, Los 2", *[None] * 16, "Stand 04/26"],
            [],
            _GROUPS,
            _HEADINGS,
            _UNITS,
            ["Abschnitt Ost"],
            *_EAST,
            [],
            ["Abschnitt West"],
            *_WEST,
            ["Summe", None, None, None, 84.7],
            [],
            ["Anmerkung: Schneehöhen nach Auswertung der Station, T = 100 Jahre"],
        ],
    )
    for merged in ("A1:P1", "C3:E3", "F3:G3", "H3:J3", "K3:M3", "N3:P3", "Q3:R3"):
        nets.merge_cells(merged)
    nets.column_dimensions["D"].hidden = True
    assumptions = book.create_sheet("1 Annahmen")
    fill(
        assumptions,
        [
            ["Annahmen und Kennwerte"],
            [],
            ["Kennwert", "von", "bis", "Einheit", "Quelle"],
            ["Schneedichte ρ", "0,25", "0,45", "t/m³", "Richtlinie"],
            ["Reibung Schnee/Netz φ", 15, 45, "Grad", "Versuche"],
            ["Netzneigung", "25°", "35°", "°", "rechtwinklig zum Hang gemessen"],
        ],
    )
    fill(
        book.create_sheet("Ankertypen"),
        [
            [
                "Typ",
                "Zugglied [kN]",
                "Herausziehen [kN]",
                "Nachweis",
                "Bohrung",
                "Gewebestrumpf",
            ],
            ["GEWI 32", "442,5", "380", "Versuch", "90 mm", None],
            ["GEWI 28", "338,0", "300,25", "berechnet", "90 mm", "nein"],
        ],
    )
    fill(
        book.create_sheet("Seilliste"),
        [
            ["Seiltyp", "Mindestbruchkraft (kN)"],
            ["SL 20", 290],
            ["SL 18", "235,5"],
        ],
    )
    fill(
        book.create_sheet("Stützentypen"),
        [
            ["Stützentyp", "Druckwiderstand [kN]", "Stahl"],
            ["Rohr 168", "520", "S 355"],
            ["Rohr 140", "395", "S 355"],
        ],
    )
    hidden = book.create_sheet("Netze (alt)")
    fill(hidden, [_HEADINGS, _UNITS, *[[*line[:2], 30, *line[3:]] for line in _EAST]])
    hidden.sheet_state = "hidden"
    fill(book.create_sheet("Tabelle1"), [])
    book.save(path)


_EASTERN: dict[str, float | str] = {
    **{"ground_law": "sliding", "glide_factor": 1.8, "net_height": 3.0},
    **{"net_stiffness": 9500.0, "slack": 0.03, "post_spacing": 3.5},
    **{"post_tilt": 0.0, "post": "Rohr 168", "foot_anchor": "GEWI 32"},
    **{"uphill_anchor": "GEWI 32", "downhill_anchor": "GEWI 28"},
    **{"uphill_guy": "SL 20", "downhill_guy": "SL 18"},
}
_WESTERN: dict[str, float | str] = {
    **{"ground_law": "free", "net_height": 2.5, "net_stiffness": 9500.0},
    **{"slack": 0.025, "post_spacing": 4.0, "post_tilt": -5.0, "post": "Rohr 140"},
    **{"foot_anchor": "GEWI 28", "uphill_anchor": "GEWI 28"},
    **{"downhill_anchor": "GEWI 28", "uphill_guy": "SL 18", "downhill_guy": "SL 18"},
}
ROWS: dict[str, dict[str, float | str]] = {
    "W 01": {
        **{"slope_angle": 38.0, "upslope_length": 16.5, "snow_height": 3.3},
        **_EASTERN,
    },
    "W 02": {
        **{"slope_angle": 39.5, "upslope_length": 17.0, "snow_height": 3.45},
        **_EASTERN,
    },
    "W 03": {
        **{"slope_angle": 35.0, "upslope_length": 21.0, "snow_height": 3.1},
        **{"ground_law": "no-slip", "net_height": 3.0, "net_stiffness": 9500.0},
        **{"slack": 0.025, "post_spacing": 4.0, "post_tilt": -5.0},
        **{"post": "Rohr 168", "foot_anchor": "GEWI 28"},
        **{"uphill_anchor": "GEWI 32", "downhill_anchor": "GEWI 28"},
        **{"uphill_guy": "SL 20", "downhill_guy": "SL 18"},
    },
    "W 04": {
        **{"slope_angle": 41.0, "upslope_length": 15.0, "snow_height": 2.85},
        **_WESTERN,
    },
    "W 05": {
        **{"slope_angle": 40.5, "upslope_length": 15.2, "snow_height": 2.9},
        **_WESTERN,
    },
}
RANGES = {
    "density": (250.0, 450.0),
    "friction_angle": (15.0, 45.0),
    "inclination": (25.0, 35.0),
}
# Characteristic resistances [kN] by type and mode.
TYPES: dict[str, dict[str, float | str]] = {
    "GEWI 32": {"tendon": 442.5, "pull_out": 380.0, "basis": "tested"},
    "GEWI 28": {"tendon": 338.0, "pull_out": 300.25, "basis": "computed"},
    "SL 20": {"rope": 290.0},
    "SL 18": {"rope": 235.5},
    "Rohr 168": {"compression": 520.0},
    "Rohr 140": {"compression": 395.0},
}
# What the office answers when asked: "Neigung" is the slope again, in per cent, and
# "Grad" are degrees.
ANSWERS: dict[str, str] = {
    "Gelände › Neigung": "ignore",
    "Reibung Schnee/Netz φ": "Reibungswinkel [deg]",
}
LEFT_OUT = ("Abschnitt", "Neigung", "Bemerkung")
