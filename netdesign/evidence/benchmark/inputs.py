"""Inputs that every version reads: scene files, and a site as a folder of csv files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from netdesign.evidence.benchmark.scenes import SCENES, Tables

# The scenes that version 0.1.0 had; four layered ones came later, to be hard.
NAMES = tuple(
    name
    for name in SCENES
    if name not in ("layered-rough", "layered-free", "weak-base", "soft-middle")
)
# Three metres of snow on sliding ground, and a row as short as it can be: with it a
# process loads what it needs before the other is timed.
ROW: Tables = {
    "slope": {"angle_deg": 38.0},
    "snow": {
        "thickness_m": 3.0,
        "upslope_length_m": 15.0,
        "density_kg_m3": 350.0,
    },
    "ground": {"law": "sliding", "slip_length_m": 3.0},
    "net": {
        "inclination_deg": 30.0,
        "friction_deg": 30.0,
        "slack": 0.05,
        "stiffness_kN_per_m": 2e4,
        "height_m": 3.0,
    },
}
SHORT: Tables = {
    **ROW,
    "snow": {"thickness_m": 2.0, "upslope_length_m": 4.0, "density_kg_m3": 350.0},
    "net": {**ROW["net"], "height_m": 2.0},
}

_LESS_SNOW = 0.03  # of a row's snow, each time it is used again
_NETS = (
    "id,slope angle [deg],snow thickness [m],upslope length [m],ground law,"
    "slip length [m],net height [m],net stiffness [kN/m],slack [-],post spacing [m],"
    "uphill anchor distance [m],downhill anchor distance [m],foot anchor,uphill anchor,"
    "downhill anchor,uphill guy,downhill guy,post"
)
# id, slope, thickness, length, ground, slip length, height, and the rest of the line.
_ROWS = (
    ("R1", 30, 2.5, 15, "no-slip", "", 2.5, "8000,0.05,4,2.5,2.5,A28,A28,A28,G18,G18"),
    ("R2", 35, 2.8, 18, "no-slip", "", 3.0, "10000,0.06,3.5,3,3,A28,A28,A28,G22,G18"),
    ("R3", 38, 3.0, 20, "sliding", 1.2, 3.0, "12000,0.05,3.5,3,3,A32,A28,A28,G22,G18"),
    ("R4", 40, 3.9, 22, "sliding", 1.8, 3.9, "15000,0.08,3,4,3.5,A32,A32,A28,G24,G22"),
    ("R5", 45, 3.5, 25, "sliding", 2.4, 4.0, "20000,0.08,3,4.5,4,A40,A32,A28,G24,G22"),
    ("R6", 36, 2.6, 16, "no-slip", "", 3.0, "10000,0.05,3.5,3,3,A28,A28,A28,G22,G18"),
    ("R7", 38, 2.5, 8, "free", "", 2.5, "5000,0.02,4,2.5,2.5,A28,A28,A28,G22,G18"),
)
_SHEETS = {
    "Project": "item,value\nname,Rows that are timed\n",
    "Ranges": "quantity,unit,low,high\ndensity,kg/m3,270,400\n"
    "friction angle,deg,15,45\nnet inclination,deg,25,35\n",
    "Anchors": "id,tendon resistance [kN],pull-out resistance [kN],basis\n"
    "A28,400,320,tested\nA32,480,380,tested\nA40,800,700,tested\n",
    "Ropes": "id,minimum breaking force [kN]\nG18,250\nG22,350\nG24,400\n",
    "Posts": "id,compression resistance [kN]\nP,500\n",
}


def write_scene(path: Path, tables: Tables) -> None:
    """Write the tables of a scene file."""
    lines = []
    for name, table in tables.items():
        lines.append(f"[{name}]")
        lines += [f"{key} = {_write_value(value)}" for key, value in table.items()]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _write_value(value: object) -> str:
    if isinstance(value, list):
        return f"[{', '.join(_write_value(one) for one in value)}]"
    if isinstance(value, Mapping):
        pairs = (f"{key} = {_write_value(one)}" for key, one in value.items())
        return f"{{ {', '.join(pairs)} }}"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def write_scenes(folder: Path, names: tuple[str, ...]) -> None:
    """Write named scenes, each as NAME.toml."""
    folder.mkdir()
    for name in names:
        write_scene(folder / f"{name}.toml", SCENES[name])


def write_site(folder: Path, count: int) -> None:
    """Write a site of so many net rows, each sheet as a csv file.

    The rows are those of the first example; used again, each has less snow.
    """
    folder.mkdir()
    lines = [_NETS]
    for number in range(count):
        again, place = divmod(number, len(_ROWS))
        name, slope, thickness, length, ground, slip, height, rest = _ROWS[place]
        share = 1.0 - _LESS_SNOW * again
        given = (
            *(f"{name}.{again + 1}", slope),
            *(f"{share * one:.4f}" for one in (thickness, length)),
            *(ground, slip, height, rest, "P"),
        )
        lines.append(",".join(map(str, given)))
    for sheet, text in {"Nets": "\n".join(lines) + "\n", **_SHEETS}.items():
        (folder / f"{sheet}.csv").write_text(text, encoding="utf-8")
