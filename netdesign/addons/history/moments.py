"""Moments of a transient or staggered solve, and whether it has come to rest."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from netdesign.numerics.arrays import Floats

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
CRITERION = (
    f"after a mean creep strain of {LEAST_STRAIN:.1%}, for one e-fold of time, end "
    f"pulls change by less than {PULL_DRIFT:.0%} and node forces by less than "
    f"{NODE_DRIFT:.0%} of the largest per e-fold, and the net moves by less than "
    f"{REST_SHARE:.0%} of its way, or {REST_WAY:.1%} of the snow thickness, per e-fold"
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
    time : float or None
        Begin of that span [time scale, or s]; None without one.
    index, end : int or None
        Number of its first moment, and of that which proves it.
    drift : float or None
        Largest change of an end pull since the begin over its size, per e-fold of
        time, at the end of the span or later [-].
    """

    reached: bool
    time: float | None = None
    index: int | None = None
    end: int | None = None
    drift: float | None = None

    @property
    def was_left(self) -> bool:
        """There was one, but the pulls drifted on."""
        return self.index is not None and not self.reached


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
            return Plateau(
                reached=True, time=moments[begin].time, index=begin, end=place
            )
    return Plateau(reached=False)


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


def largest_pull(pulls: Sequence[Floats]) -> Floats:
    """The vector of largest size.

    Parameters
    ----------
    pulls : sequence of ndarray, shape (2,)
        Any unit.

    Returns
    -------
    ndarray, shape (2,)
        In that unit.
    """
    return max(pulls, key=lambda pull: float(np.hypot(*pull)))


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
