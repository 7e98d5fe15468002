"""Scenes as tables of scene files: named ones, and random ones of a seed.

Scene number k of a seed is the same however many are drawn, and in any order.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from netdesign.coupling.scene import Scene
from netdesign.errors import ModelError
from netdesign.files.scene import SceneFile, build_scene
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
