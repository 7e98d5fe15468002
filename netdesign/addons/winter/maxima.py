"""Annual maximum of a row: uniform snow of each day's mass and height.

Of many winters through a table. Theory: addons/winter/THEORY.md, sections 2, 3 and 8.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from netdesign.addons.winter.day import LEAST_DENSITY, DaySolver, RowDay
from netdesign.addons.winter.settling import DayPack
from netdesign.addons.winter.uniform_table import UniformTable, build_table
from netdesign.numerics.arrays import Floats
from netdesign.words.message import Message

# Powers of density and thickness that rank the days (fitted; no force follows).
_RANKS = {"free": (0.95, 1.15), "no-slip": (1.2, 1.9), "sliding": (1.2, 1.9)}
RANKED = 0.7  # of the best rank: days below it are not solved for the maximum
# Within one winter pulls over ranks differ by less than this factor (section 2).
RANK_SPREAD = 1.2
_FEW = 2  # days that are solved at once
# A failed day above this share of the best day's rank may be the one that governs.
DOUBTED = 0.8
_SECANT_STEPS = 3

MaximumEnding = Literal["solved", "overtopped", "doubtful", "no snow"]


@dataclass(frozen=True, slots=True, kw_only=True)
class AnnualMaximum:
    """Largest pull of a winter.

    Attributes
    ----------
    winter : str
        As "1999/2000".
    ending : str
        ``solved``; ``overtopped`` and ``doubtful`` prove no maximum: snow stood above
        the net, or a day that may govern has no force. ``no snow``: on no day it
        reached the least thickness, and the maximum is 0.
    index : int or None
        Place of its day in the series.
    foot, head : float
        Pulls of that day [N/m].
    equivalent_density : float or None
        Of uniform snow of the winter's largest height that pulls as much [kg/m3].
    bound : float or None
        The foot pulls at most that in a ``doubtful`` winter [N/m]; None without one.
    reason : Message or None
        Why a day of a ``doubtful`` winter has no force.
    """

    winter: str
    ending: MaximumEnding
    index: int | None = None
    foot: float = 0.0
    head: float = 0.0
    equivalent_density: float | None = None
    bound: float | None = None
    reason: Message | None = None

    @property
    def has_pull(self) -> bool:
        """Its pulls are those of a day, or 0 of a winter without snow."""
        return self.index is not None or self.is_proven

    @property
    def is_proven(self) -> bool:
        """The winter's maximum is known."""
        return self.ending in ("solved", "no snow")


def find_annual_maximum(
    winter: str,
    packs: Mapping[int, DayPack],
    solver: DaySolver,
    *,
    is_alone: bool = False,
    table: UniformTable | None = None,
) -> tuple[AnnualMaximum, tuple[RowDay, ...]]:
    """Annual maximum, and the days among which it was found.

    Parameters
    ----------
    winter : str
        Its name.
    packs : mapping of int to DayPack
        Snowpack of each day by its place in the series.
    solver : DaySolver
        Of the row.
    is_alone : bool, optional
        Nothing but the maximum is wanted: days that pull less by (Y19) are left out.
    table : UniformTable, optional
        Of the row; days outside are solved.
    """
    days = _prepare(packs, solver)
    chosen = choose_days(days, solver)
    read = table.read_days(chosen) if table else ()
    inside = {day.index for day in read}
    outside = [day for day in chosen if day.index not in inside]
    if is_alone:
        solved = _solve_heaviest(outside, solver, read)
    else:
        solved = (*read, *solver.solve(outside))
    best = find_largest(solved)
    judged = _judge(winter, days, solved, solver)
    if best is None or best.foot is None or best.head is None:
        return judged, solved
    top = max(day.thickness for day in days)
    by_table = table.find_density(top, best.pull or 0.0) if table else None
    maximum = replace(
        judged,
        index=best.index,
        foot=best.foot.value,
        head=best.head.value,
        equivalent_density=by_table or find_equivalent(top, best, solver),
    )
    return maximum, solved


def _prepare(packs: Mapping[int, DayPack], solver: DaySolver) -> tuple[RowDay, ...]:
    """Days with snow, uniform, before they are solved."""
    snow = {k: pack for k, pack in packs.items() if pack.heights.size}
    return solver.prepare(snow, layered=False)


