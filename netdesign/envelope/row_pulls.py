"""Pulls of the net on heads, feet and ropes of a row in all its solved cases.

By the section, and by every panel between posts. They are alike on every layout of the
support. Last: by what the guideline's load raises those along the row.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from netdesign.checks.inputs import Band
from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.envelope.signed_forces import gather_pulls
from netdesign.guideline.floor import Floor
from netdesign.numerics.arrays import Floats, Ints, Mask
from netdesign.structure.anchors import measure_pull
from netdesign.structure.layout import Point
from netdesign.structure.members import Member, RopeForce

_DIRECTIONS = 16  # in which the outermost of the pulls are looked for


@dataclass(frozen=True, kw_only=True, eq=False)
class HeadPulls:
    """Pulls on the heads inside a row, by its section and each of its panels.

    Attributes
    ----------
    inclinations : tuple of float
        Of the net [rad].
    places : ndarray of int, shape (n,)
        Which of these each pull has.
    origins : ndarray of int, shape (n,)
        0 of the section, else the number of the panel.
    groups : ndarray of bool, shape (g, n)
        Pulls that are raised together, `list_groups`.
    pulls, errors : ndarray, shape (2, n) and (n,)
        (x, y) of each pull, and its error [N].
    has_panels : bool
        Some pull is that of a panel.
    """

    inclinations: tuple[float, ...]
    places: Ints
    origins: Ints
    groups: Mask
    pulls: Floats
    errors: Floats
    has_panels: bool

    @property
    def count(self) -> int:
        """Number of pulls."""
        return self.places.size

    def list_outermost(self, least: float) -> list[tuple[int, Point]]:
        """Pulls that lie outermost among those at each of the inclinations [N].

        In each group the pulls of the section, and of each panel, are raised until the
        largest of them comes to the least one of all, the guideline's.
        """
        sizes = np.hypot(*self.pulls)
        raised, places = [], []
        for group in self.groups:
            own = np.flatnonzero(group)
            largest = np.zeros(self.origins.max(initial=0) + 1)
            np.maximum.at(largest, self.origins[own], sizes[own])
            factors = np.ones_like(largest)
            np.divide(least, largest, out=factors, where=largest > 0.0)
            np.maximum(factors, 1.0, out=factors)
            raised.append(self.pulls[:, own] * factors[self.origins[own]])
            places.append(self.places[own])
        return self._choose(np.concatenate(raised, axis=1), np.concatenate(places))

    def _choose(self, pulls: Floats, places: Ints) -> list[tuple[int, Point]]:
        """Those of some pulls that lie outermost at their inclination [N]."""
        turns = 2.0 * np.pi * np.arange(_DIRECTIONS)[:, None] / _DIRECTIONS
        outermost: list[tuple[int, Point]] = []
        for place in range(len(self.inclinations)):
            x, y = pulls[:, places == place]
            far = (np.cos(turns) * x + np.sin(turns) * y).argmax(axis=1)
            chosen = zip(x[far].tolist(), y[far].tolist(), strict=True)
            outermost += [(place, pull) for pull in dict.fromkeys(chosen)]
        return outermost

    def bound_size(self, hidden: float) -> Band:
        """Largest size of a pull with its error and with what may hide [N]."""
        sizes = np.hypot(*self.pulls)
        return Band(
            low=max(0.0, float((sizes - self.errors).max())),
            value=float(sizes.max()),
            high=float((sizes + self.errors).max()) + hidden,
        )


def read_heads(
    post_spacing: float, results: Sequence[CaseResult], *, has_panels: bool = True
) -> HeadPulls:
    """Pulls on the heads in the solved cases of a row; those of panels if wanted."""
    solved = [result for result in results if result.anchors and result.solution]
    pulls = gather_pulls(solved, post_spacing)
    most = None if has_panels else 1
    x, y, errors = (part[:, :most].ravel() for part in (*pulls.head, pulls.head_errors))
    inclinations = [result.case.inclination for result in solved]
    distinct, places = np.unique(inclinations, return_inverse=True)
    count = x.size // max(1, places.size)
    return HeadPulls(
        inclinations=tuple(distinct.tolist()),
        places=places.repeat(count),
        origins=np.tile(np.arange(count), places.size),
        groups=np.array(list_groups(solved)).repeat(count, axis=1),
        pulls=np.array((x, y)),
        errors=errors,
        has_panels=has_panels and bool(list_panels(results)),
    )


def list_groups(results: Sequence[CaseResult]) -> list[Mask]:
    """Cases whose pulls are raised together: all, and those at each end of a range.

    What pulls at one value of a range is not lowered by more load at another.
    """
    groups = [np.full(len(results), True)]
    values = [result.case.values for result in results]
    for name in values[0] if values else ():
        own = np.array([each[name] for each in values])
        ends = {own.min(), own.max()} if own.min() < own.max() else set()
        groups += [own == end for end in sorted(ends)]
    return groups


def list_panels(results: Sequence[CaseResult]) -> list[PanelForces]:
    """Forces by panels between posts, of the cases that have any."""
    panels = (result.panel for result in results)
    return [panel for panel in panels if isinstance(panel, PanelForces)]


@dataclass(frozen=True, slots=True, kw_only=True)
class FootPulls:
    """Pulls of the net on foot anchors over the states of a row.

    Attributes
    ----------
    turns : tuple of float
        Least and largest inclination, as `measure_pull` has it [rad]; empty without
        any state.
    along : float
        Largest pull of the lower rope along the row over that of the net on a foot [-].
    """

    turns: tuple[float, ...]
    along: float


def measure_feet(
    results: Sequence[CaseResult], *, has_panels: bool = True
) -> FootPulls:
    """Pulls on the foot anchors: they are the same on every layout of a support.

    Those of the sections, and of every panel if that is wanted.
    """
    anchors = [result.anchors for result in results if result.anchors is not None]
    pulls = [np.array([(one.foot_anchor.x, one.foot_anchor.y) for one in anchors])]
    share = 0.0
    for panel in list_panels(results) if has_panels else ():
        solved, sizes = panel.solved, np.hypot(*panel.solved.foot.T)
        pulls += [solved.foot, solved.mid_foot[solved.mid_foot.any(axis=1)]]
        along = solved.along[sizes > 0.0, 0] / sizes[sizes > 0.0]
        share = max(share, float(along.max(initial=0.0)))
    x, y = np.concatenate([each.reshape(-1, 2) for each in pulls]).T
    turns = measure_pull(x, y, Member.FOOT_ANCHOR)
    ends = (float(turns.min()), float(turns.max())) if turns.size else ()
    return FootPulls(turns=ends, along=share)


def find_least_ropes(results: Sequence[CaseResult]) -> dict[RopeForce, float]:
    """Largest force of each rope in the panel that has the least, at its least [N]."""
    panels = list_panels(results)
    if not panels:
        return {}
    lows = {
        rope: np.array([one.ropes[rope][0] for one in panels]) for rope in RopeForce
    }
    return {rope: float(low.max(axis=0).min()) for rope, low in lows.items()}


class RopeFactors(NamedTuple):
    """Pulls of the ropes under the guideline's load over those solved, at least 1 [-].

    They raise the largest pull of lower and ridge rope.
    """

    lower: float = 1.0
    ridge: float = 1.0


def find_rope_factors(
    results: Sequence[CaseResult], floor: Floor | None
) -> RopeFactors:
    """Factors by which the guideline's load raises what pulls along the row.

    Of several panels that may be built each is raised by its own, in each group of
    `list_groups`. Theory: panel/THEORY.md, (P12), (P13).
    """
    solved = [result for result in results if list_panels([result])]
    foot = floor.find(Member.FOOT_ANCHOR) if floor else None
    if not solved or floor is None or floor.head is None or foot is None:
        return RopeFactors()
    cases = list_panels(solved)
    feet = np.array([np.hypot(*panel.feet.T) for panel in cases])
    heads = np.array([np.hypot(*panel.solved.head.T) for panel in cases])
    groups = list_groups(solved)

    def find(pulls: Floats, least: float, ropes: Sequence[RopeForce]) -> float:
        sizes = [np.array([panel.ropes[rope][1] for panel in cases]) for rope in ropes]
        return max(_raise(size, pulls, least, groups) for size in sizes)

    return RopeFactors(
        lower=find(feet, foot.force, _OF_LOWER),
        ridge=find(heads, floor.head.pull, _OF_RIDGE),
    )


_OF_LOWER = (RopeForce.LOWER_ALONG, RopeForce.LOWER_TENSION)
_OF_RIDGE = (RopeForce.UPPER_ALONG, RopeForce.UPPER_TENSION)


def _raise(sizes: Floats, pulls: Floats, least: float, groups: list[Mask]) -> float:
    """Largest force of a rope once its pulls come to a least one, over that before.

    Both of shape (cases, panels) [N].
    """
    raised = [
        float((np.maximum(1.0, least / pulls[own].max(axis=0)) * sizes[own]).max())
        for own in groups
    ]
    largest = float(sizes.max())
    return max(raised) / largest if largest > 0.0 else 1.0
