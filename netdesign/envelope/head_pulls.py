"""Pulls of the net on the post heads of a row in all its solved cases, as arrays.

By the section, and by every panel between posts. They are alike on every layout of the
support.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from netdesign.checks.result import Band
from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.numerics.arrays import Floats, Ints
from netdesign.structure.layout import Point

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
    states = []
    for result in results:
        if result.anchors is None:
            continue
        own = result.solution.head.error if result.solution else 0.0
        ends = [(*result.anchors.head_pull, own * post_spacing)]
        if has_panels and isinstance(result.panel, PanelForces):
            errors = result.panel.brought.error * post_spacing
            ends += np.column_stack([result.panel.solved.head, errors]).tolist()
        states += [(result.case.inclination, *end) for end in ends]
    inclinations, x, y, errors = np.array(states).reshape(-1, 4).T
    distinct, places = np.unique(inclinations, return_inverse=True)
    return HeadPulls(
        inclinations=tuple(distinct.tolist()),
        places=places,
        pulls=np.array((x, y)),
        errors=errors,
        has_panels=has_panels and bool(list_panels(results)),
    )


def list_panels(results: Sequence[CaseResult]) -> list[PanelForces]:
    """Forces by panels between posts, of the cases that have any."""
    panels = (result.panel for result in results)
    return [panel for panel in panels if isinstance(panel, PanelForces)]
