"""A history as it is kept and shown: its moments in SI units, and its plateau."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from netdesign.addons.history.moments import (
    COUNTED_STRAIN,
    CRITERION,
    HistoryPoint,
    Plateau,
)
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import Solution
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome
from netdesign.units import (
    day_from_second,
    fluidity_per_mpa_year,
    kilonewton_from_newton,
)
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

_NOTED_LOSS = 0.005  # share of the snow that may go over the head unmentioned


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class History:
    """A history in SI units.

    Attributes
    ----------
    moments : tuple of HistoryPoint
        [s, N/m, m, m/s].
    plateau : Plateau
        [s].
    start : str
        ``steady``, ``sagged`` or ``straight``.
    densifies : bool
        The creep law followed the density.
    fallen_share : float
        Share of the snow's mass that fell over the head.
    ended : Message or None
        Why it ended before its horizon; None if it did not.
    """

    moments: tuple[HistoryPoint, ...]
    plateau: Plateau
    start: str
    densifies: bool
    fallen_share: float
    ended: Message | None

    @property
    def at_plateau(self) -> HistoryPoint | None:
        """Point at which the plateau is proven to begin."""
        if self.plateau.index is None:
            return None
        return self.moments[self.plateau.index]

    @property
    def unproven(self) -> Message | None:
        """Reason why it proves nothing: no plateau; None where it has one."""
        if self.plateau.reached:
            return None
        return self.ended or Outcome.PLATEAU_NOT_REACHED.message

    def write(self, solution: Solution, language: Language) -> dict[str, Any]:
        """Part of the solution document: moments, the plateau and both its pulls."""
        plateau, moment = self.plateau, self.at_plateau
        return {
            "history": [_write_moment(entry) for entry in self.moments],
            "plateau": {
                "reached": plateau.reached,
                "time_d": None
                if plateau.time is None
                else day_from_second(plateau.time),
                "criterion": CRITERION,
                "drift_per_efold": plateau.drift,
                "foot_kN_per_m": None if moment is None else _size(moment.foot),
                "head_kN_per_m": None if moment is None else _size(moment.head),
            },
            "largest": {
                f"{end}_kN_per_m": kilonewton_from_newton(pull.size)
                for end, pull in (("foot", solution.foot), ("head", solution.head))
            },
            "start": self.start,
            "densification": self.densifies,
            "fallen_over_head": self.fallen_share,
            "ended": render(self.ended or "", language),
        }

    def write_table(self) -> bytes:
        """Moments as CSV, one a line."""
        return write_moments([_write_moment(entry) for entry in self.moments])

    def list_flags(self, scene: Scene) -> list[Message]:
        """Remarks that a reader must know before using the numbers."""
        flags = [_describe_clock(scene)] if scene.settles_as_stations else []
        plateau = self.plateau
        if plateau.was_left:
            flags.append(
                say(
                    "solution.plateau_left",
                    drift=float(plateau.drift or 0.0),
                    strain=COUNTED_STRAIN,
                )
            )
        elif not plateau.reached:
            flags.append(say("solution.plateau_not_reached"))
        if self.ended:
            flags.append(say("solution.ended_early", reason=self.ended))
        if self.fallen_share > _NOTED_LOSS:
            flags.append(say("solution.fell_over", share=float(self.fallen_share)))
        return flags


def write_moments(moments: Sequence[Mapping[str, Any]]) -> bytes:
    """History of a solution document as CSV, one moment a line."""
    from netdesign.report.blocks import write_csv

    plain = [key for key in moments[0] if key != "node_forces"]
    count = len(moments[0]["node_forces"])
    nodes = [
        f"node_{k + 1}_{axis}_kN_per_m" for k in range(count) for axis in ("x", "y")
    ]
    rows = [
        [
            *(moment[key] for key in plain),
            *(part for node in moment["node_forces"] for part in node),
        ]
        for moment in moments
    ]
    return write_csv([*plain, *nodes], rows)


def _write_moment(moment: HistoryPoint) -> dict[str, Any]:
    return {
        "time_d": day_from_second(moment.time),
        "foot_kN_per_m": _size(moment.foot),
        "head_kN_per_m": _size(moment.head),
        "tension_min_kN_per_m": kilonewton_from_newton(moment.tension_min),
        "tension_max_kN_per_m": kilonewton_from_newton(moment.tension_max),
        "max_relative_density": moment.max_relative_density,
        "relative_residual": moment.residual,
        "node_forces": [
            [kilonewton_from_newton(float(x)), kilonewton_from_newton(float(y))]
            for x, y in moment.on_net.T
        ],
    }


def _size(vector: Floats) -> float:
    return kilonewton_from_newton(float(np.hypot(*vector)))


def _describe_clock(scene: Scene) -> Message:
    n = scene.creep_law.exponent
    fluidity = fluidity_per_mpa_year(scene.creep_fluidity, n)
    return say("solution.settling_clock", fluidity=fluidity, exponent=n)
