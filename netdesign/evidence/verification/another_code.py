"""Exported scenes against the results of other codes, which are kept as data."""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files

from netdesign.evidence.verification.case import VerificationCase
from netdesign.evidence.verification.exported import ExportedScene, solve_exported

_FILE = "another_code.toml"
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
    text = files(__package__).joinpath(_FILE).read_text(encoding="utf-8")
    return tuple(
        OtherResult(code=code["name"], recipe=code["recipe"], **result)
        for code in tomllib.loads(text)["code"]
        for result in code["result"]
    )


def list_another_code() -> list[VerificationCase]:
    """Force and moment on the net of each exported scene."""
    scenes = {scene.name: scene for scene in solve_exported()}
    return [
        case
        for other in load_results()
        for case in _compare(scenes[other.scene], other)
    ]


def _compare(scene: ExportedScene, other: OtherResult) -> list[VerificationCase]:
    x, y = scene.resultant
    pairs = (
        ("force-x", other.force_x, x, other.uncertainty_force, other.force),
        ("force-y", other.force_y, y, other.uncertainty_force, other.force),
        ("moment", other.moment, scene.moment, other.uncertainty_moment, other.moment),
    )
    return [
        VerificationCase(
            id=f"another-code-{scene.name}-{name}",
            kind="cross model",
            reference=f"{other.code}; within 0.1 % of the whole and its uncertainty",
            expected=expected,
            got=got / 1e3,
            tolerance=(uncertainty + _WITHIN * whole) / abs(expected),
        )
        for name, expected, got, uncertainty, whole in pairs
    ]
