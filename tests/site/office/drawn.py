"""Drawn contents of an input workbook, as tables by key."""

import random
import tomllib
from pathlib import Path

GROUNDS = ("till", "scree", "gravel", "rock")
_FILE = Path(__file__).parents[1] / "drawn.toml"
_KEPT = tomllib.loads(_FILE.read_text(encoding="utf-8"))


def draw_line(rng, table):
    """A line of a table of ``drawn.toml``."""
    kept = _KEPT[table]
    line = dict(kept.get("same", {}))
    for key, (low, high, digits) in kept.get("between", {}).items():
        number = round(rng.uniform(low, high), digits)
        line[key] = number if digits > 0 else int(number)
    return line | {key: rng.choice(one) for key, one in kept.get("of", {}).items()}


def draw_tables(seed, rows=4):
    """Tables of a site with every column of Rows, Net types and Anchors filled in."""
    rng = random.Random(seed)
    names = [f"SN {n}.{rng.randint(0, 9)}" for n in range(rng.randint(1, 3))]
    anchors = [f"GEWI {n}" for n in rng.sample(range(20, 60), 4)]
    nets = [{"id": one} | draw_line(rng, "net_types") for one in names]
    ranges = {
        "density": (rng.randint(250, 300), rng.randint(380, 450)),
        "friction_angle": (_pick(rng, 10, 18), _pick(rng, 30, 44)),
        "inclination": (_pick(rng, 20, 27), _pick(rng, 30, 38)),
    }
    return {
        "project": [{"name": f"Site {seed}"} | ranges | draw_line(rng, "project")],
        "rows": [_draw_row(rng, f"A{n + 1}", nets, anchors) for n in range(rows)],
        "net_types": nets,
        "anchor_types": [_draw_anchor(rng, one) for one in anchors],
        "ropes": [
            {"id": f"S {d}", "rope": d * d, "termination": "included"}
            for d in (18, 20, 22, 24)
        ],
        "posts": [{"id": "HEA 160", "yield_strength": 355, "bearing": 400}],
    }


def _pick(rng, low, high):
    return round(rng.uniform(low, high), 1)


def _draw_row(rng, name, nets, anchors):
    net = rng.choice(nets)
    sides = ("foot", "uphill", "downhill", "end")
    line = {"id": name, "net_type": net["id"]} | draw_line(rng, "rows")
    line["snow"] = round(net["net_height"] * rng.uniform(0.8, 1.0), 2)
    return line | {f"{one}_anchor": rng.choice(anchors) for one in sides}


def _draw_anchor(rng, name):
    diameter = int(name.split()[1])
    tendon = round(0.45 * diameter**2)
    least = round(0.6 * tendon)
    forces = {"pull_out": least, "test_mean": least + rng.randint(0, 9)}
    sizes = {"bar_diameter": diameter, "drill_diameter": 2 * diameter + 30}
    line = {"id": name, "tendon": tendon, **forces, **sizes}
    return line | draw_line(rng, "anchor_types")
