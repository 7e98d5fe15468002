"""Solves any scene by any method, and keeps of the solution what a row needs.

Kept are end pulls, balances and the net's shape; they have a stored form.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import (
    RELEASED,
    Balance,
    EndPull,
    FailedSolution,
    Method,
    MethodSettings,
    Solution,
)
from netdesign.coupling.steady.solve import solve_steady
from netdesign.edge.json_text import list_fields
from netdesign.numerics.arrays import Floats, Mask
from netdesign.outcome import Outcome
from netdesign.units import degree_from_radian
from netdesign.words.message import Message, dump, restore

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


# Distance from the net's foot over that of its head. Cases that slip only so far move
# by at most a tenth of their stated error if friction grows (512 cases of a row).
_BY_FOOT = 5e-3
_SHAPE_ARRAYS = (
    ("net_curve", "<f8"),
    ("net_forces", "<f8"),
    ("net_slides", "|b1"),
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SolvedState:
    """A converged solution without what no envelope needs. SI units.

    Attributes
    ----------
    method : str
        ``steady``, ``transient`` or ``staggered``.
    foot, head : EndPull
        Pulls on the net's ends [N/m].
    tension_max : float
        Along the net [N/m].
    balance : Balance
        Tests that it passed.
    elements, linear_solves : int
        What it took.
    net_curve, net_forces, net_slides, is_released
        As in ``Solution``.
    """

    method: str
    foot: EndPull
    head: EndPull
    tension_max: float
    balance: Balance
    elements: int
    linear_solves: int
    net_curve: Floats
    net_forces: Floats
    net_slides: Mask
    is_released: bool = False

    @property
    def outcome(self) -> Outcome:
        """Always converged: anything else is a ``FailedSolution``."""
        return Outcome.CONVERGED

    @property
    def reason(self) -> Message | None:
        """Remark that a reader needs; None of what was solved as asked."""
        return RELEASED if self.is_released else None

    @property
    def head_point(self) -> tuple[float, float]:
        """Position of the net's head [m]."""
        x, y = self.net_curve[:, -1]
        return float(x), float(y)

    @property
    def sticks(self) -> bool:
        """The snow slips nowhere on the net, or only by its foot.

        There, where the pressure is singular, some snow slips at any friction; more
        friction would change next to nothing.
        """
        slides = np.flatnonzero(self.net_slides)
        if not slides.size:
            return True
        (x, y), head = self.net_curve[:, slides[-1]], self.head_point
        return math.hypot(x, y) <= _BY_FOOT * math.hypot(*head)

    @property
    def is_finite(self) -> bool:
        """Whether every number behind a force is finite, and no error is negative."""
        parts = (
            getattr(part, key)
            for part in (self.foot, self.head, self.balance)
            for key in part.__dataclass_fields__
        )
        numbers = [self.tension_max, *(part for part in parts if part is not None)]
        shape = (self.net_curve, self.net_forces)
        return (
            all(math.isfinite(number) for number in numbers)
            and all(bool(np.isfinite(array).all()) for array in shape)
            and min(self.foot.error, self.head.error) >= 0.0
        )


CaseEnd = SolvedState | FailedSolution  # end of one solve


def is_stuck(end: CaseEnd) -> bool:
    """Whether more friction would change nothing."""
    return isinstance(end, SolvedState) and end.sticks


def keep_state(solution: Solution) -> SolvedState:
    """Part of a solution that an envelope keeps."""
    return SolvedState(
        method=solution.method,
        foot=solution.foot,
        head=solution.head,
        tension_max=solution.tension_max,
        balance=solution.balance,
        elements=solution.cost.elements,
        linear_solves=solution.cost.linear_solves,
        net_curve=np.asarray(solution.net_curve, dtype="<f8"),
        net_forces=np.asarray(solution.net_forces, dtype="<f8"),
        net_slides=np.asarray(solution.net_slides, dtype="|b1"),
        is_released=solution.is_released,
    )


def encode_end(end: CaseEnd) -> tuple[str, bytes]:
    """Text and bytes from which ``decode_end`` makes the very same value."""
    reason = None if end.reason is None else dump(end.reason)
    if isinstance(end, FailedSolution):
        return json.dumps({"outcome": end.outcome.value, "reason": reason}), b""
    arrays = [
        np.ascontiguousarray(getattr(end, name), dtype=kind)
        for name, kind in _SHAPE_ARRAYS
    ]
    numbers = {
        "outcome": end.outcome.value,
        "reason": reason,
        "method": end.method,
        "foot": list_fields(end.foot),
        "head": list_fields(end.head),
        "tension_max": end.tension_max,
        "balance": list_fields(end.balance),
        "elements": end.elements,
        "linear_solves": end.linear_solves,
        "shapes": [array.shape for array in arrays],
    }
    # compressed it would be a third smaller, and take half as long again to keep
    return json.dumps(numbers), b"".join(array.tobytes() for array in arrays)


def decode_end(text: str, shape: bytes) -> CaseEnd:
    """The value that was encoded.

    Raises
    ------
    ValueError, KeyError, TypeError
        If the two are not what ``encode_end`` wrote.
    """
    numbers: dict[str, Any] = json.loads(text)
    outcome, stored = Outcome(numbers["outcome"]), numbers["reason"]
    reason = None if stored is None else restore(stored)
    if outcome is not Outcome.CONVERGED:
        if reason is None:
            raise ValueError("a failure without a reason")
        return FailedSolution(outcome=outcome, reason=reason)
    state = SolvedState(
        method=numbers["method"],
        foot=EndPull(**numbers["foot"]),
        head=EndPull(**numbers["head"]),
        tension_max=numbers["tension_max"],
        balance=Balance(**numbers["balance"]),
        elements=numbers["elements"],
        linear_solves=numbers["linear_solves"],
        is_released=reason is not None,
        **_decode_arrays(shape, numbers["shapes"]),
    )
    if not state.is_finite:
        raise ValueError("a force is no number")
    return state


def _decode_arrays(content: bytes, shapes: list[list[int]]) -> dict[str, Any]:
    arrays: dict[str, Any] = {}
    start = 0
    for (name, kind), shape in zip(_SHAPE_ARRAYS, shapes, strict=True):
        size = math.prod(shape) * np.dtype(kind).itemsize
        flat = np.frombuffer(content[start : start + size], dtype=kind)
        arrays[name] = flat.reshape(shape)
        start += size
    if start != len(content):
        raise ValueError("arrays: the length is wrong")
    return arrays
