"""What the solved cases of a row tell of its forces, at each corner of its statics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from operator import attrgetter

from netdesign.envelope.panel_forces import PANEL_QUANTITIES
from netdesign.envelope.row_pulls import (
    FootPulls,
    HeadPulls,
    RopeFactors,
    find_least_ropes,
    find_rope_factors,
    measure_feet,
    read_heads,
)
from netdesign.envelope.rows import RowEnvelope
from netdesign.envelope.run import CaseResult
from netdesign.guideline.floor import Floor
from netdesign.site.model import NetRow
from netdesign.structure.layout import Point, SupportLayout
from netdesign.structure.members import Member
from netdesign.study.anchor_pulls import list_pulls
from netdesign.study.case_records import LargestForce, record_largest
from netdesign.study.guideline_load import find_effects, find_row_floors, record_floor
from netdesign.study.load_along_row import (
    find_end_guy,
    find_held_sideways,
    find_tilt,
)
from netdesign.study.member_force import (
    RowForces,
    find_end_pull,
    find_one_way_pull,
)
from netdesign.study.row_to_check import RowToCheck, list_layouts, list_variants
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import say


def gather_variants(task: RowToCheck) -> list[RowForces]:
    """Forces of a row at each corner of what is assumed of its statics.

    Those of one layout share what its cases tell there.
    """
    variants: list[RowForces] = []
    rows = groupby(list_variants(task.row), key=attrgetter("layout"))
    cases: RowCases | None = None
    for layout, of_layout in rows:
        solved, (first, *others) = task.solved.on_layout(layout), of_layout
        cases = gather_cases(task, first, solved, cases)
        base = read_cases(cases)
        for row in (first, *others):
            of_row = replace(cases, task=replace(cases.task, row=row))
            variants.append(place_forces(of_row, base))
    return variants


def find_forces_alone(task: RowToCheck, row: NetRow, solved: RowEnvelope) -> RowForces:
    """Knowledge of a variant of a row by its envelope on that one's layout."""
    cases = gather_cases(task, row, solved)
    return place_forces(cases, read_cases(cases))


def find_least_forces(task: RowToCheck, row: NetRow, solved: RowEnvelope) -> RowForces:
    """Knowledge of a variant with what any panel that it may have brings at least.

    That is what its section brings, and the pull of each rope in the panel that pulls
    on it least.
    """
    cases = gather_cases(task, row, solved)
    heads = read_heads(row.layout.post_spacing, solved.results, has_panels=False)
    feet = measure_feet(solved.results, has_panels=False)
    cases = replace(
        cases,
        heads=heads,
        feet=feet,
        factors=RopeFactors(),
        outermost=heads.list_outermost(0.0),
    )
    base = read_cases(cases)
    largest = _take_least(base.largest, solved.results)
    forces = place_forces(cases, replace(base, largest=largest))
    return take_off_truss(forces)


def take_off_truss(forces: RowForces) -> RowForces:
    """The row whose guys hold no part of the ridge rope's pull beside its end guy."""
    end = forces.at_end
    if end is None:
        return forces
    alone = replace(end, uphill_guy_kN=None, downhill_guy_kN=None)
    return replace(forces, end_guy=alone)


def _take_least(
    largest: Mapping[str, LargestForce], results: Sequence[CaseResult]
) -> dict[str, LargestForce]:
    """Largest forces by the section, and of each rope in the panel with the least."""
    kept = {key: force for key, force in largest.items() if key not in PANEL_QUANTITIES}
    for rope, force in find_least_ropes(results).items():
        least = kilonewton_from_newton(force)
        kept[rope] = replace(
            largest[rope], low_kN=least, value_kN=least, high_kN=least, bound_kN=least
        )
    return kept


