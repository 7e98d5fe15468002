"""Drawn sites of one net row, every cell of which somebody might leave empty.

What is typed of net, snow and support lies inside the range that an empty cell stands
for: outside it somebody has said something that nobody could assume.
"""

import math
import random

from netdesign.site.columns.office import TABLES, load_columns

DEFAULT = "nf-p-95-304-style"
ANCHORS = ("turning", "solid", "hollow", "tried", "GEWI 40")
ROPES = ("typed", "ended", "stiff")
POSTS = ("rolled", "HEB 160")
# The worst of these lies at a corner to within some tenths of a per cent alone:
# tests/study/test_variants.py.
AT_CORNERS = (
    *("post_tilt", "guy_count", "guy_splay", "guy_anchors"),
    *("uphill_anchor_distance", "downhill_anchor_distance", "end_guy_angle"),
)
# Statements: an empty cell is a condition that the study prints. What is drilled and
# built as the report says, where nobody says otherwise, is none that is not known.
STATEMENTS = (
    *("name", "protection", "soil", "soil_cohesion", "soil_friction", "soil_weight"),
    *("soil_water", "dip", "mid_anchors", "drilled_length", "at_end"),
    # ropes whose stiffness nobody gives are of one construction with the others
    "axial_stiffness",
    # between their samples on a grid lies what is larger
    *("density", "friction_angle"),
)
REQUIRED = {
    table: {one.field.key for one in load_columns(table) if one.need == "yes"}
    for table in TABLES
}
_GROUPS = (
    ("kind",),
    ("kind", "lever_arm"),
    ("head_across",),
    ("head_eccentricity",),
    ("guy_count", "guy_splay"),
    ("guy_anchors",),
    ("design_life",),
    ("mesh_strength", "angle", "count"),
    ("force", "meaning"),
    ("ground",),
    ("post_tilt",),
    ("uphill_anchor_distance", "downhill_anchor_distance"),
    ("gap",),
    ("ridge_rope", "lower_rope", "ridge_sag", "lower_sag"),
    ("foot_anchor", "uphill_anchor", "downhill_anchor", "uphill_guy", "downhill_guy"),
    ("post",),
    ("pull_out", "proven", "test_count", "test_mean"),
    ("temperature",),
    ("standard",),
    ("inclination",),
    ("base_friction",),
)


def draw_tables(seed, *, is_placed=False, is_tested=False):
    """Tables of a site; one friction angle and inclination.

    A row that is placed may say its ground; with tests, a type has them one by one.
    """
    draw = random.Random(seed)
    row, net = _draw_row(draw)
    tables = {
        "project": [{"name": f"drawn {seed}"} | _draw_project(draw)],
        "rows": [row],
        "net_types": [net],
        "anchor_types": list(_draw_anchors(draw)),
        "ropes": list(_draw_ropes(draw)),
        "posts": list(_draw_posts(draw, net)),
        "layers": _draw_layers(draw, row),
        "declared": _draw_declared(draw),
    }
    _stand_in_ground(draw, tables, has_two=is_placed and draw.random() < 0.5)
    tables["links"] = list(_draw_links(draw, tables))
    if is_tested:
        _test_one_by_one(tables)
    if "into" in str(row.get("gap", "")):
        own = list(tables["layers"])
        for name in ("R2", "R3"):
            tables["rows"].append({**row, "id": name})
            del tables["rows"][-1]["gap"]
            tables["layers"] += [{**one, "row": name} for one in own]
    return tables


def give_strength(draw, tables):
    """Let the site say the strength of its ground, now and then."""
    if draw.random() < 0.5:
        soil = {
            "ground": tables["rows"][0]["ground"],
            "soil_cohesion": _round(draw.uniform(8.0, 48.0)),
            "soil_friction": _round(draw.uniform(25.0, 40.0)),
            "soil_weight": _round(draw.uniform(17.0, 23.0)),
        }
        if draw.random() < 0.5:
            soil["soil_water"] = draw.choice(("seepage", "drained"))
        tables["soils"] = [soil]


