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
from netdesign.envelope.rows import RowEnvelope
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
from netdesign.study.judge import judge_site
from netdesign.study.member_checks import find_ground, holds_in_ground
from netdesign.study.records import Study
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
    site: Site,
    solved: Sequence[RowEnvelope],
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
    site : Site
        As built.
    solved : sequence of RowEnvelope
        Of its rows.
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
    trials = _Trials(
        site=site, solved=solved, study=study, standard=standard, run=run, read=read
    )
    cells = [cell for cell in _list_cells(study, site) if cell.open_rows]
    placed = [cell for cell in cells if cell.cell]
    used_by_type: dict[SizedCell, dict[str, float]] = {cell: {} for cell in cells}
    for number in range(max((len(cell.types) for cell in placed), default=0)):
        trial = {
            cell: cell.types[number] for cell in placed if number < len(cell.types)
        }
        for cell, used in trials.list_passing(trial):
            used_by_type[cell][trial[cell]] = used
    return [_choose(cell, used) for cell, used in used_by_type.items()]


def _choose(cell: SizedCell, passing: Mapping[str, float]) -> SizedCell:
    best = min(passing, key=lambda kind: (-passing[kind], kind), default="")
    return replace(cell, now=best, used=passing.get(best))


def _list_cells(study: Study, site: Site) -> Iterator[SizedCell]:
    """Cells that name a type, with the checks of the type in each row.

    A row is open where a check with a known force does not pass. Of two rows a type has
    to hold in the ground of both.
    """
    named: dict[tuple[str, ...], dict[str, list[Check]]] = {}
    rows = {row.id: row for row in site.rows}
    for row in study.rows:
        for check in row.checks:
            column = _find_column(check.member)
            if column is not None:
                cell, was = _find_cell(rows[row.id], column, check.position)
                key = (column, cell, was, "" if cell else row.id)
                named.setdefault(key, {}).setdefault(row.id, []).append(check)
    for (name, cell, was, _), of_rows in named.items():
        column = next(column for column in _MODES if column == name)
        grounds = [_compare_grounds(site, rows[row], column, was) for row in of_rows]
        yield SizedCell(
            checks={
                row: tuple(check.id for check in checks)
                for row, checks in of_rows.items()
            },
            open_rows=tuple(
                row for row, checks in of_rows.items() if any(map(_is_open, checks))
            ),
            column=column,
            cell=cell,
            was=was,
            types=tuple(
                kind for kind in grounds[0] if all(holds[kind] for holds in grounds)
            ),
            left_out=max(list(holds.values()).count(False) for holds in grounds),
        )


def _is_open(check: Check) -> bool:
    return check.verdict in _OPEN and check.demand_kN is not None


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


@dataclass(frozen=True, slots=True, kw_only=True)
class _Trials:
    """Site as built, with what judges it again with other types in its cells."""

    site: Site
    solved: Sequence[RowEnvelope]
    study: Study
    standard: Standard
    run: CheckRun
    read: ReadInstead

    def list_passing(
        self, trial: Mapping[SizedCell, str]
    ) -> Iterator[tuple[SizedCell, float]]:
        """Cells that pass with their types of a trial, with their largest utilisations.

        A type that raises a question leaves its row open, and one that is refused the
        whole site: the types of other cells are then tried alone.
        """
        try:
            site = self.read({cell.cell: kind for cell, kind in trial.items()})
        except SiteDataError:
            yield from self._try_alone(trial, trial)
            return
        questions = {row.id: set(row.questions) for row in self.site.rows}
        rows, judged = self._judge_again(site, trial)
        asked = {row.id for row in rows if set(row.questions) - questions[row.id]}
        alone = [cell for cell in trial if not asked.isdisjoint(cell.checks)]
        yield from self._try_alone(alone, trial)
        built = {row.id: row.checks for row in self.study.rows}
        tried = {row.id: row.checks for row in judged.rows}
        for cell in trial:
            if cell in alone or not tried.keys() >= cell.checks.keys():
                continue  # not all its forces are known with this type
            used = [
                _rate(cell.column, ids, built[row_id], tried[row_id])
                for row_id, ids in cell.checks.items()
            ]
            if None not in used:
                yield cell, max(value for value in used if value is not None)

    def _try_alone(
        self, cells: Iterable[SizedCell], trial: Mapping[SizedCell, str]
    ) -> Iterator[tuple[SizedCell, float]]:
        for cell in cells if len(trial) > 1 else ():
            yield from self.list_passing({cell: trial[cell]})

    def _judge_again(
        self, site: Site, cells: Iterable[SizedCell]
    ) -> tuple[Sequence[NetRow], Study]:
        """Rows whose forces are known with other types in cells, and their study."""
        wanted = {row_id for cell in cells for row_id in cell.checks}
        built, run = self.site, self.run
        known = zip(built.rows, self.solved, strict=True)
        by_id = {row.id: (row, of_row) for row, of_row in known}
        rows = tuple(
            row
            for row in site.rows
            if row.id in wanted
            and have_same_forces(row, site.ranges, by_id[row.id][0], built.ranges, run)
        )
        solved = [by_id[row.id][1] for row in rows]
        return rows, judge_site(replace(site, rows=rows), solved, self.standard, run)


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
