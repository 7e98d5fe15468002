"""Inputs of the benches: named scenes, random ones of a seed, a site; their files.

Scene number k of a seed is the same however many are drawn, and in any order.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from netdesign.coupling.scene import Scene
from netdesign.files.scene import SceneFile, build_scene
from netdesign.outcome import ModelError
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.snow.ground import GROUND_KINDS
from netdesign.words.message import say

PAPER_SCENE = "paper-30"
# Of these histories are measured too.
HISTORY_SCENES = ("paper-0", PAPER_SCENE)


def _scene(
    slope: float,
    thickness: float,
    length: float,
    snow: dict[str, Any] | float,
    ground: dict[str, Any] | str,
    net: tuple[float, float, float, float],
    *,
    height: float = 0.0,
    gravity: str = "full",
) -> Tables:
    """Tables; ``net`` holds inclination, friction, slack, stiffness."""
    inclination, friction, slack, stiffness = net
    packed = {"density_kg_m3": snow} if isinstance(snow, float) else snow
    return {
        "slope": {"angle_deg": slope},
        "snow": {"thickness_m": thickness, "upslope_length_m": length, **packed},
        "ground": {"law": ground} if isinstance(ground, str) else ground,
        "net": {
            "inclination_deg": inclination,
            "friction_deg": friction,
            "slack": slack,
            "stiffness_kN_per_m": stiffness,
            "height_m": height or thickness,
        },
        "gravity": {"mode": gravity},
    }


def _layers(*pairs: tuple[float, float]) -> dict[str, Any]:
    return {
        "layers": [
            {"thickness_m": height, "density_kg_m3": density}
            for height, density in pairs
        ]
    }


def _sliding(slip_length: float, contact: str = "two-sided") -> dict[str, Any]:
    return {"law": "sliding", "slip_length_m": slip_length, "contact": contact}


SCENES: dict[str, Tables] = {
    "paper-0": _scene(40, 4.0, 20, 366.8, "free", (0, 30, 0.0, 2e4)),
    PAPER_SCENE: _scene(40, 4.0, 20, 366.8, "free", (30, 30, 0.0, 2e4)),
    "smooth-net": _scene(40, 4.0, 20, 366.8, "free", (30, 0, 0.0, 2e4)),
    "slipping-part": _scene(45, 3.0, 25, 400.0, "free", (35, 15, 0.02, 1e4)),
    "parallel-gravity": _scene(
        40, 4.0, 20, 366.8, "free", (0, 30, 0.0, 2e4), gravity="parallel"
    ),
    "rough-ground": _scene(38, 3.0, 15, 300.0, "no-slip", (30, 30, 0.03, 2e4)),
    "rough-steep": _scene(55, 2.0, 12, 250.0, "no-slip", (15, 20, 0.0, 5e4)),
    "rough-leaning": _scene(35, 4.5, 30, 450.0, "no-slip", (40, 45, 0.02, 1e5)),
    "sliding-short": _scene(40, 3.0, 20, 350.0, _sliding(1.5), (25, 25, 0.03, 2e4)),
    "sliding-long": _scene(
        45, 2.5, 40, 300.0, _sliding(20.0), (30, 35, 0.05, 5e3)
    ),
    "flat-light": _scene(28, 1.5, 10, 200.0, "free", (20, 40, 0.05, 2e3)),
    "long-slope": _scene(42, 2.0, 60, 320.0, "free", (30, 30, 0.02, 3e4)),
    "slack-net": _scene(38, 3.0, 20, 400.0, _sliding(3.0), (10, 30, 0.15, 2e4)),
    "freeboard": _scene(
        40, 2.5, 20, 350.0, "free", (25, 30, 0.02, 2e4), height=3.2
    ),
    "layered": _scene(
        40, 3.0, 20, _layers((1.0, 450.0), (1.2, 350.0), (0.8, 250.0)),
        _sliding(3.0), (30, 30, 0.03, 2e4),
    ),
    "layered-rough": _scene(
        38, 3.0, 20, _layers((1.2, 400.0), (1.0, 320.0), (0.8, 240.0)),
        "no-slip", (30, 30, 0.03, 2e4),
    ),
    "layered-free": _scene(
        38, 3.0, 20, _layers((1.2, 400.0), (1.0, 320.0), (0.8, 240.0)),
        "free", (30, 30, 0.03, 2e4),
    ),
    "weak-base": _scene(
        41, 2.6, 17,
        _layers((0.37, 208.0), (0.71, 391.0), (0.83, 342.0), (0.69, 226.0)),
        _sliding(1.4), (27, 24, 0.04, 1.3e4),
    ),
    "soft-middle": _scene(
        36, 3.4, 23, _layers((1.3, 431.0), (0.6, 187.0), (1.5, 318.0)),
        "no-slip", (22, 33, 0.02, 3e4),
    ),
    "dense-firn": _scene(
        36, 3.0, 15, {"density_kg_m3": 600.0, "creep_law": "gagliardini-1997"},
        _sliding(2.0, "one-sided"), (28, 38, 0.01, 4e4),
    ),
}  # fmt: skip


def load_scenes(names: tuple[str, ...] = ()) -> dict[str, Scene]:
    """Scenes by name; all of them if none is named.

    Raises
    ------
    ModelError
        For a name that is not known.
    """
    unknown = [name for name in names if name not in SCENES]
    if unknown:
        raise ModelError(
            say("bench.no_scene", unknown=tuple(unknown), accepted=tuple(SCENES))
        )
    return {name: build_tables(SCENES[name]) for name in names or tuple(SCENES)}


def build_tables(tables: Tables) -> Scene:
    """Scene of the tables of a scene file."""
    return build_scene(SceneFile.model_validate(tables))[0]


Tables = dict[str, dict[str, Any]]

# Usual ranges of the symbols; stiffness and slip length are drawn on a log scale.
SLOPE_DEG = (28.0, 55.0)
THICKNESS_M = (0.5, 6.0)
UPSLOPE_LENGTH_M = (5.0, 60.0)
DENSITY_KG_M3 = (150.0, 600.0)
INCLINATION_DEG = (0.0, 40.0)
NET_HEIGHT_M = (1.5, 5.0)
STIFFNESS_KN_PER_M = (2e3, 1e5)
SLACK = (0.0, 0.15)
FRICTION_DEG = (0.0, 45.0)
SLIP_LENGTH_RATIO = (0.05, 20.0)  # over the thickness: glide factors 1.05 to 3

# Shares of the drawn scenes.
_FLUSH = 0.7  # net as high as the snow; else within NET_HEIGHT_M, if it can be
_TAUT = 0.2  # no slack at all
_SMOOTH = 0.05  # no friction at all
_LAYERED = 0.3
_ONE_SIDED = 0.2  # each of ground and net
_PARALLEL = 0.1  # gravity along the slope only
_MOST_LAYERS = 4


def draw_scene(seed: int, number: int) -> Tables:
    """Tables of the scene file of one random scene."""
    rng = np.random.default_rng([seed, number])
    thickness = _uniform(rng, THICKNESS_M)
    return {
        "slope": {"angle_deg": _uniform(rng, SLOPE_DEG)},
        "snow": {
            "thickness_m": thickness,
            "upslope_length_m": _uniform(rng, UPSLOPE_LENGTH_M),
            "creep_law": str(rng.choice(list(CREEP_LAWS))),
        }
        | _draw_density(rng, thickness),
        "ground": _draw_ground(rng, thickness),
        "net": _draw_net(rng, thickness),
        "gravity": {"mode": "parallel" if rng.random() < _PARALLEL else "full"},
    }


def _draw_density(rng: np.random.Generator, thickness: float) -> dict[str, Any]:
    """One density, or layers that add up to the thickness."""
    if rng.random() >= _LAYERED:
        return {"density_kg_m3": _uniform(rng, DENSITY_KG_M3)}
    count = int(rng.integers(2, _MOST_LAYERS + 1))
    shares = rng.uniform(0.2, 1.0, count)
    heights = thickness * shares / shares.sum()
    layers = [
        {"thickness_m": float(height), "density_kg_m3": _uniform(rng, DENSITY_KG_M3)}
        for height in heights
    ]
    # the file's thickness and the sum of the layers must agree to rounding
    layers[-1]["thickness_m"] = thickness - sum(la["thickness_m"] for la in layers[:-1])
    return {"layers": layers}


def _draw_ground(rng: np.random.Generator, thickness: float) -> dict[str, Any]:
    law = str(rng.choice(GROUND_KINDS))
    ratio = _log_uniform(rng, SLIP_LENGTH_RATIO)
    slip = {"slip_length_m": ratio * thickness} if law == "sliding" else {}
    return {"law": law, "contact": _draw_contact(rng), **slip}


def _draw_net(rng: np.random.Generator, thickness: float) -> dict[str, Any]:
    height = thickness if rng.random() < _FLUSH else _uniform(rng, NET_HEIGHT_M)
    slack = 0.0 if rng.random() < _TAUT else _uniform(rng, SLACK)
    friction = 0.0 if rng.random() < _SMOOTH else _uniform(rng, FRICTION_DEG)
    return {
        "inclination_deg": _uniform(rng, INCLINATION_DEG),
        "height_m": height,
        "stiffness_kN_per_m": _log_uniform(rng, STIFFNESS_KN_PER_M),
        "slack": slack,
        "friction_deg": friction,
        "contact": _draw_contact(rng),
    }


def _draw_contact(rng: np.random.Generator) -> str:
    return "one-sided" if rng.random() < _ONE_SIDED else "two-sided"


def _uniform(rng: np.random.Generator, bounds: tuple[float, float]) -> float:
    return float(rng.uniform(*bounds))


def _log_uniform(rng: np.random.Generator, bounds: tuple[float, float]) -> float:
    return float(np.exp(rng.uniform(*np.log(bounds))))


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