def list_cells(tables):
    """Places of all optional cells that hold something unknown if empty."""
    return [
        (table, number, key)
        for table, lines in tables.items()
        for number, line in enumerate(lines)
        for key in line
        if key not in (*REQUIRED[table], *AT_CORNERS, *STATEMENTS)
        and line[key] != "free"  # worse than what an empty cell means
    ]


def list_groups(tables):
    """Cells that belong together: a table, a panel, all kinds, all dimensions."""
    groups = [[("table", one)] for one in ("declared", "links", "tests", "ropes")]
    of_corners = [
        ("net_types", 0, key) for key in AT_CORNERS if key in tables["net_types"][0]
    ]
    cells = [*list_cells(tables), *of_corners]
    for keys in _GROUPS:
        found = [one for one in cells if one[2] in keys]
        if found:
            groups.append(found)
    return groups


def empty(tables, cells):
    """Tables with some cells left empty; a group may name a whole table."""
    kept = {table: [dict(line) for line in lines] for table, lines in tables.items()}
    for table, *place in cells:
        if table == "table":
            (name,) = place
            kept[name] = []
        elif place[0] < len(kept[table]):
            kept[table][place[0]].pop(place[1], None)
    return kept


def _round(value, digits=3):
    return float(f"{value:.{digits}g}")


def _draw_project(draw):
    density = draw.uniform(330.0, 360.0), draw.uniform(375.0, 399.0)
    found = {
        "density": tuple(map(_round, density)),
        "friction_angle": _round(draw.uniform(15.0, 44.0)),
        "inclination": _round(draw.uniform(25.0, 35.0)),
        "standard": draw.choice(("eurocode", DEFAULT, DEFAULT)),
        "design_life": draw.choice((30, 50, 80, 100)),
        "base_friction": _round(draw.uniform(0.36, 0.7)),
    }
    if draw.random() < 0.5:
        found["soil"] = draw.choice(("natural", "natural", "organic", "fill"))
    return found


def _draw_row(draw):
    """A row and its net type."""
    height = _round(draw.uniform(2.2, 4.4))
    row = {
        "id": "R1",
        "slope_angle": _round(draw.uniform(30.0, 48.0)),
        "snow": _round(height * draw.uniform(0.72, 1.0) - 0.01),
        "glide_factor": draw.choice(("free", 1.0, _round(draw.uniform(1.15, 2.9)))),
        "upslope_length": _round(draw.uniform(6.0, 25.0)),
        "altitude": _round(draw.uniform(1300.0, 2600.0)),
        "net_type": "N1",
        "post_spacing": _round(draw.uniform(2.4, 4.4)),
    }
    for key in ("foot_anchor", "uphill_anchor", "downhill_anchor", "end_anchor"):
        row[key] = draw.choice(ANCHORS)
    if draw.random() < 0.15:
        del row["end_anchor"]
    end = draw.random()
    if end < 0.2:
        row["gap"] = "into R2, R3"
    elif end < 0.75:
        row["gap"] = draw.choice((0.0, _round(draw.uniform(0.5, 4.0))))
    return row, _draw_net(draw, height)


