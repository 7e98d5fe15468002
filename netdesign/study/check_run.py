"""Settings of a run of `check`: what it has beside its inputs."""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.coupling.scene import SolverSettings
from netdesign.snow.creep_law import BOUTILLIER_2004, CreepLaw


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckRun:
    """Settings of the solves of a site.

    With ``has_reliability`` the notional reliability of each row is worked out, too.
    """

    settings: SolverSettings
    creep_law: CreepLaw = BOUTILLIER_2004
    jobs: int = 1
    started: str = ""  # ISO 8601, UTC; given, so that equal input gives equal bytes
    has_reliability: bool = False
