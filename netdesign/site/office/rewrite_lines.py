"""Lines of a workbook of version 0.1 as rows, net types, anchors and parts.

A log ticks off each filled cell, so that none is lost silently.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from netdesign.outcome import ModelError
from netdesign.resistance.steel import RoundSection
from netdesign.site.cells.findings import quote, shorten
from netdesign.site.columns.fields import from_si
from netdesign.site.columns.office import load_columns
from netdesign.site.readings import Reading, Row
from netdesign.site.titles import name_net_type
from netdesign.site.type_resistances import SOLID
from netdesign.structure.row_position import find_dip
from netdesign.words.message import Message, say

Line = dict[str, object]  # of the new workbook, by key
Lines = Mapping[str, Sequence[Row]]  # of the old one, by sheet
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


_MOST_PLACES = 3  # named in a line


@dataclass(frozen=True, slots=True)
class RewriteLog:
    """Log of a rewriting: which cells are ticked off, and what was done with them.

    Attributes
    ----------
    ticked : set of str
        Places of the cells that need no further word.
    done : dict of Message to list of str
        Places of the cells that were changed or left out, by what was done.
    """

    ticked: set[str] = field(default_factory=set)
    done: dict[Message, list[str]] = field(default_factory=dict)

    def tick(self, *readings: Reading) -> None:
        """Tick off cells that stand in the new workbook as they are."""
        self.ticked.update(reading.place for reading in readings)

    def change(self, change: Message, *readings: Reading) -> None:
        """Tick off cells that stand there in another form, and note how."""
        typed = [reading for reading in readings if is_typed(reading)]
        self.tick(*typed)
        if typed:
            self.done.setdefault(change, []).extend(reading.place for reading in typed)

    def leave(self, key: str, *readings: Reading) -> None:
        """Tick off cells that are not copied, and note why."""
        for reading in filter(is_typed, readings):
            self.tick(reading)
            reason = say(key, name=reading.field.name)
            text = quote(reading.cell.text) if reading.cell else ""
            self.done.setdefault(reason, []).append(f"{reading.place} = {text}")

    def leave_rest(self, lines: Iterable[Row]) -> None:
        """Note all cells of a sheet that are not ticked off."""
        for line in lines:
            rest = (
                reading for reading in line.values() if reading.place not in self.ticked
            )
            self.leave("rewrite.left", *rest)

    def list_done(self) -> Iterator[Message]:
        """What was done, each kind once, with its first cells."""
        for change, places in self.done.items():
            distinct = list(dict.fromkeys(places))
            yield say(
                "rewrite.done", how=change, places=shorten(distinct, _MOST_PLACES)
            )


def is_typed(reading: Reading) -> bool:
    """Whether something stands in the cell."""
    return reading.cell is not None and not reading.cell.is_blank


def show(reading: Reading) -> object:
    """Value of a cell in the first unit of its column; as typed if it is none."""
    return reading.text if reading.value is None else reading.value


def copy_line(
    table: str, line: Row, sheet: str, log: RewriteLog, skip: Collection[str] = ()
) -> Line:
    """Copy the cells of a line that a table of the new workbook has, too.

    Parameters
    ----------
    table : str
        Table of the new workbook.
    line, sheet : Row, str
        Line of the old workbook, and its sheet.
    log : RewriteLog
        The cells are ticked off in it.
    skip : collection of str
        Keys of the columns that are left out.
    """
    copied: Line = {}
    for column in load_columns(table):
        key, (place, _, old) = column.field.key, column.like.rpartition(".")
        is_other = place != sheet or old not in line or key in skip
        if is_other or not is_typed(line[old]):
            continue
        log.tick(line[old])
        value = show(line[old])
        is_share = column.unit == "%" or column.choice == "sag_unit"
        if is_share and isinstance(value, float):
            value = round(100.0 * value, 8)
        copied[key] = value
    return copied


def rewrite_rows(
    lines: Lines, ranged: Mapping[str, str], log: RewriteLog
) -> tuple[dict[str, list[Line]], dict[tuple[str, str], str]]:
    """Rows and net types, and what their unit cells measure.

    Parameters
    ----------
    lines : mapping of str to sequence of Row
        By sheet.
    ranged : mapping of str to str
        Ranges of the whole site, as texts of cells.
    log : RewriteLog
        What becomes of each cell is noted in it.
    """
    measure = _choose_measure(lines["Nets"], ranged)
    ends = {end["row"].word: end for end in lines["Ends"]}
    types: dict[str, Line] = {}
    named: dict[Hashable, str] = {}
    rows: list[Line] = []
    for line in lines["Nets"]:
        end = ends.get(line["id"].word, ends.get("all"))
        row = copy_line("rows", line, "Nets", log, ("snow", "glide_factor", "gap"))
        row |= _rewrite_snow(line, ranged, measure, log)
        row |= _rewrite_ground(line, ranged, log) | _rewrite_gap(line, log)
        net = copy_line("net_types", line, "Nets", log, ("id",))
        net |= {key: ranged[key] for key in _RANGED_OF_NET if key in ranged}
        if "upslope_length" in ranged:
            row["upslope_length"] = ranged["upslope_length"]
        if end is not None:
            row |= _rewrite_end(end, log)
            net |= copy_line("net_types", end, "Ends", log)
        height = net.get("net_height", "")
        shown = f"{height:g}" if isinstance(height, float) else str(height)
        name = name_net_type(shown, repr(sorted(net.items())), named)
        types.setdefault(name, {"id": name, **net})
        rows.append({**row, "net_type": name})
    measures = {("rows", "snow"): measure, ("net_types", "slack"): "slack"}
    has_heights = any(is_typed(layer["height"]) for layer in lines["Snow"])
    measures["layers", "thickness"] = "vertical" if has_heights else "normal"
    return {"rows": rows, "net_types": list(types.values())}, measures


def _choose_measure(nets: Sequence[Row], ranged: Mapping[str, str]) -> str:
    """Measure of the snow column: that of a range, else of most rows."""
    if "snow_height" in ranged or "thickness" in ranged:
        return "vertical" if "snow_height" in ranged else "normal"
    keys = ("snow_height", "snow_thickness")
    heights, thicknesses = (
        sum(net[key].state == "given" for net in nets) for key in keys
    )
    return "vertical" if heights >= thicknesses else "normal"


def _rewrite_snow(
    line: Row, ranged: Mapping[str, str], measure: str, log: RewriteLog
) -> Line:
    log.tick(line["snow_layers"])  # sheet Snow says it
    for key in ("snow_height", "thickness"):
        if key in ranged:
            return {"snow": ranged[key]}
    is_vertical = measure == "vertical"
    keys = ("snow_height", "snow_thickness")
    typed, other = (line[key] for key in (keys if is_vertical else reversed(keys)))
    if is_typed(typed):
        log.tick(typed)
        log.change(say("rewrite.one_height"), other)
        return {"snow": show(typed)}
    slope = line["slope_angle"]
    if other.state != "given" or slope.state != "given":
        return {}
    log.change(say("rewrite.turned"), other)
    factor = math.cos(slope.si)
    return {"snow": round(other.si / factor if is_vertical else other.si * factor, 4)}


def _rewrite_ground(line: Row, ranged: Mapping[str, str], log: RewriteLog) -> Line:
    law, glide = line["ground_law"], line["glide_factor"]
    if law.word == "free":
        log.change(say("rewrite.glide_cell"), law)
        return {"glide_factor": "free"}
    if law.word == "no-slip":
        log.change(say("rewrite.no_slip"), law)
        return {"glide_factor": 1.0}
    log.tick(law, glide)
    if "glide_factor" in ranged:
        return {"glide_factor": ranged["glide_factor"]}
    return {"glide_factor": show(glide)} if is_typed(glide) else {}


def _rewrite_gap(line: Row, log: RewriteLog) -> Line:
    """Gap of a row, or the rows that it runs into."""
    gap, row_end, neighbour = line["gap"], line["row_end"], line["neighbour"]
    if row_end.word == "continuous" and neighbour.word:
        log.change(say("rewrite.into"), row_end, neighbour)
        return {"gap": f"into {neighbour.word.replace(';', ',')}"}
    log.tick(gap, row_end)
    return {"gap": show(gap)} if is_typed(gap) else {}


def _rewrite_end(end: Row, log: RewriteLog) -> Line:
    """Anchor of a row's end: the lateral anchor, else that of the end guy."""
    log.tick(end["row"], end["support_types"])
    anchors = [end[key] for key in ("lateral_anchor", "end_guy_anchor")]
    typed = [anchor for anchor in anchors if anchor.word]
    alike = (anchor for anchor in typed if anchor.word == typed[0].word)
    log.change(say("rewrite.end_anchor"), *alike)
    return {"end_anchor": typed[0].word} if typed else {}