def _draw_net(draw, height):
    net = {
        "id": "N1",
        "net_height": height,
        "net_stiffness": _round(draw.uniform(4000.0, 22000.0)),
        "slack": _round(draw.uniform(3.0, 10.0)),
        "post_tilt": _round(draw.uniform(10.0, 20.0)),
        "uphill_anchor_distance": _round(height * draw.uniform(0.76, 1.24)),
        "downhill_anchor_distance": _round(height * draw.uniform(0.76, 1.24)),
        "guy_count": draw.choice((1, 2, 2, 2)),
        "mid_anchors": "no",
        "mesh_strength": _round(draw.uniform(90.0, 600.0)),
        "post": draw.choice(POSTS),
    }
    if net["guy_count"] == 2:
        net["guy_splay"] = _round(draw.uniform(10.0, 25.0))
        net["guy_anchors"] = draw.choice(("own", "shared"))
    for key in ("uphill_guy", "downhill_guy", "end_guy", "ridge_rope", "lower_rope"):
        net[key] = draw.choice(ROPES)
    for key in ("ridge_sag", "lower_sag"):
        net[key] = _round(draw.uniform(8.0, 15.0))
    if draw.random() < 0.7:
        net["end_guy_angle"] = _round(draw.uniform(30.0, 45.0))
    if draw.random() < 0.5:
        net["ropes_at_supports"] = draw.choice(("held", "slide"))
    for key in ("ridge_rope", "lower_rope", "ridge_sag", "lower_sag", "end_guy"):
        if draw.random() < 0.1:
            del net[key]
    return net


def _draw_anchors(draw):
    scale = draw.uniform(0.8, 4.5)
    yield {
        "id": "turning",
        "kind": "rope anchor",
        "tendon": _round(330.0 * scale),
        "pull_out": _round(255.0 * scale),
        "proven": "calculated",
    }
    for name, kind, diameter in (
        ("solid", "bar", _round(draw.uniform(25.0, 57.0))),
        ("hollow", "micropile", _round(draw.uniform(52.0, 73.0))),
    ):
        strength = draw.uniform(0.45, 0.56)  # [GPa]
        yields = 0.25 * math.pi * diameter**2 * strength
        yield {
            "id": name,
            "kind": kind,
            "bar_diameter": diameter,
            "tendon": _round(yields),
            "lever_arm": draw.choice((0.0, _round(draw.uniform(2.0, 60.0)))),
            **_draw_tests(draw, yields * draw.uniform(0.5, 0.78)),
        }
    yield {
        "id": "tried",
        "kind": "rope anchor",
        "tendon": _round(400.0 * scale),
        **_draw_tests(draw, 310.0 * scale),
    }
    yield {
        "id": "GEWI 40",
        "kind": "bar",
        "pull_out": _round(draw.uniform(250.0, 480.0)),
        "proven": "calculated",
    }


def _draw_tests(draw, mean):
    return {
        "pull_out": _round(mean * draw.uniform(0.8, 1.0)),
        "proven": "tests",
        "test_count": draw.choice((1, 2, 3, 5)),
        "test_mean": _round(mean),
    }


def _draw_ropes(draw):
    yield {
        "id": "typed",
        "rope": 250.0,
        "termination": "included",
        "axial_stiffness": _round(draw.uniform(11500.0, 31000.0)),
    }
    yield {
        "id": "ended",
        "rope": _round(draw.uniform(200.0, 420.0)),
        "termination": draw.choice(("clips", "swaged")),
    }
    yield {
        "id": "stiff",
        "rope": 470.0,
        "termination": "included",
        "axial_stiffness": _round(draw.uniform(21500.0, 58000.0)),
    }


def _draw_posts(draw, net):
    """Posts a little longer than the row asks for, but for what is assumed of them."""
    upright = net["net_height"] / math.cos(math.radians(net["post_tilt"]))
    rolled = {
        "id": "rolled",
        "area": 65.3,
        "second_moment": 3831.0,
        "buckling_length": round(upright + draw.uniform(0.02, 0.29), 2),
        "yield_strength": 235.0,
        "buckling_curve": draw.choice(("b", "c")),
        "post_width": 180.0,
        "section_modulus": 425.7,
        "bearing": _round(draw.uniform(240.0, 960.0)),
    }
    named = {"id": "HEB 160", "bearing": _round(draw.uniform(200.0, 900.0))}
    for post in (rolled, named):
        if draw.random() < 0.6:
            post["head_eccentricity"] = draw.choice((0.0, 25.0, 70.0))
        if draw.random() < 0.5:
            post["foot_tension"] = _round(draw.uniform(5.0, 90.0))
        yield post


