"""The three couplings against each other: steady state, history, staggered exchange."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from netdesign.coupling.history.run import Run
from netdesign.coupling.history.settings import (
    TRANSIENT_LEVELS,
    StaggeredSettings,
    TransientSettings,
)
from netdesign.coupling.history.staggered import run_exchange
from netdesign.coupling.history.transient import run_history
from netdesign.coupling.moments import HistoryPoint
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.evidence.verification.case import VerificationCase, observe_order
from netdesign.evidence.verification.coupled import build_paper_scene
from netdesign.numerics.arrays import Floats

_HORIZON = 0.06  # creep time
_DRAGS = (0.1, 0.05)
_SETTLED = 1e-4  # creep time after which pulls must be smooth; 3 s in these scenes


def list_histories() -> list[VerificationCase]:
    """Steady state met, balance of all steps, smooth pulls, staggered trend."""
    cases = []
    for inclination in (0.0, 30.0):
        scene = build_paper_scene(inclination=inclination)
        run = _run(scene, start="sagged", densifies=False, level=1)
        cases += _compare_with_steady(scene, run, f"history-{inclination:g}")
        cases += _check_steps(run, f"history-{inclination:g}")
        straight = _run(scene, start="straight", densifies=True, level=1)
        cases += _check_steps(straight, f"history-{inclination:g}-straight")
    return [*cases, _compare_staggered()]


def _check_steps(run: Run, name: str) -> list[VerificationCase]:
    return [
        VerificationCase(
            id=f"{name}-balance",
            kind="invariant",
            reference="no force missing in any step, over the weight",
            expected=0.0,
            got=max(moment.residual for moment in run.moments),
            tolerance=1e-8,
        ),
        VerificationCase(
            id=f"{name}-smooth",
            kind="invariant",
            reference="no step takes back what the one before has changed in a pull",
            expected=0.0,
            got=_largest_return(run),
            tolerance=5e-3,
        ),
    ]


def _run(scene: Scene, *, start: str, densifies: bool, level: int) -> Run:
    settings = TransientSettings(
        start="straight" if start == "straight" else "sagged",
        densifies=densifies,
        stops_at_plateau=densifies is False,
    )
    return run_history(scene, TRANSIENT_LEVELS[level], settings, _HORIZON)


def _compare_with_steady(scene: Scene, run: Run, name: str) -> list[VerificationCase]:
    """Pulls when the net has come to rest, densification off."""
    steady = solve_steady(scene, on_failure="raise")
    if not isinstance(steady, Solution) or run.plateau.end is None:
        return [
            VerificationCase(
                id=f"{name}-foot",
                kind="cross model",
                reference="the history has no plateau",
                expected=0.0,
                got=1.0,
                tolerance=0.0,
            )
        ]
    moment = run.moments[run.plateau.end]
    pulls = ((steady.foot.size, moment.foot), (steady.head.size, moment.head))
    return [
        VerificationCase(
            id=f"{name}-{end}",
            kind="cross model",
            reference="steady state, when the sagged net has come to rest",
            expected=expected / 1e3,
            got=float(np.hypot(*got)) * scene.force_scale / 1e3,
            tolerance=0.01,
        )
        for end, (expected, got) in zip(("foot", "head"), pulls, strict=True)
    ]


def _largest_return(run: Run) -> float:
    """Largest part of a step's change of a pull that the next step takes back."""
    moments = [moment for moment in run.moments if moment.time > _SETTLED]
    worst = 0.0
    for sizes in (_sizes(moments, "foot"), _sizes(moments, "head")):
        change = np.diff(np.log(sizes))
        back = change[1:] * change[:-1] < 0.0
        returned = np.minimum(np.abs(change[1:]), np.abs(change[:-1]))
        worst = max(worst, float(returned[back].max(initial=0.0)))
    return worst


def _sizes(moments: list[HistoryPoint], end: str) -> Floats:
    return np.array([float(np.hypot(*getattr(moment, end))) for moment in moments])


def _compare_staggered() -> VerificationCase:
    """Foot pull of the exchange at one creep time, drag and step shrinking."""
    scene = build_paper_scene(inclination=0.0)
    history = _run(scene, start="straight", densifies=True, level=0)
    expected = float(np.hypot(*history.moments[-1].foot)) * scene.force_scale / 1e3
    settings = StaggeredSettings(horizon=_HORIZON)
    got = [
        float(
            np.hypot(
                *run_exchange(scene, replace(settings, base_drag=drag)).moments[-1].foot
            )
        )
        * scene.force_scale
        / 1e3
        for drag in _DRAGS
    ]
    return VerificationCase(
        id="staggered-tends-to-transient",
        kind="cross model",
        reference="implicit history at the same time; drag and step halved",
        expected=expected,
        got=got[-1],
        tolerance=0.12,
        order=observe_order(_DRAGS, [abs(value - expected) for value in got]),
        least_order=0.6,
    )
