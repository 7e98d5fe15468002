"""Smallest types of the workbook with which failing checks pass: each one is tried.

A type is tried where the workbook names it: in its cell, with every check that follows
from that cell, at each support. An anchor type of another ground is not tried. No force
depends on the types that are tried here; a type for which that does not hold is not
judged.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import Standard
from netdesign.checks.check import Check
from netdesign.outcome import SiteDataError, Verdict
from netdesign.site.model import NetRow, Site
from netdesign.structure.members import (
    END_ANCHORS,
    END_MODES,
    MEMBER_MODES,
    NAMED_BY,
    EndMember,
    Member,
)
from netdesign.study.cases import have_same_forces
from netdesign.study.check_site import SolvedSite
from netdesign.study.judge import judge_site
from netdesign.study.records import RowStudy, Study
from netdesign.study.remedies import find_ground, holds_in_ground
from netdesign.study.row_to_check import CheckRun
from netdesign.words.message import say

Column = Member | EndMember
# Site of the workbook with other texts in some of its cells.
ReadInstead = Callable[[Mapping[str, str]], Site]

_OPEN = (Verdict.FAIL, Verdict.NOT_PROVEN)
# Of the first mode that a column's types have: it tells their sheet.
_MODES: Mapping[Column, str] = {
    **{column: mode for column, mode in reversed(MEMBER_MODES)},
    **{column: mode for column, mode in reversed(END_MODES)},
}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SizedCell:
    """A cell that names a type, with the checks that follow from it in each row.

    Attributes
    ----------
    checks : mapping of str to tuple of str
        Their ids, by net row.
    open_rows : tuple of str
        Net rows in which some check does not pass.
    column, cell, was : str
        Member whose column it is; ``Rows!P8``, "" without such a cell; the type that is
        there.
    types : tuple of str
        Others of its sheet, in the ground of the row.
    left_out : int
        Number of types that are for another ground, or none.
    now : str
        Smallest type with which every check of the cell passes; "" where none does.
    used : float or None
        Upper end of the largest utilisation of these checks, with that type [-].
    """

    checks: Mapping[str, tuple[str, ...]]
    open_rows: tuple[str, ...]
    column: Column
    cell: str
    was: str
    types: tuple[str, ...]
    left_out: int
    now: str = ""
    used: float | None = None

    @property
    def row_id(self) -> str:
        """Net rows, with commas."""
        return ", ".join(self.open_rows or self.checks)

    @property
    def tried(self) -> int:
        """Number of types that were tried."""
        return len(self.types) if self.cell else 0


def size_site(
    solved: SolvedSite,
    study: Study,
    standard: Standard,
    run: CheckRun,
    read: ReadInstead,
) -> list[SizedCell]:
    """Find the smallest type for every cell whose checks do not all pass.

    The smallest is the one that is used most while everything passes; of two alike the
    first by its name.

    Parameters
    ----------
    solved : SolvedSite
        The site as built, solved.
    study : Study
        Of it, under the profile ``standard``.
    standard : Standard
        Limit profile.
    run : CheckRun
        Settings of the run.
    read : callable
        Gives the site with other texts in some cells; refuses what the workbook does.

    Returns
    -------
    list of SizedCell
        In the order of rows and columns; empty where every check passes.
    """
    slots = [slot for slot in _join_slots(study, solved.site) if slot.open_rows]
    placed = [slot for slot in slots if slot.cell]
    used_by_type: dict[SizedCell, dict[str, float]] = {slot: {} for slot in slots}
    for number in range(max((len(slot.types) for slot in placed), default=0)):
        trial = {
            slot: slot.types[number] for slot in placed if number < len(slot.types)
        }
        for slot, used in _try_types(trial, solved, study, standard, run, read):
            used_by_type[slot][trial[slot]] = used
    return [_choose(slot, used_by_type[slot]) for slot in slots]


def _join_slots(study: Study, site: Site) -> list[SizedCell]:
    """Join the cells of several rows into one."""
    joined: dict[tuple[str, str, str], SizedCell] = {}
    for row, net_row in zip(study.rows, site.rows, strict=True):
        for slot in _list_slots(row, net_row, site):
            key = (slot.cell, "" if slot.cell else row.id, slot.column)
            joined[key] = _join(joined[key], slot) if key in joined else slot
    return list(joined.values())


def _join(sized: SizedCell, other: SizedCell) -> SizedCell:
    """Join a cell of two rows: a type has to hold in the ground of both."""
    return replace(
        sized,
        checks={**sized.checks, **other.checks},
        open_rows=sized.open_rows + other.open_rows,
        types=tuple(kind for kind in sized.types if kind in other.types),
        left_out=max(sized.left_out, other.left_out),
    )


def _choose(slot: SizedCell, passing: Mapping[str, float]) -> SizedCell:
    best = min(passing, key=lambda kind: (-passing[kind], kind), default="")
    return replace(slot, now=best, used=passing.get(best))


def _list_slots(row: RowStudy, net_row: NetRow, site: Site) -> Iterator[SizedCell]:
    """List the cells of a row that name a type, with the checks of the type.

    A row is open where a check with a known force does not pass.
    """
    checks: dict[tuple[Column, str, str], list[Check]] = {}
    for check in row.checks:
        column = _find_column(check.member)
        if column is not None:
            place = _find_cell(net_row, column, check.position)
            checks.setdefault((column, *place), []).append(check)
    for (column, cell, was), of_cell in checks.items():
        is_open = any(
            check.verdict in _OPEN and check.demand_kN is not None for check in of_cell
        )
        holding = _compare_grounds(site, net_row, column, was)
        yield SizedCell(
            checks={row.id: tuple(check.id for check in of_cell)},
            open_rows=(row.id,) if is_open else (),
            column=column,
            cell=cell,
            was=was,
            types=tuple(kind for kind, is_here in holding.items() if is_here),
            left_out=sum(not is_here for is_here in holding.values()),
        )


def _compare_grounds(
    site: Site, row: NetRow, column: Column, was: str
) -> dict[str, bool]:
    """Other types of a column's sheet: whether each holds in the ground of the row."""
    ground = row.ground_type or find_ground(site, was)
    return {
        kind.type_id: holds_in_ground(column, ground, kind)
        for kind in site.catalogue
        if kind.mode == _MODES[column] and kind.type_id != was
    }


