"""Lines of a workbook of version 0.1 as rows, net types, anchors and parts."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping, Sequence

from netdesign.site.columns.fields import from_si
from netdesign.site.office.told import Line, Told, copy_line, is_typed, show
from netdesign.site.readings import Reading, Row
from netdesign.site.titles import name_net_type
from netdesign.site.type_resistances import compute_tendon
from netdesign.structure.row_position import find_dip
from netdesign.words.message import say

Lines = Mapping[str, Sequence[Row]]  # by sheet
_RANGED_OF_NET = ("slack", "net_stiffness")
_AXES = {
    "foot_anchor": "foot_axis",
    "uphill_anchor": "uphill_axis",
    "downhill_anchor": "downhill_axis",
}
_AT_END = {
    "anchor_types": ("foot_anchor", "uphill_anchor", "downhill_anchor"),
    "ropes": ("uphill_guy", "downhill_guy"),
    "posts": ("post",),
}
_FLATTEST, _UPRIGHT = -30.0, 90.0  # dips that a cell takes [deg]
_BASES = {"tested": "tests", "report": "report", "computed": "calculated"}


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
    measure = _choose_measure(lines["Nets"], ranged)
    ends = {one["row"].word: one for one in lines["Ends"]}
    types: dict[str, Line] = {}
    named: dict[Hashable, str] = {}
    rows: list[Line] = []
    for line in lines["Nets"]:
        end = ends.get(line["id"].word, ends.get("all"))
        row = copy_line("rows", line, "Nets", told, ("snow", "glide_factor", "gap"))
        row |= _rewrite_snow(line, ranged, measure, told)
        row |= _rewrite_ground(line, ranged, told) | _rewrite_gap(line, told)
        net = copy_line("net_types", line, "Nets", told, ("id",))
        net |= {key: ranged[key] for key in _RANGED_OF_NET if key in ranged}
        if "upslope_length" in ranged:
            row["upslope_length"] = ranged["upslope_length"]
        if end is not None:
            row |= _rewrite_end(end, told)
            net |= copy_line("net_types", end, "Ends", told)
        height = net.get("net_height", "")
        shown = f"{height:g}" if isinstance(height, float) else str(height)
        name = name_net_type(shown, repr(sorted(net.items())), named)
        types.setdefault(name, {"id": name, **net})
        rows.append({**row, "net_type": name})
    measures = {("rows", "snow"): measure, ("net_types", "slack"): "slack"}
    has_heights = any(is_typed(one["height"]) for one in lines["Snow"])
    measures["layers", "thickness"] = "vertical" if has_heights else "normal"
    return {"rows": rows, "net_types": list(types.values())}, measures


def _choose_measure(nets: Sequence[Row], ranged: Mapping[str, str]) -> str:
    """Measure of the snow column: that of a range, else of most rows."""
    if "snow_height" in ranged or "thickness" in ranged:
        return "vertical" if "snow_height" in ranged else "normal"
    keys = ("snow_height", "snow_thickness")
    heights, sizes = (sum(one[key].state == "given" for one in nets) for key in keys)
    return "vertical" if heights >= sizes else "normal"


def _rewrite_snow(
    line: Row, ranged: Mapping[str, str], measure: str, told: Told
) -> Line:
    told.take(line["snow_layers"])  # sheet Snow says it
    for key in ("snow_height", "thickness"):
        if key in ranged:
            return {"snow": ranged[key]}
    is_vertical = measure == "vertical"
    keys = ("snow_height", "snow_thickness")
    given, other = (line[key] for key in (keys if is_vertical else reversed(keys)))
    if is_typed(given):
        told.take(given)
        told.do(say("rewrite.one_height"), other)
        return {"snow": show(given)}
    slope = line["slope_angle"]
    if other.state != "given" or slope.state != "given":
        return {}
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
    return {"glide_factor": show(glide)} if is_typed(glide) else {}


def _rewrite_gap(line: Row, told: Told) -> Line:
    """Gap of a row, or the rows that it runs into."""
    gap, said, neighbour = line["gap"], line["row_end"], line["neighbour"]
    if said.word == "continuous" and neighbour.word:
        told.do(say("rewrite.into"), said, neighbour)
        return {"gap": f"into {neighbour.word.replace(';', ',')}"}
    told.take(gap, said)
    return {"gap": show(gap)} if is_typed(gap) else {}


def _rewrite_end(end: Row, told: Told) -> Line:
    """Anchor of a row's end: the lateral one, else that of the end guy."""
    told.take(end["row"], end["support_types"])
    anchors = [end[key] for key in ("lateral_anchor", "end_guy_anchor")]
    named = [one for one in anchors if one.word]
    told.do(say("rewrite.end_anchor"), *(x for x in named if x.word == named[0].word))
    return {"end_anchor": named[0].word} if named else {}


