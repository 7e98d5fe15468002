"""A French office's workbook: one block a sector, units where there was room.

``TRUTH`` was written by hand from the plan that the office had, not from the sheets:
per row id and field what was meant, in the first unit of the field.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import openpyxl

from tests.site.messy.sheets import fill

if TYPE_CHECKING:
    from pathlib import Path

_NETS = "Lignes de filets"
_TITLES: list[list[object]] = [
    ["COMBE DU LAC - Protection de la RD 902 - PR 12+300 à 12+850"],
    ["Tableau récapitulatif des ouvrages", *[None] * 18, "Indice B", "12/03/2026"],
    [],
    [
        *(None, None, "Terrain", None, "Neige", None, None, "Filet", None, None),
        *("Poteaux", None, None, "Ancrages", None, None, "Haubans", None),
    ],
]
_HEADINGS: list[object] = [
    *("N° de ligne", "Lieu-dit", "Pente ψ", "Longueur de manteau\nà l'amont (m)"),
    *("Épaisseur D ⊥ pente [m]", "Conditions de glissement", "Facteur N"),
    *("hauteur du filet Dk", "Raideur filet (kN/ml)", "Mou"),
    *("Entraxe poteaux", "Inclin. poteaux (°)", "Type poteau"),
    *("pied", "amont", "aval", "amont", "aval"),
    *("Nb de poteaux", "Linéaire (m)", "Observations"),
]
_NORTH: list[list[object]] = [
    [
        *("N1", "Sous la Croix", "33°", 20, "2,8 m", "glissant", "1,8"),
        *("3,0 m", "12 500", 0.05, "3,5 m", 10, "HEB 140"),
        *("T32", "T32", "T28", "C22", "C18", 9, 28, "accès hélicoptère"),
    ],
    [
        *("N2", "Sous la Croix", "34,5 °", "18,5", "2,85 m", "Glissant", "1,8"),
        *("3,0 m", "12 500", 0.05, "3,50 m", "10", "HEB 140"),
        *("T32", "T32", "T28", "C22", "C18", 12, 38.5, None),
    ],
    [
        *("N3", "La Vire", "36°", 22.000000000000004, "2,9 m", "sans glissement"),
        *(None, "3,5m", "12500", 0.04, "3,5 m", "10", "HEB 140"),
        *("T32", "T32", "T28", "C22", "C18", 7, 21, "idem"),
    ],
]
_SOUTH: list[list[object]] = [
    [
        *("S1", "Grand Pré", "38°", 15, "2,4 m", "libre", None),
        *("2,5 m", 10000, 0.03, "4 m", 5, "HEB 120"),
        *("T28", "T28", "T28", "C18", "C18", 6, 20, None),
    ],
    [
        *("S2", "Grand Pré", "37,0°", 16, "2,45 m", "libre", None),
        *("2,5 m", 10000, 0.03, "4 m", 5, "HEB 120"),
        *("T28", "T28", "T28", "C18", "C18", 6, 20, "voir plan 4"),
    ],
    [
        *("S3", "Les Rochers", "41°", 15.5, "2,5 m", "sans glissement", None),
        *("3 m", "10 000", 0.03, "4,0 m", 0, "HEB 120"),
        *("T28", "T28", "T28", "C18", "C18", 8, 28, None),
    ],
]


def _total(name: str, first: int, last: int) -> list[object]:
    counts = (f"=SUM({column}{first}:{column}{last})" for column in "ST")
    return [name, *[None] * 17, *counts]


def build(path: Path) -> None:
    """Write the workbook."""
    book = openpyxl.Workbook()
    cover = book.active
    cover.title = "Page de garde"
    fill(
        cover,
        [
            [],
            [None, "Département - Service des routes"],
            [None, "Affaire n° 26-041", None, "Combe du Lac"],
            [None, "Rédigé par : C. Favre", None, "Vérifié : -"],
        ],
    )
    nets = book.create_sheet(_NETS)
    fill(nets, [*_TITLES, _HEADINGS, ["Secteur Nord"], *_NORTH])
    fill(nets, [_total("Sous-total secteur Nord", 7, 9), []], below=9)
    fill(nets, [["Secteur Sud (versant exposé)"], *_SOUTH], below=11)
    fill(nets, [_total("Sous-total secteur Sud", 13, 15)], below=15)
    fill(nets, [_total("TOTAL", 7, 15), []], below=16)
    fill(
        nets,
        [
            ["Nota : Dk et D sont mesurés perpendiculairement à la pente."],
            ["(1) linéaires mesurés en plan, à confirmer par le géomètre"],
        ],
        below=18,
    )
    for merged in (
        *("A1:U1", "C4:D4", "E4:G4", "H4:J4", "K4:M4", "N4:P4", "Q4:R4"),
        *("A6:U6", "A12:U12"),
    ):
        nets.merge_cells(merged)
    for row in (7, 8, 9, 13, 14, 15):
        nets.cell(row, 10).number_format = "0%"
    hypotheses = book.create_sheet("Hypothèses")
    fill(
        hypotheses,
        [
            ["Hypothèses de calcul"],
            [],
            ["Paramètre", "Valeurs retenues", "Unité", "Source"],
            ["Masse volumique de la neige", "250-450", "kg/m³", "directive"],
            ["Frottement neige/filet", "15 à 45", "°", "étude 2024"],
            ["Inclinaison du filet", "25 - 35", "°", "/ normale à la pente"],
        ],
    )
    hypotheses.merge_cells("A1:D1")
    fill(
        book.create_sheet("Tirants"),
        [
            ["Ancrages passifs - résistances caractéristiques"],
            [],
            [
                *("Désignation", "Nuance", "Armature Rt,k (kN)"),
                *("Arrachement [kN]", "Origine", "Remarque", "gaine textile"),
            ],
            ["T32", "GEWI 500/550", "442,5", "380 kN", "essais", None, None],
            ["T28", "GEWI 500/550", 338, "300,25 kN", "calcul", "à confirmer", "non"],
        ],
    )
    fill(
        book.create_sheet("Câbles"),
        [
            ["Désignation", "Charge de rupture min. (kN)", "Fournisseur"],
            ["C22", 350, "n.c."],
            ["C18", "250", None],
        ],
    )
    fill(
        book.create_sheet("Poteaux"),
        [
            ["Profil", "Compression (kN)", "Masse (kg/m)"],
            ["HEB 140", 380, 33.7],
            ["HEB 120", "300", 26.7],
        ],
    )
    fill(book.create_sheet("Métré"), [["Poste", "Quantité"], ["Filet", 434.5]])
    old = book.create_sheet("Lignes (ancien)")
    fill(old, [_HEADINGS, _NORTH[0][:3] + [99] * 5])
    old.sheet_state = "hidden"
    book.save(path)


# Headings and lines that may be asked for, with what the engineer answers.
ANSWERS: dict[str, str] = {}
ROWS: dict[str, dict[str, float | str]] = {
    "N1": {
        **{"post_count": 9.0, "row_length": 28.0},
        **{"slope_angle": 33.0, "upslope_length": 20.0, "snow_thickness": 2.8},
        **{"ground_law": "sliding", "glide_factor": 1.8, "net_height": 3.0},
        **{"net_stiffness": 12500.0, "slack": 0.05, "post_spacing": 3.5},
        **{"post_tilt": 10.0, "post": "HEB 140", "foot_anchor": "T32"},
        **{"uphill_anchor": "T32", "downhill_anchor": "T28"},
        **{"uphill_guy": "C22", "downhill_guy": "C18"},
    },
    "N2": {
        **{"post_count": 12.0, "row_length": 38.5},
        **{"slope_angle": 34.5, "upslope_length": 18.5, "snow_thickness": 2.85},
        **{"ground_law": "sliding", "glide_factor": 1.8, "net_height": 3.0},
        **{"net_stiffness": 12500.0, "slack": 0.05, "post_spacing": 3.5},
        **{"post_tilt": 10.0, "post": "HEB 140", "foot_anchor": "T32"},
        **{"uphill_anchor": "T32", "downhill_anchor": "T28"},
        **{"uphill_guy": "C22", "downhill_guy": "C18"},
    },
    "N3": {
        **{"post_count": 7.0, "row_length": 21.0},
        **{"slope_angle": 36.0, "upslope_length": 22.0, "snow_thickness": 2.9},
        **{"ground_law": "no-slip", "net_height": 3.5},
        **{"net_stiffness": 12500.0, "slack": 0.04, "post_spacing": 3.5},
        **{"post_tilt": 10.0, "post": "HEB 140", "foot_anchor": "T32"},
        **{"uphill_anchor": "T32", "downhill_anchor": "T28"},
        **{"uphill_guy": "C22", "downhill_guy": "C18"},
    },
    "S1": {
        **{"post_count": 6.0, "row_length": 20.0},
        **{"slope_angle": 38.0, "upslope_length": 15.0, "snow_thickness": 2.4},
        **{"ground_law": "free", "net_height": 2.5},
        **{"net_stiffness": 10000.0, "slack": 0.03, "post_spacing": 4.0},
        **{"post_tilt": 5.0, "post": "HEB 120", "foot_anchor": "T28"},
        **{"uphill_anchor": "T28", "downhill_anchor": "T28"},
        **{"uphill_guy": "C18", "downhill_guy": "C18"},
    },
    "S2": {
        **{"post_count": 6.0, "row_length": 20.0},
        **{"slope_angle": 37.0, "upslope_length": 16.0, "snow_thickness": 2.45},
        **{"ground_law": "free", "net_height": 2.5},
        **{"net_stiffness": 10000.0, "slack": 0.03, "post_spacing": 4.0},
        **{"post_tilt": 5.0, "post": "HEB 120", "foot_anchor": "T28"},
        **{"uphill_anchor": "T28", "downhill_anchor": "T28"},
        **{"uphill_guy": "C18", "downhill_guy": "C18"},
    },
    "S3": {
        **{"post_count": 8.0, "row_length": 28.0},
        **{"slope_angle": 41.0, "upslope_length": 15.5, "snow_thickness": 2.5},
        **{"ground_law": "no-slip", "net_height": 3.0},
        **{"net_stiffness": 10000.0, "slack": 0.03, "post_spacing": 4.0},
        **{"post_tilt": 0.0, "post": "HEB 120", "foot_anchor": "T28"},
        **{"uphill_anchor": "T28", "downhill_anchor": "T28"},
        **{"uphill_guy": "C18", "downhill_guy": "C18"},
    },
}
RANGES = {
    "density": (250.0, 450.0),
    "friction_angle": (15.0, 45.0),
    "inclination": (25.0, 35.0),
}
# Characteristic resistances [kN] by type and mode.
TYPES: dict[str, dict[str, float | str]] = {
    "T32": {"tendon": 442.5, "pull_out": 380.0, "basis": "tested"},
    "T28": {"tendon": 338.0, "pull_out": 300.25, "basis": "computed"},
    "C22": {"rope": 350.0},
    "C18": {"rope": 250.0},
    "HEB 140": {"compression": 380.0},
    "HEB 120": {"compression": 300.0},
}
# Columns of sheet Nets that hold nothing for the check: each has to be told.
LEFT_OUT = ("Lieu-dit", "Observations")
