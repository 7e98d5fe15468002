"""Lines of sheet Nets and Ends as rows and net types of the input workbook."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from netdesign.site.columns.fields import from_si
from netdesign.site.office.told import Told, copy_cells, show
from netdesign.site.readings import Reading, Row
from netdesign.words.message import say

Lines = Mapping[str, Sequence[Row]]
Line = dict[str, object]
_AS_IT_IS = (
    *("id", "slope_angle", "upslope_length", "post_count", "altitude", "post_spacing"),
    *("foot_anchor", "uphill_anchor", "downhill_anchor", "ground"),
)
_OF_NET = (
    *("net_height", "slack", "post_tilt", "guy_count", "guy_splay"),
    *("uphill_anchor_distance", "downhill_anchor_distance", "guy_anchors"),
    *("mid_anchors", "net_stiffness", "ridge_sag", "lower_sag", "mesh_strength"),
    *("ridge_rope", "lower_rope", "uphill_guy", "downhill_guy", "post"),
)
_PERCENT = ("slack", "ridge_sag", "lower_sag")  # that the new workbook has in per cent
_RANGED_OF_NET = ("slack", "net_stiffness")
_INCLINATIONS = (25.0, 35.0)  # of a net, from which a tilt follows [deg]
_STEEPEST_POST = 45.0  # tilt that a cell takes [deg]


def rewrite_rows(
    lines: Lines, ranged: Mapping[str, str], told: Told
) -> tuple[dict[str, list[Line]], dict[tuple[str, str], str]]:
    """Rows and net types, and what their unit cells say.

    Parameters
    ----------
    lines : mapping of str to sequence of Row
        By sheet.
    ranged : mapping of str to str
        Ranges of the whole site, as texts of cells.
    told : Told
        What becomes of each cell.
    """
    nets = lines["Nets"]
    sizes = [
        sum(one[key].state == "given" for one in nets)
        for key in ("snow_height", "snow_thickness")
    ]
    is_vertical = "snow_height" in ranged or (
        "thickness" not in ranged and sizes[0] >= sizes[1]
    )
    ends = {one["row"].word: one for one in lines["Ends"]}
    every = ends.get("all")
    types: dict[tuple[object, ...], Line] = {}
    rows: list[Line] = []
    for line in nets:
        end = ends.get(line["id"].word, every)
        row = copy_cells(line, _AS_IT_IS, told)
        row |= _rewrite_snow(line, ranged, told, is_vertical=is_vertical)
        row |= _rewrite_ground(line, ranged, told)
        row |= _rewrite_end(line, end, told)
        row |= _count_posts(line, told)
        if "upslope_length" in ranged:
            row["upslope_length"] = ranged["upslope_length"]
        net = _rewrite_net(line, end, ranged, told)
        row["net_type"] = _name_type(net, types)
        rows.append(row)
    measures = {
        ("rows", "snow"): "vertical" if is_vertical else "normal",
        ("net_types", "slack"): "slack",
    }
    return {"rows": rows, "net_types": list(types.values())}, measures


def _name_type(net: Line, types: dict[tuple[object, ...], Line]) -> str:
    """Id of the net type with these values; rows with the same share one."""
    key = tuple(sorted((name, str(value)) for name, value in net.items()))
    if key not in types:
        height = net.get("net_height", "")
        same = sum(one.get("net_height") == height for one in types.values())
        letter = f" {chr(ord('a') + same)}" if same else ""
        text = f"{height:g}" if isinstance(height, float) else f"{height}"
        types[key] = {"id": f"D_K {text}{letter}", **net}
    return str(types[key]["id"])


def _rewrite_snow(
    line: Row, ranged: Mapping[str, str], told: Told, *, is_vertical: bool
) -> Line:
    vertical, normal, slope = (
        line[key] for key in ("snow_height", "snow_thickness", "slope_angle")
    )
    told.take(line["snow_layers"])  # sheet Snow says it
    for key in ("snow_height", "thickness"):
        if key in ranged:
            return {"snow": ranged[key]}
    given, other = (vertical, normal) if is_vertical else (normal, vertical)
    if given.state != "blank":
        told.take(given)
        told.do(say("rewrite.one_height"), other)
        return {"snow": show(given)}
    if other.state != "given" or slope.state != "given":
        return copy_cells({"snow": other}, ["snow"], told)
    told.do(say("rewrite.turned"), other)
    factor = math.cos(slope.si)
    return {"snow": round(other.si / factor if is_vertical else other.si * factor, 4)}


def _rewrite_ground(line: Row, ranged: Mapping[str, str], told: Told) -> Line:
    law, glide = line["ground_law"], line["glide_factor"]
    if law.word == "free":
        told.do(say("rewrite.glide_cell"), law)
        return {"glide_factor": "free"}
    if law.word == "no-slip":
        told.do(say("rewrite.no_slip"), law)
        return {"glide_factor": 1.0}
    told.take(law, glide)
    if "glide_factor" in ranged:
        return {"glide_factor": ranged["glide_factor"]}
    return {"glide_factor": show(glide)} if glide.state != "blank" else {}


def _rewrite_end(line: Row, end: Row | None, told: Told) -> Line:
    """Gap or neighbours of a row, and the anchor of its end."""
    found: Line = {}
    gap, said, neighbour = line["gap"], line["row_end"], line["neighbour"]
    if said.word == "continuous" and neighbour.word:
        told.do(say("rewrite.into"), said, neighbour)
        named = neighbour.word.replace(";", ",")
        found["gap"] = f"into {named}"
    else:
        told.take(gap, said)
        found |= {"gap": show(gap)} if gap.state != "blank" else {}
    if end is None:
        return found
    anchors = (end["lateral_anchor"], end["end_guy_anchor"])
    named_anchors = [one for one in anchors if one.word]
    if named_anchors:
        found["end_anchor"] = named_anchors[0].word
        told.do(say("rewrite.end_anchor"), named_anchors[0])
        if named_anchors[-1].word == named_anchors[0].word:
            told.take(*named_anchors)
    told.take(end["row"], end["support_types"])
    return found


def _count_posts(line: Row, told: Told) -> Line:
    """Number of posts of a row of which only the length is given."""
    length, spacing = line["row_length"], line["post_spacing"]
    if length.state != "given":
        return {}
    told.do(say("rewrite.posts"), length)
    if line["post_count"].state != "blank" or spacing.state != "given":
        return {}
    return {"post_count": 1.0 + math.ceil(length.si / spacing.si - 0.02)}


def _rewrite_net(
    line: Row, end: Row | None, ranged: Mapping[str, str], told: Told
) -> Line:
    net = copy_cells(line, _OF_NET, told)
    for key in _PERCENT:
        value = net.get(key)
        if isinstance(value, float):
            net[key] = round(100.0 * value, 8)
    for key in _RANGED_OF_NET:
        if key in ranged:
            net[key] = ranged[key]
    if end is not None:
        net |= copy_cells(end, ("end_guy", "end_guy_angle", "ropes_at_supports"), told)
    if line["panel_system"].word == "rectangular":
        told.take(line["panel_system"])
    if line["anchor_axes"].word:
        told.take(line["anchor_axes"])  # an empty cell says so
    if line["row_above"].word == "alike":
        told.take(line["row_above"])
    return net | _rewrite_base(line, told)


def _rewrite_base(line: Row, told: Told) -> Line:
    """Tilt of a post whose base is given; a cell holds no range across zero."""
    base, height = line["post_base_distance"], line["net_height"]
    if base.state != "given" or height.state != "given":
        return {}
    low, high = _find_tilts(base, height)
    if low < 0.0:
        return {}
    told.do(say("rewrite.tilt"), base)
    return {"post_tilt": f"{low:.1f} to {high:.1f}"}


def _find_tilts(base: Reading, height: Reading) -> tuple[float, float]:
    """Least and largest tilt of a post whose base is given, over net inclinations."""
    tilts = [
        from_si(math.atan(math.tan(math.radians(one)) - base.si / height.si), "deg")
        for one in _INCLINATIONS
    ]
    return min(tilts), min(max(tilts), _STEEPEST_POST)