def _draw_layers(draw, row):
    if draw.random() < 0.5:
        return []
    has_temperatures, count = draw.random() < 0.5, draw.choice((2, 3))
    shares = [draw.uniform(0.6, 1.4) for _ in range(count)]
    found = []
    for number, share in enumerate(shares, start=1):
        line = {
            "row": "R1",
            "layer": number,
            "thickness": round(row["snow"] * share / sum(shares), 3),
            "density": 430.0 - 90.0 * number + draw.uniform(-20.0, 20.0),
        }
        if has_temperatures:
            line["temperature"] = _round(draw.uniform(-9.0, -0.5))
        found.append(line)
    mean = sum(one["thickness"] * one["density"] for one in found) / row["snow"]
    for one in found:  # the mean lies in the middle of the range of density
        one["density"] = _round(one["density"] * 368.0 / mean, 4)
    return found


def _draw_declared(draw):
    if draw.random() < 0.6:
        return []
    check = draw.choice(
        ("post_base.bearing", "foot_anchor.pull_out", "post.compression_bending.end")
    )
    return [
        {
            "row": draw.choice(("R1", "all")),
            "check": check,
            "document": "Report 17",
            "author": "B. Nobody",
            "date": "2026-02-03",
        }
    ]


def _stand_in_ground(draw, tables, *, has_two):
    """Ground of row and types, one of which has lines in two; bores and heads."""
    (row,) = tables["rows"]
    row["ground"] = draw.choice(("limestone", "gravel"))
    other = {"limestone": "scree", "gravel": "rock"}[row["ground"]]
    for one in list(tables["anchor_types"]):
        one["ground"] = row["ground"]
        one["drilled_length"] = _round(draw.uniform(6.0, 9.0))
        if draw.random() < 0.4:
            one["dip"] = _round(draw.uniform(15.0, 40.0))
        if draw.random() < 0.5:
            key = "cover" if one["kind"] == "rope anchor" else "sacrificial"
            one["protection"] = draw.choice((key, "sheath"))
        if one["kind"] == "rope anchor" and draw.random() < 0.5:
            one["head_across"] = _round(draw.uniform(40.0, 900.0))
        if has_two and one["id"] == "tried":
            elsewhere = {"ground": other, "pull_out": 900.0, "test_mean": 950.0}
            tables["anchor_types"].append({**one, **elsewhere})
    for table, names in (("anchor_types", ANCHORS), ("ropes", ROPES), ("posts", POSTS)):
        for one in tables[table]:
            if draw.random() < 0.15:
                one["at_end"] = draw.choice(names)


def _draw_links(draw, tables):
    """One or two links of nearly every type."""
    names = dict.fromkeys(
        one["id"] for one in (*tables["anchor_types"], *tables["ropes"])
    )
    for name in names:
        for _ in range(draw.choice((0, 1, 1, 1, 2, 2))):
            link = {
                "type": name,
                "link": draw.choice(("shackle", "eye", "plate")),
                "force": _round(draw.uniform(180.0, 900.0)),
                "meaning": draw.choice(("strength", "limit")),
            }
            if draw.random() < 0.4:
                link["count"] = draw.choice((1, 2))
            if link["link"] == "shackle" and draw.random() < 0.6:
                link["angle"] = _round(draw.uniform(0.0, 60.0))
            yield link


def _test_one_by_one(tables):
    """Tests of a type on sheet Tests, in the place of their number, least and mean."""
    shares = ((1.0, "pulled out"), (1.1, "held"), (1.2, "pulled out"))
    tables["tests"] = []
    for tried in (one for one in tables["anchor_types"] if one["id"] == "tried"):
        least = tried.pop("pull_out")
        for key in ("proven", "test_count", "test_mean"):
            del tried[key]
        tables["tests"] += [
            {
                "type": "tried",
                "ground": tried["ground"],
                "force": _round(share * least),
                "result": result,
            }
            for share, result in shares
        ]
