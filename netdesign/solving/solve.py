"""Solves any scene by any method, and writes what a row needs of it for the store."""

from __future__ import annotations

import json
from dataclasses import fields
from typing import Any

import numpy as np

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import (
    Balance,
    Cost,
    EndPull,
    FailedSolution,
    Method,
    MethodSettings,
    Solution,
    SolvedState,
)
from netdesign.coupling.steady.solve import solve_steady
from netdesign.edge.json_text import list_fields
from netdesign.outcome import Outcome
from netdesign.units import degree_from_radian
from netdesign.words.message import restore

Settings = SolverSettings | MethodSettings


def solve_scene(
    scene: Scene, settings: Settings | None = None
) -> Solution | FailedSolution:
    """Snow against the scene's net; the settings choose the method.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    settings : SolverSettings or MethodSettings, optional
        Of the steady state (default), or of a method that an add-on brings.
    """
    # what is not finite ends as an outcome with its reason, not as a remark on stderr
    with np.errstate(all="ignore"):
        if settings is not None and not isinstance(settings, SolverSettings):
            return settings.solve(scene)
        return solve_steady(scene, settings)


def method_of(settings: Settings) -> Method:
    """Name of the method that the settings choose."""
    return "steady" if isinstance(settings, SolverSettings) else settings.method


def describe_case(scene: Scene, settings: Settings) -> str:
    """``density 400 kg/m3, friction 30 deg, inclination 25 deg, ..., steady``."""
    snow, net = scene.snowpack, scene.net
    parts = (
        f"density {snow.density:.6g} kg/m3",
        f"friction {degree_from_radian(net.friction_angle):.6g} deg",
        f"inclination {degree_from_radian(net.inclination):.6g} deg",
        f"slope {degree_from_radian(snow.slope_angle):.6g} deg",
        f"snow {snow.thickness:.6g} m by {snow.upslope_length:.6g} m",
        method_of(settings),
    )
    return ", ".join(parts)


CaseEnd = SolvedState | FailedSolution  # end of one solve


def keep_state(solution: Solution) -> SolvedState:
    """Part of a solution that an envelope keeps."""
    kept = {field.name: getattr(solution, field.name) for field in fields(SolvedState)}
    return SolvedState(**kept)


_RECORDS = {"foot": EndPull, "head": EndPull, "balance": Balance, "cost": Cost}
_ARRAYS = {"net_curve": float, "net_forces": float, "net_slides": bool}


def encode_end(end: CaseEnd) -> str:
    """Text from which ``decode_end`` makes the very same value."""
    numbers: dict[str, Any] = list_fields(end)
    if isinstance(end, FailedSolution):
        numbers = {"outcome": end.outcome.value, "reason": end.reason}
    # compressed it would be a third of that, and take as long again to keep
    return json.dumps(numbers, default=_write_part)


def _write_part(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else list_fields(value)


def decode_end(text: str) -> CaseEnd:
    """The value that was encoded.

    Raises
    ------
    ValueError, KeyError, TypeError
        If the text is not what ``encode_end`` wrote.
    """
    numbers: dict[str, Any] = json.loads(text)
    if "outcome" in numbers:
        outcome = Outcome(numbers["outcome"])
        return FailedSolution(outcome=outcome, reason=restore(numbers["reason"]))
    parts = {name: kind(**numbers[name]) for name, kind in _RECORDS.items()}
    arrays = {x: np.array(numbers[x], dtype=kind) for x, kind in _ARRAYS.items()}
    state = SolvedState(**{**numbers, **parts, **arrays})
    if not state.is_finite:
        raise ValueError("a force is no number")
    return state
