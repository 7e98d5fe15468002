"""Sheet Declared: checks that are proven elsewhere, and numbers that are meant.

A line that confirms a number has ``Posts!C2 = 3175`` in the place of a check. A what-if
names a cell in the same way: it is read as if something else were typed there.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import product

from netdesign.checks import Declaration, Proof
from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import (
    Cell,
    Sheet,
    Workbook,
    group_by_row,
    split_address,
)
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.fields import normalise
from netdesign.site.lines import ALL_ROWS, refuse_unknown_ids, settle_ids
from netdesign.site.model import ReplacedCell
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.type_resistances import ANCHORS
from netdesign.structure.members import (
    CONNECTED,
    DEPENDENT_MODES,
    END_ANCHORS,
    END_MODES,
    LIFTED_MODE,
    MEMBER_MODES,
    NET_MODES,
    Member,
)
from netdesign.words.catalogue import LANGUAGES, Language, name_check, render
from netdesign.words.message import Message, say

_PLACE = re.compile(r"(?P<sheet>.+?)[!.](?P<column>[A-Za-z]{1,3})(?P<row>[1-9]\d{0,6})")


def split_replacement(text: str) -> tuple[str, str] | None:
    """Place and text of ``Rows.P8=A40``, the place as ``Rows!P8``; else None."""
    place, sign, value = text.partition("=")
    match = _PLACE.fullmatch(place.strip())
    if not sign or match is None or not value.strip():
        return None
    address = f"{match['column'].upper()}{match['row']}"
    return f"{match['sheet']}!{address}", value.strip()


def replace_cells(
    workbook: Workbook, instead: Mapping[str, str]
) -> tuple[Workbook, tuple[ReplacedCell, ...]]:
    """Workbook with other texts in some cells, and what was there.

    Parameters
    ----------
    workbook : Workbook
        As stored.
    instead : mapping of str to str
        Texts by place, such as ``Rows!P8``.

    Raises
    ------
    SiteDataError
        With every place on a sheet that is not read, and every text that is there
        already: a what-if that changes nothing would be the site as built.
    """
    findings: list[Finding] = []
    changed: dict[str, list[Cell]] = {}
    replaced: list[ReplacedCell] = []
    # two sheets of one name are refused where they are read; here the first counts
    sheets = {sheet.name.casefold(): sheet for sheet in reversed(workbook.sheets)}
    for place, text in instead.items():
        typed, _, address = place.rpartition("!")
        sheet = sheets.get(typed.casefold())
        if sheet is None:
            accepted = say(
                "accepted.words", words=tuple(sheet.name for sheet in sheets.values())
            )
            rule = say("what_if.no_sheet", sheet=typed)
            findings.append(workbook.finding(rule, accepted))
            continue
        cell = find_cell(sheet, address)
        if cell.text == text:
            accepted = say("what_if.another_text")
            findings.append(cell.finding(say("what_if.same"), accepted))
        changed.setdefault(sheet.name, []).append(cell.retype(text))
        replaced.append(ReplacedCell(cell=cell.place, was=cell.text, now=text))
    if findings:
        raise SiteDataError(findings)
    now = []
    for sheet in workbook.sheets:
        cells = [*sheet.cells, *changed.get(sheet.name, ())]
        now.append(replace(sheet, rows=group_by_row(cells)))
    return replace(workbook, sheets=tuple(now)), tuple(replaced)


def find_cell(sheet: Sheet, address: str) -> Cell:
    """Cell of a sheet at an address such as ``C14``."""
    column, row = split_address(address)
    return sheet.cell(row, column)


# Checks of geometry that may be proven elsewhere. An impossible slope and a net below
# its snow are no matter of proof.
_OF_GEOMETRY = tuple(
    ("net", mode)
    for mode in ("inclination", "spacing", "gap", "ends", "anchors", "cover")
)
_OF_STRUCTURE = ("structure", "resistances")  # all of it, where nothing is given
OF_ROWS = (*_OF_GEOMETRY, (Member.POST, "lateral"), _OF_STRUCTURE)  # of no support
_IN_GROUND = (*ANCHORS, *END_ANCHORS)
_OF_DIRECTIONS = (
    *(
        (anchor, mode)
        for anchor in _IN_GROUND
        for mode in ("bending", "wedge", "direction")
    ),
    (Member.POST, "lateral"),
)
DECLARABLE: tuple[tuple[str, str], ...] = (
    *MEMBER_MODES,
    *DEPENDENT_MODES,
    LIFTED_MODE,
    *END_MODES,
    *NET_MODES,
    *((member, "connection") for member in CONNECTED),
    *_OF_DIRECTIONS,
    *_OF_GEOMETRY,
    _OF_STRUCTURE,
)


_Subject = tuple[str, str, str]  # member, mode, position of its support or ""


GROUPS = ("structure", "anchors", "post base", "ground at the anchors")


def _is_of_group(group: str, member: str, mode: str) -> bool:
    """The word of a group stands for a check, beside other checks."""
    is_anchor = member in _IN_GROUND and mode != "connection"
    of_groups = {
        "anchors": is_anchor or (member, mode) == ("net", "anchors"),
        "structure": not is_anchor and member != Member.NET,
        "post base": member == Member.POST_BASE and mode in ("bearing", "sliding"),
        "ground at the anchors": mode in ("wedge", "cover"),
    }
    return of_groups[group]


def name_group(group: str, language: Language) -> str:
    """Word for several checks in a language."""
    return render(say(f"choice.check.{normalise(group)}"), language)


@lru_cache(maxsize=1)
def _list_subjects() -> Mapping[str, tuple[_Subject, ...]]:
    """Checks by id, and by the words for them that reports and the template have."""
    subjects = [
        (*check, position)
        for check in DECLARABLE
        for position in (("",) if check in OF_ROWS else ("", "edge"))
    ]
    names: dict[str, tuple[_Subject, ...]] = {}
    for subject in subjects:
        member, mode, position = subject
        spelt = f"{member}.{mode}{'.end' if position else ''}"
        title = name_check(*subject)
        spellings = [spelt, *(render(title, language) for language in LANGUAGES)]
        names |= dict.fromkeys(map(normalise, spellings), (subject,))
    for group in GROUPS:
        of_group = tuple(
            subject for subject in subjects if _is_of_group(group, *subject[:2])
        )
        spellings = [name_group(group, language) for language in LANGUAGES]
        names |= dict.fromkeys(map(normalise, spellings), of_group)
    return names


def read_declared(
    lines: Sequence[Row],
    workbook: Workbook,
    places: Mapping[str, str],
    findings: list[Finding],
) -> tuple[tuple[Declaration, ...], Mapping[str, Message]]:
    """Declared checks, and sentences on confirmed numbers by their cells.

    Parameters
    ----------
    lines : sequence of Row
        Of sheet Declared.
    workbook : Workbook
        As read; a number that is no longer there is not confirmed.
    places : mapping of str to str
        Cells of the ids of sheet Rows.
    findings : list of Finding
        Appended to: unknown rows and checks, what is no date, a check declared twice,
        cells that hold something else than what is confirmed. A line without document
        or author is a finding of its cell already.
    """
    declared: list[Declaration] = []
    confirmed: dict[str, Message] = {}
    rows_by_line = [_list_rows(line["row"], places) for line in lines]
    if places:
        ids = (
            row for rows in rows_by_line for row in rows if not _is_of_all(row, places)
        )
        refuse_unknown_ids(ids, places, findings, "declared.id_or_all")
    for line, rows in zip(lines, rows_by_line, strict=True):
        replacement = split_replacement(line["check"].word)
        if replacement is not None:
            confirmed |= _read_confirmation(line, replacement, workbook, findings)
            continue
        for declaration in _read_line(line, rows, places, findings):
            twice = next(
                (
                    earlier
                    for earlier in declared
                    if _concern_same_check(earlier, declaration)
                ),
                None,
            )
            if twice:
                rule = say("declared.twice", place=twice.proof.cell)
                refuse(line["check"], rule, say("declared.once"), findings)
            else:
                declared.append(declaration)
    return tuple(declared), confirmed


def _list_rows(reading: Reading, places: Mapping[str, str]) -> list[Reading]:
    """Net rows that a cell names: one, or several with commas."""
    names = filter(None, map(str.strip, reading.word.replace(";", ",").split(",")))
    rows = [{"row": replace(reading, value=name)} for name in names]
    return [row["row"] for row in settle_ids(rows, places, "row")]


def _concern_same_check(first: Declaration, second: Declaration) -> bool:
    """Two declarations concern the same check of some net row."""
    same_row = first.row_id == second.row_id or "" in (first.row_id, second.row_id)
    subjects = {
        (declaration.member, declaration.mode, declaration.position)
        for declaration in (first, second)
    }
    return same_row and len(subjects) == 1


def _read_line(
    line: Row,
    rows: Iterable[Reading],
    places: Mapping[str, str],
    findings: list[Finding],
) -> Iterator[Declaration]:
    """Checks of net rows that a line declares: one, or all that its word stands for."""
    check = line["check"]
    subjects = _list_subjects().get(normalise(check.word), ())
    if check.word and not subjects:
        shown = tuple(name_check(*subject) for subject in DECLARABLE)
        end = say("check.of_end", check="...")
        accepted = say("declared.accepted", checks=shown, end=end)
        refuse(check, say("declared.unknown"), accepted, findings)
    if any(reading.state == "faulty" for reading in line.values()):
        return
    proof = Proof(
        document=line["document"].word,
        author=line["author"].word,
        date=line["date"].word,
        cell=check.place,
    )
    for row, (member, mode, position) in product(rows, subjects):
        yield Declaration(
            row_id="" if _is_of_all(row, places) else row.word,
            member=member,
            mode=mode,
            position=position,
            proof=proof,
        )


def _is_of_all(row: Reading, places: Mapping[str, str]) -> bool:
    """A line holds for all net rows, by a word that is the id of none."""
    return row.word not in places and normalise(row.word) in ALL_ROWS


def _read_confirmation(
    line: Row,
    replacement: tuple[str, str],
    workbook: Workbook,
    findings: list[Finding],
) -> dict[str, Message]:
    """Sentence on the number that a line confirms, by its cell; else a finding."""
    place, text = replacement
    sheet_name, _, address = place.rpartition("!")
    sheets = {sheet.name.casefold(): sheet for sheet in workbook.sheets}
    sheet = sheets.get(sheet_name.casefold())
    cell = find_cell(sheet, address) if sheet else None
    if cell is None or not _holds(cell, text):
        content = show_value(cell) if cell else ""
        rule = say("plausible.holds_other", cell=place, held=content)
        refuse(line["check"], rule, say("plausible.such_as"), findings)
        return {}
    if not line["date"].word:
        day = line["date"]
        refuse(day, say("cell.empty"), day.field.accepted, findings)
        return {}
    sentence = say(
        "plausible.confirmed",
        cell=cell.place,
        value=show_value(cell),
        document=line["document"].word,
        author=line["author"].word,
        date=line["date"].word,
    )
    return {cell.place: sentence}


def show_value(cell: Cell) -> str:
    """Content of a cell as text; of a formula its result."""
    is_number = isinstance(cell.value, int | float)
    return f"{cell.value:.10g}" if is_number else cell.text


def _holds(cell: Cell, typed: str) -> bool:
    """A cell holds what is confirmed, as text or as number."""
    if typed in (cell.text, show_value(cell)):
        return True
    try:
        return float(typed.replace(",", ".")) == float(show_value(cell))
    except ValueError:
        return False
