"""Drawn sites of one net row, every cell of which somebody might leave empty.

What is typed of net, snow and support lies inside the range that an empty cell stands
for: outside it somebody has said something that nobody could assume.
"""

import math
import random

from netdesign.site.columns.all_tables import SHEETS

GROUNDS = ("free", "no-slip", "sliding")
MEMBER_COLUMNS = (
    *("foot_anchor", "uphill_anchor", "downhill_anchor"),
    *("uphill_guy", "downhill_guy", "post"),
)
PANEL_COLUMNS = (
    *("panel_system", "net_cut", "ridge_rope", "ridge_sag"),
    *("lower_rope", "lower_sag", "mid_anchors"),
)
# Words of the ground and of the snow that are worse than what an empty cell means.
NOT_ASSUMED = (
    ("ground_law", "free"),
    ("snow_layers", "layered"),
    ("snow_layers", "layered with temperatures"),
)
# The worst of these lies at a corner to within some tenths of a per cent alone:
# tests/study/test_variants.py.
AT_CORNERS = (
    *("post_tilt", "post_base_distance", "guy_count", "guy_splay", "guy_anchors"),
    *("uphill_anchor_distance", "downhill_anchor_distance", "end_guy_angle"),
)
REQUIRED = {
    plan.name: {field.key for field in plan.fields if field.required} for plan in SHEETS
}


def draw_lines(seed, *, is_placed=False, is_tested=False):
    """Lines of all sheets; three densities, one friction angle and inclination.

    A row that is placed may say its ground; with tests, a type has them one by one.
    """
    draw = random.Random(seed)
    net = _draw_net(draw)
    lines = {
        "Project": [
            {"item": "name", "value": f"drawn {seed}"},
            {"item": "standard", "value": draw.choice(("eurocode", DEFAULT, DEFAULT))},
            {"item": "extrapolated creep law accepted", "value": "boutillier-2004"},
        ],
        "Ranges": list(_draw_ranges(draw)),
        "Anchors": list(_draw_anchors(draw)),
        "Ropes": list(_draw_ropes(draw)),
        "Posts": list(_draw_posts(draw)),
        "Nets": [net],
        "Ends": _draw_ends(draw, net),
        "Snow": _draw_snow(draw, net),
        "Declared": _draw_declared(draw),
    }
    _place_base(random.Random(f"base {seed}"), net, lines["Ranges"])
    if is_placed and draw.random() < 0.5:
        _stand_in_ground(draw, lines)
    _complete_chain(random.Random(f"chain {seed}"), lines)
    _say_more(random.Random(f"more {seed}"), lines)
    if is_tested:
        _test_one_by_one(lines)
    if net.get("row_end") == "continuous":
        own = list(lines["Snow"])
        for name in ("R2", "R3"):
            lines["Nets"].append({**net, "id": name, "row_end": "free"})
            del lines["Nets"][-1]["neighbour"]
            lines["Snow"] += [{**one, "row": name} for one in own]
    return lines


def _place_base(draw, net, ranges):
    """A base of the post, where one is typed, of a tilt that is built."""
    if "post_base_distance" not in net:
        return
    inclination = math.radians(ranges[-1]["low"])
    tilt = math.radians(draw.uniform(10.5, 19.5))
    reach = math.tan(inclination) - math.tan(tilt)
    net["post_base_distance"] = round(net["net_height"] * reach, 3)


DEFAULT = "nf-p-95-304-style"


# Statements: an empty cell is a condition that the study prints. What is drilled and
# built as the report says, where nobody says otherwise, is none that is not known.
STATEMENTS = (
    *("edge_distance", "least_cover", "least_edge", "protection", "protected_years"),
    *("soil", "sleeve", "lateral_distance", "soil_cohesion", "soil_friction"),
    *("soil_weight", "soil_water", "foot_axis", "uphill_axis", "downhill_axis"),
    *("lateral_axis", "anchor_axes", "end_guy_angle", "sliding", "mid_anchors"),
    # ropes whose stiffness nobody gives are of one construction with the others
    "axial_stiffness",
)


def is_unknown(line, key):
    """Whether an empty cell leaves something unknown, which is assumed at its worst."""
    is_of_end = "lateral_anchor" in line or "support_types" in line
    if key == "panel_system":
        return line[key] != "triangular"
    if key == "post":  # its base may slide at less than what is assumed of friction
        return line[key] != "plain"
    return key not in STATEMENTS and not (is_of_end and key in MEMBER_COLUMNS)


