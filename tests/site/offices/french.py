"""A French office's list: a cover sheet, one sheet per structure, NGF altitudes.

What holds for the whole site stands once, on the cover sheet. ``ROWS`` and the rest of
what was meant were typed by hand from the same plan.
"""

from __future__ import annotations

SHEETS: dict[str, list[list[object]]] = {
    "Page de garde": [
        ["Protection de la RD 213, combe du Merle"],
        [],
        ["Affaire :", "RD 213, combe du Merle"],
        ["N° d'affaire :", "24-117"],
        ["Maître d'ouvrage :", "Département"],
        ["Auteur :", "C. Morel"],
        ["Indice :", "B"],
        ["Raideur du filet [kN/m]", "9 800"],
        ["Mou du filet", "2,5 %"],
        ["Entraxe poteaux [m]", "3,50"],
    ],
    "Filets A": [
        ["Filets A, combe du Merle, T = 100 ans"],
        [
            *("N°", "Altitude [m NGF]", "Pente moyenne [°]", "Exposition", "Hs [m]"),
            *("Hauteur efficace Dk [m]", "Longueur amont [m]", "Facteur N", "Sol"),
            *("Type poteau", "Inclin. poteaux [°]", "Ancrage pied", "Ancrage amont"),
            *("Ancrage aval", "Hauban amont", "Hauban aval", "Remarques"),
        ],
        [
            *("A1", "1 845", "37,5", "NE", "3,60", "3,00", "18,5", "2,1", "éboulis"),
            *("HEA 160", 5, "TI 25", "TI 32", "TI 25", "C18", "C16", None),
        ],
        [
            *("A2", "1 832", "38", "NE", "3,55", "3,00", "17", "2,1", "éboulis"),
            *("HEA 160", 5, "TI 25", "TI 32", "TI 25", "C18", "C16", None),
        ],
        [
            *("A3", "1 820", "39,2", "N", "3,42", "3,00", "16,2", "2,4", "rocher"),
            *("HEA 160", 5, "TI 25", "TI 32", "TI 25", "C18", "C16", "biffée"),
        ],
        [
            *("A4", "1 811", "41", "N", "3,30", "2,50", "15", "2,4", "rocher"),
            *("HEA 140", 0, "TI 25", "TI 25", "TI 25", "C16", "C16", None),
        ],
        [
            *("A5", "1 802", "36,8", "N", "3,10", "2,50", "15", "2,6", "rocher"),
            *("HEA 140", 0, "TI 25", "TI 25", "TI 25", "C16", "C16", None),
        ],
        [],
        ["Total", None, None, None, None, None, "81,7"],
    ],
    "Filets B": [
        ["Filets B, rive gauche"],
        [
            *("N°", "Altitude [m NGF]", "Pente moyenne [°]", "Exposition", "Hs [m]"),
            *("Hauteur efficace Dk [m]", "Longueur amont [m]", "Facteur N", "Sol"),
            *("Type poteau", "Inclin. poteaux [°]", "Ancrage pied", "Ancrage amont"),
            *("Ancrage aval", "Hauban amont", "Hauban aval", "Remarques"),
        ],
        *(
            [
                *(f"B{n}", altitude, slope, "E", height, "3,00", length, "1,9"),
                *("éboulis", "HEA 160", 5, "TI 25", "TI 32", "TI 25", "C18", "C16"),
            ]
            for n, altitude, slope, height, length in (
                (1, "1 790", "35", "3,45", "19,4"),
                (2, "1 781", "35,6", "3,40", "18"),
                (3, "1 770", "36,1", "3,38", "17,25"),
                (4, "1 764", "37", "3,30", "16"),
                (5, "1 755", "38,4", "3,28", "14,9"),
            )
        ),
    ],
    "Hypothèses": [
        ["Paramètre", "mini", "maxi", "Unité"],
        ["Masse volumique", 250, 450, "kg/m³"],
        ["Frottement neige/filet", 15, 40, "°"],
        ["Inclinaison du filet", 25, 35, "°"],
    ],
    "Ancrages": [
        [
            *("Type", "Nuance", "diamètre barre [mm]", "diamètre de forage [mm]"),
            *("longueur scellée [m]", "terrain", "nombre d'essais"),
            *("résistance minimale d'essai [kN]", "résistance moyenne d'essai [kN]"),
            "genre d'ancrage",
        ],
        ["TI 32", "500/550", 32, 90, "4,5", "éboulis", 3, 310, 338, "barre"],
        ["TI 25", "500/550", 25, 90, "3,5", "éboulis", 4, 222, "241,5", "barre"],
        ["TI 32", "500/550", 32, 90, "3,0", "rocher", 3, 330, "361,4", "barre"],
        ["TI 25", "500/550", 25, 90, "2,5", "rocher", 3, 240, "252,1", "barre"],
    ],
    "Câbles": [
        [
            *("Type", "diamètre du câble [mm]", "composition", "classe du câble [MPa]"),
            *("charge de rupture [kN]", "terminaison"),
        ],
        ["C18", 18, "6x19 IWRC", 1770, "204", "cosse + serre-câbles"],
        ["C16", 16, "6x19 IWRC", 1770, "161", "cosse + serre-câbles"],
    ],
    "Poteaux": [
        ["Type", "Nuance", "longueur de flambement [m]"],
        ["HEA 160", "S235", "3,6"],
        ["HEA 140", "S235", "3,1"],
    ],
    "Filets (ancien)": [
        ["N°", "Pente moyenne [°]", "Hs [m]"],
        ["A1", 30, 2],
        ["A2", 30, 2],
    ],
}
MERGED = {"Filets A": "A1:Q1", "Filets B": "A1:Q1"}
STRUCK = {"Filets A": 5}
ANSWERS = {"Filets (ancien)": "ignore"}