def rewrite_types(lines: Lines, log: RewriteLog) -> dict[str, list[Line]]:
    """Tables of types, tests and layers."""
    tables = {
        "anchor_types": [_rewrite_anchor(line, log) for line in lines["Anchors"]],
        "ropes": [copy_line("ropes", line, "Ropes", log) for line in lines["Ropes"]],
        "posts": [_rewrite_post(line, log) for line in lines["Posts"]],
        "links": [_rewrite_link(line, log) for line in lines["Links"]],
        "soils": _list_soils(lines["Anchors"], log),
        "tests": [copy_line("tests", line, "Tests", log) for line in lines["Tests"]],
        "layers": [_rewrite_layer(line, log) for line in lines["Snow"]],
    }
    _add_dips(tables["anchor_types"], lines["Nets"], log)
    nets = {net["id"].word: net for net in lines["Nets"]}
    for end in lines["Ends"]:
        rows = [nets[end["row"].word]] if end["row"].word in nets else nets.values()
        for table, keys in _AT_END.items():
            for key in keys:
                inner_types = [net[key] for net in rows]
                _add_end_type(tables[table], end[key], inner_types, log)
    return tables


_PROOF = ("pull_out", "test_count", "test_mean")


def _rewrite_anchor(line: Row, log: RewriteLog) -> Line:
    anchor = copy_line("anchor_types", line, "Anchors", log, ("dip", *_PROOF))
    steel = (line["bar_diameter"], line["bar_strength"], line["inner_diameter"])
    tendon = _compute_tendon(*steel, is_solid=line["kind"].word == SOLID)
    if line["tendon"].state == "blank" and tendon is not None:
        anchor["tendon"] = float(f"{tendon / 1e3:.5g}")
        log.change(say("rewrite.computed", name=line["tendon"].field.name), *steel)
    return anchor | _rewrite_proof(line, log)


