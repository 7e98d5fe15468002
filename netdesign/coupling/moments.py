"""What a transient or staggered solve records, and whether it has come to rest."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from netdesign.words.message import Message

Floats = NDArray[np.float64]

# On a plateau, per e-fold of time: end pulls change by less than the first share of
# their size, node forces by less than the second of the largest of them; the net goes
# across itself less than the third share of the way it has gone, or less than the
# fourth of the snow thickness. It begins once the snow has crept by the last figure
# on average: earlier, nothing has had time to change; much later it is other snow,
# which has settled and gathered at the net.
PULL_DRIFT = 0.05
NODE_DRIFT = 0.10
REST_SHARE = 0.2
REST_WAY = 2e-3
LEAST_STRAIN = 0.004
# Pulls count from the first creep strain, when a net that hung at rest has taken up
# the history's own corners and friction, until the second: then the snow still is the
# scene's.
START_STRAIN, COUNTED_STRAIN = 1e-3, 0.01
_EFOLDS = 1.0  # for so long
CRITERION = (
    f"after a mean creep strain of {LEAST_STRAIN:.1%}, for one e-fold of time, end "
    f"pulls change by less than {PULL_DRIFT:.0%} and node forces by less than "
    f"{NODE_DRIFT:.0%} of the largest per e-fold, and the net moves by less than "
    f"{REST_SHARE:.0%} of its way, or {REST_WAY:.1%} of the snow thickness, per e-fold"
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Moment:
    """One recorded time; units are those of the run that records.

    Attributes
    ----------
    time : float
        Since the start.
    foot, head : ndarray, shape (2,)
        Pulls on the net's ends.
    tension_min, tension_max : float
        Along the net.
    on_net : ndarray, shape (2, n)
        Forces of the snow on the net's vertices above the foot.
    max_relative_density : float
        Of the snow [-].
    way : float
        Longest way of a net vertex across the net so far.
    speed : float
        Largest velocity of a net vertex across the net.
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
    """Whether, and from when on, the forces of a history hardly change.

    Attributes
    ----------
    reached : bool
        The criterion was met over a span, and the pulls have not left it since.
    time : float or None
        Begin of that span; None without one.
    index, end : int or None
        Number of its first moment, and of that which proves it.
    drift : float or None
        Largest change of an end pull since the begin over its size, per e-fold of
        time, at the end of the span or later [-].
    criterion : str
        In words.
    """

    reached: bool
    time: float | None
    index: int | None
    end: int | None = None
    drift: float | None = None
    criterion: str = CRITERION

    @property
    def was_left(self) -> bool:
        """There was one, but the pulls drifted on."""
        return self.index is not None and not self.reached


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class History:
    """A history in SI units.

    Attributes
    ----------
    moments : tuple of Moment
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

    moments: tuple[Moment, ...]
    plateau: Plateau
    start: str
    densifies: bool
    fallen_share: float
    ended: Message | None

    @property
    def at_plateau(self) -> Moment | None:
        """Moment at which the plateau is proven to begin."""
        if self.plateau.index is None:
            return None
        return self.moments[self.plateau.index]


def find_plateau(moments: Sequence[Moment]) -> Plateau:
    """First span of one e-fold of time over which the criterion holds."""
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
    return Plateau(reached=False, time=None, index=None)


def judge_plateau(moments: Sequence[Moment], plateau: Plateau) -> Plateau:
    """The plateau with the drift since it began, not reached if that is too fast.

    Snow that settles and gathers at the net is other snow in the end; a history of it
    must not pass for one that rests.
    """
    if plateau.index is None or plateau.end is None:
        return plateau
    first = moments[plateau.index]
    drift = max(
        (_drift_between(first, later) for later in moments[plateau.end :]), key=abs
    )
    return replace(plateau, drift=drift, reached=abs(drift) <= PULL_DRIFT)


def _drift_between(first: Moment, later: Moment) -> float:
    """The larger change of an end pull, signed, over its size and per e-fold."""
    changes = [
        float(np.hypot(*new) / np.hypot(*old)) - 1.0
        for old, new in ((first.foot, later.foot), (first.head, later.head))
    ]
    return max(changes, key=abs) / float(np.log(later.time / first.time))


def select_counted(
    moments: Sequence[Moment], plateau: Plateau, *, is_guessed: bool
) -> Sequence[Moment]:
    """Moments whose pulls are those of the scene's snow on its net.

    Those until the snow has crept by 1 % on average, or until a plateau begins if that
    is later, whatever the horizon: afterwards the snow is not what it was. The instants
    of the start, to 0.1 %, are left out: there the snow's upper corner and the friction
    along the net find their places. A net whose first shape is guessed pulls by that
    guess for longer: its moments count from that on which proves the plateau. Without a
    plateau all count.
    """
    if plateau.index is None or plateau.end is None:
        return moments
    strains = [moment.strain for moment in moments]
    begin, least = bisect_left(strains, START_STRAIN), plateau.index
    if is_guessed:
        begin = least = plateau.end
    return moments[begin : max(least + 1, bisect_right(strains, COUNTED_STRAIN))]


def largest_pull(pulls: Sequence[Floats]) -> Floats:
    """The vector of largest size."""
    return max(pulls, key=lambda pull: float(np.hypot(*pull)))


def _is_steady(before: Moment, after: Moment) -> bool:
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