def list_cells(lines):
    """Places of all optional cells that hold something unknown if empty."""
    return [
        (sheet, number, key)
        for sheet, table in lines.items()
        for number, line in enumerate(table)
        for key in line
        if key not in (*REQUIRED[sheet], *AT_CORNERS)
        and is_unknown(line, key)
        and (key, line[key]) not in NOT_ASSUMED
    ]


def list_groups(lines):
    """Cells that belong together: a sheet, a panel, all kinds, all dimensions."""
    cells = list_cells(lines)
    sheets = ("Declared", "Links", "Tests")
    groups = [[("sheet", sheet)] for sheet in sheets if lines.get(sheet)]
    for keys in (
        PANEL_COLUMNS,
        ("kind",),
        ("kind", "inner_diameter", "lever_arm"),
        ("ground_modulus",),
        ("head_across",),
        ("tested_dip",),
        ("head_eccentricity", "foot_eccentricity", "foot_joint", "efficiency"),
        ("guy_count", "guy_splay"),
        ("guy_anchors",),
        ("design_life",),
        ("mesh_strength", "angle", "count"),
        ("chain",),
        ("ground",),
        ("post_tilt", "post_base_distance"),
        ("uphill_anchor_distance", "downhill_anchor_distance"),
        ("gap", "row_end", "neighbour"),
        MEMBER_COLUMNS,
        ("test_count", "test_least", "test_mean"),
        ("snow_layers",),
        ("axial_stiffness",),
        ("temperature", "snow_layers"),
    ):
        found = [one for one in cells if one[2] in keys]
        if found:
            groups.append(found)
    groups.append([("item", "standard")])
    groups.append([("item", "extrapolated creep law accepted")])
    groups.append([("quantity", "net inclination")])
    return groups


def empty(lines, cells):
    """Lines with some cells left empty; a group may name a sheet or an item."""
    kept = {sheet: [dict(line) for line in table] for sheet, table in lines.items()}
    for cell in cells:
        if cell[0] == "sheet":
            if cell[1] in ("Anchors", "Ropes", "Posts"):
                kept[cell[1]] = [{"id": one["id"]} for one in kept[cell[1]]]
            else:
                kept[cell[1]] = []
        elif cell[0] == "item":
            kept["Project"] = [one for one in kept["Project"] if one["item"] != cell[1]]
        elif cell[0] == "quantity":
            kept["Ranges"] = [
                one for one in kept["Ranges"] if one["quantity"] != cell[1]
            ]
        else:
            sheet, number, key = cell
            if number < len(kept[sheet]):
                kept[sheet][number].pop(key, None)
    return kept


def _round(value, digits=3):
    return float(f"{value:.{digits}g}")


def _draw_ranges(draw):
    density = draw.uniform(330.0, 360.0)
    inclination = _round(draw.choice((draw.uniform(25, 35), draw.uniform(25, 35))))
    friction = _round(draw.uniform(15.0, 44.0))
    yield {
        "quantity": "density",
        "unit": "kg/m3",
        "low": _round(density),
        "high": _round(draw.uniform(375.0, 399.0)),
    }
    yield {
        "quantity": "friction angle",
        "unit": "deg",
        "low": friction,
        "high": friction,
    }
    yield {
        "quantity": "net inclination",
        "unit": "deg",
        "low": inclination,
        "high": inclination,
    }