def _compute_tendon(
    outer: Reading, strength: Reading, inner: Reading, *, is_solid: bool
) -> float | None:
    """Yield force of a bar [N]; None without all that it follows from."""
    is_known = inner.state == "given" or is_solid
    if outer.state != "given" or strength.state != "given" or not is_known:
        return None
    hollow = inner.given_si or 0.0
    try:
        bar = RoundSection(outer=outer.si, inner=hollow, strength=strength.si)
    except ModelError:
        return None
    return bar.axial_resistance


def _rewrite_proof(line: Row, log: RewriteLog) -> Line:
    """Pull-out resistance with how it is proven."""
    least, force, basis = (line[key] for key in ("test_least", "pull_out", "basis"))
    if least.state == "given":
        log.change(say("rewrite.tests"), least)
        log.tick(basis)
        counted = {key: line[key] for key in _PROOF[1:] if is_typed(line[key])}
        log.tick(*counted.values())
        shown = {key: show(cell) for key, cell in counted.items()}
        return {"pull_out": show(least), "proven": "tests", **shown}
    if not is_typed(force):
        return {}
    log.tick(force, basis)
    proven = {"proven": _BASES[basis.word]} if basis.word else {}
    return {"pull_out": show(force), **proven}


def _rewrite_post(line: Row, log: RewriteLog) -> Line:
    post = copy_line("posts", line, "Posts", log)
    section = line["section"]
    return {"id": section.word, **post} if section.word else post


def _rewrite_link(line: Row, log: RewriteLog) -> Line:
    link = copy_line("links", line, "Links", log, ("force",))
    for key, meaning in (("strength", "strength"), ("working_limit", "limit")):
        if is_typed(line[key]):
            log.tick(line[key])
            link |= {"force": show(line[key]), "meaning": meaning}
    return link


def _rewrite_layer(line: Row, log: RewriteLog) -> Line:
    layer = copy_line("layers", line, "Snow", log)
    if is_typed(line["height"]):
        log.tick(line["height"])
        layer["thickness"] = show(line["height"])
    return layer


def _list_soils(lines: Iterable[Row], log: RewriteLog) -> list[Line]:
    """Strengths of each ground, from the first anchor type in it that has any."""
    soils: dict[object, Line] = {}
    for line in lines:
        cells = [cell for key, cell in line.items() if key.startswith("soil_")]
        if not line["ground"].word or not any(map(is_typed, cells)):
            continue
        soil = copy_line("soils", line, "Anchors", RewriteLog())
        if soils.setdefault(soil["ground"], soil) == soil:
            log.change(say("rewrite.soil"), *cells)
    return list(soils.values())


def _add_dips(types: list[Line], nets: Sequence[Row], log: RewriteLog) -> None:
    """Give each anchor type its flattest dip, of the axes in all rows that name it."""
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
        for anchor_type in types:
            if anchor_type.get("id") == name:
                anchor_type["dip"] = flattest
        for dip, axes in by_dip.items():
            key = "rewrite.dip" if dip == flattest else "rewrite.flattest"
            log.change(say(key), *axes)


def _add_end_type(
    types: list[Line],
    end_type: Reading,
    inner_types: Sequence[Reading],
    log: RewriteLog,
) -> None:
    """Name the type of a row's end in the lines of the types inside the row."""
    for inner in inner_types:
        if not end_type.word or end_type.word == inner.word:
            log.tick(end_type)
            continue
        for line in types:
            if line.get("id") != inner.word:
                continue
            if line.setdefault("at_end", end_type.word) == end_type.word:
                log.change(say("rewrite.at_end"), end_type)
            else:
                log.leave("rewrite.other_end", end_type)
