"""Pulls of the net on heads, feet and ropes of a row in all its solved cases.

By the section, and by every panel between posts. They are alike on every layout of the
support. Last: by what the guideline's load raises those along the row.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from netdesign.checks.inputs import Band
from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.rows import LARGE
from netdesign.envelope.run import CaseResult
from netdesign.envelope.signed_forces import gather_pulls
from netdesign.guideline.floor import Floor
from netdesign.numerics.arrays import Floats, Ints
from netdesign.structure.anchors import measure_pull
from netdesign.structure.layout import Point
from netdesign.structure.members import Member, RopeForce

_DIRECTIONS = 16  # in which the outermost of the pulls are looked for


@dataclass(frozen=True, kw_only=True, eq=False)
class HeadPulls:
    """Pulls on the heads inside a row.

    Attributes
    ----------
    inclinations : tuple of float
        Of the net [rad].
    places : ndarray of int, shape (n,)
        Which of these each pull has.
    pulls, errors : ndarray, shape (2, n) and (n,)
        (x, y) of each pull, and its error [N].
    has_panels : bool
        Some pull is that of a panel.
    """

    inclinations: tuple[float, ...]
    places: Ints
    pulls: Floats
    errors: Floats
    has_panels: bool

    @property
    def count(self) -> int:
        """Number of pulls."""
        return self.places.size

    @cached_property
    def outermost(self) -> list[tuple[int, Point]]:
        """Pulls that lie outermost among those at each of the inclinations [N]."""
        turns = 2.0 * np.pi * np.arange(_DIRECTIONS)[:, None] / _DIRECTIONS
        outermost: list[tuple[int, Point]] = []
        for place in range(len(self.inclinations)):
            x, y = self.pulls[:, self.places == place]
            far = (np.cos(turns) * x + np.sin(turns) * y).argmax(axis=1)
            pulls = zip(x[far].tolist(), y[far].tolist(), strict=True)
            outermost += [(place, pull) for pull in dict.fromkeys(pulls)]
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
    return HeadPulls(
        inclinations=tuple(distinct.tolist()),
        places=places.repeat(x.size // max(1, places.size)),
        pulls=np.array((x, y)),
        errors=errors,
        has_panels=has_panels and bool(list_panels(results)),
    )


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
    """Pulls of the guideline's load over those of the solved cases, at least 1 [-].

    ``lower`` and ``ridge`` raise the largest pull of each rope; ``head`` is that of the
    panel whose heads are pulled least.
    """

    lower: float = 1.0
    ridge: float = 1.0
    head: float = 1.0


def find_rope_factors(
    results: Sequence[CaseResult], floor: Floor | None
) -> RopeFactors:
    """Factors by which the guideline's load raises what pulls along the row.

    Of several panels that may be built each is raised by its own. What pulls at one
    inclination is not lowered by more load at another: the cases at the least and the
    largest one are raised alone, too. Theory: panel/THEORY.md, (P12), (P13).
    """
    cases = list_panels(results)
    foot = floor.find(Member.FOOT_ANCHOR) if floor else None
    if not cases or floor is None or floor.head is None or foot is None:
        return RopeFactors()
    angles = [x.case.inclination for x in results if list_panels([x])]
    groups = [cases] + [
        [panel for panel, angle in zip(cases, angles, strict=True) if angle == end]
        for end in {min(angles), max(angles)}
    ]
    lower, ridge, head = [], [], []
    for group in groups:
        feet, heads = _find_panel_factors(group, foot.force, floor.head.pull)
        lower += [_raise_rope(cases, group, rope, feet) for rope in _OF_LOWER]
        ridge += [_raise_rope(cases, group, rope, heads) for rope in _OF_RIDGE]
        head += heads.tolist()
    return RopeFactors(lower=max(lower), ridge=max(ridge), head=max(head))


_OF_LOWER = (RopeForce.LOWER_ALONG, RopeForce.LOWER_TENSION)
_OF_RIDGE = (RopeForce.UPPER_ALONG, RopeForce.UPPER_TENSION)


def _find_panel_factors(
    cases: Sequence[PanelForces], foot: float, head: float
) -> tuple[Floats, Floats]:
    """Pull on foot and on head [N] over the largest ones of each panel, at least 1."""
    feet = np.max([np.hypot(*panel.feet.T) for panel in cases], axis=0)
    heads = np.max([np.hypot(*panel.solved.head.T) for panel in cases], axis=0)
    return np.maximum(1.0, foot / feet), np.maximum(1.0, head / heads)


def _raise_rope(
    every: Sequence[PanelForces],
    cases: Sequence[PanelForces],
    rope: str,
    factors: Floats,
) -> float:
    """Largest force of a rope in some cases, each panel's raised, over that of all.

    Where a panel's force is largest, it has a share of the largest of all panels:
    envelope/THEORY.md, (E3).
    """
    sizes = np.array([panel.ropes[rope][1] for panel in cases])  # by case and panel
    largest = sizes.max(axis=1)[:, None]
    is_near = largest >= LARGE * sizes.max(axis=0)
    shares = np.where(is_near, sizes / largest, 0.0).max(axis=0)
    of_all = max(float(panel.ropes[rope][1].max()) for panel in every)
    raised = float((factors * shares).max())
    return raised * (float(largest.max()) / of_all if of_all else 1.0)
