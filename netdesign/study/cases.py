"""The cases of a site: a search of the worst."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

from netdesign.coupling.scene import Scene
from netdesign.edge.progress import Phase
from netdesign.envelope.ranges import NO_RANGES, Case, Ranges
from netdesign.envelope.rows import RowEnvelope, RowTask, refine_settings
from netdesign.envelope.search import search_rows
from netdesign.outcome import ModelError
from netdesign.search.maxima import SearchSettings
from netdesign.search.upper_bound import list_first_design
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import CREEP_LAWS, CreepLaw
from netdesign.solving.runner import Runner
from netdesign.study.row_to_check import CheckRun, build_scene, list_layouts
from netdesign.words.message import Message, group_reasons, say

# Solves of a row, as --dry-run and progress expect them. Beside the envelope a row
# takes one for each other creep law.
_SEARCH, _BESIDE = 55, len(CREEP_LAWS) - 1
_BEYOND_FIRST = 20  # 35 first cases of three ranges, 55 in all
_CLOSEST_GAP = 1e-3  # of a search, however accurate its cases are
_USUAL_RANGES, _MORE_CASES = 3, 150  # density, friction, inclination; for each more


def count_cases(site: Site) -> int:
    """Estimate the number of cases of a search."""
    return sum(_count_row(site.at_row(row).ranges) for row in site.rows)


def _count_row(ranges: Ranges) -> int:
    """Estimate the number of cases of a row from its first design."""
    if not ranges.axes:
        return 1
    return max(_SEARCH, len(list_first_design(len(ranges.axes))) + _BEYOND_FIRST)


def list_phases(site: Site) -> list[Phase]:
    """Phases of the check of a site, in their order, with about so many solves."""
    rows = len(site.rows)
    search, checks = count_cases(site), rows * _BESIDE
    phases = [
        Phase(key="envelope", words=say("phase.search_cases"), cases=search),
        Phase(key="checks", words=say("phase.checks"), cases=checks, pieces=rows),
    ]
    reports = Phase(key="reports", words=say("phase.reports"), cases=0)
    return [*(phase for phase in phases if phase.cases), reports]


def search_site(
    site: Site,
    run: CheckRun,
    runner: Runner | None = None,
) -> list[RowEnvelope]:
    """Search the largest forces of all net rows; no limit profile is needed for it.

    Parameters
    ----------
    site : Site
        What the engineer gives.
    run : CheckRun
        Settings; their accuracy is the gap that is asked for, too.
    runner : Runner, optional
        Where cases are solved and kept; this process unless told otherwise.

    Returns
    -------
    list of RowEnvelope
        One a row, each with its upper bounds and governing cases confirmed on finer
        meshes.
    """
    runner = runner or Runner()
    tasks = [_build_search(row, site.ranges, run) for row in site.rows]
    return search_rows(tasks, runner)


@dataclass(frozen=True, slots=True, kw_only=True)
class _RowScenes:
    """Scenes of a row whose layers or further ranges follow the case.

    Layers follow the density of a case; a typed glide factor follows its thickness.
    """

    row: NetRow
    law: CreepLaw

    def __call__(self, case: Case) -> Scene:
        return build_scene(self.row, case, self.law)


def _count_most_cases(ranges: Ranges) -> int:
    """Cases after which a search ends: more for more quantities that range."""
    free = sum(interval.low < interval.high for _, interval in ranges.intervals)
    return SearchSettings().max_cases + _MORE_CASES * max(0, free - _USUAL_RANGES)


def _build_search(row: NetRow, of_site: Ranges, run: CheckRun) -> RowTask:
    ranges = of_site.replaced_by(row.ranges)
    is_own = bool(row.layers or ranges.further)
    return RowTask(
        scene=_find_scene(row, ranges, run.creep_law),
        ranges=ranges,
        layouts=list_layouts(row),
        settings=run.settings,
        search=SearchSettings(
            gap=max(run.settings.accuracy, _CLOSEST_GAP),
            max_cases=_count_most_cases(ranges),
        ),
        confirmed_by=refine_settings(run.settings) if ranges.axes else None,
        build=_build_scenes(row, run.creep_law) if is_own else None,
        panels=row.panels,
        has_end=row.row_end is not None,
    )


def have_same_forces(
    row: NetRow, ranges: Ranges, other: NetRow, others: Ranges, run: CheckRun
) -> bool:
    """Two rows have the same search, and so the same forces."""
    return _build_search(row, ranges, run) == _build_search(other, others, run)


def list_alike(site: Site, run: CheckRun) -> list[tuple[NetRow, ...]]:
    """Group the rows of a site by equal searches."""
    alike: dict[RowTask, list[NetRow]] = {}
    for row in site.rows:
        alike.setdefault(_build_search(row, site.ranges, run), []).append(row)
    return [tuple(rows) for rows in alike.values()]


def _build_scenes(row: NetRow, law: CreepLaw) -> _RowScenes:
    """Build the scenes of a row without the inputs that change no force."""
    bare = replace(
        row,
        inputs=(),
        resistances=(),
        end_resistances=None,
        axes=(),
        anchors=(),
        end_anchors=None,
        net_parts=(),
        panels=(),
        row_end=None,
        assumed=(),
        ranges=NO_RANGES,
        questions=(),
        approval=None,
    )
    return _RowScenes(row=bare, law=law)


def _find_scene(row: NetRow, ranges: Ranges, law: CreepLaw) -> Scene:
    """Scene of the first corner of the ranges that the model accepts.

    Raises
    ------
    ModelError
        If it refuses every corner.
    """
    names = [name for name, _ in ranges.intervals]
    ends = ((span.low, span.high) for _, span in ranges.intervals)
    refusals: dict[Message, None] = {}
    for values in product(*ends):
        case = Case.of(dict(zip(names, values, strict=True)))
        try:
            return build_scene(row, case, law)
        except ModelError as error:
            refused = say("study.net_row", row=row.id, reason=error.message)
            refusals.setdefault(refused)
    raise ModelError(say("text.lines", lines=group_reasons(refusals)))
