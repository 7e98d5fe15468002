"""Single coupled solves of a changed row, each done once."""

from __future__ import annotations

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.grid import Case
from netdesign.envelope.run import CaseResult, build_task, run_cases
from netdesign.envelope.runner import Runner
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CreepLaw
from netdesign.snow.snowpack import Snowpack


def build_scene(row: NetRow, case: Case, law: CreepLaw) -> Scene:
    """Scene of one case of a net row.

    Raises
    ------
    ModelError
        If the model refuses it.
    """
    return Scene(
        snowpack=Snowpack(
            slope_angle=row.slope_angle,
            thickness=row.snow_thickness,
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
    )


class Probe:
    """Solves a row at a case, remembers it, and counts its solves.

    Profiles that are checked one after the other share one probe: forces do not
    depend on them.
    """

    def __init__(
        self, settings: SolverSettings, law: CreepLaw, runner: Runner | None = None
    ) -> None:
        """Without a ``runner`` cases are solved in this process and kept nowhere."""
        self.law = law
        self.count = 0
        self._settings = settings
        self._runner = runner
        self._known: dict[tuple[NetRow, Case, str], CaseResult] = {}

    def solve(self, row: NetRow, case: Case, law: CreepLaw | None = None) -> CaseResult:
        """Result of one case; a failed one is a result too."""
        law = law or self.law
        key = (row, case, law.name)
        if key not in self._known:
            self.count += 1
            task = build_task(
                case, lambda c: build_scene(row, c, law), row.layout, self._settings
            )
            (self._known[key],) = run_cases([task], self._runner)
        return self._known[key]