def _draw_net(draw):
    height = _round(draw.uniform(2.2, 4.4))
    ground = draw.choice(GROUNDS)
    net = {
        "id": "R1",
        "slope_angle": _round(draw.uniform(30.0, 48.0)),
        "snow_thickness": _round(height * draw.uniform(0.72, 1.0) - 0.01),
        "upslope_length": _round(draw.uniform(6.0, 25.0)),
        "ground_law": ground,
        "net_height": height,
        "net_stiffness": _round(draw.uniform(4000.0, 22000.0)),
        "slack": _round(draw.uniform(0.02, 0.1)),
        "post_spacing": _round(draw.uniform(2.4, 4.4)),
        "uphill_anchor_distance": _round(height * draw.uniform(0.76, 1.24)),
        "downhill_anchor_distance": _round(height * draw.uniform(0.76, 1.24)),
        "altitude": _round(draw.uniform(1300.0, 2600.0)),
        "snow_layers": draw.choice(
            ("uniform", "uniform", "layered", "layered with temperatures")
        ),
    }
    if ground == "sliding":
        if draw.random() < 0.5:
            net["glide_factor"] = _round(draw.uniform(1.15, 2.9))
        else:
            net["slip_length"] = _round(draw.uniform(0.4, 6.0))
    if draw.random() < 0.6:
        net["post_tilt"] = _round(draw.uniform(10.0, 20.0))
    else:
        net["post_base_distance"] = _round(draw.uniform(0.2, 0.6) * height)
    net["guy_count"] = draw.choice((1, 2, 2, 2))
    if net["guy_count"] == 2:
        net["guy_splay"] = _round(draw.uniform(10.0, 25.0))
    if draw.random() < 0.6:
        net["anchor_axes"] = "along the pull"
    else:
        axes = ("foot_axis", "uphill_axis", "downhill_axis")
        net |= {key: _round(draw.uniform(12.0, 60.0)) for key in axes}
    end = draw.random()
    if end < 0.2:
        net |= {"row_end": "continuous", "neighbour": "R2, R3"}
    elif end < 0.75:
        gap = draw.choice((0.0, _round(draw.uniform(0.5, 4.0))))
        net |= {"gap": gap} if gap else {}
    net |= {
        "foot_anchor": draw.choice(ANCHORS),
        "uphill_anchor": draw.choice(ANCHORS),
        "downhill_anchor": draw.choice(ANCHORS),
        "uphill_guy": draw.choice(ROPES),
        "downhill_guy": draw.choice(ROPES),
        "post": draw.choice(POSTS),
    }
    return net | _draw_panel(draw)


def _draw_panel(draw):
    system = draw.choice(("none", "rectangular", "rectangular", "triangular", ""))
    if system != "rectangular":
        return {"panel_system": system} if system else {}
    panel = {
        "panel_system": system,
        "net_cut": draw.choice(("uniform", "upper", "fitted")),
        "ridge_rope": draw.choice(ROPES),
        "ridge_sag": _round(draw.uniform(0.08, 0.15)),
        "lower_rope": draw.choice(ROPES),
        "lower_sag": _round(draw.uniform(0.08, 0.15)),
        "mid_anchors": draw.choice(("no", "no", "no")),
    }
    if draw.random() < 0.2:
        del panel[draw.choice(list(panel)[1:])]
    return panel


ANCHORS = ("turning", "solid", "hollow", "tried", "drilled")
ROPES = ("typed", "stranded", "stiff")
POSTS = ("rolled", "plain")


def _draw_anchors(draw):
    scale = draw.uniform(0.8, 4.5)
    ground = draw.choice(("limestone", "gravel"))
    yield {
        "id": "turning",
        "kind": "rope anchor",
        "tendon": _round(330.0 * scale),
        "pull_out": _round(255.0 * scale),
        "loop_efficiency": 0.9,
        "basis": draw.choice(("tested", "computed")),
        "sleeve": "no",
    }
    diameter = _round(draw.uniform(25.0, 57.0))
    bears = 0.25 * math.pi * diameter**2 * 0.5  # [kN]
    yield {
        "id": "solid",
        "kind": "bar",
        "bar_diameter": diameter,
        "bar_strength": 500.0,
        "lever_arm": draw.choice((0.0, _round(draw.uniform(2.0, 60.0)))),
        "pull_out": _round(bears * draw.uniform(0.5, 0.78)),
        "basis": "tested",
    }
    diameter, inner = _round(draw.uniform(52.0, 73.0)), _round(draw.uniform(25.0, 45.0))
    bears = 0.25 * math.pi * (diameter**2 - inner**2) * 0.54  # [kN]
    mean = _round(bears * draw.uniform(0.5, 0.78))
    yield {
        "id": "hollow",
        "kind": "micropile",
        "bar_diameter": diameter,
        "inner_diameter": inner,
        "bar_strength": 540.0,
        "lever_arm": _round(draw.uniform(5.0, 80.0)),
        "test_count": draw.choice((2, 3, 5)),
        "test_least": _round(mean * draw.uniform(0.8, 1.0)),
        "test_mean": mean,
    }
    yield {
        "id": "tried",
        "kind": "rope anchor",
        "tendon": _round(400.0 * scale),
        "test_count": draw.choice((1, 3)),
        "test_least": _round(285.0 * scale),
        "test_mean": _round(310.0 * scale),
    }
    yield {
        "id": "drilled",
        "kind": "rope anchor",
        "tendon": _round(410.0 * scale),
        "drill_diameter": _round(draw.uniform(90.0, 115.0)),
        "bond_length": _round(draw.uniform(2.5, 6.0)),
        "ground": ground,
        "grouting": "A" if ground == "limestone" else "B",
        "sleeve": "no",
    }


