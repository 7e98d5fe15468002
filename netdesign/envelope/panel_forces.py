"""Forces of a row of panels in one solved case, beside those of its section.

First: forces on any supports from the pulls on their ends, with the bands of the pulls'
errors. Names, equations and bands of the panel's forces: envelope/THEORY.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from netdesign.cable.net import Net
from netdesign.checks.inputs import Band
from netdesign.coupling.solution import SolvedState
from netdesign.numerics.arrays import Floats, Mask
from netdesign.outcome import Outcome
from netdesign.panel.inputs import Panel
from netdesign.panel.solve import (
    FailedPanel,
    PanelSolution,
    SolvedPanels,
    solve_strips,
)
from netdesign.panel.strips import Strip, build_strip
from netdesign.structure.anchors import (
    AnchorForces,
    compute_anchor_forces,
    compute_member_forces,
)
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import Point, SupportLayout, place_support
from netdesign.structure.members import (
    CARRYING_MEMBERS,
    Member,
    RopeForce,
    name_in_panel,
)
from netdesign.structure.splay import find_ways
from netdesign.words.message import say

# Shares of its error by which a pull is moved: each component (of foot, then of head)
# alone, down and up. Shape: component and way, 1, component.
_MOVES = (np.eye(4)[:, None] * np.array([-1.0, 1.0])[:, None]).reshape(8, 1, 4)


class Pulls(NamedTuple):
    """Pulls of the net on the two ends of a support, n times.

    Attributes
    ----------
    ends : ndarray, shape (n, 4)
        (x, y) on the foot, then on the head [N/m].
    errors : ndarray, shape (n, 4)
        Of each component [N/m].
    """

    ends: Floats
    errors: Floats


class HeldPulls(NamedTuple):
    """Forces on some supports, each under n pulls.

    Attributes
    ----------
    bands : dict of str to ndarray, shape (supports, 3, n)
        Least, own and largest force of each member [N], of use where it is held.
    is_held : ndarray of bool, shape (supports, 8 + 1, n)
        Under the pulls, and under each of the moved ones.
    moved : ndarray, shape (8 + 1, n, 4)
        These pulls [N/m].
    """

    bands: dict[str, Floats]
    is_held: Mask
    moved: Floats

    def explain(
        self,
        layouts: Sequence[SupportLayout],
        head: Point,
        chosen: slice = slice(None),
    ) -> FailedSupport:
        """Why some support cannot hold some chosen pull; there has to be one."""
        place, *state = map(int, np.argwhere(~self.is_held[..., chosen])[0])
        failed = stand_on(layouts[place], head, self.moved[tuple(state)])
        if isinstance(failed, FailedSupport):
            return failed
        raise ValueError("pulls that one way holds, and not the other")


def hold_pulls(
    layouts: Sequence[SupportLayout], head: Point, pulls: Pulls
) -> HeldPulls:
    """Forces on supports and their members, with their bands, under some pulls.

    Within one set of working members the forces are linear in the pulls, so moving
    each component by its error, and adding the changes, bounds them.

    Parameters
    ----------
    layouts : sequence of SupportLayout
        Of the supports; all carry the same width of net.
    head : tuple of float, shape (2,)
        Where the net hangs, from its foot [m].
    pulls : Pulls
        Of the net on foot and head.

    Verified by
    -----------
    tests/envelope/test_support_bands.py
    """
    width, (x_head, y_head) = layouts[0].post_spacing, np.array(head)[:, None, None]
    with np.errstate(invalid="ignore", over="ignore"):  # of an error that is no number
        moved = np.concatenate([pulls.ends[None], pulls.ends + _MOVES * pulls.errors])
        is_finite = np.isfinite(moved * width).all(axis=-1)
        x, y, along, across = np.moveaxis(moved, -1, 0)
        of_members, is_held = compute_member_forces(
            find_ways(layouts, (x_head, y_head)),
            foot_pull_per_m=(x, y),
            head_pull_per_m=(along, across),
            post_spacing=width,
            is_foot_shared=layouts[0].is_foot_shared,
        )
        forces = np.stack(np.broadcast_arrays(*of_members.values()))
        values = forces[:, :, 0]
        changes = np.abs(forces[:, :, 1:] - values[:, :, None])
        errors = changes.reshape(*values.shape[:2], 4, 2, -1).max(axis=3).sum(axis=2)
    bands = _spread(values, errors)
    return HeldPulls(
        dict(zip(of_members, bands, strict=True)), is_held & is_finite, moved
    )


def _spread(values: Floats, errors: Floats) -> Floats:
    """Bands of sizes with their errors: (.., n) to (.., 3, n), in one unit."""
    low = np.maximum(values - errors, 0.0)
    return np.stack([low, values, values + errors], axis=-2)


def spread_out(value: float, error: float) -> Band:
    """Band of a size with its error, in one unit."""
    return Band(low=max(0.0, value - error), value=value, high=value + error)


def stand_on(
    layout: SupportLayout, head: Point, ends: Floats
) -> AnchorForces | FailedSupport:
    """Forces on the ground under pulls (x, y) on foot and head, in one row [N/m]."""
    x, y, along, across = map(float, ends)
    return compute_anchor_forces(
        place_support(layout, head),
        foot_pull_per_m=(x, y),
        head_pull_per_m=(along, across),
        post_spacing=layout.post_spacing,
    )


# Error of six stations over the panel's load, without and with anchors in mid-panel:
# panel/THEORY.md, section 3.
_STATIONS, _STATIONS_MID = 3e-4, 2e-3

# In the order in which a search has them.
PANEL_QUANTITIES = (*map(name_in_panel, CARRYING_MEMBERS), *RopeForce)
# Tension of a post, by the section and by the panel between posts.
POST_PULLS: tuple[str, ...] = (Member.POST_FOOT, name_in_panel(Member.POST_FOOT))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PanelForces:
    """Panels of a case, what a bay of each brings to a support, and their ropes.

    Attributes
    ----------
    solved : SolvedPanels
        n of them; several where the row's panel is assumed: the worst counts.
    pulls : Pulls
        Their mean pulls on foot and head, between two equal panels.
    ropes : dict of str to ndarray, shape (3, n)
        Least, own and largest force by ``RopeForce`` [N].
    """

    solved: SolvedPanels
    pulls: Pulls
    ropes: dict[str, Floats]

    @property
    def width(self) -> float:
        """Width of a bay [m]."""
        return self.solved.panels[0].post_spacing

    @property
    def feet(self) -> Floats:
        """Pull of the net on both feet of a bay, shape (n, 2) [N]."""
        return self.solved.foot + self.solved.mid_foot

    @property
    def error(self) -> Floats:
        """Of a pull on foot or head, shape (n,) [N/m]."""
        return self.pulls.errors[:, 0]

    @property
    def feet_beside_posts(self) -> Floats:
        """Force on the foot anchor beside a post, as its band has it (n,) [N]."""
        return np.asarray(np.hypot(*(self.pulls.ends[:, :2] * self.width).T))

    @property
    def largest_feet(self) -> Floats:
        """Force on the more loaded foot anchor of each panel, shape (n,) [N]."""
        mids = np.hypot(*self.solved.mid_foot.T)
        return np.asarray(np.maximum(self.feet_beside_posts, mids))

    @property
    def solution(self) -> PanelSolution:
        """The first panel."""
        solution = self.solved.describe(0)
        if isinstance(solution, FailedPanel):
            raise ValueError("forces of a panel that failed")
        return solution

    def read_members(self, held: HeldPulls) -> dict[str, Floats]:
        """Bands (supports, 3, n) of members that hold a section's pulls, then these.

        The foot anchor's is that of the more loaded one, beside a post or in mid-panel.
        """
        bands = {name_in_panel(m): band[..., 1:] for m, band in held.bands.items()}
        at_foot, mids = bands[_AT_FOOT], np.hypot(*self.solved.mid_foot.T)
        in_mid = _spread(mids, self.width * self.error)
        bands[_AT_FOOT] = np.where(mids > at_foot[:, 1:2], in_mid, at_foot)
        return bands


_AT_FOOT = name_in_panel(Member.FOOT_ANCHOR)


def resolve_panels(
    panels: Sequence[Panel], net: Net, state: SolvedState
) -> PanelForces | FailedPanel:
    """Panels of a row whose section at the post has been solved, and their pulls.

    Parameters
    ----------
    panels : sequence of Panel
        Spacing, ropes and cut: at least one, all of one spacing; several where the
        row's panel is assumed.
    net : Net
        At the post.
    state : SolvedState
        Of the section.

    Returns
    -------
    PanelForces or FailedPanel
        Or the first failure of any panel. Its outcome is ``out_of_validity`` also of a
        history.

    Verified by
    -----------
    tests/envelope/test_panel_forces.py
    """
    if state.method != "steady":
        reason = say("panel.steady_only")
        return FailedPanel(outcome=Outcome.OUT_OF_VALIDITY, reason=reason)
    strip = build_strip(net, state.net_curve, state.net_forces, state.foot)
    solved = _solve_panels(strip, panels)
    if isinstance(solved, FailedPanel):
        return solved
    pulls = _find_pulls(solved, state)
    return PanelForces(solved=solved, pulls=pulls, ropes=_read_ropes(solved, pulls))


# Panels that are not built like this: their pressure on the ground would be unknown.
_NOT_BUILT = ("panel.lies_on_ground", "panel.no_net_left")
_HALVINGS = 4  # of the sags between a panel that hangs free and one that does not


def _solve_panels(strip: Strip, panels: Sequence[Panel]) -> SolvedPanels | FailedPanel:
    """Panels of a row, or the first that fails.

    Of several that may be built, one that would lie on the ground has the largest sags
    with which it hangs free; where it never does, another one stands in its place.
    """
    solved = solve_strips(strip, panels)
    if not solved.failures:
        return solved
    failures = [solved.failures[place] for place in sorted(solved.failures)]
    free = [panel for k, panel in enumerate(panels) if k not in solved.failures]
    is_built = any(failure.reason.key not in _NOT_BUILT for failure in failures)
    if is_built or not free:
        return failures[0]
    sags = [(panel.upper.sag, panel.lower.sag) for panel in panels]
    least = tuple(map(min, zip(*sags, strict=True)))
    hung = list(panels)
    for place in solved.failures:
        hung[place] = _hang_free(strip, panels[place], least) or free[0]
    return solve_strips(strip, hung)


def _hang_free(strip: Strip, panel: Panel, least: tuple[float, ...]) -> Panel | None:
    """Panel with the largest sags up to its own with which it hangs free."""
    hung: Panel | None = None
    free, lying, share = 0.0, 1.0, 0.0
    for _ in range(_HALVINGS + 1):
        upper, lower = (
            replace(rope, sag=sag + share * (rope.sag - sag))
            for rope, sag in zip((panel.upper, panel.lower), least, strict=True)
        )
        trial = replace(panel, upper=upper, lower=lower)
        if solve_strips(strip, (trial,)).failures:
            lying = share
        else:
            hung, free = trial, share
        if hung is None:
            return None
        share = 0.5 * (free + lying)
    return hung


def _find_pulls(solved: SolvedPanels, state: SolvedState) -> Pulls:
    """Mean pulls of a bay on foot and head, with their errors.

    A panel answers less to its load than the net at the post, whose error counts;
    that of the stations comes on top.
    """
    width = solved.panels[0].post_spacing
    load = np.hypot(*(solved.foot + solved.mid_foot + solved.head).T) / width
    shares = [_STATIONS_MID if x.has_mid_anchors else _STATIONS for x in solved.panels]
    errors = max(state.foot.error, state.head.error) + np.array(shares) * load
    ends = np.concatenate([solved.foot, solved.head], axis=1) / width
    return Pulls(ends, np.repeat(errors[:, None], 4, axis=1))


def _read_ropes(solved: SolvedPanels, pulls: Pulls) -> dict[str, Floats]:
    """Bands (3, n) of both ropes: they grow at most as what pulls on them."""
    width, error = solved.panels[0].post_spacing, pulls.errors[:, 0]
    on_lower = np.hypot(*(solved.foot + solved.mid_foot).T) / width
    on_upper = np.hypot(*pulls.ends[:, 2:].T)
    shares = np.stack([error / on_lower, error / on_upper])
    forces = np.stack([solved.along.T, solved.tension.T])
    bands = _spread(forces, shares * forces).reshape(len(RopeForce), 3, -1)
    return dict(zip(RopeForce, bands, strict=True))
