"""A workbook from Ticino for Bern: every heading in Italian and in German.

``ROWS`` was written by hand from the plan: per row id and field what was meant, in
the first unit of the field.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import openpyxl

from tests.site.messy.sheets import fill

if TYPE_CHECKING:
    from pathlib import Path

_HEADINGS: list[object] = [
    *("Settore\nAbschnitt", "Linea\nReihe", "Pendenza ψ\nHangneigung ψ [°]"),
    "Distanza a monte\nLänge bergwärts [m]",
    "Spessore neve D\nSchneemächtigkeit D [m]",
    "Terreno / Gleiten am Boden",
    "Fattore di slittamento N / Gleitfaktor N",
    "Altezza HK\nWerkhöhe HK [m]",
    "Altezza rete DK / Netzhöhe DK",
    "Rigidezza rete / Netzsteifigkeit [kN/m']",
    "Allentamento / Überlänge [%]",
    "Interasse pali / Stützenabstand",
    "Palo / Stütze",
    "Ancoraggio al piede / Fussanker",
    "Ancoraggio a monte / Anker bergseitig",
    "Ancoraggio a valle / Anker talseitig",
    "Fune a monte / Seil bergseitig",
    "Fune a valle / Seil talseitig",
    "Osservazioni / Bemerkungen",
]
_NUMBERS: list[object] = [f"({number})" for number in range(1, 20)]
_FIRST: list[list[object]] = [
    [
        *("Alpe Nord", 1, 35, "20.0", 2.6, "liscio / gleitet", 2.4, 3.66, "3.0 m"),
        *("8'500", 4, "3.50 m", "P1", "A1", "A1", "A2", "F1", "F2", None),
    ],
    [
        *(None, 2, "35.5", 20, "2.60", "liscio / gleitet", 2.4, 3.69, "3.0 m"),
        *("8’500", 4, "3.50 m", "P1", "A1", "A1", "A2", "F1", "F2", None),
    ],
    [
        *(None, 3, 37.0, 19.0, 2.75, "ruvido / rauh", None, 4.38, "3.5 m"),
        *(8500, "4", "3.50 m", "P1", "A1", "A1", "A2", "F1", "F2", "vedi all. 3"),
    ],
]
_SECOND: list[list[object]] = [
    [
        *("Alpe Sud", 4, 40, 14, 2.2, "ruvido / rauh", None, 3.26, "2.5 m"),
        *("7'900", 3, "4.00 m", "P2", "A2", "A2", "A2", "F2", "F2", None),
    ],
    [
        *(None, 5, "41", 14.5, 2.25, "ruvido / rauh", None, 3.31, "2.5 m"),
        *("7'900", 3, "4.00 m", "P2", "A2", "A2", "A2", "F2", "F2", "provvisorio"),
    ],
]


def build(path: Path) -> None:
    """Write the workbook."""
    book = openpyxl.Workbook()
    cover = book.active
    cover.title = "Copertina"
    fill(cover, [["Cantone Ticino"], [], ["Premunizione valanghiva Alpe di Sotto"]])
    assumptions = book.create_sheet("Ipotesi - Annahmen")
    fill(
        assumptions,
        [
            ["Ipotesi di calcolo / Berechnungsannahmen"],
            [],
            ["Grandezza / Größe", "Valori / Werte", "Unità / Einheit"],
            ["Densità neve / Schneedichte", "270 – 400", "kg/m3"],
            ["Attrito neve/rete / Reibung Schnee/Netz", "20°-40°", "°"],
            ["Inclinazione rete / Netzneigung", "25..35", "°"],
        ],
    )
    nets = book.create_sheet("Linee - Werkreihen")
    fill(
        nets,
        [
            ["Alpe di Sotto: linee di reti / Netzreihen"],
            ["(misure perpendicolari al pendio / Maße rechtwinklig zum Hang)"],
            [],
            _HEADINGS,
            _NUMBERS,
            *_FIRST,
            ["Totale / Total", None, None, 59.0],
            [],
            *_SECOND,
            ["Totale / Total", None, None, 28.5],
            [],
            ["Osservazione: valori dei carichi secondo il rilievo del 2025"],
        ],
    )
    for merged in ("A1:S1", "A2:S2", "A6:A8", "A11:A12"):
        nets.merge_cells(merged)
    fill(
        book.create_sheet("Ancoraggi - Anker"),
        [
            [
                *("Tipo / Typ", "Armatura / Zugglied [kN]"),
                *("Sfilamento / Herausziehen [kN]", "Verifica / Nachweis"),
            ],
            ["A1", 410, 350, "prova"],
            ["A2", "330.5", "290", "prova"],
        ],
    )
    fill(
        book.create_sheet("Funi - Seile"),
        [
            ["Tipo / Typ", "Carico di rottura minimo / Mindestbruchkraft [kN]"],
            ["F1", "300"],
            ["F2", 255],
        ],
    )
    fill(
        book.create_sheet("Pali - Stützen"),
        [
            ["Tipo / Typ", "Resistenza a compressione / Druckwiderstand [kN]"],
            ["P1", 430],
            ["P2", 360],
        ],
    )
    prices = book.create_sheet("Prezzi")
    fill(prices, [["Pos.", "CHF"], ["Ancoraggi", "125'000.-"]])
    prices.sheet_state = "veryHidden"
    book.save(path)


_FIRST_LINES: dict[str, float | str] = {
    **{"net_stiffness": 8500.0, "slack": 0.04, "post_spacing": 3.5, "post": "P1"},
    **{"foot_anchor": "A1", "uphill_anchor": "A1", "downhill_anchor": "A2"},
    **{"uphill_guy": "F1", "downhill_guy": "F2"},
}
_SECOND_LINES: dict[str, float | str] = {
    **{"net_stiffness": 7900.0, "slack": 0.03, "post_spacing": 4.0, "post": "P2"},
    **{"foot_anchor": "A2", "uphill_anchor": "A2", "downhill_anchor": "A2"},
    **{"uphill_guy": "F2", "downhill_guy": "F2"},
    **{"ground_law": "no-slip", "net_height": 2.5},
}
_SLIDING: dict[str, float | str] = {
    **{"ground_law": "sliding", "glide_factor": 2.4, "net_height": 3.0}
}
ROWS: dict[str, dict[str, float | str]] = {
    "1": {
        **{"slope_angle": 35.0, "upslope_length": 20.0, "snow_thickness": 2.6},
        **_SLIDING,
        **_FIRST_LINES,
    },
    "2": {
        **{"slope_angle": 35.5, "upslope_length": 20.0, "snow_thickness": 2.6},
        **_SLIDING,
        **_FIRST_LINES,
    },
    "3": {
        **{"slope_angle": 37.0, "upslope_length": 19.0, "snow_thickness": 2.75},
        **{"ground_law": "no-slip", "net_height": 3.5},
        **_FIRST_LINES,
    },
    "4": {
        **{"slope_angle": 40.0, "upslope_length": 14.0, "snow_thickness": 2.2},
        **_SECOND_LINES,
    },
    "5": {
        **{"slope_angle": 41.0, "upslope_length": 14.5, "snow_thickness": 2.25},
        **_SECOND_LINES,
    },
}
RANGES = {
    "density": (270.0, 400.0),
    "friction_angle": (20.0, 40.0),
    "inclination": (25.0, 35.0),
}
# Characteristic resistances [kN] by type and mode.
TYPES: dict[str, dict[str, float | str]] = {
    "A1": {"tendon": 410.0, "pull_out": 350.0, "basis": "tested"},
    "A2": {"tendon": 330.5, "pull_out": 290.0, "basis": "tested"},
    "F1": {"rope": 300.0},
    "F2": {"rope": 255.0},
    "P1": {"compression": 430.0},
    "P2": {"compression": 360.0},
}
# HK is the vertical height of the works, DK / cos ψ: not a quantity of the check.
ANSWERS: dict[str, str] = {"Altezza HK / Werkhöhe HK": "ignore"}
LEFT_OUT = ("Settore", "HK", "Osservazioni")