def _find_column(member: str) -> Column | None:
    """Column that names the type of a member; None of the net."""
    column = next((column for column in _MODES if column == member), None)
    return NAMED_BY.get(column, column) if isinstance(column, Member) else column


def _find_cell(row: NetRow, column: Column, position: str) -> tuple[str, str]:
    """Cell that names a type, and the type; of an end its own, where it has one."""
    echoes = {echo.label: echo for echo in row.inputs}
    name = "end_anchor" if column in END_ANCHORS else column
    labels = [f"{table}.{name}" for table in ("rows", "net_types")]
    if position == "edge":  # of a type that stands there alone
        labels.insert(0, f"Ends.{name}")
    keys = (say(f"column.{label}") for label in labels)
    echo = next((echoes[key] for key in keys if key in echoes), None)
    if echo is None or "!" not in echo.cell:
        return "", ""
    return echo.cell, str(echo.value)


def _try_types(
    trial: Mapping[SizedCell, str],
    solved: SolvedSite,
    study: Study,
    standard: Standard,
    run: CheckRun,
    read: ReadInstead,
) -> Iterator[tuple[SizedCell, float]]:
    """Cells that pass with their types of a trial, with their largest utilisations.

    A type that raises a question leaves its row open, and one that is refused the whole
    site: the types of other cells are then tried alone.
    """
    try:
        site = read({slot.cell: kind for slot, kind in trial.items()})
    except SiteDataError:
        if len(trial) > 1:
            for slot, kind in trial.items():
                yield from _try_types({slot: kind}, solved, study, standard, run, read)
        return
    by_id = {row.id: row for row in solved.site.rows}
    rows, judged = _judge_again(site, trial, solved, standard, run)
    built = {row.id: row.checks for row in study.rows}
    tried = {row.id: row.checks for row in judged.rows}
    asked = {
        row.id for row in rows if set(row.questions) - set(by_id[row.id].questions)
    }
    for slot, kind in trial.items():
        if not asked.isdisjoint(slot.checks):
            if len(trial) > 1:
                alone = {slot: kind}
                yield from _try_types(alone, solved, study, standard, run, read)
            continue
        used = [
            _rate(slot.column, ids, built[row_id], tried[row_id])
            for row_id, ids in slot.checks.items()
            if row_id in tried  # its forces are known with this type
        ]
        if len(used) == len(slot.checks) and None not in used:
            yield slot, max(value for value in used if value is not None)


def _judge_again(
    site: Site,
    slots: Iterable[SizedCell],
    solved: SolvedSite,
    standard: Standard,
    run: CheckRun,
) -> tuple[Sequence[NetRow], Study]:
    """Rows of some cells whose forces are known with other types, and their study."""
    wanted = {row_id for slot in slots for row_id in slot.checks}
    old = zip(solved.site.rows, solved.rows, strict=True)
    by_id = {row.id: (row, of_row) for row, of_row in old}
    rows = [
        row
        for row in site.rows
        if row.id in wanted
        and have_same_forces(
            row, site.ranges, by_id[row.id][0], solved.site.ranges, run
        )
    ]
    envelopes = [by_id[row.id][1] for row in rows]
    return rows, judge_site(replace(site, rows=tuple(rows)), envelopes, standard, run)


def _rate(
    column: Column,
    ids: Sequence[str],
    built: Iterable[Check],
    tried: Sequence[Check],
) -> float | None:
    """Find the largest utilisation of a cell's checks; None if one does not pass.

    A check that is declared as proven elsewhere stays so; no other becomes one. A type
    may bring checks of its own: a bar bends where a rope anchor turns. One of whose
    ground without a given strength does not replace a type whose ground has one.
    """
    lost = set(ids) - {check.id for check in tried}
    if any("wedge" in name for name in lost):
        return None
    declared = {check.id for check in built if check.verdict is Verdict.DECLARED}
    places = {check.position for check in tried if check.id in ids}
    used = 0.0
    for check in tried:
        is_of_slot = _find_column(check.member) == column and check.position in places
        if check.id not in ids and not is_of_slot:
            continue
        if check.verdict is Verdict.DECLARED and check.id in declared:
            continue
        if check.verdict is not Verdict.PASS:
            return None
        used = max(used, check.utilisation_band[1] or 0.0)
    return used
