"""Lines of the sheets of types as sheets Anchors, Parts and Tests of the workbook."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from netdesign.site.columns.fields import from_si
from netdesign.site.office.rewrite_rows import Line, Lines
from netdesign.site.office.told import Told, copy_cells, show
from netdesign.site.readings import Reading, Row
from netdesign.site.type_resistances import compute_tendon
from netdesign.structure.row_position import find_dip
from netdesign.words.message import Message, say

_OF_ANCHOR = (
    *("id", "kind", "tendon", "bar_diameter", "ground", "drill_diameter"),
    *("drilled_length", "bond_length", "tube_diameter", "tube_wall", "head_across"),
    *("lever_arm", "protection"),
)
_OF_ROPE = ("id", "rope", "termination", "axial_stiffness")
_OF_POST = (
    *("id", "yield_strength", "area", "second_moment", "section_modulus"),
    *("post_width", "buckling_curve", "buckling_length", "head_eccentricity"),
    *("bearing", "foot_tension"),
)
_SOIL = ("soil_cohesion", "soil_friction", "soil_weight", "soil_water")
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


def rewrite_types(lines: Lines, told: Told) -> dict[str, list[Line]]:
    """Tables of types, and those of sheet Project that hold for all of them."""
    made: dict[str, list[Line]] = {
        "anchor_types": [_rewrite_anchor(one, told) for one in lines["Anchors"]],
        "ropes": [copy_cells(one, _OF_ROPE, told) for one in lines["Ropes"]],
        "posts": [_rewrite_post(one, told) for one in lines["Posts"]],
        "links": [_rewrite_link(one, told) for one in lines["Links"]],
        "soils": _list_soils(lines["Anchors"], told),
        "tests": [_copy_whole(one, told) for one in lines["Tests"]],
        "layers": [_rewrite_layer(one, told) for one in lines["Snow"]],
    }
    _add_dips(made["anchor_types"], lines["Nets"], told)
    _add_end_types(made, lines, told)
    made["project"] = [_find_common(lines, told)]
    return made


def _copy_whole(line: Row, told: Told) -> Line:
    keys = [key for key in line if key != "anchor"]
    return copy_cells(line, keys, told)


def _rewrite_anchor(line: Row, told: Told) -> Line:
    made = copy_cells(line, _OF_ANCHOR, told) | _rewrite_proof(line, told)
    steel = (line["bar_diameter"], line["bar_strength"], line["inner_diameter"])
    tendon = compute_tendon(line, [])["tendon"]
    if tendon.derivation is not None:
        made["tendon"] = float(f"{tendon.number:.5g}")
        told.do(say("rewrite.computed", name=tendon.field.name), *steel)
    if line["sleeve"].word == "no":
        told.take(line["sleeve"])
    return made


def _rewrite_proof(line: Row, told: Told) -> Line:
    """Pull-out resistance with how it is proven."""
    least = line["test_least"]
    if least.state == "given":
        told.do(say("rewrite.tests"), least)
        told.take(line["basis"])
        counted = copy_cells(line, ("test_count", "test_mean"), told)
        return {"pull_out": show(least), "proven": "tests", **counted}
    force, basis = line["pull_out"], line["basis"]
    if force.state == "blank":
        return {}
    made: Line = {"pull_out": show(force)}
    told.take(force, basis)
    return {**made, "proven": _BASES[basis.word]} if basis.word else made


def _rewrite_post(line: Row, told: Told) -> Line:
    made = copy_cells(line, _OF_POST, told)
    if line["section"].state == "given":
        made["id"] = line["id"].word or line["section"].word
    feet = (line["foot_eccentricity"], line["head_eccentricity"])
    if feet[0].state == "given" and feet[0].value == feet[1].value:
        told.take(feet[0])
    return made


def _rewrite_link(line: Row, told: Told) -> Line:
    made = copy_cells(line, ("type", "link", "count", "angle", "chain"), told)
    for key, meaning in (("strength", "strength"), ("working_limit", "limit")):
        if line[key].state != "blank":
            told.take(line[key])
            made |= {"force": show(line[key]), "meaning": meaning}
    return made


def _rewrite_layer(line: Row, told: Told) -> Line:
    made = copy_cells(line, ("row", "layer", "density", "temperature"), told)
    for key in ("thickness", "height"):
        if line[key].state != "blank":
            told.take(line[key])
            made["thickness"] = show(line[key])
    return made


def _list_soils(lines: Iterable[Row], told: Told) -> list[Line]:
    """Strengths of grounds, of the types in them; the first of a ground counts."""
    found: dict[str, Line] = {}
    for line in lines:
        given = {key: line[key] for key in _SOIL if line[key].state == "given"}
        values = {key: show(one) for key, one in given.items()}
        ground = line["ground"].word
        if not given or not ground:
            continue
        known = found.setdefault(ground, {"ground": ground, **values})
        if known == {"ground": ground, **values}:
            told.do(say("rewrite.soil"), *given.values())
    return list(found.values())


def _add_dips(types: list[Line], nets: Sequence[Row], told: Told) -> None:
    """Dips of bores by anchor type, where the axes of all rows give one."""
    found: dict[str, dict[float, list[Reading]]] = {}
    for line in nets:
        for member, key in _AXES.items():
            axis, slope = line[key], line["slope_angle"]
            if axis.state == slope.state == "given" and line[member].word:
                dip = round(from_si(find_dip(axis.si, slope.si, member), "deg"), 1)
                of_type = found.setdefault(line[member].word, {})
                of_type.setdefault(dip, []).append(axis)
    for name, dips in found.items():
        flattest = min(dips)
        if not _FLATTEST <= flattest <= _UPRIGHT:
            continue
        for one in types:
            if one.get("id") == name:
                one["dip"] = flattest
        for dip, axes in dips.items():
            key = "rewrite.dip" if dip == flattest else "rewrite.flattest"
            told.do(say(key), *axes)


def _add_end_types(made: dict[str, list[Line]], lines: Lines, told: Told) -> None:
    """Types that stand at the row's end in the place of those inside."""
    nets = {one["id"].word: one for one in lines["Nets"]}
    for end in lines["Ends"]:
        rows = [nets[end["row"].word]] if end["row"].word in nets else nets.values()
        for table, keys in _AT_END.items():
            for key in keys:
                _add_end_type(made[table], end[key], [one[key] for one in rows], told)


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
                told.leave(there, say("rewrite.other_end"))


def _find_common(lines: Lines, told: Told) -> Line:
    """What sheet Project says once: where all lines say the same, else the worse."""
    found: Line = {}
    for key, sheet, column, pick in (
        ("design_life", "Nets", "design_life", max),
        ("base_friction", "Posts", "base_friction", min),
    ):
        given = [one[column] for one in lines[sheet] if one[column].state == "given"]
        if given:
            found[key] = pick(one.number for one in given)
            told.do(_say_common(given), *given)
    soils = [one["soil"] for one in lines["Anchors"] if one["soil"].state == "given"]
    if soils and len({one.word for one in soils}) == 1:
        found["soil"] = soils[0].word
        told.do(_say_common(soils), *soils)
    return found


def _say_common(given: Sequence[Reading]) -> Message:
    is_one = len({one.value for one in given}) == 1
    key = "rewrite.once" if is_one else "rewrite.worst_once"
    return say(key, name=given[0].field.name)
