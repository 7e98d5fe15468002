"""One net row to be checked, with what solves it beside its envelope; its snow."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from netdesign.cable.net import Net
from netdesign.checks import Standard
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.extremes import Extreme
from netdesign.envelope.ranges import Case
from netdesign.envelope.rows import RowEnvelope
from netdesign.envelope.run import CaseResult, CaseTask, build_task, run_cases
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import CreepLaw
from netdesign.snow.snowpack import Snowpack
from netdesign.solving.runner import Runner
from netdesign.study.effects import find_solved_ground
from netdesign.study.variants import list_layouts


@dataclass(frozen=True, slots=True, kw_only=True)
class Basis:
    """Ground of the checks of a net row, beside its forces."""

    site: Site
    row: NetRow
    standard: Standard
    law: CreepLaw


@dataclass(frozen=True, slots=True, kw_only=True)
class RowToCheck(Basis):
    """One net row under one profile.

    ``extremes`` are the largest forces of its solved cases; ``solver`` is None where
    nothing beyond the solved cases is to be solved; ``on_check`` is called after each
    check of a force.
    """

    solved: RowEnvelope
    extremes: Mapping[str, Extreme]
    solver: CaseSolver | None
    on_check: Callable[[], None] = lambda: None

    def count_faults(self) -> int:
        """Faults of the program in the solves so far."""
        return self.solver.faults if self.solver else 0


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
    layout, *others = list_layouts(row)
    return build_task(
        case,
        lambda one: build_scene(row, one, law),
        layout,
        settings,
        row.panels,
        tuple(others),
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
        self.faults = 0  # of the program, in what was asked for
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
            key: build_row_task(*one, self._settings)
            for key, one in zip(keys, wanted, strict=True)
            if key not in self._known
        }
        self.count += len(unknown)
        results = run_cases(list(unknown.values()), self._runner)
        self._known |= zip(unknown, results, strict=True)
        found = [self._known[key] for key in keys]
        for (row, *_), result in zip(keys, found, strict=True):
            self._runner.keep_fault(result.fault, row.id)
            self.faults += result.fault is not None
        return found
