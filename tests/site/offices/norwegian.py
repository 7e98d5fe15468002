"""A Norwegian office's folder of csv files: English, commas, dotted dates."""

from __future__ import annotations

_FIRST = ["HEB 140", "A32", "A32", "A25", "R18", "R16"]
_SECOND = ["HEB 120", "A25", "A25", "A25", "R16", "R16"]
SHEETS: dict[str, list[list[object]]] = {
    "Project": [
        ["Project", "Storfjellet, slope stabilisation"],
        ["Project no.", "N-2207"],
        ["Client", "Road authority"],
        ["Designed by", "K. Aas"],
        ["Net stiffness", "12000 kN/m"],
        ["Slack", "2 %"],
    ],
    "Nets": [
        ["Storfjellet, list of net rows"],
        [
            *("row ID", "elevation [m a.s.l.]", "terrain slope [deg]", "Hext [m]"),
            *("net height Dk [m]", "upslope length [m]", "glide factor N", "ground"),
            *("post c/c [m]", "post", "foot anchor", "uphill anchor"),
            *("downhill anchor", "uphill guy", "downhill guy", "comments"),
        ],
        ["Section north"],
        ["N1", "812", "37,0", "3,2", "3,0", "16,0", "2,0", "scree", "3,5", *_FIRST],
        ["N2", "805", "37,5", "3,25", "3,0", "15,5", "2,0", "scree", "3,5", *_FIRST],
        ["N3", "799", "38,2", "3,3", "3,0", "15,0", "2,0", "scree", "3,5", *_FIRST],
        ["N4", "793", "39,0", "3,3", "3,0", "14,5", "2,0", "scree", "3,5", *_FIRST],
        [],
        ["Section south"],
        ["S1", "788", "34,5", "2,8", "2,5", "18,0", "2,4", "rock", "4,0", *_SECOND],
        ["S2", "780", "35,0", "2,75", "2,5", "17,5", "2,4", "rock", "4,0", *_SECOND],
        ["S3", "774", "35,5", "2,7", "2,5", "17,0", "2,4", "rock", "4,0", *_SECOND],
        ["S4", "769", "36,0", "2,7", "2,5", "16,5", "2,4", "rock", "4,0", *_SECOND],
        ["Sum", "", "", "", "", "130,0"],
    ],
    "Ranges": [
        ["quantity", "low", "high", "unit"],
        ["density", "300", "450", "kg/m3"],
        ["friction angle", "20", "40", "deg"],
        ["net inclination", "25", "35", "deg"],
    ],
    "Anchors": [
        [
            *("type", "bar dia. [mm]", "steel", "kind of anchor"),
            *("pull-out resistance [kN]", "basis"),
        ],
        ["A32", "32", "S500", "bar", "305", "tested"],
        ["A25", "25", "S500", "bar", "215", "tested"],
    ],
    "Ropes": [
        ["type", "minimum breaking force [kN]", "termination"],
        ["R18", "210", "sockets"],
        ["R16", "166", "sockets"],
    ],
    "Posts": [
        ["type", "steel", "buckling length [m]"],
        ["HEB 140", "S355", "3,2"],
        ["HEB 120", "S355", "2,8"],
    ],
    "Monitoring": [
        ["net row", "member", "date and time", "tension [kN]"],
        ["N1", "foot anchor", "01.11.2023", "4,2"],
        ["N1", "foot anchor", "02.12.2023", "11,9"],
        ["N1", "foot anchor", "13.01.2024", "23,4"],
    ],
}
MERGED: dict[str, str] = {}
STRUCK: dict[str, int] = {}
ANSWERS: dict[str, str] = {}


def _mean(
    altitude: float, slope: float, height: float, length: float
) -> dict[str, float | str]:
    return {
        **{"altitude": altitude, "slope_angle": slope, "snow_height": height},
        **{"upslope_length": length, "net_stiffness": 12000.0, "slack": 0.02},
        **{"downhill_anchor": "A25", "downhill_guy": "R16"},
    }


_NORTH: dict[str, float | str] = {
    **{"net_height": 3.0, "glide_factor": 2.0, "ground": "scree"},
    **{"post_spacing": 3.5, "post": "HEB 140", "foot_anchor": "A32"},
    **{"uphill_anchor": "A32", "uphill_guy": "R18"},
}
_SOUTH: dict[str, float | str] = {
    **{"net_height": 2.5, "glide_factor": 2.4, "ground": "rock"},
    **{"post_spacing": 4.0, "post": "HEB 120", "foot_anchor": "A25"},
    **{"uphill_anchor": "A25", "uphill_guy": "R16"},
}
ROWS: dict[str, dict[str, float | str]] = {
    "N1": {**_mean(812, 37.0, 3.2, 16.0), **_NORTH},
    "N2": {**_mean(805, 37.5, 3.25, 15.5), **_NORTH},
    "N3": {**_mean(799, 38.2, 3.3, 15.0), **_NORTH},
    "N4": {**_mean(793, 39.0, 3.3, 14.5), **_NORTH},
    "S1": {**_mean(788, 34.5, 2.8, 18.0), **_SOUTH},
    "S2": {**_mean(780, 35.0, 2.75, 17.5), **_SOUTH},
    "S3": {**_mean(774, 35.5, 2.7, 17.0), **_SOUTH},
    "S4": {**_mean(769, 36.0, 2.7, 16.5), **_SOUTH},
}
RANGES = {
    "density": (300.0, 450.0),
    "friction angle": (20.0, 40.0),
    "net inclination": (25.0, 35.0),
}
PROJECT = {
    "name": "Storfjellet, slope stabilisation",
    **{"number": "N-2207", "author": "K. Aas"},
}
TYPES: dict[str, dict[str, float]] = {
    "A32": {"pull_out": 305.0},
    "A25": {"pull_out": 215.0},
    "R18": {"rope": 210.0},
    "R16": {"rope": 166.0},
}
TOLD = ("comments", "Section north", "Sum", "Client")
