"""A bound of the pulls of a net whose own steady state is refused.

Less slack is less sag, and a flatter net pulls more: coupling/THEORY.md, section 2.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import EndPull, Solution
from netdesign.coupling.steady.solve import solve_steady

# Shares of a refused net's slack that are tried in turn.
_SHARES = (0.75, 0.5, 0.25, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class PullBound:
    """Pulls of the same net with less slack; its own are smaller.

    Attributes
    ----------
    slack : float
        Of the net that was solved [-].
    foot, head : EndPull
        Its pulls.
    """

    slack: float
    foot: EndPull
    head: EndPull


def bound_by_less_slack(scene: Scene, settings: SolverSettings) -> PullBound | None:
    """Pulls of a refused scene with the most slack that is solved.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net, or a wall, which has no slack.
    settings : SolverSettings
        Accuracy and tolerances.

    Returns
    -------
    PullBound or None
        None if the net has no slack, or none of the tautened nets is solved.

    Verified by
    -----------
    tests/coupling/steady/test_bound.py
    """
    for tauter in _list_tauter(scene):
        solution = solve_steady(tauter, settings)
        if isinstance(solution, Solution):
            assert isinstance(tauter.net, Net)
            return PullBound(
                slack=tauter.net.slack, foot=solution.foot, head=solution.head
            )
    return None


def _list_tauter(scene: Scene) -> Iterator[Scene]:
    net = scene.net
    if not isinstance(net, Net) or net.slack == 0.0:
        return
    for share in _SHARES:
        yield replace(scene, net=replace(net, slack=share * net.slack))
