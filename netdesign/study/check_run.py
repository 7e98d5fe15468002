"""Settings of a run of `check`: what it has beside its inputs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, cast, get_args

from netdesign.coupling.scene import SolverSettings
from netdesign.snow.creep_law import BOUTILLIER_2004, CreepLaw

Method = Literal["steady", "transient"]


def read_method(name: str) -> Method:
    """Method of a name in a document.

    Raises
    ------
    ValueError
        If no method has it.
    """
    if name not in get_args(Method):
        raise ValueError(f"no method {name!r:.60}")
    return cast(Method, name)


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckRun:
    """Settings of the solves of a site.

    With ``has_reliability`` the notional reliability of each row is worked out, too.
    """

    settings: SolverSettings
    method: Method = "steady"
    creep_law: CreepLaw = BOUTILLIER_2004
    jobs: int = 1
    started: str = ""  # ISO 8601, UTC; given, so that equal input gives equal bytes
    has_reliability: bool = False
