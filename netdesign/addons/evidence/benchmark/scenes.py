"""Inputs of the benches: named scenes, as scene files; random ones of a seed; a site.

Scene number k of a seed is the same however many are drawn, and in any order.
"""

from __future__ import annotations

import csv
import shutil
import tomllib
from datetime import date, timedelta
from pathlib import Path
from typing import Any

import numpy as np

from netdesign.coupling.scene import Scene
from netdesign.files.scene import SceneFile, build_scene_of_file
from netdesign.outcome import ModelError
from netdesign.site.template.office_workbook import load_input_example, render_input
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.snow.ground import GROUND_KINDS
from netdesign.words.message import say

PAPER_SCENE = "paper-30"
# Of these histories are measured too.
HISTORY_SCENES = ("paper-0", PAPER_SCENE)


Tables = dict[str, dict[str, Any]]

NAMED, INPUTS = (Path(__file__).with_name(name) for name in ("named", "timed"))
SCENES: dict[str, Tables] = {
    path.stem: tomllib.loads(path.read_text(encoding="utf-8"))
    for path in sorted(NAMED.iterdir())
}
# The scenes that version 0.1.0 had; four layered ones came later, to be hard.
NAMES = tuple(
    name
    for name in SCENES
    if name not in ("layered-rough", "layered-free", "weak-base", "soft-middle")
)


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
    return build_scene_of_file(SceneFile.model_validate(tables)).scene


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


_LESS_SNOW = 0.03  # of a row's snow, each time it is used again, at most
_LEAST_SNOW = 0.5  # of it at last
_SCALED = ("snow height [m normal]", "upslope length L [m]")


def write_site(folder: Path, count: int) -> None:
    """Write a site of ``count`` net rows, each sheet as a csv file.

    The rows are those of the first example; used again, each has less snow.
    """
    shutil.copytree(INPUTS / "site", folder)
    path = folder / "Rows.csv"
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    less_snow = min(_LESS_SNOW, (1.0 - _LEAST_SNOW) * len(rows) / count)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        for number in range(count):
            again, place = divmod(number, len(rows))
            row, share = rows[place], 1.0 - less_snow * again
            less = {name: f"{share * float(row[name]):.4f}" for name in _SCALED}
            writer.writerow({**row, "row": f"{row['row']}.{again + 1}", **less})


def change_value(site: Path, sheet: str, column: str, text: str) -> None:
    """Put a text into the last line of a column of a site that `write_site` wrote."""
    path = site / f"{sheet}.csv"
    rows = list(csv.reader(path.read_text(encoding="utf-8").splitlines()))
    rows[-1][rows[0].index(column)] = text
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows(rows)


def write_offices(folder: Path) -> None:
    """Write two lists of an office: the example's rows as they are, and with bare nets.

    Of a bare net only the height is given.
    """
    folder.mkdir(exist_ok=True)
    tables = load_input_example()
    (folder / "office.xlsx").write_bytes(render_input(tables))
    types = [
        {key: one[key] for key in ("id", "net_height")} for one in tables["net_types"]
    ]
    given = ("project", "rows", "anchor_types", "tests")
    bare = {**{name: tables[name] for name in given}, "net_types": types}
    (folder / "bare.xlsx").write_bytes(render_input(bare))


_SNOW_DAYS = (60, 230)  # after the first of September: snow falls, and does not melt
_FALLS = 0.2  # share of these days on which snow falls
_FALL_CM = 8.0  # mean of a fall
_SETTLES = 0.008  # share of the height that goes each day
_MELTS_CM = 6.0  # each day, once the snow melts


def write_heights(path: Path, winters: int) -> None:
    """Write drawn snow heights of a station, 0.7 to 2.5 m deep."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("date", "HS [cm]"))
        for number in range(winters):
            rng = np.random.default_rng([winters, number])
            first, height = date(1980 + number, 9, 1), 0.0
            for day in range((date(1981 + number, 9, 1) - first).days):
                height *= 1.0 - _SETTLES
                if _SNOW_DAYS[0] <= day < _SNOW_DAYS[1]:
                    height += float(rng.exponential(_FALL_CM)) * (rng.random() < _FALLS)
                else:
                    height = max(0.0, height - _MELTS_CM)
                writer.writerow((first + timedelta(days=day), round(height)))
