"""Rewrites a workbook of version 0.1 as lines of the input workbook.

`office.toml` says of each column in which columns of version 0.1 it was. Every filled
cell is copied from there, or is named in the list of what was done.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from statistics import mode

from netdesign.outcome import ModelError
from netdesign.resistance.steel import RoundSection
from netdesign.site.cells.cells import TextFormat, Workbook
from netdesign.site.cells.findings import Finding, quote, shorten
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import FURTHER, load_old_plans
from netdesign.site.columns.fields import (
    Field,
    SheetPlan,
    find_item,
    from_si,
    normalise_unit,
    split_heading,
)
from netdesign.site.columns.office import is_heading, load_columns, load_text
from netdesign.site.declared_sheet import split_replacement
from netdesign.site.office.rows import count_posts
from netdesign.site.office.sheets import is_old
from netdesign.site.readings import Reading, Row, read_cell
from netdesign.site.tables import find_table, read_rows
from netdesign.site.type_resistances import SOLID
from netdesign.structure.row_position import find_dip
from netdesign.units import kilonewton_from_newton
from netdesign.words.catalogue import Language
from netdesign.words.message import Message, say

Line = dict[str, object]  # of the new workbook, by key
Lines = Mapping[str, Sequence[Row]]  # of the old one, by sheet
_UNREAD = ("heading.unknown", "heading.close_to_missing", "table.no_heading_unread")
_MOST_PLACES = 3  # named in a line
# Cells that say nothing more beside those that are copied.
_SAID = (
    *("Nets.ground_law", "Nets.row_end", "Nets.snow_layers"),
    *("Ends.row", "Ends.support_types", "Anchors.basis"),
)
_BASES = {"tested": "tests", "report": "report", "computed": "calculated"}
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Rewritten:
    """Lines of the input workbook, and what was done to get them.

    Attributes
    ----------
    tables : mapping of str to sequence of mapping
        Lines by table and key.
    measures : mapping
        What unit cells measure, by table and key.
    done : sequence of Message
        What was done, each kind once.
    """

    tables: Mapping[str, Sequence[Line]]
    measures: Mapping[tuple[str, str], str]
    done: Sequence[Message]


@dataclass(frozen=True, slots=True)
class _Log:
    """Log of a rewriting: places of copied cells, and of others by what was done."""

    copied: set[str] = field(default_factory=set)
    done: dict[Message, list[str]] = field(default_factory=dict)

    def change(self, change: Message, *readings: Reading) -> None:
        """Note cells that stand in the new workbook in another form."""
        for reading in filter(_is_typed, readings):
            self.copied.add(reading.place)
            self.done.setdefault(change, []).append(reading.place)

    def leave(self, key: str, reading: Reading) -> None:
        """Note a cell that is not copied, unless that is said of it already."""
        if _is_typed(reading) and reading.place not in self.copied:
            self.copied.add(reading.place)
            text = quote(reading.cell.text) if reading.cell else ""
            reason = say(key, name=reading.field.name)
            self.done.setdefault(reason, []).append(f"{reading.place} = {text}")

    def list_done(self) -> Iterator[Message]:
        """What was done, each kind once, with its first cells."""
        for change, places in self.done.items():
            shown = shorten(list(dict.fromkeys(places)), _MOST_PLACES)
            yield say("rewrite.done", how=change, places=shown)


def read_old(path: Path, text_format: TextFormat) -> Workbook | None:
    """Workbook of version 0.1; None of any other."""
    plans = load_old_plans().values()

    def is_wanted(name: str) -> bool:
        return any(plan.matches(name) for plan in plans)

    workbook = read_workbook(path, is_wanted, is_heading, text_format)
    return workbook if is_old(workbook) else None


def rewrite(workbook: Workbook, language: Language) -> Rewritten:
    """Rewrite a workbook; cells that are not understood are copied as they are.

    Parameters
    ----------
    workbook : Workbook
        As `read_old` gives it.
    language : str
        Of the workbook that is written, also of the words in its ranges.
    """
    log, findings = _Log(), list[Finding]()
    lines = {
        name: read_rows(find_table(workbook, _free_all(plan), findings), findings)
        for name, plan in load_old_plans().items()
    }
    further = {plan.name: lines.pop(plan.name) for plan in FURTHER}
    declared = lines.pop("Declared")
    lines["items"] = [_read_items(lines.pop("Project"))]
    ranged = _read_ranges(lines["Ranges"], language, log)
    lines["quantities"] = [ranged]
    lines["justified"] = [_read_justified(lines.pop("Ranges"))]
    tables, measures = _rewrite_rows(lines, log)
    tables |= _rewrite_types(lines, log)
    tables["project"] = [_copy("project", _find_common(lines, log), log)]
    tables["declared"] = list(_rewrite_declared(declared, log))
    for name, of_addon in further.items():
        tables[name] = [_copy_all(line) for line in of_addon]
    for range_text in ranged.values():
        if range_text.place in log.copied:
            log.change(say("rewrite.range"), range_text)
        log.leave("rewrite.of_range", range_text)
    _name_rest(lines, log)
    unread = (finding.message for finding in findings if finding.rule.key in _UNREAD)
    return Rewritten(tables=tables, measures=measures, done=(*log.list_done(), *unread))


def _free_all(plan: SheetPlan) -> SheetPlan:
    """Plan that needs no column: what is not there is left empty."""
    fields = tuple(replace(field, required=False) for field in plan.fields)
    return replace(plan, fields=fields, required=False)


def _name_rest(lines: Lines, log: _Log) -> None:
    """Note all cells that were not copied and say something of their own."""
    for sheet, of_sheet in lines.items():
        for line in of_sheet:
            for key, reading in line.items():
                if f"{sheet}.{key}" not in _SAID:
                    log.leave("rewrite.left", reading)


def _is_typed(reading: Reading) -> bool:
    """Whether something stands in the cell."""
    return reading.cell is not None and not reading.cell.is_blank


def _show(reading: Reading) -> object:
    """Value of a cell in the first unit of its column; as typed if it is none."""
    return reading.text if reading.value is None else reading.value


def _copy_all(line: Row) -> Line:
    return {key: _show(cell) for key, cell in line.items() if _is_typed(cell)}


def _copy(table: str, old: Mapping[str, Row], log: _Log) -> Line:
    """Line of a table, with the cells of old lines in which its columns were.

    Parameters
    ----------
    table : str
        Table of the new workbook.
    old : mapping of str to Row
        Line of each sheet of the old workbook, of those that belong to it.
    log : _Log
        The cells are noted in it.
    """
    copied: Line = {}
    for column in load_columns(table):
        places = (place.rpartition(".") for place in column.was)
        were = [old.get(sheet, {}).get(key) for sheet, _, key in places]
        cells = [cell for cell in were if cell and _is_typed(cell)]
        if not cells:
            continue
        value = _show(cells[0])
        log.copied.update(cell.place for cell in cells if _show(cell) == value)
        shown = column.show(value) if isinstance(value, float) else value
        copied[column.field.key] = shown
    return copied


def _read_items(lines: Sequence[Row]) -> Row:
    """Values of sheet Project by their items; items that are unknown by their cells."""
    items = load_old_plans()["Project"].items
    values: dict[str, Reading] = {}
    for line in lines:
        item, value = find_item(line["item"].word, items), line["value"]
        if item is None:
            values[line["item"].place] = line["item"]
        elif _is_typed(value):
            values[item.key] = replace(value, field=item)
    if "number" in values and "revision" in values:
        number, revision = values["number"], values.pop("revision")
        values["number"] = replace(number, value=f"{number.word}, {revision.word}")
    return values


def _read_ranges(lines: Sequence[Row], language: Language, log: _Log) -> Row:
    """Ranges by their quantity, as texts of cells in the first unit of their column."""
    items = load_old_plans()["Ranges"].items
    to, mark = f" {load_text('to', language)} ", load_text("comma", language)
    ranged: dict[str, Reading] = {}
    for line in lines:
        if not any(_is_typed(line[key]) for key in ("low", "high", "span")):
            continue
        quantity = find_item(line["quantity"].word, items)
        ends = _read_ends(line, quantity) if quantity else ()
        if quantity is None or len(ends) < 2:
            log.leave("rewrite.of_range", line["quantity"])
            continue
        share = 100.0 if quantity.key == "slack" else 1.0
        texts = (f"{round(share * end, 6):g}".replace(".", mark) for end in ends)
        ranged[quantity.key] = replace(line["quantity"], value=to.join(texts))
    return ranged


def _read_justified(lines: Sequence[Row]) -> Row:
    """Justifications of ranges by their quantity; of what is none by their cells."""
    items = load_old_plans()["Ranges"].items
    justified: dict[str, Reading] = {}
    for line in lines:
        quantity = find_item(line["quantity"].word, items)
        why = line["justification"]
        justified[quantity.key if quantity else why.place] = why
    return justified


def _read_ends(line: Row, quantity: Field) -> Sequence[float]:
    """Low and high end of a line, in the first unit of its quantity; else none."""
    typed = normalise_unit(line["unit"].word.strip(" []()"))
    unit = typed or split_heading(line["quantity"].word)[1] or quantity.unit
    cells = (line[key].cell for key in ("low", "high") if unit in quantity.units)
    ends = [read_cell(cell, quantity, unit, []) for cell in cells if cell is not None]
    return [end.number for end in ends if end.state == "given"]


def _find_common(lines: Lines, log: _Log) -> Mapping[str, Row]:
    """Cells that sheet Project has once, where all lines say the same; by sheet."""
    common: dict[str, dict[str, Reading]] = {}
    for column in load_columns("project"):
        for sheet, _, key in (place.rpartition(".") for place in column.was):
            typed = [x[key] for x in lines.get(sheet, ()) if key in x]
            cells = list(filter(_is_typed, typed))
            if len({cell.value for cell in cells}) == 1:
                common.setdefault(sheet, {})[key] = cells[0]
                log.copied.update(cell.place for cell in cells)
                break
            for cell in cells:
                log.leave("rewrite.several", cell)
    return common


def _rewrite_declared(lines: Sequence[Row], log: _Log) -> Iterator[Line]:
    for line in lines:
        if split_replacement(line["check"].word):
            log.leave("rewrite.confirmed", line["check"])
        else:
            yield _copy_all(line)


def _rewrite_rows(
    lines: Lines, log: _Log
) -> tuple[dict[str, list[Line]], dict[tuple[str, str], str]]:
    """Rows and net types, one for all rows of like nets; what unit cells measure."""
    (ranged,), nets = lines["quantities"], lines["Nets"]
    measured = [key for key in _SNOW for line in nets if _is_typed(line[key])]
    is_vertical = "snow_height" in ranged or (
        "thickness" not in ranged and mode([*measured, _SNOW[0]]) == _SNOW[0]
    )
    ends = {end["row"].word: end for end in lines["Ends"]}
    types: dict[str, Line] = {}
    rows: list[Line] = []
    for line in lines["Nets"]:
        end = ends.get(line["id"].word) or ends.get("all", {})
        old = {"Nets": line, "Ends": end, "quantities": ranged}
        row, net = _copy("rows", old, log), _copy("net_types", old, log)
        row |= _rewrite_snow(line, ranged, log, is_vertical=is_vertical)
        row |= _rewrite_words(line, log)
        own = {"id": f"N{len(types) + 1}", **net}
        own = types.setdefault(repr(sorted(net.items())), own)
        rows.append({**row, "net_type": own["id"]})
    has_heights = any(_is_typed(layer["height"]) for layer in lines["Snow"])
    measures = {
        ("rows", "snow"): "vertical" if is_vertical else "normal",
        ("net_types", "slack"): "slack",
        ("layers", "thickness"): "vertical" if has_heights else "normal",
    }
    return {"rows": rows, "net_types": list(types.values())}, measures


_SNOW = ("snow_height", "snow_thickness")


def _rewrite_snow(line: Row, ranged: Row, log: _Log, *, is_vertical: bool) -> Line:
    """Snow of a row as its column measures it, converted where it was the other."""
    own, other = (line[key] for key in (_SNOW if is_vertical else reversed(_SNOW)))
    own = ranged.get("snow_height" if is_vertical else "thickness", own)
    if _is_typed(own):
        log.copied.add(own.place)
        log.change(say("rewrite.one_height"), other)
        return {"snow": _show(own)}
    slope = line["slope_angle"]
    if other.state != "given" or slope.state != "given":
        return {}
    log.change(say("rewrite.turned"), other)
    factor = math.cos(slope.si)
    return {"snow": round(other.si / factor if is_vertical else other.si * factor, 4)}


def _rewrite_words(line: Row, log: _Log) -> Line:
    """Ground, gap and length of a row that are now in other columns."""
    law, row_end, neighbour = line["ground_law"], line["row_end"], line["neighbour"]
    words: Line = {}
    length, spacing = line["row_length"], line["post_spacing"].given_si
    if length.given_si and spacing and not _is_typed(line["post_count"]):
        log.change(say("rewrite.posts"), length)
        words["post_count"] = count_posts(length.given_si, spacing)
    if law.word == "free":
        log.change(say("rewrite.glide_cell"), law)
        words["glide_factor"] = "free"
    if law.word == "no-slip":
        log.change(say("rewrite.no_slip"), law)
        words["glide_factor"] = 1.0
    if row_end.word == "continuous" and neighbour.word:
        log.change(say("rewrite.into"), row_end, neighbour)
        words["gap"] = f"into {neighbour.word.replace(';', ',')}"
    return words


_FROM = {"ropes": "Ropes", "posts": "Posts", "tests": "Tests", "layers": "Snow"}


def _rewrite_types(lines: Lines, log: _Log) -> dict[str, list[Line]]:
    """Tables of types, tests and layers."""
    tables = {
        table: [_copy(table, {sheet: line}, log) for line in lines[sheet]]
        for table, sheet in _FROM.items()
    }
    tables["anchor_types"] = [_rewrite_anchor(line, log) for line in lines["Anchors"]]
    tables["links"] = [_rewrite_link(line, log) for line in lines["Links"]]
    tables["soils"] = _list_soils(lines["Anchors"], log)
    _add_dips(tables["anchor_types"], lines["Nets"], log)
    nets = {net["id"].word: net for net in lines["Nets"]}
    for end in lines["Ends"]:
        rows = [nets[end["row"].word]] if end["row"].word in nets else nets.values()
        for table, keys in _AT_END.items():
            for key in keys:
                inner_types = {net[key].word for net in rows}
                _add_end_type(tables[table], end[key], inner_types, log)
    return tables


def _rewrite_anchor(line: Row, log: _Log) -> Line:
    """Anchor type with its tendon, and how its pull-out resistance is proven."""
    anchor = _copy("anchor_types", {"Anchors": line}, log)
    tendon = _compute_tendon(line)
    if line["tendon"].state == "blank" and tendon is not None:
        anchor["tendon"] = float(f"{kilonewton_from_newton(tendon):.5g}")
        steel = (line[key] for key in _STEEL)
        log.change(say("rewrite.computed", name=line["tendon"].field.name), *steel)
    basis = line["basis"].word
    if _is_typed(line["test_least"]):
        log.change(say("rewrite.tests"), line["test_least"])
        basis = "tested"
    return anchor | ({"proven": _BASES[basis]} if basis else {})


_STEEL = ("bar_diameter", "bar_strength", "inner_diameter")


def _compute_tendon(line: Row) -> float | None:
    """Yield force of a bar [N]; None without all that it follows from."""
    outer, strength, inner = (line[key].given_si for key in _STEEL)
    inner = 0.0 if inner is None and line["kind"].word == SOLID else inner
    if outer is None or strength is None or inner is None:
        return None
    with suppress(ModelError):
        bar = RoundSection(outer=outer, inner=inner, strength=strength)
        return bar.axial_resistance
    return None


def _rewrite_link(line: Row, log: _Log) -> Line:
    link = _copy("links", {"Links": line}, log)
    is_strength = _is_typed(line["strength"])
    meaning = {"meaning": "strength" if is_strength else "limit"}
    return link | (meaning if "force" in link else {})


def _list_soils(lines: Sequence[Row], log: _Log) -> list[Line]:
    """Strengths of each ground, from the first anchor type in it that has any."""
    soils: dict[object, Line] = {}
    for line in lines:
        cells = [cell for key, cell in line.items() if key.startswith("soil_")]
        if not line["ground"].word or not any(map(_is_typed, cells)):
            continue
        soil = _copy("soils", {"Anchors": line}, _Log())
        if soils.setdefault(soil["ground"], soil) == soil:
            log.change(say("rewrite.soil"), *cells)
    return list(soils.values())


def _add_dips(types: list[Line], nets: Sequence[Row], log: _Log) -> None:
    """Give each anchor type its flattest dip, of the axes in all rows that name it."""
    dips: dict[str, dict[float, list[Reading]]] = {}
    without: dict[str, list[Reading]] = {}  # ids of the rows that give no axis
    for line in nets:
        for member, key in _AXES.items():
            axis, slope = line[key], line["slope_angle"]
            if axis.state == "blank":
                without.setdefault(line[member].word, []).append(line["id"])
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
        log.change(say("rewrite.dip_for_all"), *without.get(name, ()))
        for dip, axes in by_dip.items():
            key = "rewrite.dip" if dip == flattest else "rewrite.flattest"
            log.change(say(key), *axes)


def _add_end_type(
    types: list[Line], end_type: Reading, inner_types: set[str], log: _Log
) -> None:
    """Name the type of a row's end in the lines of the types inside the row."""
    if end_type.word in inner_types:
        log.copied.add(end_type.place)
    for line in types:
        if not end_type.word or line.get("id") not in inner_types - {end_type.word}:
            continue
        if line.setdefault("at_end", end_type.word) == end_type.word:
            log.change(say("rewrite.at_end"), end_type)
        else:
            log.leave("rewrite.other_end", end_type)
