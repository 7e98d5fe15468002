"""An Austrian office's list: ods, a cover sheet, groups, part headings, sums.

What holds for all rows of the sheet stands in a line above its table; nobody gives the
stiffness of the net.
"""

from __future__ import annotations

_EAST = ["Rohr 168", "GEWI 25", "GEWI 32", "GEWI 25", "Seil 18", "Seil 16"]
_WEST = ["Rohr 140", "GEWI 25", "GEWI 25", "GEWI 25", "Seil 16", "Seil 16"]
SHEETS: dict[str, list[list[object]]] = {
    "Deckblatt": [
        ["Projekt:", "Lawinenverbauung Rosskar"],
        ["Projektnummer:", "AT-0481"],
        ["Gemeinde:", "Kals"],
        ["Verfasser:", "M. Hofer"],
    ],
    "Werkliste": [
        ["Lawinenverbauung Rosskar, Werkliste, Stand 03/2026"],
        ["Überlänge", "3 %"],
        ["Pfostenabstand [m]", "4,00"],
        [],
        [
            *("Werk", "Höhenlage [m ü. A.]", "Neigung Hang [°]", "Exposition"),
            *("Schneehöhe lotrecht [m]", "wirksame Werkhöhe Dk [m]"),
            *("Länge bergwärts [m]", "Gleitfaktor N", "Untergrund", "Stütze"),
            *("Fußanker", "Anker bergseitig", "Anker talseitig", "Seil bergseitig"),
            *("Seil talseitig", "Bemerkung"),
        ],
        ["Abschnitt Ost"],
        ["W1", "2105", "38,5", "O", "3,90", "3,5", "20", "1,8", "Geröll", *_EAST],
        ["W2", "2096", "39", "O", "3,85", "3,5", "19,5", "1,8", "Geröll", *_EAST],
        ["W3", "2088", "40,2", "O", "3,80", "3,5", "18", "1,8", "Geröll", *_EAST],
        ["W4", "2079", "41", "O", "3,70", "3,5", "17,5", "2,0", "Geröll", *_EAST],
        ["Summe", None, None, None, None, None, "75"],
        [],
        ["Abschnitt West"],
        ["W5", "2101", "36", "SO", "3,40", "3,0", "21", "2,2", "Fels", *_WEST],
        ["W6", "2092", "36,5", "SO", "3,35", "3,0", "20,4", "2,2", "Fels", *_WEST],
        ["W7", "2083", "37,8", "SO", "3,30", "3,0", "19", "2,2", "Fels", *_WEST],
        ["W8", "2075", "38", "SO", "3,28", "3,0", "18,1", "2,2", "Fels", *_WEST],
        ["W9", "2066", "39,9", "SO", "3,20", "3,0", "16,6", "2,2", "Fels", *_WEST],
        ["Summe", None, None, None, None, None, "95,1"],
    ],
    "Annahmen": [
        ["Kennwert", "von", "bis", "Einheit"],
        ["Schneedichte", "270", "430", "kg/m³"],
        ["Reibung Schnee/Netz", "15", "40", "°"],
        ["Netzneigung", "25", "35", "°"],
    ],
    "Ankerliste": [
        [
            *("Typ", "Stab-Ø [mm]", "Stahl", "Bohrloch-Ø [mm]", "Zugglied [kN]"),
            *("Herausziehen [kN]", "Nachweis", "Verankerungslänge [m]"),
        ],
        ["GEWI 32", 32, "S 500", 90, "402", "290", "Versuch", "4,0"],
        ["GEWI 25", 25, "S 500", 90, "245", "200", "Versuch", "3,0"],
    ],
    "Seilliste": [
        ["Typ", "Nenndurchmesser [mm]", "Machart", "Mindestbruchkraft [kN]"],
        ["Seil 18", 18, "6x19", "210"],
        ["Seil 16", 16, "6x19", "166"],
    ],
    "Stützenliste": [
        ["Typ", "A [cm²]", "Iz [cm4]", "Stahl", "Knicklänge [m]"],
        ["Rohr 168", "30,7", "1003", "S355", "4,1"],
        ["Rohr 140", "20,7", "480", "S355", "3,5"],
    ],
}
MERGED = {"Werkliste": "A1:P1"}
STRUCK: dict[str, int] = {}
ANSWERS = {"6x19": "6x19 FC"}


def _mean(
    altitude: float, slope: float, height: float, length: float, n: float
) -> dict[str, float | str]:
    return {
        **{"altitude": altitude, "slope_angle": slope, "snow_height": height},
        **{"upslope_length": length, "glide_factor": n, "slack": 0.03},
        **{"post_spacing": 4.0, "foot_anchor": "GEWI 25"},
        **{"downhill_anchor": "GEWI 25", "downhill_guy": "Seil 16"},
    }


_IN_EAST: dict[str, float | str] = {
    **{"net_height": 3.5, "ground": "scree", "post": "Rohr 168"},
    **{"uphill_anchor": "GEWI 32", "uphill_guy": "Seil 18"},
}
_IN_WEST: dict[str, float | str] = {
    **{"net_height": 3.0, "ground": "rock", "post": "Rohr 140"},
    **{"uphill_anchor": "GEWI 25", "uphill_guy": "Seil 16"},
}
ROWS: dict[str, dict[str, float | str]] = {
    "W1": {**_mean(2105, 38.5, 3.9, 20.0, 1.8), **_IN_EAST},
    "W2": {**_mean(2096, 39.0, 3.85, 19.5, 1.8), **_IN_EAST},
    "W3": {**_mean(2088, 40.2, 3.8, 18.0, 1.8), **_IN_EAST},
    "W4": {**_mean(2079, 41.0, 3.7, 17.5, 2.0), **_IN_EAST},
    "W5": {**_mean(2101, 36.0, 3.4, 21.0, 2.2), **_IN_WEST},
    "W6": {**_mean(2092, 36.5, 3.35, 20.4, 2.2), **_IN_WEST},
    "W7": {**_mean(2083, 37.8, 3.3, 19.0, 2.2), **_IN_WEST},
    "W8": {**_mean(2075, 38.0, 3.28, 18.1, 2.2), **_IN_WEST},
    "W9": {**_mean(2066, 39.9, 3.2, 16.6, 2.2), **_IN_WEST},
}
RANGES = {
    "density": (270.0, 430.0),
    "friction angle": (15.0, 40.0),
    "net inclination": (25.0, 35.0),
    "net stiffness": (2500.0, 45000.0),
}
PROJECT = {
    "name": "Lawinenverbauung Rosskar",
    **{"number": "AT-0481", "author": "M. Hofer"},
}
TYPES: dict[str, dict[str, float]] = {
    "GEWI 32": {"tendon": 402.0, "pull_out": 290.0},
    "GEWI 25": {"tendon": 245.0, "pull_out": 200.0},
    "Seil 18": {"rope": 210.0},
    "Seil 16": {"rope": 166.0},
}
TOLD = ("Exposition", "Bemerkung", "Abschnitt Ost", "Summe", "Gemeinde")
