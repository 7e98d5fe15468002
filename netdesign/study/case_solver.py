"""Coupled solves of a row with a changed value, each done once."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult, CaseTask, build_task, run_cases
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CreepLaw
from netdesign.snow.law import Sides
from netdesign.snow.snowpack import Snowpack
from netdesign.solving.runner import Runner

_TWO_SIDED: Sides = "two-sided"


def build_scene(
    row: NetRow, case: Case, law: CreepLaw, ground_contact: Sides = "two-sided"
) -> Scene:
    """Scene of one case of a net row, with what ranges as the case has it.

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
        ground=row.ground,
        net=Net(
            height_normal=row.net_height,
            inclination=case.inclination,
            stiffness_per_m=row.net_stiffness_per_m,
            slack=row.slack,
            friction_angle=case.friction_angle,
        ),
        creep_law=law,
        ground_contact=ground_contact,
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
        self._known: dict[tuple[NetRow, Case, str, Sides], CaseResult] = {}

    def solve(self, row: NetRow, case: Case, law: CreepLaw | None = None) -> CaseResult:
        """Result of one case; a failed one is a result too."""
        (result,) = self.solve_all([(row, case, law or self.law)])
        return result

    def solve_all(
        self,
        wanted: Sequence[tuple[NetRow, Case, CreepLaw]],
        contacts: Sequence[Sides] = (),
    ) -> list[CaseResult]:
        """Results of some cases in their order, the unknown ones solved together.

        ``contacts`` are those of their grounds; two-sided unless told.
        """
        sides = contacts or (_TWO_SIDED,) * len(wanted)
        keys: list[tuple[NetRow, Case, str, Sides]] = [
            (row, case, law.name, side)
            for (row, case, law), side in zip(wanted, sides, strict=True)
        ]
        unknown = {
            key: self._build_task(*one, key[-1])
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

    def _build_task(
        self, row: NetRow, case: Case, law: CreepLaw, contact: Sides
    ) -> CaseTask:
        return build_task(
            case,
            lambda c: build_scene(row, c, law, contact),
            row.layout,
            self._settings,
            row.panels,
        )