def _solve_heaviest(
    days: Sequence[RowDay], solver: DaySolver, read: Sequence[RowDay] = ()
) -> tuple[RowDay, ...]:
    """Days solved by descending rank, while one that is left may pull most.

    They are solved coarsely, and the largest again to the full accuracy. None is solved
    that another outdoes in thickness and density, (Y19), unless that one has no force.
    Days that were ``read`` from a table are as accurate as they can be.
    """
    solved = list(read)
    left = _list_uncovered(days, solved)
    while batch := _choose_next(_list_heaviest(left), solved, solver):
        solved += solver.coarse.solve(batch)
        tried = {day.index for day in batch}
        left = _list_uncovered([day for day in left if day.index not in tried], solved)
    best = find_largest(solved)
    if any(day is best for day in read):
        return tuple(solved)
    return tuple(
        solver.solve([day.unsolved])[0] if day is best else day for day in solved
    )


def _list_uncovered(days: Sequence[RowDay], solved: Sequence[RowDay]) -> list[RowDay]:
    """Days that no solved day equals or exceeds in both thickness and density."""
    heaviest = _list_heaviest([heavier for heavier in solved if heavier.foot])
    return [
        day for day in days if not any(_covers(heavier, day) for heavier in heaviest)
    ]


def _choose_next(
    days: Sequence[RowDay], solved: Sequence[RowDay], solver: DaySolver
) -> list[RowDay]:
    """The two highest-ranked days that may still exceed the largest solved pull."""
    ground = solver.row.scene.ground.kind
    pulling = [day for day in solved if day.foot]
    pulls = np.array([day.pull for day in pulling])
    least = 0.0
    if pulling:
        most = float(np.max(pulls / rank_days(pulling, ground)))
        least = float(pulls.max()) / (RANK_SPREAD * most)
    ranks = rank_days(days, ground)
    order = [k for k in np.argsort(-ranks, kind="stable") if ranks[k] >= least]
    return [days[k] for k in order[:_FEW]]


def _list_heaviest(days: Sequence[RowDay]) -> list[RowDay]:
    """Days that no other day equals or exceeds in both thickness and density."""
    order = sorted(days, key=lambda day: (-day.thickness, -day.density))
    heaviest: list[RowDay] = []
    for day in order:  # only what is denser than all that is thicker
        if not heaviest or day.density > heaviest[-1].density:
            heaviest.append(day)
    return heaviest


def find_many_maxima(
    groups: Mapping[str, Mapping[str, Mapping[int, DayPack]]],
    solver: DaySolver,
    *,
    by_table: bool = True,
) -> tuple[dict[str, tuple[AnnualMaximum, ...]], UniformTable | None]:
    """Annual maxima of many winters, and the table that they are read from.

    By solves where there is none.

    Parameters
    ----------
    groups : mapping of str to mapping
        Packs of each winter by its name, for each settling model.
    solver : DaySolver
        Of the row.
    by_table : bool, optional
        Whether a table is made of the row.
    """
    every = [packs for winters in groups.values() for packs in winters.values()]
    days = [_prepare(packs, solver) for packs in every if by_table]
    table = _build_table(days, solver)
    maxima = {
        model: tuple(
            find_annual_maximum(*winter, solver, is_alone=True, table=table)[0]
            for winter in winters.items()
        )
        for model, winters in groups.items()
    }
    return maxima, table


def choose_days(days: Sequence[RowDay], solver: DaySolver) -> tuple[RowDay, ...]:
    """Days whose uniform snow may pull most: those near the best rank.

    Parameters
    ----------
    days : sequence of RowDay
        Prepared.
    solver : DaySolver
        Of the row.
    """
    waiting = [day for day in days if day.ending == "open"]
    ranks = rank_days(waiting, solver.row.scene.ground.kind)
    least = RANKED * float(ranks.max(initial=0.0))
    return tuple(day for day, rank in zip(waiting, ranks, strict=True) if rank >= least)


def rank_days(days: Sequence[RowDay], ground: str) -> Floats:
    """Order of the pulls to be expected, eq. (Y3); no force follows. Shape (n_days,).

    Parameters
    ----------
    days : sequence of RowDay
        Thickness and density of each.
    ground : str
        Kind of ground.
    """
    p, q = _RANKS[ground]
    densities = np.array([day.density for day in days])
    thicknesses = np.array([day.thickness for day in days])
    return np.asarray(densities**p * thicknesses**q)


def find_largest(days: Iterable[RowDay]) -> RowDay | None:
    """Day of the largest foot pull; None if no day has one.

    Parameters
    ----------
    days : iterable of RowDay
        Any.
    """
    solved = [day for day in days if day.foot is not None]
    return max(solved, key=lambda day: day.pull or 0.0, default=None)


