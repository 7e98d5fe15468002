"""Lines of all sheets of a site, and the ids by which they refer to each other."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.site.cells.cells import Workbook
from netdesign.site.cells.findings import Finding, add_nearest
from netdesign.site.headings import Table
from netdesign.site.model import Project
from netdesign.site.office.project import SiteRanges
from netdesign.site.readings import Reading, Row, refuse
from netdesign.words.message import Message, say

TYPES = ("anchor_types", "ropes", "posts")
Types = Mapping[str, Mapping[str, Row]]  # lines of the types, by table and id

ALL_ROWS = ("all", "alle", "toutes")  # in place of an id, of every net row
_ENDS = 2  # of a row


@dataclass(frozen=True, slots=True, kw_only=True)
class Lines:
    """What a workbook holds before net rows are built.

    Attributes
    ----------
    workbook : Workbook
        Its sheets that are read.
    project, project_cells : Project, mapping of str to str
        Of sheet Project, and the cells of its items.
    table : Table or None
        Sheet Rows.
    rows : sequence of Row
        Net rows, each with the columns of its net type and what the site says of all.
    ends : mapping of str to Row
        Cells that name other types at the end of a row, by net row and column.
    snow : mapping of str to sequence of Row
        Of sheet Snow, by net row, from the ground up.
    types : mapping of str to mapping of str to Row
        Anchors, ropes and posts with what follows from their lines, by table and id.
    ranges : SiteRanges
        That its rows share.
    further : mapping of str to Table or None
        Sheets of add-ons, by name.
    typed : mapping of str to sequence of Row
        Lines as they are typed, by table.
    library : tuple of str
        File of further net types, and its hash; empty without one.
    """

    workbook: Workbook
    project: Project
    project_cells: Mapping[str, str]
    table: Table | None
    rows: Sequence[Row]
    ends: Mapping[str, Row]
    snow: Mapping[str, Sequence[Row]]
    types: Types
    ranges: SiteRanges
    further: Mapping[str, Table | None]
    typed: Mapping[str, Sequence[Row]]
    library: tuple[str, str] = ("", "")

    @property
    def places(self) -> dict[str, str]:
        """Cell of each net row's id."""
        return {line["id"].word: line["id"].place for line in self.rows}


def fold_id(text: str) -> str:
    """Id without case and double spaces."""
    return " ".join(text.casefold().split())


def settle_ids(lines: Iterable[Row], ids: Iterable[str], key: str) -> list[Row]:
    """Lines whose column names an id as its sheet writes it, whatever the case.

    Ids that differ by their case alone are kept apart.
    """
    by_fold: dict[str, list[str]] = {}
    for name in dict.fromkeys(ids):
        by_fold.setdefault(fold_id(name), []).append(name)
    settled: list[Row] = []
    for line in lines:
        reading = line[key]
        matches = by_fold.get(fold_id(reading.word), ())
        if reading.word and len(matches) == 1:
            line = {**line, key: replace(reading, value=matches[0])}
        settled.append(line)
    return settled


def index_lines(
    lines: Iterable[Row], key: str, accepted: Message, findings: list[Finding]
) -> dict[str, Row]:
    """Lines by the id in a column; an id used again is a finding, in whatever case."""
    by_id: dict[str, Row] = {}
    places: dict[str, str] = {}
    for line in lines:
        reading = line[key]
        folded = fold_id(reading.word)
        if folded in places:
            rule = say("nets.used_twice", place=places[folded])
            refuse(reading, rule, accepted, findings)
        elif reading.word:
            by_id[reading.word], places[folded] = line, reading.place
    return by_id


def refuse_unknown_ids(
    readings: Iterable[Reading],
    places: Mapping[str, str],
    findings: list[Finding],
    key: str = "accepted.id_of_sheet",
) -> None:
    """Refuse ids that the sheet of their column does not have, each once.

    Parameters
    ----------
    readings : iterable of Reading
        Cells of one column.
    places : mapping of str to str
        Cells of the ids that there are.
    findings : list of Finding
        Appended to.
    key : str
        Text of what is accepted, which names the sheet.
    """
    seen = {"", *places}
    for reading in readings:
        if reading.word in seen:
            continue
        seen.add(reading.word)
        typed = next((place.partition("!")[0] for place in places.values()), "")
        sheet = typed or say(f"sheet.{reading.field.refers_to}")
        accepted = add_nearest(say(key, sheet=sheet), reading.word, places)
        refuse(reading, say("nets.no_id", sheet=sheet), accepted, findings)


def refuse_unknown_types(line: Row, lines: Lines, findings: list[Finding]) -> None:
    """Refuse types of a net row, or of its end, that their sheet does not have."""
    for sheet, types in lines.types.items():
        places = {name: type_line["id"].place for name, type_line in types.items()}
        for reading in line.values():
            if reading.field.refers_to == sheet:
                refuse_unknown_ids([reading], places, findings, "nets.id_or_empty")


Neighbours = Mapping[str, tuple[str, ...]]  # rows into which each row's nets go on


def find_neighbours(rows: Sequence[Row], findings: list[Finding]) -> Neighbours:
    """Rows that go on at both ends, with those into which they do.

    It is enough that one of two rows names the other. Refused are neighbours that are
    no other net rows, a third neighbour of a row, and rows that close a ring.
    """
    joined = _join_rows(rows)
    lines = {row["id"].word: row for row in rows}
    for name, row in lines.items():
        neighbours, cell = joined[name], find_neighbour_cell(row)
        for neighbour in neighbours:
            if neighbour == name or neighbour not in lines:
                rule = say("nets.no_neighbour", id=neighbour)
                refuse(cell, rule, say("nets.other_ids"), findings)
        chained = _find_chain(name, joined)
        if len(neighbours) > _ENDS:
            rule = say("nets.two_ends", id=name, ids=tuple(sorted(neighbours)))
            refuse(cell, rule, say("nets.free_or_both"), findings)
        elif all(len(joined[row_id]) == _ENDS for row_id in chained):
            rule = say("nets.ring", ids=tuple(sorted(chained)))
            refuse(cell, rule, say("nets.free_or_both"), findings)
    return {name: joined[name] for name in lines if len(joined[name]) >= _ENDS}


def find_neighbour_cell(row: Row) -> Reading:
    """Cell that names the neighbours, or that of the id if there is no such column."""
    return row["gap"] if row["gap"].cell else row["id"]


def _join_rows(rows: Sequence[Row]) -> dict[str, tuple[str, ...]]:
    """Rows into which each row's nets go on, where either of the two says so."""
    ids = {fold_id(row["id"].word): row["id"].word for row in rows}
    joined: dict[str, dict[str, None]] = {row["id"].word: {} for row in rows}
    for row in rows:
        own = row["id"].word
        for typed in filter(None, map(str.strip, row["gap"].word.split(","))):
            neighbour = ids.get(fold_id(typed), typed)
            joined[own][neighbour] = None
            joined.setdefault(neighbour, {})[own] = None
    return {own: tuple(neighbours) for own, neighbours in joined.items()}


def _find_chain(name: str, beside: Mapping[str, Collection[str]]) -> set[str]:
    """Rows into which the nets of a row go on, one after the other."""
    reached, newest = {name}, {name}
    while newest:
        newest = {neighbour for row in newest for neighbour in beside[row]} - reached
        reached |= newest
    return reached
