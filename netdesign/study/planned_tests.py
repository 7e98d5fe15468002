"""Pull-out tests that a site wants: how many, where, and to which load."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain, cycle, islice

from netdesign.checks import Standard
from netdesign.checks.routes import find_proof_factor, find_wanted
from netdesign.outcome import StudyError
from netdesign.site.columns.all_tables import TESTS
from netdesign.site.columns.fields import normalise
from netdesign.site.model import NetRow, Site
from netdesign.study.records import CheckRecord, RowStudy, Study
from netdesign.words.message import Message, say

STEPS = (0.1, 0.4, 0.6, 0.8, 1.0)  # of the proof load; a choice of this program


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedTests:
    """Tests of one anchor type in one ground.

    Attributes
    ----------
    type_id, ground : str
        As on sheet Anchors; the ground "" where nobody gives it.
    rows : tuple of str
        Net row of each test, the largest design force first.
    force : float
        Largest design force on an anchor of the type [kN].
    proof_load : float
        P_p [kN], (R18).
    steel : float or None
        Characteristic resistance of its steel [kN]; None where none is given.
    """

    type_id: str
    ground: str
    rows: tuple[str, ...]
    force: float
    proof_load: float
    steel: float | None

    @property
    def is_beyond_steel(self) -> bool:
        """Its steel would yield, or is not known to hold the proof load."""
        return self.steel is None or self.proof_load > self.steel


_Key = tuple[str, str]  # type and ground


def plan_tests(
    study: Study, site: Site, standard: Standard
) -> tuple[list[PlannedTests], list[Message]]:
    """Tests of every anchor type and ground, and what cannot be planned.

    All tests of a type have one proof load, by its largest design force: they prove it
    in each of its rows.

    Parameters
    ----------
    study : Study
        Judged under ``standard``.
    site : Site
        That the study is of.
    standard : Standard
        Says how many tests, and their factors.

    Raises
    ------
    StudyError
        If the profile has no number of tests, or no factors for them.
    """
    factor, count = find_proof_factor(standard), find_wanted(standard)
    if factor is None or count is None:
        raise StudyError(say("plan.no_factor", profile=standard.id))
    rows = {row.id: row for row in site.rows}
    checks: dict[_Key, list[tuple[RowStudy, CheckRecord]]] = {}
    for row in study.rows:
        grounds = _list_grounds(rows[row.id])
        for check in row.checks:
            name = check.resistance_type
            if check.mode == "pull_out" and name:
                key = _split(name, grounds.get(name, ""))
                checks.setdefault(key, []).append((row, check))
    planned, open_ = [], []
    for (name, ground), of_type in checks.items():
        forces = _rank_rows(of_type)
        if forces is None:
            open_.append(say("plan.no_force", type=name))
            continue
        planned.append(
            PlannedTests(
                type_id=name,
                ground=ground,
                rows=tuple(islice(cycle(forces), count)),
                force=max(forces.values()),
                proof_load=factor * max(forces.values()),
                steel=_find_steel(of_type),
            )
        )
    return planned, open_


def _list_grounds(row: NetRow) -> dict[str, str]:
    """Ground of each anchor type of a row: its own, else that of the row."""
    at_end = row.row_end.resistances if row.row_end else ()
    places = (row.resistances_at("intermediate"), row.resistances_at("edge"), at_end)
    found = (one for one in chain(*places) if one.mode == "pull_out")
    return {one.type_id: one.ground or row.ground_type for one in found}


def _split(name: str, ground: str) -> _Key:
    """Type and ground; of "A32 (scree)" the type alone, as sheet Anchors has it."""
    head, _, tail = name.removesuffix(")").rpartition(" (")
    field = next(one for one in TESTS.fields if one.key == "ground")
    spellings = {normalise(text): word for text, word in field.spellings.items()}
    is_named = bool(ground) and spellings.get(normalise(tail)) == ground
    return (head if head and is_named else name), ground


def _rank_rows(of_type: list[tuple[RowStudy, CheckRecord]]) -> dict[str, float] | None:
    """Largest design force of each row [kN], the largest first; None if one is open."""
    forces: dict[str, float] = {}
    for row, check in of_type:
        force = check.read_band("E_d")[1]
        if force is None:
            return None
        forces[row.id] = max(force, forces.get(row.id, 0.0))
    ranked = sorted(forces.items(), key=lambda one: -one[1])
    return dict(ranked) if ranked[0][1] > 0.0 else None


def _find_steel(of_type: list[tuple[RowStudy, CheckRecord]]) -> float | None:
    """Characteristic resistance of the steel beside a pull-out check [kN]."""
    found = (
        other.read("R_k")
        for row, check in of_type
        for other in row.checks
        if other.mode == "tendon" and other.resistance_type == check.resistance_type
    )
    return min((force for force in found if force is not None), default=None)
