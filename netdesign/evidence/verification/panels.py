"""Panels between posts: a prototype's forces, a net in space, straight ropes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.errors import SolveError
from netdesign.evidence.scene import build_scene, solve
from netdesign.evidence.verification.case import VerificationCase
from netdesign.evidence.verification.net_in_space import solve_net_in_space
from netdesign.panel.inputs import Cut, Panel, Rope
from netdesign.panel.solution import FailedPanel, PanelSolution
from netdesign.panel.solve import solve_panel
from netdesign.panel.strips import take_strip
from netdesign.snow.ground import GroundLaw

_HEIGHT = 3.0  # [m]
_SLIP_RATIO = 2.4147  # N 1.8 as the prototype had it
_ROPE = Rope(stiffness=18e6, sag=0.05)
_PANEL = Panel(post_spacing=4.0, lower=_ROPE, upper=_ROPE, cut="upper")
# Of the prototype: foot, head, H and T of the lower, then of the upper rope [kN].
_PROTOTYPE: dict[Cut, tuple[float, ...]] = {
    "uniform": (175.0, 129.6, 237.2, 252.9, 187.4, 198.3),
    "upper": (186.8, 141.2, 249.9, 266.8, 200.8, 212.9),
}
_NAMES = ("foot", "head", "lower-H", "lower-T", "upper-H", "upper-T")
_STRAIGHT = Rope(stiffness=1e40, sag=0.0)  # [N]


def list_panels() -> list[VerificationCase]:
    """One section, its panel by a prototype, in space, and on straight ropes."""
    section = _solve_section()
    cases = [
        VerificationCase(
            id=f"panel-{cut}-{name}",
            kind="cross model",
            reference="prototype of the same model: strips between two elastic ropes",
            expected=expected,
            got=got / 1e3,
            tolerance=5e-3,
        )
        for cut, row in _PROTOTYPE.items()
        for name, expected, got in zip(
            _NAMES, row, _list_forces(_solve(section, cut)), strict=True
        )
    ]
    return [*cases, *_list_in_space(section), _hang_straight(section)]


def _list_in_space(section: Solution) -> list[VerificationCase]:
    panel = _solve(section, "upper")
    net = solve_net_in_space(take_strip(section), panel.panel)
    pairs = {
        "foot": (np.hypot(*net.foot), math.hypot(*panel.foot)),
        "head": (np.hypot(*net.head), math.hypot(*panel.head)),
        "lower-H": (net.lower_along, panel.lower.along),
        "upper-H": (net.upper_along, panel.upper.along),
    }
    return [
        VerificationCase(
            id=f"panel-in-space-{name}",
            kind="cross model",
            reference="net of bars in space that only pull, least energy",
            expected=float(expected) / 1e3,
            got=got / 1e3,
            tolerance=0.02,
        )
        for name, (expected, got) in pairs.items()
    ]


def _hang_straight(section: Solution) -> VerificationCase:
    panel = replace(_PANEL, lower=_STRAIGHT, upper=_STRAIGHT, cut="uniform")
    return VerificationCase(
        id="panel-straight-ropes",
        kind="limit",
        reference="pull times spacing, as EA grows without bound",
        expected=section.foot.size * panel.post_spacing / 1e3,
        got=math.hypot(*_require(solve_panel(section, panel)).foot) / 1e3,
        tolerance=1e-10,
    )


def _solve_section() -> Solution:
    ground = GroundLaw(kind="sliding", slip_length=_SLIP_RATIO * _HEIGHT)
    scene = build_scene(
        (_HEIGHT, 400.0), slope=40.0, length=20.0, ground=ground, slack=0.04
    )
    return solve(scene, SolverSettings(accuracy=1e-3))


def _solve(section: Solution, cut: Cut) -> PanelSolution:
    return _require(solve_panel(section, replace(_PANEL, cut=cut)))


def _require(solved: PanelSolution | FailedPanel) -> PanelSolution:
    if isinstance(solved, FailedPanel):
        raise SolveError(solved.outcome, solved.reason)
    return solved


def _list_forces(solved: PanelSolution) -> tuple[float, ...]:
    lower, upper = solved.lower, solved.upper
    return (
        *(math.hypot(*solved.foot), math.hypot(*solved.head)),
        *(lower.along, lower.tension, upper.along, upper.tension),
    )
