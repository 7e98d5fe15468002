"""Cells of sheets Nets and Ends that name a type: whether the types are there."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from netdesign.site.cells.findings import Finding, add_nearest, quote
from netdesign.site.end_supports import list_end_types
from netdesign.site.model import MEMBER_MODES, NAMED_BY
from netdesign.site.panel_inputs import list_ropes
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.tables import Table
from netdesign.words.message import Message, say

Types = Mapping[str, Row]  # the lines of one type sheet, by id
# By name of the sheet; None without a sheet whose ids can be read.
TypeSheets = Mapping[str, Types | None]

_MOST_PLACES = 5  # named in one finding
# Columns that name a type.
_MEMBERS = tuple(dict.fromkeys(NAMED_BY.get(one, one) for one, _ in MEMBER_MODES))


def refuse_unknown_types(
    row: Row, type_sheets: TypeSheets, findings: list[Finding]
) -> None:
    """Refuse ids of a line that their type sheet does not have."""
    for reading in _list_named(row):
        sheet = reading.field.refers_to
        types = type_sheets[sheet]
        if types is not None and reading.word not in types:
            title = say(f"sheet.{sheet}")
            accepted = say("nets.id_or_empty", sheet=title)
            places = {name: line["id"].place for name, line in types.items()}
            accepted = add_nearest(accepted, reading.word, types, places)
            refuse(reading, say("nets.no_id", sheet=title), accepted, findings)


def list_references(rows: Iterable[Row], sheet: str) -> list[Reading]:
    """Cells that name an id of a type sheet."""
    return [
        reading
        for row in rows
        for reading in _list_named(row)
        if reading.field.refers_to == sheet
    ]


def _list_named(row: Row) -> list[Reading]:
    """Cells of a line of sheet Nets or Ends that name a type."""
    further = list_ropes(row) if "panel_system" in row else list_end_types(row)
    return [*(row[member] for member in _MEMBERS if row[member].word), *further]


def refuse_missing_sheets(
    table: Table, rows: list[Row], absent: Iterable[str], findings: list[Finding]
) -> None:
    """One finding for a type sheet that is not there, not one for each of its ids."""
    for name in absent:
        named = list_references(rows, name)
        if not named:
            continue
        sheet = say("finding.in_quotes", text=say(f"sheet.{name}"))
        ids = list(dict.fromkeys(one.word for one in named))
        findings.append(
            Finding(
                file=table.sheet.file,
                rule=_refuse_ids(ids, sheet, table.sheet.name),
                accepted=_ask_for_sheet([one.place for one in named], sheet),
            )
        )


def _refuse_ids(ids: list[str], sheet: Message, nets: str) -> Message:
    shown = tuple(map(quote, ids[:_MOST_PLACES]))
    if len(ids) == 1:
        return say("nets.lacks_sheet_one", sheet=sheet, id=shown[0], nets=nets)
    more = ("...",) if len(ids) > _MOST_PLACES else ()
    return say(
        "nets.lacks_sheet", sheet=sheet, count=len(ids), ids=(*shown, *more), nets=nets
    )


def _ask_for_sheet(places: list[str], sheet: Message) -> Message:
    shown, more = tuple(places[:_MOST_PLACES]), len(places) - _MOST_PLACES
    if more <= 0:
        return say("nets.sheet_or_empty", sheet=sheet, places=shown)
    return say("nets.sheet_or_empty_more", sheet=sheet, places=shown, count=more)
