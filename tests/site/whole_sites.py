"""Three whole sites as their engineers typed them: French, German, damaged."""

from __future__ import annotations

import datetime

Sheets = dict[str, list[list[object]]]

# Rows of both sound sites: id, slope, snow height or thickness, net height.
FRENCH_SLOPES_PERCENT = [
    *("78,5", "70", "84,0", "65,5", "90", "100"),
    *("72,25", "80", "81,5", "95", "60", "88"),
]
FRENCH_HEIGHTS = [
    *("3,2", "2,75", "3,5", "2,9", "3,10", "3,6"),
    *("3", "2,8", "3,05", "3,3", "2,5", "3,4"),
]


def french_site() -> Sheets:
    """Twelve rows; decimal commas, slopes in per cent, vertical heights, notes."""
    headings = [
        *("Rangée", "Pente [%]", "Hauteur de neige verticale (m)"),
        *("Longueur amont [m]", "Conditions au sol", "Facteur de glissement"),
        *("Hauteur du filet [m]", "Raideur du filet [kN/ml]", "Mou [%]"),
        *("Entraxe des poteaux [m]", "Ancrage de pied", "Ancrage amont"),
        *("Ancrage aval", "Hauban amont", "Hauban aval", "Poteau", "Remarque"),
    ]
    lines: list[list[object]] = []
    pairs = zip(FRENCH_SLOPES_PERCENT, FRENCH_HEIGHTS, strict=True)
    for number, (slope, height) in enumerate(pairs, start=1):
        is_sliding = number % 3 == 0
        lines.append(
            [
                *(f"F{number:02}", slope, height, "18,5"),
                "glissant" if is_sliding else "Sans glissement",
                "1,4" if is_sliding else None,
                *("3,5", "12 500", "5", "3,5", "GEWI 32", "GEWI 32", "GEWI 28"),
                *("C 22", "C 18", "HEB 140", "accès difficile"),
            ]
        )
    notes: list[list[object]] = [
        [],
        ["Remarque : hauteurs relevées au jalon, hiver 2023"],
        ["Source des résistances, fiches du fabricant jointes"],
    ]
    return {
        "Projet": [
            ["Rubrique", "Valeur"],
            ["projet", "Combe de l'Ours"],
            ["numéro", "2026-17"],
            ["auteur", "É. Façade"],
            ["révision", "B"],
        ],
        "Filets": [["Inventaire des filets"], [], headings, *lines, *notes],
        "Plages": [
            ["Grandeur", "Unité", "Minimum", "Maximum"],
            ["masse volumique", "kg/m³", "270", "412,5"],
            ["angle de frottement", "°", "15", "45"],
        ],
        "Ancrages": [
            [
                *("Type", "Résistance de l'armature [kN]"),
                *("Résistance à l'arrachement [kN]", "Justification", "gaine textile"),
            ],
            ["GEWI 32", "442,5", "380", "essai", None],
            ["GEWI 28", "338", "300,25", "calcul", "non"],
        ],
        "Câbles": [
            ["Type", "Charge de rupture minimale [kN]"],
            ["C 22", "350"],
            ["C 18", "250"],
        ],
        "Poteaux": [["Type", "Résistance en compression [kN]"], ["HEB 140", "380"]],
    }


def german_site() -> Sheets:
    """A units row, thousands with points."""
    return {
        "Netze": [
            [
                *("Werkreihe", "Hangneigung", "Schneemächtigkeit", "Länge bergwärts"),
                *("Gleiten am Boden", "Gleitlänge", "Netzhöhe", "Netzsteifigkeit"),
                *("Stützenabstand", "Stützenneigung", "Netzfußanker", "Berganker"),
                *("Talanker", "Seil bergseitig", "Seil talseitig", "Stütze"),
            ],
            ["", "°", "cm", "m", "", "m", "m", "N/m", "m", "gon"],
            [
                *("W1", "38,5", "280", "20", "frei", None, "3,2", "12.500.000"),
                *("3,50", "10", "A1", "A1", "A2", "S1", "S1", "P1"),
            ],
            [
                *("W2", 41, "275,5", "22,5", "gleitend", "1,25", 3.5, "9.000.000,0"),
                *("4,0", "12,5", "A1", "A2", "A2", "S1", "S1", "P1"),
            ],
        ],
        "Bereiche": [
            ["Größe", "von", "bis"],
            ["Dichte [t/m3]", "0,27", "0,4"],
            ["Reibungswinkel [gon]", "20", "50"],
            ["Netzneigung [°]", "25", "35"],
        ],
        "Anker": [
            ["Typ", "Zugglied", "Ausziehwiderstand", "Grundlage"],
            ["", "[kN]", "[kN]", ""],
            ["A1", "480,5", "380", "geprüft"],
            ["A2", "400", "300", "berechnet"],
        ],
        "Seile": [["Typ", "Mindestbruchkraft [kN]"], ["S1", "350"]],
        "Stützen": [["Typ", "Druckwiderstand [MN]"], ["P1", "0,38"]],
        "Schnee": [
            ["Werkreihe", "Schicht", "Mächtigkeit [cm]", "Dichte [kg/m3]"],
            ["W2", 2, "175,5", 250],
            ["W2", 1, "100", 400],
        ],
    }


def damaged_site() -> Sheets:
    """Everything that goes wrong in a workbook of many hands."""
    return {
        "Nets": [
            [
                *("id", "slope angle", "snow depth [m]", "upslope length [furlong]"),
                *("ground law", "net hight [m]", "net stiffness [kN/m]"),
                *("post spacing [m]", "foot anchor", "uphill guy", "weather"),
            ],
            ["R1", 40, 3.0, 20, "free", 3.5, "1,234", 3.5, "A32", "G18", "fine"],
            ["R1", "4O", 3.0, 20, "slipery", 3.5, 9000, "=7/2", "A23", "G81", None],
            [
                *("R3", 38, 3.0, 20, "free", 3.5, "#REF!"),
                *(datetime.datetime(2026, 5, 3), "A32", None, None),
            ],
        ],
        "Ranges": [
            ["quantity", "low", "high"],
            ["density [kg/m3]", 400, 270],
            ["friction angle [grad]", 15, 45],
        ],
        "Anchors": [["id", "tendon resistance [kN]"], ["A32", 400]],
        "Ropes": [["id", "minimum breaking force [kN]"], ["G18", -250]],
        "Old": [["do not use"]],
    }


DAMAGED_FINDINGS = {
    (
        "Nets!B1",
        "has no unit: B2 could be 40 deg or 40 % (21.8 deg) or 40 gon (36 deg)",
    ),
    (
        "Nets!C1",
        'is ambiguous: "snow thickness [m]" or "snow height vertical [m]"',
    ),
    ("Nets!D1", "has an unknown unit"),
    (
        "Nets!F1",
        'is no known heading, but close to "effective height D_K [m]", '
        "which is missing",
    ),
    ("Nets!G2", "is ambiguous: 1.234 or 1234"),
    ("Nets!A3", "is used twice: also in Nets!A2"),
    ("Nets!B3", "is not a number"),
    ("Nets!E3", "is not a known word"),
    ("Nets!H3", "is a formula without a stored result"),
    ("Nets!I3", "is no id of sheet Anchors"),
    ("Nets!J3", "is no id of sheet Ropes"),
    ("Nets!G4", "is an error value"),
    ("Nets!H4", "is a date or time, not a number"),
    ("Ranges!C2", "is below the low end in Ranges!B2"),
    ("Ranges!A3", "is ambiguous: [deg] or [gon]"),
    ("Ropes!B2", "is out of range"),
}
