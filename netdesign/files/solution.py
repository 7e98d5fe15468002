"""The solution document (JSON): what one solve found, at the edge."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from netdesign import __version__
from netdesign.core.library import name_core
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import (
    RELEASED,
    Balance,
    Cost,
    FailedSolution,
    Solution,
)
from netdesign.numerics.arrays import Floats, Mask
from netdesign.snow.creep_law import FLUIDITY_EXPONENT
from netdesign.solving.solve import Settings
from netdesign.units import (
    fluidity_per_mpa_year,
    kilonewton_from_newton,
    mm_per_day,
)
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

SOLUTION_SCHEMA = "netdesign.solution/1"


def write_solution_document(
    solution: Solution | FailedSolution,
    settings: Settings,
    wall_s: float,
    language: Language = "en",
    support: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Solution as plain values in the form ``netdesign.solution/1``.

    ``support`` is what `cases.write_support` says of a net's, where there is one;
    reasons and remarks are in ``language``.
    """
    if isinstance(solution, FailedSolution):
        return {
            "schema": SOLUTION_SCHEMA,
            "outcome": solution.outcome.value,
            "reason": render(solution.reason, language),
        }
    history = getattr(solution, "history", None)
    return {
        "schema": SOLUTION_SCHEMA,
        "outcome": solution.outcome.value,
        "method": solution.method,
        **_write_net(solution),
        **({} if support is None else {"support": support}),
        "balance": _write_balance(solution.balance),
        "largest_velocity_mm_per_day": mm_per_day(solution.largest_velocity),
        **({"history": None} if history is None else history.write(solution, language)),
        "flags": [render(flag, language) for flag in _list_flags(solution, settings)],
        "cost": _write_cost(solution.cost, wall_s),
        "provenance": {
            "version": __version__,
            "core": name_core(),
            "creep_law": solution.scene.creep_law.name,
            "clock": _write_clock(solution.scene),
            "element": solution.scene.flow_problem.element,
            "settings": settings.describe(),
        },
    }


def _write_cost(cost: Cost, wall_s: float) -> dict[str, Any]:
    """Work of the solve."""
    return {
        "wall_s": wall_s,
        "linear_solves": cost.linear_solves,
        "rounds": cost.rounds,
        "elements": cost.elements,
        "degrees_of_freedom": cost.degrees_of_freedom,
    }


def _write_clock(scene: Scene) -> dict[str, Any]:
    """Fluidity that turns creep time into time, and where it is from."""
    n = scene.creep_law.exponent
    return {
        "source": "settling" if scene.settles_as_stations else "scene",
        "fluidity_per_MPa_n_a": fluidity_per_mpa_year(scene.creep_fluidity, n),
        "creep_exponent": n,
    }


def _write_net(solution: Solution) -> dict[str, Any]:
    ends = {"foot": solution.foot, "head": solution.head}
    # a free end of the net above the snow carries no nodal force and is left out
    curve = solution.net_curve[:, : solution.net_slides.size]
    return {
        "anchor_forces": {
            end: {
                "x_kN_per_m": kilonewton_from_newton(pull.x),
                "y_kN_per_m": kilonewton_from_newton(pull.y),
                "size_kN_per_m": kilonewton_from_newton(pull.size),
                "error_kN_per_m": kilonewton_from_newton(pull.error),
            }
            for end, pull in ends.items()
        },
        "wall": None,
        "tension_kN_per_m": {
            **{end: kilonewton_from_newton(pull.size) for end, pull in ends.items()},
            "min": kilonewton_from_newton(solution.tension_min),
            "max": kilonewton_from_newton(solution.tension_max),
        },
        "sag_m": solution.sag,
        "nodes": _write_nodes(curve, solution.net_forces, solution.net_slides),
    }


def _write_nodes(curve: Floats, forces: Floats, slides: Mask) -> list[dict[str, Any]]:
    return [
        {
            "x_m": float(x),
            "y_m": float(y),
            "force_x_kN_per_m": kilonewton_from_newton(float(force_x)),
            "force_y_kN_per_m": kilonewton_from_newton(float(force_y)),
            "sliding": bool(is_sliding),
        }
        for (x, y), (force_x, force_y), is_sliding in zip(
            curve.T, forces.T, slides, strict=True
        )
    ]


def _write_balance(balance: Balance) -> dict[str, float]:
    return {
        "weight_along_slope_kN_per_m": kilonewton_from_newton(
            balance.weight_along_slope
        ),
        "relative_residual": balance.relative_residual,
        "friction_excess": balance.friction_excess,
        "suction_share": balance.suction_share,
        "ground_tension_share": balance.ground_tension_share,
    }


def _list_flags(solution: Solution, settings: Settings) -> list[Message]:
    """Remarks that a reader must know before using the numbers."""
    law = solution.scene.creep_law
    missed = _find_missed_accuracy(solution, settings)
    history = getattr(solution, "history", None)
    flags = [] if history is None else history.list_flags(solution.scene)
    if missed is not None:
        flags.append(missed)
    if solution.is_released:
        flags.append(RELEASED)
    if not solution.scene.is_calibrated:
        low, high = law.calibrated
        flags.append(say("solution.uncalibrated", low=low, high=high, law=law.name))
    if law.exponent != FLUIDITY_EXPONENT:
        flags.append(say("solution.exponent", exponent=law.exponent))
    return flags


def _find_missed_accuracy(solution: Solution, settings: Settings) -> Message | None:
    """Accuracy that was not reached, or control of it that was switched off."""
    if settings.accuracy is None:
        return say("solution.staggered_error")
    pulls = solution.foot, solution.head
    error = max((pull.error / pull.size for pull in pulls if pull.size), default=0.0)
    if error <= (1.0 + 1e-9) * settings.accuracy:
        return None
    return say("solution.accuracy_missed", asked=settings.accuracy, error=error)