def find_equivalent(
    thickness: float, governing: RowDay, solver: DaySolver
) -> float | None:
    """Equivalent density [kg/m3], eq. (Y4), by secants in logarithms.

    Parameters
    ----------
    thickness : float
        Largest of the winter [m].
    governing : RowDay
        Day whose foot pull it is to have.
    solver : DaySolver
        Of the row.

    Returns
    -------
    float or None
        None where snow of that thickness cannot be solved, or stands above the net.
    """
    if not governing.pull or not solver.row.holds(thickness):
        return None
    target, power = np.log(governing.pull), _RANKS["no-slip"][0]
    x, tried = float(np.log(governing.density)), []
    for _ in range(_SECANT_STEPS):
        (day,) = solver.solve([governing.reopen(thickness, float(np.exp(x)))])
        if not day.pull:
            return None
        tried.append((x, float(np.log(day.pull))))
        if len(tried) > 1 and abs(tried[-1][0] - tried[-2][0]) > 1e-3:
            (x0, y0), (x1, y1) = tried[-2:]
            power = (y1 - y0) / (x1 - x0)
        x = tried[-1][0] + (target - tried[-1][1]) / power
    return float(np.exp(x))


def _judge(
    winter: str, days: Sequence[RowDay], solved: Sequence[RowDay], solver: DaySolver
) -> AnnualMaximum:
    """Ending of a winter, with its bound where a day that may govern has no force."""
    best = find_largest(solved)
    if any(day.ending == "overtopped" for day in days):
        return AnnualMaximum(winter=winter, ending="overtopped")
    doubted = _list_doubted(solved, best, solver)
    if not doubted:
        return AnnualMaximum(winter=winter, ending="solved" if best else "no snow")
    bound = find_bound(doubted, solved, solver)
    largest = best.foot.high if best and best.foot else 0.0
    if bound is not None and bound <= largest:
        return AnnualMaximum(winter=winter, ending="solved")
    return AnnualMaximum(
        winter=winter, ending="doubtful", bound=bound, reason=doubted[0].reason
    )


def _list_doubted(
    solved: Sequence[RowDay], best: RowDay | None, solver: DaySolver
) -> list[RowDay]:
    """Failed days that may govern, those that may pull most first."""
    failed = [day for day in solved if day.ending == "failed"]
    every = [best, *failed] if best else failed
    ranks = rank_days(every, solver.row.scene.ground.kind)
    least = DOUBTED * float(ranks[0]) if best else 0.0
    order = np.argsort(-ranks, kind="stable")
    return [every[k] for k in order if every[k] is not best and ranks[k] > least]


_THICKER = 1.1  # from one snow to the next that is tried for a bound


def find_bound(
    failed: Sequence[RowDay], solved: Sequence[RowDay], solver: DaySolver
) -> float | None:
    """Upper bound of the pulls of failed days [N/m], eq. (Y19).

    Parameters
    ----------
    failed : sequence of RowDay
        At least one.
    solved : sequence of RowDay
        Uniform snow of the same row; those that failed do not count.
    solver : DaySolver
        Of the row.

    Returns
    -------
    float or None
        None where no thicker snow of a day's density has a force, up to the head.
    """
    pulling = [(day, day.foot.high) for day in solved if day.foot]
    bound = 0.0
    for day in sorted(failed, key=lambda snow: -snow.density):
        above = [high for other, high in pulling if _covers(other, day)]
        if not above:
            thicker = _solve_thicker(day, solver)
            if thicker is None or thicker.foot is None:
                return None
            above = [thicker.foot.high]
            pulling.append((thicker, thicker.foot.high))
        bound = max(bound, min(above))
    return bound


def _covers(day: RowDay, other: RowDay) -> bool:
    """The snow is neither thinner nor lighter than the other."""
    return day.thickness >= other.thickness and day.density >= other.density


def _solve_thicker(day: RowDay, solver: DaySolver) -> RowDay | None:
    """Least thick snow of a day's density that has a force; None without any."""
    top = solver.row.scene.net.height_normal
    steps = math.ceil(math.log(top / day.thickness) / math.log(_THICKER))
    density = max(day.density, LEAST_DENSITY)
    for thickness in np.geomspace(day.thickness, top, max(steps, 1) + 1)[1:]:
        (thicker,) = solver.solve([day.reopen(float(thickness), density)])
        if thicker.foot:
            return thicker
    return None


def _build_table(
    winters: Sequence[Sequence[RowDay]], solver: DaySolver
) -> UniformTable | None:
    """Table over the days that may govern, and over the largest heights."""
    chosen = [day for days in winters for day in choose_days(days, solver)]
    if not chosen:
        return None
    tops = [max(day.thickness for day in days) for days in winters if days]
    thicknesses = [day.thickness for day in chosen]
    most = max(*thicknesses, *(top for top in tops if solver.row.holds(top)))
    densities = [day.density for day in chosen]
    return build_table(
        solver, (min(thicknesses), most), (min(densities), max(densities))
    )
