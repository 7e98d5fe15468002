"""One net row to be checked, the settings of its run, and what solves its cases.

The variants of a row are the corners of what is assumed of its statics. Post, guys and
end guy hold what the net pulls, and do not change it: a variant has the row's solved
cases, and forces of its own. Where the largest lies: structure/THEORY.md, "Where nobody
gives a number".
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product

from netdesign.cable.net import Net
from netdesign.checks import Standard
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.ranges import Case, Ranges
from netdesign.envelope.rows import RowEnvelope
from netdesign.envelope.run import CaseResult, CaseTask, build_task, run_cases
from netdesign.guideline.floor import Floor
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import BOUTILLIER_2004, CreepLaw
from netdesign.snow.snowpack import Snowpack
from netdesign.solving.runner import Runner
from netdesign.structure.layout import SupportLayout
from netdesign.structure.splay import Guys
from netdesign.study.guideline_load import find_solved_ground

_OF_LAYOUT = ("post_tilt", "uphill_anchor_distance", "downhill_anchor_distance")
_COUNT, _SPLAY, _END = "guy_count", "guy_splay", "end_guy_angle"
_OF_STATICS = (*_OF_LAYOUT, _COUNT, _SPLAY, _END)


def list_layouts(row: NetRow) -> tuple[SupportLayout, ...]:
    """Layouts of a row's support at all corners of what is assumed of them."""
    corners = _list_corners(row, _OF_LAYOUT)
    return tuple(replace(row.layout, **values) for values in corners)


def list_variants(row: NetRow) -> tuple[NetRow, ...]:
    """The row at each corner of what is assumed of its statics; itself without any.

    What is assumed of a variant has one value, at which it is. Those of one layout
    stand together, the layouts in the order of ``list_layouts``.
    """
    apart: dict[tuple[tuple[str, float], ...], dict[str, float]] = {}
    for values in _list_corners(row, _OF_STATICS):
        if values.get(_COUNT, row.guys.count) < 2:
            values.pop(_SPLAY, None)  # a single guy has none
        apart.setdefault(tuple(values.items()), values)
    return tuple(place_variant(row, values) for values in apart.values())


def place_variant(row: NetRow, values: Mapping[str, float]) -> NetRow:
    """The row with values of what is assumed of its statics, by their keys."""
    layout = {key: values[key] for key in _OF_LAYOUT if key in values}
    guys, end = row.guys, row.row_end
    if _COUNT in values or _SPLAY in values:
        count = int(values.get(_COUNT, guys.count))
        splay = values.get(_SPLAY, guys.splay) if count > 1 else None
        guys = Guys(count=count, splay=splay, are_shared=guys.are_shared)
    if end is not None and _END in values:
        end = replace(end, guy_angle=values[_END])
    return replace(
        row,
        layout=replace(row.layout, **layout),
        guys=guys,
        row_end=end,
        assumed=tuple(
            replace(assumed, low=values[assumed.key], high=values[assumed.key])
            if assumed.key in values
            else assumed
            for assumed in row.assumed
            if assumed.key != _SPLAY or guys.count > 1
        ),
    )


def read_values(row: NetRow) -> dict[str, float]:
    """Values of what is assumed of a variant's statics, by their keys, in SI units."""
    return {
        assumed.key: assumed.low
        for assumed in row.assumed
        if assumed.key in _OF_STATICS and not assumed.is_range
    }


def _list_corners(row: NetRow, keys: Sequence[str]) -> Iterator[dict[str, float]]:
    """Values at all corners of what is assumed of some columns, by their keys."""
    ends = {}
    for key in keys:
        assumed = row.find_assumed(key)
        if assumed is not None and (key != _END or row.row_end is not None):
            ends[key] = dict.fromkeys((assumed.low, assumed.high))
    for corner in product(*ends.values()):
        yield dict(zip(ends, corner, strict=True))


@dataclass(frozen=True, slots=True, kw_only=True)
class Basis:
    """Ground of the checks of a net row, beside its forces."""

    site: Site
    row: NetRow
    standard: Standard


@dataclass(frozen=True, slots=True, kw_only=True)
class RowToCheck(Basis):
    """One net row under one profile.

    ``solver`` is None where nothing beyond the solved cases is to be solved; ``floors``
    are those worked out so far, by layout and ranges.
    """

    law: CreepLaw
    solved: RowEnvelope
    solver: CaseSolver | None
    floors: dict[tuple[SupportLayout, Ranges], Floor | None] = field(
        default_factory=dict
    )


def build_scene(row: NetRow, case: Case, law: CreepLaw) -> Scene:
    """Scene of one case of a net row, with what ranges as the case has it.

    Its ground slips at least as far as the guideline's least glide factor says.

    Raises
    ------
    ModelError
        If the model refuses it.
    """
    row = row.at(case)
    return Scene(
        snowpack=Snowpack(
            slope_angle=row.slope_angle,
            thickness=row.held_thickness,
            upslope_length=row.upslope_length,
            density=case.density,
            layers=row.layers_at(case.density),
        ),
        ground=find_solved_ground(row, law),
        net=Net(
            height_normal=row.net_height,
            inclination=case.inclination,
            stiffness_per_m=row.net_stiffness_per_m,
            slack=row.slack,
            friction_angle=case.friction_angle,
        ),
        creep_law=law,
    )


def build_row_task(
    row: NetRow,
    case: Case,
    law: CreepLaw,
    settings: SolverSettings,
) -> CaseTask:
    """Task of one case of a net row; a refused scene is a named refusal."""
    return build_task(
        case,
        lambda case_solved: build_scene(row, case_solved, law),
        list_layouts(row),
        settings,
        row.panels,
    )


class CaseSolver:
    """Solves a row at a case, remembers it, and counts its solves.

    Profiles that are checked one after the other share one solver: forces do not
    depend on them.
    """

    def __init__(
        self, settings: SolverSettings, law: CreepLaw, runner: Runner | None = None
    ) -> None:
        """Without a ``runner`` cases are solved in this process and kept nowhere."""
        self.law = law
        self.count = 0
        self._settings = settings
        self._runner = runner or Runner()
        self._known: dict[tuple[NetRow, Case, str], CaseResult] = {}

    def solve_all(
        self, wanted: Sequence[tuple[NetRow, Case, CreepLaw]]
    ) -> list[CaseResult]:
        """Results of some cases in their order, the unknown ones solved together.

        A failed one is a result too.
        """
        keys = [(row, case, law.name) for row, case, law in wanted]
        unknown = {
            key: build_row_task(*asked, self._settings)
            for key, asked in zip(keys, wanted, strict=True)
            if key not in self._known
        }
        self.count += len(unknown)
        results = run_cases(list(unknown.values()), self._runner)
        self._known |= zip(unknown, results, strict=True)
        results_asked = [self._known[key] for key in keys]
        for (row, *_), result in zip(keys, results_asked, strict=True):
            self._runner.keep_fault(result.fault, row.id)
        return results_asked


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckRun:
    """Settings of the solves of a site.

    With ``has_reliability`` the notional reliability of each row is worked out, too.
    """

    settings: SolverSettings
    creep_law: CreepLaw = BOUTILLIER_2004
    started: str = ""  # ISO 8601, UTC; given, so that equal input gives equal bytes
    has_reliability: bool = False
