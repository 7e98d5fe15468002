"""Three solved scenes, and what another finite element code found of them."""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.resources import files
from typing import Any

from netdesign.addons.evidence.scene import build_scene, solve
from netdesign.addons.evidence.verification.case import Found, VerificationCase, judge
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.snow.ground import GroundLaw

_ACCURACY = 0.002


@dataclass(frozen=True, slots=True, kw_only=True)
class SharedScene:
    """One scene whose snow sticks to its net: the flow alone can be run again.

    Attributes
    ----------
    name : str
        By which results of other codes name it.
    solution : Solution
        As this program solved it.
    """

    name: str
    solution: Solution

    @property
    def resultant(self) -> tuple[float, float]:
        """Force of the snow on the net [N/m]."""
        x, y = self.solution.net_forces.sum(axis=1)
        return float(x), float(y)

    @property
    def moment(self) -> float:
        """Its moment about the foot, positive where it tips the head downslope."""
        (x, y), (force_x, force_y) = self.solution.net_curve, self.solution.net_forces
        return float((y * force_x - x * force_y).sum())


@lru_cache(maxsize=1)
def _load_tables() -> dict[str, Any]:
    text = files(__package__).joinpath("another_code.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


@lru_cache(maxsize=1)
def solve_shared() -> tuple[SharedScene, ...]:
    """The three scenes, solved; their snow sticks to the net (friction of 60 degrees).

    Raises
    ------
    SolveError
        If one has no solution.
    """
    return tuple(map(_solve, _load_tables()["scene"]))


def _solve(table: dict[str, Any]) -> SharedScene:
    scene = build_scene(
        *table["layers"],
        slope=table["slope_deg"],
        length=16.0,
        ground=GroundLaw(kind=table["ground"]),
        lean=table["inclination_deg"],
        friction=60.0,
        slack=0.03,
    )
    solution = solve(scene, SolverSettings(accuracy=_ACCURACY))
    return SharedScene(name=table["name"], solution=solution)


_WITHIN = 1e-3  # of the whole force or moment: stated errors of this program


@dataclass(frozen=True, slots=True, kw_only=True)
class OtherResult:
    """Result of another code for one scene [kN/m, kN m/m]."""

    code: str
    recipe: str
    scene: str
    force_x: float
    force_y: float
    moment: float
    uncertainty_force: float
    uncertainty_moment: float

    @property
    def force(self) -> float:
        """Size of the force [kN/m]."""
        return math.hypot(self.force_x, self.force_y)


@lru_cache(maxsize=1)
def load_results() -> tuple[OtherResult, ...]:
    """Stored results of all codes."""
    return tuple(
        OtherResult(code=code["name"], recipe=code["recipe"], **result)
        for code in _load_tables()["code"]
        for result in code["result"]
    )


def list_another_code() -> list[VerificationCase]:
    """Force and moment on the net of each scene."""
    scenes = {scene.name: scene for scene in solve_shared()}
    return [
        case
        for other in load_results()
        for case in _compare(scenes[other.scene], other)
    ]


def _compare(scene: SharedScene, other: OtherResult) -> list[VerificationCase]:
    x, y = scene.resultant
    of_force = other.uncertainty_force + _WITHIN * other.force
    of_moment = other.uncertainty_moment + _WITHIN * other.moment
    rows = {
        "force-x": (x, other.force_x, of_force),
        "force-y": (y, other.force_y, of_force),
        "moment": (scene.moment, other.moment, of_moment),
    }
    name = f"another-code-{scene.name}"
    results = {
        f"{name}-{part}": Found(got / 1e3, expected)
        for part, (got, expected, _) in rows.items()
    }
    return [
        replace(case, tolerance=allowed / abs(case.expected))
        for case, (*_, allowed) in zip(judge(results), rows.values(), strict=True)
    ]
