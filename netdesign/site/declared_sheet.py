"""Sheet Declared: checks that the engineer declares as proven elsewhere."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from datetime import date
from functools import lru_cache
from itertools import product

from netdesign.checks import Declaration
from netdesign.site.cells.findings import Finding, add_nearest
from netdesign.site.columns.fields import normalise
from netdesign.site.confirmed_values import is_confirmation
from netdesign.site.model import DEPENDENT_MODES, END_MODES, MEMBER_MODES
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.tables import Table, read_rows
from netdesign.structure.members import Member
from netdesign.words.catalogue import LANGUAGES, render
from netdesign.words.message import say
from netdesign.words.names import name_check

# Checks of geometry that somebody may prove elsewhere. A slope that cannot be one and
# a net below its snow are no matter of proof.
_OF_GEOMETRY = (
    ("net", "inclination"),
    ("net", "spacing"),
    ("net", "gap"),
    ("net", "ends"),
)
_OF_ROWS = (*_OF_GEOMETRY, (Member.POST, "lateral"))  # of no support
_ANCHORS = (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR)
_OF_DIRECTIONS = (
    *((anchor, mode) for anchor in _ANCHORS for mode in ("bending", "direction")),
    (Member.POST, "lateral"),
)
DECLARABLE: tuple[tuple[str, str], ...] = (
    *MEMBER_MODES,
    *DEPENDENT_MODES,
    *END_MODES,
    *_OF_DIRECTIONS,
    *_OF_GEOMETRY,
)

_ALL_ROWS = ("all", "alle", "toutes")  # in place of an id

_Subject = tuple[str, str, str]  # member, mode, position of its support or ""
_Check = tuple[str, _Subject]  # net row ("" for all)


def read_declared(
    table: Table | None, row_ids: Collection[str], findings: list[Finding]
) -> tuple[Declaration, ...]:
    """Declarations of the sheet; none without the sheet.

    Parameters
    ----------
    table : Table or None
        Sheet Declared, if there is one.
    row_ids : collection of str
        Ids of sheet Nets.
    findings : list of Finding
        Appended to: unknown rows and checks, what is no date, a check declared twice.
        A line without document or author is a finding of its cell already.
    """
    declared: dict[_Check, Declaration] = {}
    for line in read_rows(table, findings) if table else ():
        count = len(findings)
        if is_confirmation(line):
            _check_row(line["row"], row_ids, findings)
            continue
        found = _read_line(line, row_ids, findings)
        if found is None or len(findings) > count:
            continue
        twice = next((one for one in declared.values() if _meet(one, found)), None)
        if twice:
            rule = say("declared.twice", place=twice.source)
            refuse(line["check"], rule, say("declared.once"), findings)
            continue
        declared[found.row_id, _name_subject(found)] = found
    return tuple(declared.values())


def _meet(one: Declaration, other: Declaration) -> bool:
    """Two declarations concern the same check of some net row."""
    same_row = one.row_id == other.row_id or "" in (one.row_id, other.row_id)
    return same_row and _name_subject(one) == _name_subject(other)


def _name_subject(one: Declaration) -> _Subject:
    return one.member, one.mode, one.position


def _read_line(
    line: Row, row_ids: Collection[str], findings: list[Finding]
) -> Declaration | None:
    row, check, day = line["row"], line["check"], line["date"]
    is_of_all = _check_row(row, row_ids, findings)
    names = _list_names()
    subject = names.get(normalise(check.word))
    if check.word and subject is None:
        shown = tuple(name_check(*one) for one in DECLARABLE)
        end = say("check.of_end", check="...")
        accepted = say("declared.accepted", checks=shown, end=end)
        refuse(check, say("declared.unknown"), accepted, findings)
    if day.word and not _is_date(day.word):
        refuse(day, say("measured.no_date"), say("declared.such_as"), findings)
    if subject is None or any(reading.state == "faulty" for reading in line.values()):
        return None
    return Declaration(
        row_id="" if is_of_all else row.word,
        member=subject[0],
        mode=subject[1],
        position=subject[2],
        document=line["document"].word,
        author=line["author"].word,
        date=day.word,
        source=check.place,
    )


def _check_row(row: Reading, row_ids: Collection[str], findings: list[Finding]) -> bool:
    """Refuse an unknown net row; True of a line that holds for all of them."""
    is_of_all = row.word not in row_ids and normalise(row.word) in _ALL_ROWS
    if row.word and row_ids and row.word not in row_ids and not is_of_all:
        sheet = say("sheet.Nets")
        accepted = say("declared.id_or_all", sheet=sheet)
        accepted = add_nearest(accepted, row.word, row_ids)
        refuse(row, say("nets.no_id", sheet=sheet), accepted, findings)
    return is_of_all


def _is_date(text: str) -> bool:
    try:
        date.fromisoformat(text)
    except ValueError:
        return False
    return True


@lru_cache(maxsize=1)
def _list_names() -> Mapping[str, _Subject]:
    """Checks by their names in every language, as reports have them, and by id."""
    names: dict[str, _Subject] = {}
    at_ends = (("edge", ".end"), ("", ""))
    for (member, mode), (position, end) in product(DECLARABLE, at_ends):
        if position and (member, mode) in _OF_ROWS:
            continue
        subject = (member, mode, position)
        title = name_check(*subject)
        spelt = f"{member}.{mode}{end}"
        spellings = [spelt, *(render(title, one) for one in LANGUAGES)]
        names |= dict.fromkeys(map(normalise, spellings), subject)
    return names