def rewrite_types(lines: Lines, told: Told) -> dict[str, list[Line]]:
    """Tables of types, tests and layers."""
    made = {
        "anchor_types": [_rewrite_anchor(one, told) for one in lines["Anchors"]],
        "ropes": [copy_line("ropes", one, "Ropes", told) for one in lines["Ropes"]],
        "posts": [_rewrite_post(one, told) for one in lines["Posts"]],
        "links": [_rewrite_link(one, told) for one in lines["Links"]],
        "soils": _list_soils(lines["Anchors"], told),
        "tests": [copy_line("tests", one, "Tests", told) for one in lines["Tests"]],
        "layers": [_rewrite_layer(one, told) for one in lines["Snow"]],
    }
    _add_dips(made["anchor_types"], lines["Nets"], told)
    nets = {one["id"].word: one for one in lines["Nets"]}
    for end in lines["Ends"]:
        rows = [nets[end["row"].word]] if end["row"].word in nets else nets.values()
        for table, keys in _AT_END.items():
            for key in keys:
                _add_end_type(made[table], end[key], [one[key] for one in rows], told)
    return made


_PROOF = ("pull_out", "test_count", "test_mean")


def _rewrite_anchor(line: Row, told: Told) -> Line:
    anchor = copy_line("anchor_types", line, "Anchors", told, ("dip", *_PROOF))
    steel = (line["bar_diameter"], line["bar_strength"], line["inner_diameter"])
    tendon = compute_tendon(line, [])["tendon"]
    if tendon.derivation is not None:
        anchor["tendon"] = float(f"{tendon.number:.5g}")
        told.do(say("rewrite.computed", name=tendon.field.name), *steel)
    return anchor | _rewrite_proof(line, told)


def _rewrite_proof(line: Row, told: Told) -> Line:
    """Pull-out resistance with how it is proven."""
    least, force, basis = (line[key] for key in ("test_least", "pull_out", "basis"))
    if least.state == "given":
        told.do(say("rewrite.tests"), least)
        told.take(basis)
        counted = {one: line[one] for one in _PROOF[1:] if is_typed(line[one])}
        told.take(*counted.values())
        shown = {key: show(one) for key, one in counted.items()}
        return {"pull_out": show(least), "proven": "tests", **shown}
    if not is_typed(force):
        return {}
    told.take(force, basis)
    proven = {"proven": _BASES[basis.word]} if basis.word else {}
    return {"pull_out": show(force), **proven}


def _rewrite_post(line: Row, told: Told) -> Line:
    post = copy_line("posts", line, "Posts", told)
    section = line["section"]
    return {"id": section.word, **post} if section.word else post


def _rewrite_link(line: Row, told: Told) -> Line:
    link = copy_line("links", line, "Links", told, ("force",))
    for key, meaning in (("strength", "strength"), ("working_limit", "limit")):
        if is_typed(line[key]):
            told.take(line[key])
            link |= {"force": show(line[key]), "meaning": meaning}
    return link


def _rewrite_layer(line: Row, told: Told) -> Line:
    layer = copy_line("layers", line, "Snow", told)
    if is_typed(line["height"]):
        told.take(line["height"])
        layer["thickness"] = show(line["height"])
    return layer


def _list_soils(lines: Iterable[Row], told: Told) -> list[Line]:
    """Strengths of grounds, of the types in them; the first of a ground counts."""
    soils: dict[object, Line] = {}
    for line in lines:
        cells = [one for key, one in line.items() if key.startswith("soil_")]
        if not line["ground"].word or not any(map(is_typed, cells)):
            continue
        soil = copy_line("soils", line, "Anchors", Told())
        if soils.setdefault(soil["ground"], soil) == soil:
            told.do(say("rewrite.soil"), *cells)
    return list(soils.values())


def _add_dips(types: list[Line], nets: Sequence[Row], told: Told) -> None:
    """Dips of bores by anchor type, where the axes of all rows give one."""
    dips: dict[str, dict[float, list[Reading]]] = {}
    for line in nets:
        for member, key in _AXES.items():
            axis, slope = line[key], line["slope_angle"]
            if axis.state == slope.state == "given" and line[member].word:
                dip = round(from_si(find_dip(axis.si, slope.si, member), "deg"), 1)
                of_type = dips.setdefault(line[member].word, {})
                of_type.setdefault(dip, []).append(axis)
    for name, by_dip in dips.items():
        flattest = min(by_dip)
        if not _FLATTEST <= flattest <= _UPRIGHT:
            continue
        for one in types:
            if one.get("id") == name:
                one["dip"] = flattest
        for dip, axes in by_dip.items():
            key = "rewrite.dip" if dip == flattest else "rewrite.flattest"
            told.do(say(key), *axes)


def _add_end_type(
    types: list[Line], there: Reading, inside: Sequence[Reading], told: Told
) -> None:
    """One member's type at the end, beside those inside the rows that it is of."""
    for one in inside:
        if not there.word or there.word == one.word:
            told.take(there)
            continue
        for line in types:
            if line.get("id") != one.word:
                continue
            if line.setdefault("at_end", there.word) == there.word:
                told.do(say("rewrite.at_end"), there)
            else:
                told.leave("rewrite.other_end", there)