def _mean(
    altitude: float, slope: float, height: float, net: float, length: float, n: float
) -> dict[str, float | str]:
    return {
        **{"altitude": altitude, "slope_angle": slope, "snow_height": height},
        **{"net_height": net, "upslope_length": length, "glide_factor": n},
        **{"net_stiffness": 9800.0, "slack": 0.025, "post_spacing": 3.5},
        **{"foot_anchor": "TI 25", "downhill_anchor": "TI 25", "downhill_guy": "C16"},
    }


_LARGE: dict[str, float | str] = {
    **{"post": "HEA 160", "post_tilt": 5.0, "uphill_anchor": "TI 32"},
    "uphill_guy": "C18",
}
_SMALL: dict[str, float | str] = {
    **{"post": "HEA 140", "post_tilt": 0.0, "uphill_anchor": "TI 25"},
    "uphill_guy": "C16",
}
ROWS: dict[str, dict[str, float | str]] = {
    "A1": {**_mean(1845, 37.5, 3.6, 3.0, 18.5, 2.1), **_LARGE, "ground": "scree"},
    "A2": {**_mean(1832, 38.0, 3.55, 3.0, 17.0, 2.1), **_LARGE, "ground": "scree"},
    "A3": {**_mean(1820, 39.2, 3.42, 3.0, 16.2, 2.4), **_LARGE, "ground": "rock"},
    "A4": {**_mean(1811, 41.0, 3.3, 2.5, 15.0, 2.4), **_SMALL, "ground": "rock"},
    "A5": {**_mean(1802, 36.8, 3.1, 2.5, 15.0, 2.6), **_SMALL, "ground": "rock"},
    "B1": {**_mean(1790, 35.0, 3.45, 3.0, 19.4, 1.9), **_LARGE, "ground": "scree"},
    "B2": {**_mean(1781, 35.6, 3.4, 3.0, 18.0, 1.9), **_LARGE, "ground": "scree"},
    "B3": {**_mean(1770, 36.1, 3.38, 3.0, 17.25, 1.9), **_LARGE, "ground": "scree"},
    "B4": {**_mean(1764, 37.0, 3.3, 3.0, 16.0, 1.9), **_LARGE, "ground": "scree"},
    "B5": {**_mean(1755, 38.4, 3.28, 3.0, 14.9, 1.9), **_LARGE, "ground": "scree"},
}
RANGES = {
    "density": (250.0, 450.0),
    "friction angle": (15.0, 40.0),
    "net inclination": (25.0, 35.0),
}
PROJECT = {
    **{"name": "RD 213, combe du Merle", "number": "24-117", "author": "C. Morel"},
    "revision": "B",
}
TYPES: dict[str, dict[str, float]] = {"C18": {"rope": 204.0}, "C16": {"rope": 161.0}}
TOLD = ("Exposition", "Remarques", "A5", "Maître d'ouvrage", "Filets (ancien)")
