"""Moments of a history, the plateau of its forces, and the history in SI units.

Theory: coupling/THEORY.md, section 6.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

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

# Plateau, each per e-fold of time (coupling/THEORY.md, section 6).
PULL_DRIFT = 0.05  # change of an end pull, over its size
NODE_DRIFT = 0.10  # change of a node force, over the largest of them
REST_SHARE = 0.2  # way of the net across itself, over its way so far
REST_WAY = 2e-3  # or over the snow thickness
# Mean creep strain from which a plateau may begin: earlier, nothing has had time to
# change.
LEAST_STRAIN = 0.004
# Mean creep strains from which and until which pulls count. At the first, a net that
# hung at rest has taken up the history's own corners and friction. Until the second the
# snow still is the scene's.
START_STRAIN, COUNTED_STRAIN = 1e-3, 0.01
_EFOLDS = 1.0  # for so long
CRITERION = say(
    "solved.criterion",
    strain=LEAST_STRAIN,
    pull=PULL_DRIFT,
    node=NODE_DRIFT,
    rest=REST_SHARE,
    way=REST_WAY,
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HistoryPoint:
    """One recorded time: of a ``Run`` dimensionless, of a ``History`` in SI units.

    Attributes
    ----------
    time : float
        Since the start [time scale, or s].
    foot, head : ndarray, shape (2,)
        Pulls on the net's ends [rho g d^2, or N/m].
    tension_min, tension_max : float
        Along the net [rho g d^2, or N/m].
    on_net : ndarray, shape (2, n)
        Forces of the snow on the net's vertices above the foot [rho g d^2, or N/m].
    max_relative_density : float
        Of the snow [-].
    way : float
        Longest way of a net vertex across the net so far [thickness, or m].
    speed : float
        Largest velocity of a net vertex across the net [velocity scale, or m/s].
    strain : float
        Mean size of the snow's creep strain so far [-].
    residual : float
        Force missing from the balance, over the weight.
    """

    time: float
    foot: Floats
    head: Floats
    tension_min: float
    tension_max: float
    on_net: Floats
    max_relative_density: float
    way: float
    speed: float
    strain: float
    residual: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Plateau:
    """Span of a history over which its forces hardly change, if there is one.

    Attributes
    ----------
    reached : bool
        The criterion was met over a span, and the pulls have not left it since.
    index, end : int or None
        Number of its first moment, and of that which proves it.
    drift : float or None
        Largest change of an end pull since the begin over its size, per e-fold of
        time, at the end of the span or later [-].
    """

    reached: bool
    index: int | None = None
    end: int | None = None
    drift: float | None = None

    @property
    def was_left(self) -> bool:
        """There was one, but the pulls drifted on."""
        return self.index is not None and not self.reached


NO_PLATEAU = Plateau(reached=False)


def find_plateau(moments: Sequence[HistoryPoint]) -> Plateau:
    """First span of one e-fold of time over which the criterion holds.

    Parameters
    ----------
    moments : sequence of HistoryPoint
        In the order of time.
    """
    begin: int | None = None
    for place in range(1, len(moments)):
        if not _is_steady(moments[place - 1], moments[place]):
            begin = None
            continue
        if begin is None:
            begin = place - 1
        if np.log(moments[place].time / moments[begin].time) >= _EFOLDS:
            return Plateau(reached=True, index=begin, end=place)
    return NO_PLATEAU


def judge_plateau(moments: Sequence[HistoryPoint], plateau: Plateau) -> Plateau:
    """The plateau with the drift since it began, not reached if that is too fast.

    Snow that settles and gathers at the net is other snow in the end; a history of it
    must not pass for one that rests.

    Parameters
    ----------
    moments : sequence of HistoryPoint
        In the order of time.
    plateau : Plateau
        As ``find_plateau`` gives it.
    """
    if plateau.index is None or plateau.end is None:
        return plateau
    first = moments[plateau.index]
    drift = max(
        (_drift_between(first, later) for later in moments[plateau.end :]), key=abs
    )
    return replace(plateau, drift=drift, reached=abs(drift) <= PULL_DRIFT)


def _drift_between(first: HistoryPoint, later: HistoryPoint) -> float:
    """The larger change of an end pull, signed, over its size and per e-fold."""
    changes = [
        float(np.hypot(*new) / np.hypot(*old)) - 1.0
        for old, new in ((first.foot, later.foot), (first.head, later.head))
    ]
    return max(changes, key=abs) / float(np.log(later.time / first.time))


def select_counted(
    moments: Sequence[HistoryPoint], plateau: Plateau, *, is_guessed: bool
) -> Sequence[HistoryPoint]:
    """Moments whose pulls are those of the scene's snow on its net.

    Those until the snow has crept by 1 % on average, or until a plateau begins if that
    is later, whatever the horizon: afterwards the snow is not what it was. The instants
    of the start, to 0.1 %, are left out: there the snow's upper corner and the friction
    along the net find their places. A net whose first shape is guessed pulls by that
    guess for longer: its moments count once the plateau is proven. Without a plateau
    all count.

    Parameters
    ----------
    moments : sequence of HistoryPoint
        In the order of time.
    plateau : Plateau
        Of this history.
    is_guessed : bool
        The net's first shape was a guess.
    """
    if plateau.index is None or plateau.end is None:
        return moments
    strains = [moment.strain for moment in moments]
    begin, least = bisect_left(strains, START_STRAIN), plateau.index
    if is_guessed:
        begin = least = plateau.end
    return moments[begin : max(least + 1, bisect_right(strains, COUNTED_STRAIN))]


def _is_steady(before: HistoryPoint, after: HistoryPoint) -> bool:
    if not before.strain >= LEAST_STRAIN:
        return False
    efolds = np.log(after.time / before.time)
    if not after.time * after.speed < max(REST_SHARE * after.way, REST_WAY):
        return False
    for old, new in ((before.foot, after.foot), (before.head, after.head)):
        if not np.hypot(*(new - old)) < PULL_DRIFT * efolds * np.hypot(*new):
            return False
    change = np.hypot(*(after.on_net - before.on_net)).max()
    return bool(change < NODE_DRIFT * efolds * np.hypot(*after.on_net).max())


_NOTED_LOSS = 0.005  # share of the snow that may go over the head unmentioned


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class History:
    """A history in SI units.

    Attributes
    ----------
    moments : tuple of HistoryPoint
        [s, N/m, m, m/s].
    plateau : Plateau
        Of its moments.
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
                "time_d": None if moment is None else day_from_second(moment.time),
                "criterion": render(CRITERION, language),
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
        flags, plateau = [], self.plateau
        if scene.settles_as_stations:
            n = scene.creep_law.exponent
            fluidity = fluidity_per_mpa_year(scene.creep_fluidity, n)
            clock = say("solution.settling_clock", fluidity=fluidity, exponent=n)
            flags.append(clock)
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
