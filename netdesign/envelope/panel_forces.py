"""Forces of a row of panels in one solved case, beside those of its section.

First: forces on any support from the pulls on its ends, with the band of the pulls'
error. Names, equations and bands of the panel's forces: envelope/THEORY.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from netdesign.cable.net import Net
from netdesign.checks.result import Band
from netdesign.coupling.solution import EndPull
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome, SolveError
from netdesign.panel.inputs import Panel
from netdesign.panel.solve import FailedPanel, PanelSolution, RopeForces, solve_strips
from netdesign.panel.strips import Strip, build_strip, build_strip_at_end
from netdesign.solving.solve import SolvedState
from netdesign.structure.anchors import (
    AnchorForces,
    compute_anchor_forces,
    compute_forces_of_layouts,
    compute_forces_of_pulls,
)
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import Point, SupportPoints
from netdesign.structure.members import (
    CARRYING_MEMBERS,
    Member,
    RopeForce,
    name_in_panel,
)
from netdesign.words.message import say

# Shares of its error by which a pull is moved: each component (of foot, then of head)
# alone, down and up. Shape: component that moves, way, component.
_MOVES = np.eye(4)[:, None] * np.array([-1.0, 1.0])[:, None]

Pulls = tuple[EndPull, EndPull]  # on foot and head, with their errors [N/m]
Resolved = tuple[AnchorForces, dict[str, Band]]


def resolve_pulls(
    points: SupportPoints, width: float, pulls: Sequence[Pulls]
) -> list[Resolved] | FailedSupport:
    """Forces on a support and its members, with their bands, under each of some pulls.

    Within one set of working members the forces are linear in the pulls, so moving
    each component by its error, and adding the changes, bounds them.

    Parameters
    ----------
    points : SupportPoints
        Geometry of the support [m].
    width : float
        Width of net that it carries [m].
    pulls : sequence of tuple of EndPull, shape (2,)
        Of the net on foot and head, with their errors [N/m].

    Returns
    -------
    list of (AnchorForces, dict of str to Band), or FailedSupport
        The failure of the first pulls that the support cannot hold, moved or not.
    """
    of_pulls = []
    for foot, head in pulls:
        anchors = _resolve(points, width, (foot.x, foot.y, head.x, head.y))
        if isinstance(anchors, FailedSupport):
            return anchors
        of_pulls.append(anchors)
    forces = [anchors.member_forces for anchors in of_pulls]
    errors = _find_errors(points, width, pulls, forces)
    if isinstance(errors, FailedSupport):
        return errors
    return [
        (anchors, {m: spread_out(x, of[m]) for m, x in anchors.member_forces.items()})
        for anchors, of in zip(of_pulls, errors, strict=True)
    ]


def spread_out(value: float, error: float) -> Band:
    """Band of a size with its error, in one unit."""
    return Band(low=max(0.0, value - error), value=value, high=value + error)


def _find_errors(
    points: SupportPoints,
    width: float,
    pulls: Sequence[Pulls],
    values: Sequence[dict[str, float]],
) -> list[dict[str, float]] | FailedSupport:
    """Error of each member under each of the pulls, from their moved ones [N]."""
    with np.errstate(invalid="ignore", over="ignore"):  # of an error that is no number
        moved = _move(pulls)
        is_sound = np.isfinite(moved * width).all(axis=-1)
    if is_sound.all():
        x, y, along, across = np.moveaxis(moved, -1, 0)
        forces, is_sound = compute_forces_of_pulls(
            points,
            foot_pull_per_m=(x, y),
            head_pull_per_m=(along, across),
            post_spacing=width,
        )
    if not is_sound.all():
        failed = _resolve(points, width, moved[~is_sound][0])
        if isinstance(failed, FailedSupport):
            return failed
        raise ValueError("pulls that one way holds, and not the other")
    changes = {
        member: np.abs(force - [own[member] for own in values]).max(axis=1).sum(axis=0)
        for member, force in forces.items()
    }
    return [
        {member: float(change[k]) for member, change in changes.items()}
        for k in range(len(pulls))
    ]


def _move(pulls: Sequence[Pulls]) -> Floats:
    """Pulls with each component moved by its error, shape (4, 2, n, 4) [N/m]."""
    still = np.array([(foot.x, foot.y, head.x, head.y) for foot, head in pulls])
    errors = np.array([(foot.error,) * 2 + (head.error,) * 2 for foot, head in pulls])
    moved: Floats = still + _MOVES[:, :, None] * errors
    return moved


def _resolve(
    points: SupportPoints, width: float, pulls: Sequence[float] | Floats
) -> AnchorForces | FailedSupport:
    """Forces under (x, y) of foot and head, in one row."""
    x, y, along, across = map(float, pulls)
    return compute_anchor_forces(
        points,
        foot_pull_per_m=(x, y),
        head_pull_per_m=(along, across),
        post_spacing=width,
    )


def resolve_layouts(
    places: Sequence[SupportPoints],
    width: float,
    section: Pulls,
    panel: PanelForces | None,
) -> list[dict[str, Band]] | FailedSupport:
    """Forces on other supports of a case, by section and by the worst of its panels.

    As `resolve_pulls` and `resolve_panels` have them on the support that the case was
    resolved on, whose pulls are these.

    Parameters
    ----------
    places : sequence of SupportPoints
        Their geometry [m].
    width : float
        Width of net that one carries [m].
    section : tuple of EndPull, shape (2,)
        Pulls of the net on foot and head [N/m].
    panel : PanelForces or None
        The panels between posts; None of a row without.

    Returns
    -------
    list of dict of str to Band, or FailedSupport
        One a support; the failure of one that cannot hold some pulls.

    Verified by
    -----------
    tests/envelope/test_layouts.py
    """
    panels = panel.variants if panel else ()
    pulls = [section, *((panel.foot, panel.head) for panel in panels)]
    moved = np.concatenate([_hold_still(pulls), _move(pulls).reshape(8, -1, 4)])
    x, y, along, across = np.moveaxis(moved, -1, 0)
    of_members, is_held = compute_forces_of_layouts(
        places,
        foot_pull_per_m=(x, y),
        head_pull_per_m=(along, across),
        post_spacing=width,
    )
    if not is_held.all():
        place, *state = map(int, np.argwhere(~is_held)[0])
        failed = _resolve(places[place], width, moved[tuple(state)])
        if isinstance(failed, FailedSupport):
            return failed
        raise ValueError("pulls that one way holds, and not the other")
    mids = np.array([0.0, *(math.hypot(*panel.solution.mid_foot) for panel in panels)])
    at_mid = width * np.array([foot.error for foot, _ in pulls])
    by_place: list[dict[str, Band]] = [{} for _ in places]
    for member, forces in of_members.items():
        value = forces[:, 0]
        changes = np.abs(forces[:, 1:] - value[:, None])
        error = changes.reshape(len(places), 4, 2, -1).max(axis=2).sum(axis=1)
        if member == Member.FOOT_ANCHOR:
            error = np.where(mids > value, at_mid, error)
            value = np.maximum(value, mids)
        ends = np.array([np.maximum(value - error, 0.0), value, value + error])
        for name, of in (
            (member, ends[:, :, :1]),
            (name_in_panel(member), ends[:, :, 1:]),
        ):
            if of.size:
                for bands, (low, size, high) in zip(
                    by_place, of.max(axis=2).T, strict=True
                ):
                    bands[name] = Band(
                        low=float(low), value=float(size), high=float(high)
                    )
    return by_place


def _hold_still(pulls: Sequence[Pulls]) -> Floats:
    """Pulls as they are, shape (1, n, 4) [N/m]."""
    return np.array([[(foot.x, foot.y, head.x, head.y) for foot, head in pulls]])


def cover(bands: Iterable[Band]) -> Band:
    """Band of the largest one of some forces."""
    parts = list(bands)
    return Band(
        low=max(band.low for band in parts),
        value=max(band.value for band in parts),
        high=max(band.high for band in parts),
    )


# Error of six stations over the panel's load, without and with anchors in mid-panel:
# panel/THEORY.md, section 3.
_STATIONS, _STATIONS_MID = 3e-4, 2e-3
# Error of a history's few corners over the load: envelope/THEORY.md.
_CORNERS = 0.01

# In the order in which a search has them.
PANEL_QUANTITIES = (*map(name_in_panel, CARRYING_MEMBERS), *RopeForce)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PanelForces:
    """Forces between two equal panels, each of a bay.

    Attributes
    ----------
    solution : PanelSolution
        The panel.
    anchors : AnchorForces
        On the ground, without anchors in mid-panel [N].
    bands : dict of str to Band
        Forces by ``PANEL_QUANTITIES`` [N]; the foot anchor's is that of the more
        loaded one, beside a post or in mid-panel.
    foot, head : EndPull
        Mean pulls of a bay on the support, with their errors [N/m].
    others : tuple of PanelForces
        Of further panels, where the row's is assumed: the worst counts.
    """

    solution: PanelSolution
    anchors: AnchorForces
    bands: dict[str, Band]
    foot: EndPull
    head: EndPull
    others: tuple[PanelForces, ...] = ()

    @property
    def variants(self) -> tuple[PanelForces, ...]:
        """All panels that the row may have, this one first."""
        return (self, *self.others)

    @property
    def worst(self) -> dict[str, Band]:
        """Largest forces of all panels that the row may have [N]."""
        return {
            name: cover(panel.bands[name] for panel in self.variants)
            for name in self.bands
        }


def resolve_panels(
    panels: Sequence[Panel], net: Net, points: SupportPoints, state: SolvedState
) -> PanelForces | FailedPanel:
    """Forces of a row of equal panels whose section at the post has been solved.

    Parameters
    ----------
    panels : sequence of Panel
        Spacing, ropes and cut: at least one, all of one spacing; several where the
        row's panel is assumed.
    net : Net
        At the post.
    points : SupportPoints
        Geometry of a support [m].
    state : SolvedState
        Of the section.

    Returns
    -------
    PanelForces or FailedPanel
        The first failure of any panel. Outcome ``out_of_validity`` also of a history
        that went on beyond its largest pulls, and of a staggered one.

    Verified by
    -----------
    tests/envelope/test_panel_forces.py
    """
    try:
        strip, doubt = _build_strip(net, state)
    except SolveError as failure:
        return FailedPanel(outcome=failure.outcome, reason=failure.reason)
    solved = _solve_panels(strip, panels)
    if isinstance(solved, FailedPanel):
        return solved
    pulls = [_find_pulls(solution, state, doubt) for solution in solved]
    supports = resolve_pulls(points, panels[0].post_spacing, pulls)
    if isinstance(supports, FailedSupport):
        return FailedPanel(outcome=supports.outcome, reason=supports.reason)
    first, *others = map(_gather, solved, pulls, supports)
    return replace(first, others=tuple(others))


# Panels that are not built like this: their pressure on the ground would be unknown.
_NOT_BUILT = ("panel.lies_on_ground", "panel.no_net_left")
_HALVINGS = 4  # of the sags between a panel that hangs free and one that does not


def _solve_panels(
    strip: Strip, panels: Sequence[Panel]
) -> list[PanelSolution] | FailedPanel:
    """Panels of a row, or the first that fails.

    Of several that may be built, one that would lie on the ground has the largest sags
    with which it hangs free; where it never does, another one stands in its place.
    """
    solutions = solve_strips(strip, panels)
    failed = [panel for panel in solutions if isinstance(panel, FailedPanel)]
    free = [panel for panel in solutions if not isinstance(panel, FailedPanel)]
    if not failed:
        return free
    sags = [(panel.upper.sag, panel.lower.sag) for panel in panels]
    least = tuple(map(min, zip(*sags, strict=True)))
    is_built = any(failure.reason.key not in _NOT_BUILT for failure in failed)
    if is_built or not free:
        return failed[0]
    return [
        (_hang_free(strip, panel, least) or free[0])
        if isinstance(solution, FailedPanel)
        else solution
        for solution, panel in zip(solutions, panels, strict=True)
    ]


def _hang_free(
    strip: Strip, panel: Panel, least: tuple[float, ...]
) -> PanelSolution | None:
    """Panel with the largest sags up to its own with which it hangs free."""
    solution: PanelSolution | None = None
    free, lying, share = 0.0, 1.0, 0.0
    for _ in range(_HALVINGS + 1):
        upper, lower = (
            replace(rope, sag=sag + share * (rope.sag - sag))
            for rope, sag in zip((panel.upper, panel.lower), least, strict=True)
        )
        hung = replace(panel, upper=upper, lower=lower)
        (trial,) = solve_strips(strip, (hung,))
        if isinstance(trial, FailedPanel):
            lying = share
        else:
            solution, free = trial, share
        if solution is None:
            return None
        share = 0.5 * (free + lying)
    return solution


def _gather(solved: PanelSolution, pulls: Pulls, support: Resolved) -> PanelForces:
    (foot, head), (anchors, members) = pulls, support
    bands = {name_in_panel(member): band for member, band in members.items()}
    at_foot = name_in_panel(Member.FOOT_ANCHOR)
    mid_foot = math.hypot(*solved.mid_foot)
    if mid_foot > bands[at_foot].value:
        error = solved.panel.post_spacing * foot.error
        bands[at_foot] = spread_out(mid_foot, error)
    return PanelForces(
        solution=solved,
        anchors=anchors,
        bands=bands | _read_ropes(solved, foot, head),
        foot=foot,
        head=head,
    )


def _build_strip(net: Net, state: SolvedState) -> tuple[Strip, float]:
    """Strip at the post, and the doubt about its load over that [-]."""
    if state.method == "steady":
        curve, forces = state.net_curve, state.net_forces
        return build_strip(net, curve, forces, state.foot), 0.0
    if state.method != "transient":
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("panel.not_staggered"))
    strip, distance = build_strip_at_end(
        net, state.net_curve, state.net_forces, (state.foot, state.head)
    )
    return strip, distance + _CORNERS


def _find_pulls(
    solved: PanelSolution, state: SolvedState, doubt: float
) -> tuple[EndPull, EndPull]:
    """Mean pulls of a bay on foot and head, with their errors [N/m].

    A panel answers less to its load than the net at the post, whose error counts;
    that of the stations comes on top, and the doubt about a history's load.
    """
    width = solved.panel.post_spacing
    load = np.sum([solved.foot, solved.mid_foot, solved.head], axis=0)
    share = _STATIONS_MID if solved.panel.has_mid_anchors else _STATIONS
    error = max(state.foot.error, state.head.error)
    error += doubt * float(np.hypot(*load)) / width
    error += share * float(np.hypot(*load)) / width
    foot, head = (_divide(pull, width, error) for pull in (solved.foot, solved.head))
    return foot, head


def _divide(force: Point, width: float, error: float) -> EndPull:
    return EndPull(x=force[0] / width, y=force[1] / width, error=error)


def _read_ropes(solved: PanelSolution, foot: EndPull, head: EndPull) -> dict[str, Band]:
    """Forces of both ropes; they grow at most in proportion to what pulls on them."""
    width = solved.panel.post_spacing
    on_lower = np.hypot(*np.add(solved.foot, solved.mid_foot)) / width
    shares = (foot.error / float(on_lower), head.error / head.size)
    bands: dict[str, Band] = {}
    for names, rope, share in (
        ((RopeForce.LOWER_ALONG, RopeForce.LOWER_TENSION), solved.lower, shares[0]),
        ((RopeForce.UPPER_ALONG, RopeForce.UPPER_TENSION), solved.upper, shares[1]),
    ):
        bands |= dict(zip(names, _spread_rope(rope, share), strict=True))
    return {name: bands[name] for name in RopeForce}


def _spread_rope(rope: RopeForces, share: float) -> tuple[Band, Band]:
    along, tension = rope.along, rope.tension
    return spread_out(along, share * along), spread_out(tension, share * tension)
