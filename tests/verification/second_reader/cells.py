"""Cells of a row as the script needs them, from the tables of the input workbook."""

import math
from dataclasses import dataclass

MEMBERS = {
    "anchor_types": ("foot_anchor", "uphill_anchor", "downhill_anchor"),
    "ropes": ("uphill_guy", "downhill_guy"),
    "posts": ("post",),
}
PERCENT = ("slack", "ridge_sag", "lower_sag")
BASES = {"tests": "tested", "calculated": "computed"}


@dataclass
class Cells:
    """Lines of the workbook by what they are of; quantities that range."""

    lines: dict
    ranges: dict

    def find(self, kind, key, name):
        found = [one for one in self.lines.get(kind, []) if one.get(key) == name]
        return found[0] if found else {}


def join_tables(tables):
    """Cells of tables whose snow is normal to the slope, and whose slack is one."""
    (project,) = tables["project"]
    nets = [join_net(tables, project, row) for row in tables["rows"]]
    lines = {
        "Nets": nets,
        "Ends": [join_end(tables, net) for net in nets],
        "Anchors": [join_anchor(tables, project, x) for x in tables["anchor_types"]],
        "Ropes": tables["ropes"],
        "Posts": [join_post(project, one) for one in tables["posts"]],
        "Links": [join_link(one) for one in tables["links"]],
    }
    names = ("density", "friction_angle", "inclination")
    return Cells(lines, {name: read_range(project[name]) for name in names})


def read_range(cell):
    ends = [float(end) for end in str(cell).split(" to ")]
    return ends[0], ends[-1]


def join_net(tables, project, row):
    (net,) = (one for one in tables["net_types"] if one["id"] == row["net_type"])
    line = {**net, **row, "snow_thickness": row["snow"]}
    line |= {key: net[key] / 100.0 for key in PERCENT}
    for member in MEMBERS["anchor_types"]:
        (kind,) = (x for x in tables["anchor_types"] if x["id"] == row[member])
        if "dip" in kind:
            slope = row["slope_angle"] * (-1.0 if "downhill" in member else 1.0)
            line[member.replace("_anchor", "_axis")] = kind["dip"] + slope
    return line | {"design_life": project["design_life"]}


def join_end(tables, net):
    """The row's end: its anchor is the lateral one and that of the end guy."""
    line = {"row": net["id"]}
    line |= {
        key: net[key]
        for key in ("end_guy", "end_guy_angle", "ropes_at_supports")
        if key in net
    }
    line |= dict.fromkeys(("lateral_anchor", "end_guy_anchor"), net["end_anchor"])
    (kind,) = (x for x in tables["anchor_types"] if x["id"] == net["end_anchor"])
    if "dip" in kind:
        slope = math.radians(net["slope_angle"])
        steep = math.sin(math.radians(kind["dip"])) / math.cos(slope)
        line["lateral_axis"] = math.degrees(math.asin(steep))
    for table, members in MEMBERS.items():
        others = {one["id"]: one["at_end"] for one in tables[table] if "at_end" in one}
        line |= {member: others.get(net[member], net[member]) for member in members}
    return line


def join_anchor(tables, project, kind):
    """Type with its steel by force and diameter, its tests, and its ground's soil."""
    line = {**kind, "soil": project["soil"]}
    if "bar_diameter" in kind:
        area = math.pi / 4.0 * kind["bar_diameter"] ** 2  # [mm2]
        line["bar_strength"] = 1e3 * kind["tendon"] / area
    if "proven" in kind:
        line["basis"] = BASES[kind["proven"]]
    if kind.get("proven") == "tests":
        line["test_least"] = kind["pull_out"]
    for soil in tables.get("soils", ()):
        if soil["ground"] == kind["ground"]:
            line |= soil
    return line


def join_post(project, post):
    line = {**post, "base_friction": project["base_friction"]}
    if "head_eccentricity" in post:  # of head and foot
        line["foot_eccentricity"] = post["head_eccentricity"]
    return line


def join_link(link):
    key = {"strength": "strength", "limit": "working_limit"}[link["meaning"]]
    return {**link, key: link["force"]}