@dataclass(frozen=True, slots=True, kw_only=True)
class RowCases:
    """Solved cases of a row on one layout of its support.

    Attributes
    ----------
    task : RowToCheck
        The row with its envelope there.
    heads : HeadPulls
        Of all its cases.
    feet : FootPulls
        What they bring to the foot.
    floor : Floor or None
        Forces by the guideline's load.
    factors : RopeFactors
        By which that raises what pulls along the row.
    outermost : list of tuple of int, tuple of float
        Pulls on its heads with that load, by their inclination [N].
    """

    task: RowToCheck
    heads: HeadPulls
    feet: FootPulls
    floor: Floor | None
    factors: RopeFactors
    outermost: list[tuple[int, Point]]


def gather_cases(
    task: RowToCheck, row: NetRow, solved: RowEnvelope, before: RowCases | None = None
) -> RowCases:
    """Solved cases of a variant of a row; ``before`` on another layout of its."""
    at = replace(task, row=row, solved=solved)
    width, floor = row.layout.post_spacing, _find_floor(task, row.layout)
    if before and _pull_alike(before.floor, floor):
        return replace(before, task=at, floor=floor)
    heads = before.heads if before else read_heads(width, solved.results)
    return RowCases(
        task=at,
        heads=heads,
        feet=before.feet if before else measure_feet(solved.results),
        floor=floor,
        factors=find_rope_factors(solved.results, floor),
        outermost=heads.list_outermost(
            floor.head.pull if floor and floor.head else 0.0
        ),
    )


def _pull_alike(first: Floor | None, second: Floor | None) -> bool:
    """Both loads pull as much on foot and head, so that they raise ropes alike."""
    if first is None or second is None:
        return first is second
    pulls = [
        (foot.force, floor.head.pull)
        for floor in (first, second)
        if floor.head and (foot := floor.find(Member.FOOT_ANCHOR))
    ]
    return len(pulls) == len({*pulls}) + 1


def _find_floor(task: RowToCheck, layout: SupportLayout) -> Floor | None:
    """Forces by the guideline's load on a layout; all corners are found at once."""
    ranges = task.site.ranges
    if (layout, ranges) not in task.floors:
        corners = list_layouts(task.row)
        layouts = corners if layout in corners else (layout,)
        floors = find_row_floors(task.row, ranges, task.standard, layouts)
        task.floors.update(((one, ranges), floor) for one, floor in floors.items())
    return task.floors[layout, ranges]


def read_cases(cases: RowCases) -> RowForces:
    """Knowledge of a row by its cases, whatever guys hold its posts along the row."""
    task, floor = cases.task, cases.floor
    site, row, standard = task.site, task.row, task.standard
    results, extremes = task.solved.results, task.solved.extremes
    return RowForces(
        site=site,
        row=row,
        standard=standard,
        effects=find_effects(row, standard, site.ranges),
        extremes=extremes,
        largest={
            k: record_largest(extreme, task.solved) for k, extreme in extremes.items()
        },
        floor=record_floor(floor, cases.factors),
        held=say("check.no_case_solved"),
        tilt=find_tilt(
            row, (result.case.inclination for result in results if result.is_converged)
        ),
        open_cases=task.solved.gap,
    )


def place_forces(cases: RowCases, base: RowForces) -> RowForces:
    """Knowledge of a row with its guys; ``base`` is what its cases tell without."""
    task, floor = cases.task, cases.floor
    head = floor.head if floor else None
    held = find_held_sideways(task, cases.heads, head)
    forces = replace(base, row=task.row, held=held)
    share, one_way = forces.effects.lateral_share, find_one_way_pull(forces)
    pulls = list_pulls(task, cases.feet, share, head, one_way)
    forces = replace(forces, pulls=tuple(pulls))
    end, along = task.row.row_end, find_end_pull(forces)
    if end is None or along is None:
        return forces
    wider = forces.effects.supports[-1].width / task.row.layout.post_spacing
    pulls_there = [(place, (wider * x, wider * y)) for place, (x, y) in cases.outermost]
    end_guy = find_end_guy(task, end, cases.heads, pulls_there, along)
    return replace(forces, end_guy=end_guy)