def _stand_in_ground(draw, lines):
    """Let the row say its ground; its types have it, too, or lines in two grounds."""
    (net,) = lines["Nets"]
    grounds = [one["ground"] for one in lines["Anchors"] if "ground" in one]
    net["ground"] = grounds[0]
    other = {"limestone": "scree", "gravel": "rock"}[net["ground"]]
    for one in list(lines["Anchors"]):
        if one["id"] == "drilled" and draw.random() < 0.5:
            del one["ground"]  # the row's is that of the bond
        elif one["id"] == "tried":
            one["ground"] = net["ground"]
            lines["Anchors"].append({**one, "ground": other, "test_least": 900.0})
            lines["Anchors"][-1]["test_mean"] = 950.0


def _complete_chain(draw, lines):
    """Let the site say what its grounds, its steel, its links and its mesh are."""
    (net,) = lines["Nets"]
    drilled = next(one for one in lines["Anchors"] if one["id"] == "drilled")
    ground = net.setdefault("ground", drilled.get("ground", "gravel"))
    net["design_life"] = draw.choice((30, 50, 80, 100))
    net["edge_distance"] = _round(draw.uniform(2.0, 40.0))
    net["mesh_strength"] = _round(draw.uniform(90.0, 600.0))
    if net["guy_count"] == 2:
        net["guy_anchors"] = draw.choice(("own", "shared"))
    for one in lines["Anchors"]:
        is_bond = one["id"] == "drilled"
        if not is_bond:
            one.setdefault("ground", ground)
        one["drilled_length"] = _round(draw.uniform(6.0, 9.0))
        one["least_cover"] = _round(draw.uniform(0.6, 1.6))
        one["least_edge"] = _round(draw.uniform(1.7, 4.0))
        if one["kind"] == "rope anchor" or draw.random() < 0.4:
            one["protection"] = draw.choice(("cover", "sheath", "galvanised"))
            one["protected_years"] = draw.choice((40, 100, 100, 120))
        else:
            one["protection"] = draw.choice(("none", "sacrificial"))
            one["soil"] = draw.choice(("natural", "natural", "organic", "fill"))
    for one in lines["Ropes"]:
        one["protected_years"] = draw.choice((60, 100, 100))
    lines["Links"] = list(_draw_links(draw, lines))


def give_strength(draw, lines):
    """Let some anchor types say the strength of their ground, instead of a cover."""
    for one in lines["Anchors"]:
        if "least_cover" in one and draw.random() < 0.5:
            del one["least_cover"]
            one["soil_cohesion"] = _round(draw.uniform(8.0, 48.0))
            one["soil_friction"] = _round(draw.uniform(25.0, 40.0))
            one["soil_weight"] = _round(draw.uniform(17.0, 23.0))
            if draw.random() < 0.5:
                one["soil_water"] = draw.choice(("seepage", "drained"))


def _draw_links(draw, lines):
    """One or two links of nearly every type."""
    names = dict.fromkeys(one["id"] for one in (*lines["Anchors"], *lines["Ropes"]))
    for name in names:
        is_whole = random.Random(f"{name} {lines['Nets'][0]}").random() < 0.8
        for _ in range(draw.choice((0, 1, 1, 1, 2, 2))):
            link = {"type": name, "link": draw.choice(("shackle", "eye", "plate"))}
            key = draw.choice(("strength", "working_limit"))
            link[key] = _round(draw.uniform(180.0, 900.0))
            if draw.random() < 0.4:
                link["count"] = draw.choice((1, 2))
            if link["link"] == "shackle" and draw.random() < 0.6:
                link["angle"] = _round(draw.uniform(0.0, 60.0))
            yield link | ({"chain": "complete"} if is_whole else {})


def _test_one_by_one(lines):
    """Tests of a type on sheet Tests, in the place of their number, least and mean."""
    shares = ((1.0, "pulled out"), (1.1, "held"), (1.2, "pulled out"))
    lines["Tests"] = []
    for tried in (one for one in lines["Anchors"] if one["id"] == "tried"):
        least = tried.pop("test_least")
        del tried["test_count"], tried["test_mean"]
        ground = {"ground": tried["ground"]} if "ground" in tried else {}
        lines["Tests"] += [
            {"type": "tried", "force": _round(share * least), "result": result} | ground
            for share, result in shares
        ]


