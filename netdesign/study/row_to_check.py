"""One net row to be checked, with what solves beside its envelope."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from netdesign.checks import Standard
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.rows import RowEnvelope, RowGrid
from netdesign.guideline.floor import Floor, FloorEnd
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import CreepLaw
from netdesign.study.case_solver import CaseSolver


@dataclass(frozen=True, slots=True, kw_only=True)
class Basis:
    """Ground of the checks of a net row, beside its forces."""

    site: Site
    row: NetRow
    standard: Standard
    law: CreepLaw


@dataclass(frozen=True, slots=True, kw_only=True)
class RowToCheck:
    """One net row under one profile.

    ``find_floor`` gives the guideline's load over ranges in which something may be
    moved, ``bound_floor`` two ends of it, or None where these are not known; ``solver``
    is None where nothing beyond the solved cases is to be solved;
    ``on_check`` is called after each check of a force.
    """

    basis: Basis
    solved: RowGrid | RowEnvelope
    find_floor: Callable[[Ranges], Floor | None]
    bound_floor: Callable[[Ranges], tuple[FloorEnd, FloorEnd] | None]
    solver: CaseSolver | None
    on_check: Callable[[], None] = lambda: None

    def count_faults(self) -> int:
        """Faults of the program in the solves so far."""
        return self.solver.faults if self.solver else 0
