"""Lines of all sheets of a site, and the ids by which they refer to each other."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from netdesign.site.cells.findings import Finding, add_nearest, quote, shorten
from netdesign.site.headings import Table
from netdesign.site.ranges import SiteRanges
from netdesign.site.readings import Reading, Row, refuse
from netdesign.words.message import Message, say

TYPE_SHEETS = ("Anchors", "Ropes", "Posts")
Types = Mapping[str, Mapping[str, Row]]  # lines of the type sheets, by name and id

ALL_ROWS = ("all", "alle", "toutes")  # in place of an id, of every net row
_MOST_PLACES = 5  # named in one finding
_ENDS = 2  # of a row


@dataclass(frozen=True, slots=True, kw_only=True)
class Lines:
    """Lines of a site's sheets.

    Attributes
    ----------
    nets : sequence of Row
        Of sheet Nets.
    ends : mapping of str to Row
        Of sheet Ends, by net row.
    snow : mapping of str to sequence of Row
        Of sheet Snow, by net row, from the ground up.
    types : mapping of str to mapping of str to Row
        Of the type sheets, by name and id.
    absent, unreadable : collection of str
        Type sheets that the workbook does not have, under whatever name; and those,
        too, whose ids cannot be read.
    ranges : SiteRanges
        That its rows share.
    links, tests : sequence of Row
        Of sheets Links and Tests.
    typed : mapping of str to sequence of Row
        Lines as they are typed, by table, of all on which net rows rest.
    """

    nets: Sequence[Row]
    ends: Mapping[str, Row]
    snow: Mapping[str, Sequence[Row]]
    types: Types
    absent: Sequence[str]
    unreadable: Sequence[str]
    ranges: SiteRanges
    links: Sequence[Row] = ()
    tests: Sequence[Row] = ()
    typed: Mapping[str, Sequence[Row]] = field(default_factory=dict)

    @property
    def places(self) -> dict[str, str]:
        """Cell of each net row's id."""
        return {line["id"].word: line["id"].place for line in self.nets}


def index_lines(
    lines: Iterable[Row], key: str, accepted: Message, findings: list[Finding]
) -> dict[str, Row]:
    """Lines by the id in a column; one used again is a finding that names the first."""
    found: dict[str, Row] = {}
    for line in lines:
        reading = line[key]
        if reading.word in found:
            rule = say("nets.used_twice", place=found[reading.word][key].place)
            refuse(reading, rule, accepted, findings)
        elif reading.word:
            found[reading.word] = line
    return found


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
    told = {"", *places}
    for reading in readings:
        if reading.word in told:
            continue
        told.add(reading.word)
        typed = next((one.partition("!")[0] for one in places.values()), "")
        sheet = typed or say(f"sheet.{reading.field.refers_to}")
        accepted = add_nearest(say(key, sheet=sheet), reading.word, places)
        refuse(reading, say("nets.no_id", sheet=sheet), accepted, findings)


def refuse_unknown_types(line: Row, lines: Lines, findings: list[Finding]) -> None:
    """Refuse types of a line of sheet Nets or Ends that their sheet does not have."""
    for sheet, types in lines.types.items():
        if sheet in lines.unreadable:
            continue
        places = {name: one["id"].place for name, one in types.items()}
        for reading in list_references([line], sheet):
            refuse_unknown_ids([reading], places, findings, "nets.id_or_empty")


def list_references(rows: Iterable[Row], sheet: str) -> list[Reading]:
    """Cells that name an id of a sheet."""
    return [
        reading
        for row in rows
        for reading in row.values()
        if reading.field.refers_to == sheet and reading.word
    ]


def refuse_missing_sheets(table: Table, lines: Lines, findings: list[Finding]) -> None:
    """One finding for a type sheet that is not there, not one for each of its ids."""
    for name in lines.absent:
        named = list_references([*lines.nets, *lines.ends.values()], name)
        if not named:
            continue
        sheet = say("finding.in_quotes", text=say(f"sheet.{name}"))
        ids = [quote(one) for one in dict.fromkeys(reading.word for reading in named)]
        rule = say(
            "nets.lacks_sheet",
            sheet=sheet,
            count=len(ids),
            ids=shorten(ids, _MOST_PLACES),
            nets=table.sheet.name,
        )
        places = shorten([one.place for one in named], _MOST_PLACES)
        accepted = say("nets.sheet_or_empty", sheet=sheet, places=places)
        found = Finding(file=table.sheet.file, rule=rule, accepted=accepted)
        findings.append(found)


Neighbours = Mapping[str, Collection[str]]  # ids of rows that share an end, by row


def check_neighbours(rows: Sequence[Row], findings: list[Finding]) -> Neighbours:
    """Rows into which each row goes on, whichever of the two says so.

    Refused are neighbours that are no other net rows, more or fewer than the two of a
    row that goes on at both ends, and rows that close a ring.
    """
    ids = {row["id"].word for row in rows}
    going_on = {x["id"].word: x for x in rows if x["row_end"].word == "continuous"}
    beside: dict[str, set[str]] = {name: set() for name in ids}
    for row in rows:
        own = row["id"].word
        for name in _list_neighbours(row):
            if name not in ids or name == own:
                rule = say("nets.no_neighbour", id=name)
                refuse(row["neighbour"], rule, say("nets.other_ids"), findings)
            elif own in going_on:
                beside[own].add(name)
                beside[name].add(own)
    for name, row in going_on.items():
        if beside[name]:
            _check_ends(name, row, beside, going_on, findings)
    return beside


def _check_ends(
    name: str,
    row: Row,
    beside: Neighbours,
    going_on: Collection[str],
    findings: list[Finding],
) -> None:
    """Refuse a row that has not two neighbours, or one of them more, and a ring."""
    ids = tuple(sorted(beside[name]))
    crowded = [one for one in (name, *ids) if len(beside[one]) > _ENDS]
    reached = _reach(name, beside)
    links = sum(len(beside[one]) for one in reached) // 2
    if crowded:
        into = tuple(sorted(beside[crowded[0]]))
        rule = say("nets.two_ends", id=crowded[0], ids=into)
        refuse(row["neighbour"], rule, say("nets.free_or_both"), findings)
    elif links >= len(reached):
        rule = say("nets.ring", ids=tuple(sorted(reached)))
        refuse(row["neighbour"], rule, say("nets.free_or_both"), findings)
    elif len(ids) < _ENDS or reached <= set(going_on):
        rule = say("nets.one_end", ids=ids)
        refuse(row["row_end"], rule, say("nets.free_or_both"), findings)


def _list_neighbours(row: Row) -> list[str]:
    """Ids that the cell of the neighbours names."""
    named = row["neighbour"].word.replace(";", ",").split(",")
    return list(filter(None, map(str.strip, named)))


def _reach(name: str, beside: Mapping[str, Collection[str]]) -> set[str]:
    """Rows into which the nets of a row go on, one after the other."""
    found, new = {name}, {name}
    while new:
        new = {one for known in new for one in beside[known]} - found
        found |= new
    return found
