"""Signed forces of a case, which a search follows in place of the members' forces.

The forces of guy and post have a kink where a guy goes slack, and a model of them would
need many cases. The forces that the post and one guy need for equilibrium, tension
positive and compression negative, have no kink. A guy carries its signed tension where
that is positive, the post the larger of its two signed compressions: bounds of the
signed forces bound the members. Theory: structure/THEORY.md, eq. (S2).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.numerics.arrays import Floats
from netdesign.structure.head import Vector, Ways, resolve_signed
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import CARRYING_MEMBERS, Member, name_in_panel
from netdesign.structure.splay import find_ways


def find_case_ways(
    layouts: Sequence[SupportLayout], results: Sequence[CaseResult]
) -> Ways:
    """Unit vectors along members of each layout in some solved cases.

    Shape of each component: layouts, cases, 1.
    """
    states = [result.solution for result in results if result.solution]
    x, y = np.array([state.head_point for state in states]).T
    return find_ways(layouts, (x[:, None], y[:, None]))


class CasePulls(NamedTuple):
    """Pulls on head and foot by the section, then by each panel of a case.

    Attributes
    ----------
    head : tuple of ndarray, shape (2,)
        x and y, of shape (cases, 1 + panels) each [N]; where a case has no panels, all
        are those of its section.
    feet, beside_post : ndarray, shape (cases, 1 + panels)
        Force on the more loaded foot anchor, and on that beside a post [N].
    foot_errors, head_errors : ndarray, shape (cases, 1 + panels)
        Of the pulls [N].
    """

    head: Vector[Floats]
    feet: Floats
    beside_post: Floats
    foot_errors: Floats
    head_errors: Floats


def gather_pulls(results: Sequence[CaseResult], width: float) -> CasePulls:
    """Pulls on supports that carry so many metres of net in some solved cases."""
    panels = [
        one.panel if isinstance(one.panel, PanelForces) else None for one in results
    ]
    counts = (len(panel.solved.panels) if panel else 0 for panel in panels)
    most = max(counts, default=0)
    table = np.empty((6, len(results), 1 + most))
    for k, (result, panel) in enumerate(zip(results, panels, strict=True)):
        if result.solution is None:
            raise ValueError("a case without a solution")
        foot, head = result.solution.foot, result.solution.head
        at_foot = np.hypot(width * foot.x, width * foot.y)  # as its band has it
        errors = width * foot.error, width * head.error
        own = [width * head.x, width * head.y, at_foot, at_foot, *errors]
        table[:, k] = np.array(own)[:, None]
        if panel:
            table[:2, k, 1:] = panel.solved.head.T
            table[2:4, k, 1:] = panel.largest_feet, panel.feet_beside_posts
            table[4:, k, 1:] = width * panel.error
    return CasePulls((table[0], table[1]), *table[2:])


_NET = "signed foot"
_SHARED = "signed foot and uphill guy"
_POST = ("signed post with uphill guy", "signed post with downhill guy")
_BASE = ("signed post base with uphill guy", "signed post base with downhill guy")
_UPHILL, _DOWNHILL = "signed uphill guy", "signed downhill guy"
_OF_SECTION = (_NET, _SHARED, _UPHILL, _DOWNHILL, *_POST, *_BASE)
SIGNED = (*_OF_SECTION, *map(name_in_panel, _OF_SECTION))
_IN_PANEL = {name_in_panel(member): member for member in CARRYING_MEMBERS}


def read_signed(
    results: Sequence[CaseResult], layouts: Sequence[SupportLayout]
) -> tuple[Floats, Floats]:
    """Signed forces of cases and their numerical errors [N].

    Parameters
    ----------
    results : sequence of CaseResult
        Of solves.
    layouts : sequence of SupportLayout
        That the support may have: each force is the largest on any of them.

    Returns
    -------
    forces, errors : ndarray, shape (cases, ``SIGNED``)
        No numbers of a case that failed, and of one in which a guy lies along the post
        and holds nothing sideways: there the members themselves have to be searched. 0
        by the panel between posts where a case has none.
    """
    both = np.full((2, len(results), len(SIGNED)), np.nan)
    places = [k for k, x in enumerate(results) if x.anchors and x.solution]
    if places:
        both[:, places] = _read_solved([results[k] for k in places], layouts)
    return both[0], both[1]


def _read_solved(
    results: Sequence[CaseResult], layouts: Sequence[SupportLayout]
) -> Floats:
    """Forces and errors of solved cases, shape (2, cases, ``SIGNED``) [N]."""
    width, ways = layouts[0].post_spacing, find_case_ways(layouts, results)
    pulls = gather_pulls(results, width)
    forces = _find_signed(pulls.head, pulls.feet, ways).max(axis=1)
    has_panel = np.array([isinstance(x.panel, PanelForces) for x in results])
    by_panel = pulls.head_errors[:, 1:].max(axis=1, initial=0.0)
    of_panel = np.where(has_panel, forces[..., 1:].max(axis=-1, initial=-np.inf), 0.0)
    read = [
        (forces[..., 0], of_panel),
        (
            _find_errors(pulls.foot_errors[:, 0], pulls.head_errors[:, 0], ways),
            has_panel * _find_errors(by_panel, by_panel, ways),
        ),
    ]
    return np.array([np.concatenate(pair).T for pair in read])


def _find_errors(foot: Floats, head: Floats, ways: Ways) -> Floats:
    """Errors of signed forces from those of foot and head on the worst support [N].

    They are linear in these: what an error of each component causes is added, as in
    the bands of the members. Shape: forces, cases.
    """
    none = 0.0 * foot
    across, along, at_foot = np.array(
        [(head, none, none), (none, head, none), (none, none, foot)]
    ).swapaxes(1, 2)
    caused = _find_signed((across, along), at_foot, ways)
    return np.asarray(np.abs(caused).sum(axis=-1).max(axis=1))


def _find_signed(pull: Vector[Floats], foot: Floats, ways: Ways) -> Floats:
    """Signed forces by pulls on the head and forces on the foot anchor [N].

    Shape: forces of a section, layouts, cases, pulls of each.
    """
    post, *guys = ways
    (post_up, uphill), (post_down, downhill) = (
        resolve_signed(pull, post, guy) for guy in guys
    )
    across = -post[1]
    forces = {
        _NET: foot + 0.0 * uphill,
        _SHARED: foot + uphill,
        _UPHILL: uphill,
        _DOWNHILL: downhill,
        _POST[0]: post_up,
        _POST[1]: post_down,
        _BASE[0]: across * post_up,
        _BASE[1]: across * post_down,
    }
    return np.stack([forces[name] for name in _OF_SECTION])


def name_sources(member: str, *, is_shared: bool) -> tuple[str, ...]:
    """Signed forces of which a member carries the largest, or 0; () if of none."""
    if member in _IN_PANEL:
        behind = name_sources(_IN_PANEL[member], is_shared=is_shared)
        return tuple(map(name_in_panel, behind))
    sources: dict[str, tuple[str, ...]] = {
        Member.FOOT_ANCHOR: (_NET,),
        Member.UPHILL_GUY: (_UPHILL,),
        Member.UPHILL_ANCHOR: (_UPHILL,),
        Member.DOWNHILL_GUY: (_DOWNHILL,),
        Member.DOWNHILL_ANCHOR: (_DOWNHILL,),
        Member.POST: _POST,
        Member.POST_BASE: _BASE,
    }
    if is_shared and member in (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR):
        return (_NET, _SHARED)
    return sources.get(member, ())
