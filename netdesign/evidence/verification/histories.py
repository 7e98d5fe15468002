"""The three couplings against each other: steady state, history, staggered exchange."""

from __future__ import annotations

import math
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
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.evidence.scene import solve
from netdesign.evidence.verification.case import (
    Found,
    VerificationCase,
    judge,
    observe_order,
)
from netdesign.evidence.verification.coupled import build_paper_scene
from netdesign.numerics.arrays import Floats

_HORIZON = 0.06  # creep time
_DRAGS = (0.1, 0.05)
_SETTLED = 1e-4  # creep time after which pulls must be smooth; 3 s in these scenes


def list_histories() -> list[VerificationCase]:
    """Steady state met, balance of all steps, smooth pulls, staggered trend."""
    found: dict[str, float | Found] = {}
    for inclination in (0, 30):
        scene, name = (
            build_paper_scene(inclination=inclination),
            f"history-{inclination}",
        )
        run = _run(scene, start="sagged", densifies=False, level=1)
        found |= _compare_with_steady(scene, run, name)
        found |= _check_steps(run, name)
        straight = _run(scene, start="straight", densifies=True, level=1)
        found |= _check_steps(straight, f"{name}-straight")
    return judge({**found, "staggered-tends-to-transient": _compare_staggered()})


def _check_steps(run: Run, name: str) -> dict[str, float]:
    residual = max(moment.residual for moment in run.moments)
    return {f"{name}-balance": residual, f"{name}-smooth": _largest_return(run)}


def _run(scene: Scene, *, start: str, densifies: bool, level: int) -> Run:
    settings = TransientSettings(
        start="straight" if start == "straight" else "sagged",
        densifies=densifies,
        stops_at_plateau=densifies is False,
    )
    return run_history(scene, TRANSIENT_LEVELS[level], settings, _HORIZON)


def _compare_with_steady(scene: Scene, run: Run, name: str) -> dict[str, Found]:
    """Pulls [kN/m] when the net has come to rest, densification off."""
    steady = solve(scene, SolverSettings())
    if run.plateau.end is None:
        return {f"{name}-{end}": Found(math.nan, math.nan) for end in ("foot", "head")}
    moment = run.moments[run.plateau.end]
    pulls = {"foot": (moment.foot, steady.foot), "head": (moment.head, steady.head)}
    return {
        f"{name}-{end}": Found(_size(got, scene), expected.size / 1e3)
        for end, (got, expected) in pulls.items()
    }


def _size(pull: Floats, scene: Scene) -> float:
    """Pull of a history [kN/m]."""
    return float(np.hypot(*pull)) * scene.force_scale / 1e3


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


def _compare_staggered() -> Found:
    """Foot pull of the exchange at one creep time, drag and step shrinking."""
    scene = build_paper_scene(inclination=0.0)
    history = _run(scene, start="straight", densifies=True, level=0)
    expected = _size(history.moments[-1].foot, scene)
    settings = StaggeredSettings(horizon=_HORIZON)
    runs = [run_exchange(scene, replace(settings, base_drag=drag)) for drag in _DRAGS]
    got = [_size(run.moments[-1].foot, scene) for run in runs]
    order = observe_order(_DRAGS, [abs(value - expected) for value in got])
    return Found(got[-1], expected, order)