def _draw_ropes(draw):
    yield {
        "id": "typed",
        "rope": 250.0,
        "termination": "included",
        "axial_stiffness": _round(draw.uniform(11500.0, 31000.0)),
    }
    yield {
        "id": "stranded",
        "rope_diameter": _round(draw.uniform(18.0, 26.0)),
        "construction": "6x19-IWRC",
        "grade": 1770.0,
        "termination": draw.choice(("clips", "swaged")),
    }
    yield {
        "id": "stiff",
        "rope": 470.0,
        "termination": "included",
        "axial_stiffness": _round(draw.uniform(21500.0, 58000.0)),
    }


def _draw_posts(draw):
    yield {
        "id": "rolled",
        "area": 65.3,
        "second_moment": 3831.0,
        "buckling_length": 5.4,
        "yield_strength": 235.0,
        "buckling_curve": draw.choice(("b", "c")),
        "post_width": 180.0,
        "section_modulus": 425.7,
        "base_friction": _round(draw.uniform(0.35, 0.7)),
        "plate_length": 0.4,
        "plate_width": 0.4,
        "bearing_stress": _round(draw.uniform(1500.0, 6000.0)),
    }
    yield {
        "id": "plain",
        "compression": _round(draw.uniform(250.0, 900.0)),
        "bearing": _round(draw.uniform(200.0, 900.0)),
        "sliding": _round(draw.uniform(60.0, 300.0)),
    }


def _say_more(draw, lines):
    """Ends of a post, its line load, ground at a bore; none worse than assumed."""
    post, anchors = lines["Posts"][0], lines["Anchors"]
    for key, value in (
        ("head_eccentricity", draw.choice((0.0, 25.0, 90.0))),
        ("foot_joint", draw.choice(("hinge", "ball", "plate"))),
        ("foot_eccentricity", 0.0),
        ("efficiency", 1.0),
    ):
        if draw.random() < 0.6:
            post[key] = value
    for one in anchors:
        if one.get("kind") in ("bar", "micropile") and draw.random() < 0.5:
            one["ground_modulus"] = _round(draw.uniform(500.0, 5000.0))
        elif one.get("kind") == "rope anchor" and draw.random() < 0.5:
            one["head_across"] = _round(draw.uniform(40.0, 900.0))
        if draw.random() < 0.4:
            one["tested_dip"] = _round(draw.uniform(-14.0, 40.0))


def _draw_ends(draw, net):
    if net.get("row_end") == "continuous" or draw.random() < 0.15:
        return []
    line = {
        "row": "R1",
        "lateral_anchor": draw.choice(ANCHORS),
        "end_guy": draw.choice(ROPES),
        "end_guy_anchor": draw.choice(ANCHORS),
        "end_guy_angle": _round(draw.uniform(30.0, 45.0)),
    }
    own = random.Random(f"lateral anchor {line['end_guy_angle']}")
    line["lateral_distance"] = _round(own.uniform(1.4, 3.0))
    line["lateral_axis"] = _round(own.uniform(15.0, 60.0))
    if net.get("panel_system") == "none":
        line = {"row": "R1"}
    if draw.random() < 0.6:
        return [line | {"support_types": "as inside"}]
    for key in MEMBER_COLUMNS:
        if draw.random() < 0.9:
            names = ANCHORS if "anchor" in key else ROPES if "guy" in key else POSTS
            line[key] = draw.choice(names)
    return [line]


def _draw_snow(draw, net):
    if net["snow_layers"] == "uniform":
        return []
    has_temperatures = "temperatures" in net["snow_layers"]
    count = draw.choice((2, 3))
    shares = [draw.uniform(0.6, 1.4) for _ in range(count)]
    total = net["snow_thickness"]
    found = []
    for number, share in enumerate(shares, start=1):
        line = {
            "row": "R1",
            "layer": number,
            "thickness": round(total * share / sum(shares), 3),
            "density": _round(430.0 - 90.0 * number + draw.uniform(-20.0, 20.0)),
        }
        if has_temperatures:
            line["temperature"] = _round(draw.uniform(-9.0, -0.5))
        found.append(line)
    mean = sum(one["thickness"] * one["density"] for one in found) / total
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
