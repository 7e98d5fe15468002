"""An office's list of net rows whose types no catalogue knows, and slips in it."""

import math
import random

from netdesign.site.columns.all_tables import SHEETS

ROWS = 4  # fewer than a median of a column needs
ANGLES = (
    *("slope_angle", "post_tilt", "guy_splay", "foot_axis", "uphill_axis"),
    *("downhill_axis", "end_guy_angle", "lateral_axis"),
)


def draw_office(seed, *, rows=ROWS, has_heights=False):
    """Lines of all sheets; with heights, snow and net are given vertically, too."""
    draw = random.Random(seed)
    height = draw.choice((2.5, 3.0, 3.5))
    tilt, splay = draw.choice((12, 15, 18)), draw.choice((15, 20, 25))
    nets = [_draw_row(draw, f"W{k}", height, tilt, splay) for k in range(1, rows + 1)]
    for one in nets if has_heights else ():
        vertical = 1.0 / math.cos(math.radians(one["slope_angle"]))
        one["snow_height"] = round(one["snow_thickness"] * vertical, 2)
        one["vertical_height"] = round(one["net_height"] * vertical, 2)
    ends = [
        {"row": one["id"], "support_types": "as inside", "lateral_anchor": "short"}
        | {"end_guy": "rope", "end_guy_anchor": "long", "end_guy_angle": 35}
        | {"lateral_distance": 1.8, "lateral_axis": 40}
        for one in nets
    ]
    return {
        "Project": [{"item": "standard", "value": "swiss-guideline-2007"}],
        "Ranges": [
            {"quantity": "density", "unit": "kg/m3", "low": 270, "high": 400},
            {"quantity": "friction angle", "unit": "deg", "low": 15, "high": 45},
            {"quantity": "net inclination", "unit": "deg", "low": 25, "high": 35},
        ],
        "Nets": nets,
        "Ends": ends,
        **_draw_types(draw, height),
    }


def _draw_row(draw, name, height, tilt, splay):
    own = height + draw.choice((0.0, 0.0, 0.5))
    return {
        "id": name,
        "slope_angle": draw.randint(30, 46),
        "snow_thickness": round(own * draw.uniform(0.8, 1.0), 2),
        "upslope_length": draw.randint(12, 28),
        "glide_factor": draw.choice((1.8, 2.0, 2.2, 2.5)),
        "net_height": own,
        "net_stiffness": 8000,
        "slack": draw.choice((0.05, 0.06)),
        "post_spacing": draw.choice((3.0, 3.5, 3.5)),
        "post_tilt": tilt,
        "uphill_anchor_distance": round(own * draw.uniform(0.8, 1.2), 1),
        "downhill_anchor_distance": round(own * draw.uniform(0.8, 1.2), 1),
        "foot_anchor": "long",
        "uphill_anchor": draw.choice(("long", "short")),
        "downhill_anchor": "short",
        "uphill_guy": "rope",
        "downhill_guy": "rope",
        "post": "post",
        "snow_layers": "uniform",
        "altitude": 10 * draw.randint(185, 215),
        "guy_count": 2,
        "guy_splay": splay,
        "guy_anchors": "shared",
        "foot_axis": draw.randint(25, 45),
        "uphill_axis": draw.randint(25, 45),
        "downhill_axis": draw.randint(25, 45),
        "ground": "till",
        "mesh_strength": 180,
    }


def _draw_types(draw, height):
    strong = 10 * draw.randint(38, 46)
    return {
        "Anchors": [
            {"id": "long", "tendon": strong, "pull_out": round(0.8 * strong)}
            | {"basis": "tested", "ground": "till", "kind": "rope anchor"},
            {"id": "short", "tendon": strong - 100, "pull_out": strong - 190}
            | {"basis": "tested", "ground": "till", "kind": "rope anchor"},
        ],
        "Ropes": [{"id": "rope", "rope": 10 * draw.randint(20, 26)}],
        "Posts": [
            {"id": "post", "compression": 10 * draw.randint(35, 60)}
            | {"bearing": 10 * draw.randint(20, 40), "sliding": 10 * draw.randint(6, 9)}
        ],
    }


FACTORS = {"times ten": 10.0, "a tenth": 0.1}


def list_office_slips(lines):
    """Kind of each slip, with its cell (sheet, line, key) and what is typed there."""
    for sheet, table in lines.items():
        for number, line in enumerate(table):
            for key, value in line.items():
                if isinstance(value, str):
                    continue
                place = (sheet, number, key)
                for kind, factor in FACTORS.items():
                    yield kind, place, float(f"{value * factor:.10g}")
                below = table[number + 1].get(key) if number + 1 < len(table) else None
                if below not in (None, value) and sheet != "Ranges":
                    yield "value of the next row", place, below
                if key in ANGLES and value:
                    percent = 100.0 * math.tan(math.radians(value))
                    yield "per cent for degrees", place, round(percent)
                    yield "gon for degrees", place, round(value / 0.9, 1)
    for number, line in enumerate(lines["Nets"]):
        cosine = math.cos(math.radians(line["slope_angle"]))
        thickness, place = line["snow_thickness"], ("Nets", number, "snow_thickness")
        yield "vertical for normal", place, round(thickness / cosine, 2)
        yield "cosine taken again", place, round(thickness * cosine, 2)


def alter(lines, place, value):
    """Lines with another number in one cell."""
    sheet, number, key = place
    kept = {name: [dict(line) for line in table] for name, table in lines.items()}
    kept[sheet][number][key] = value
    return kept


COLUMNS = {plan.name: {field.key for field in plan.fields} for plan in SHEETS}
