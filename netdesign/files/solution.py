"""The solution document (JSON): what one solve found, at the edge."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from netdesign import __version__
from netdesign.cable.net import Net
from netdesign.core.library import name_core
from netdesign.coupling.history.settings import StaggeredSettings, TransientSettings
from netdesign.coupling.moments import COUNTED_STRAIN, History, HistoryPoint
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import (
    RELEASED,
    Balance,
    Cost,
    EndPull,
    FailedSolution,
    Solution,
    WallSolution,
)
from netdesign.numerics.arrays import Floats, Mask
from netdesign.snow.creep_law import FLUIDITY_EXPONENT
from netdesign.solving.solve import Settings
from netdesign.units import (
    day_from_second,
    fluidity_per_mpa_year,
    kilonewton_from_newton,
    mm_per_day,
)
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

SOLUTION_SCHEMA = "netdesign.solution/1"
_NOTED_LOSS = 0.005  # share of the snow that may go over the head unmentioned


def write_solution_document(
    solution: Solution | WallSolution | FailedSolution,
    settings: Settings,
    wall_s: float,
    bound: Solution | None = None,
    language: Language = "en",
    support: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Solution as plain values in the form ``netdesign.solution/1``.

    ``bound`` is that of a failed solution, ``support`` what `cases.write_support` says
    of a net's, where there is one; reasons and remarks are in ``language``.
    """
    if isinstance(solution, FailedSolution):
        return {
            "schema": SOLUTION_SCHEMA,
            "outcome": solution.outcome.value,
            "reason": render(solution.reason, language),
            **({} if bound is None else {"upper_bound": _write_bound(bound)}),
        }
    held = (
        _write_wall(solution)
        if isinstance(solution, WallSolution)
        else _write_net(solution)
    )
    return {
        "schema": SOLUTION_SCHEMA,
        "outcome": solution.outcome.value,
        "method": solution.method if isinstance(solution, Solution) else "steady",
        **held,
        **({} if support is None else {"support": support}),
        "balance": _write_balance(solution.balance),
        "largest_velocity_mm_per_day": mm_per_day(solution.largest_velocity),
        **_write_history(solution, language),
        "flags": [render(one, language) for one in _list_flags(solution, settings)],
        "cost": _write_cost(solution.cost, wall_s),
        "provenance": {
            "version": __version__,
            "core": name_core(),
            "creep_law": solution.scene.creep_law.name,
            "clock": _write_clock(solution.scene),
            "element": solution.scene.flow_problem.element,
            "settings": _write_settings(settings),
        },
    }


def _write_bound(bound: Solution) -> dict[str, float]:
    """Pulls that a refused net stays below: those of the same net with this slack."""
    assert isinstance(bound.scene.net, Net)
    ends = {"foot": bound.foot, "head": bound.head}
    return {
        "slack": bound.scene.net.slack,
        **{
            f"{end}_kN_per_m": kilonewton_from_newton(pull.size + pull.error)
            for end, pull in ends.items()
        },
    }


def _write_cost(cost: Cost, wall_s: float) -> dict[str, Any]:
    """Work of the solve, and the parts that it did without."""
    return {
        "wall_s": wall_s,
        "linear_solves": cost.linear_solves,
        "rounds": cost.rounds,
        "elements": cost.elements,
        "degrees_of_freedom": cost.degrees_of_freedom,
        "skipped": {
            "upslope_length_m": cost.skipped.upslope_length,
            "pressure_unknowns": cost.skipped.pressure_unknowns,
        },
    }


def _write_settings(settings: Settings) -> dict[str, Any]:
    """Tolerances and choices that a rerun needs."""
    if isinstance(settings, SolverSettings):
        return {
            "accuracy": settings.accuracy,
            "stress_tolerance": settings.stress_tolerance,
            "shape_tolerance": settings.shape_tolerance,
            "balance_tolerance": settings.balance_tolerance,
        }
    if isinstance(settings, TransientSettings):
        return {
            "accuracy": settings.accuracy,
            "start": settings.start,
            "horizon_d": day_from_second(settings.horizon),
            "densification": settings.densifies,
            "stress_tolerance": settings.stress_tolerance,
            "balance_tolerance": settings.balance_tolerance,
        }
    return {
        "start": settings.start,
        "base_drag": settings.base_drag,
        "step_share": settings.step_share,
        "horizon_creep_time": settings.horizon,
        "stress_tolerance": settings.stress_tolerance,
    }


def _write_history(
    solution: Solution | WallSolution, language: Language
) -> dict[str, Any]:
    """Null for a steady state; else the moments, the plateau and both its pulls."""
    if not isinstance(solution, Solution) or solution.history is None:
        return {"history": None}
    history = solution.history
    plateau, moment = history.plateau, history.at_plateau
    return {
        "history": [_write_moment(entry) for entry in history.moments],
        "plateau": {
            "reached": plateau.reached,
            "time_d": None if plateau.time is None else day_from_second(plateau.time),
            "criterion": plateau.criterion,
            "drift_per_efold": plateau.drift,
            "foot_kN_per_m": None if moment is None else _size(moment.foot),
            "head_kN_per_m": None if moment is None else _size(moment.head),
        },
        "largest": {
            f"{end}_kN_per_m": kilonewton_from_newton(pull.size)
            for end, pull in (("foot", solution.foot), ("head", solution.head))
        },
        "start": history.start,
        "densification": history.densifies,
        "fallen_over_head": history.fallen_share,
        "ended": render(history.ended or "", language),
    }


def _write_moment(moment: HistoryPoint) -> dict[str, Any]:
    return {
        "time_d": day_from_second(moment.time),
        "foot_kN_per_m": _size(moment.foot),
        "head_kN_per_m": _size(moment.head),
        "tension_min_kN_per_m": kilonewton_from_newton(moment.tension_min),
        "tension_max_kN_per_m": kilonewton_from_newton(moment.tension_max),
        "max_relative_density": moment.max_relative_density,
        "relative_residual": moment.residual,
        "node_forces": [
            [kilonewton_from_newton(float(x)), kilonewton_from_newton(float(y))]
            for x, y in moment.on_net.T
        ],
    }


def _size(vector: Floats) -> float:
    return kilonewton_from_newton(float(np.hypot(*vector)))


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


def _write_wall(solution: WallSolution) -> dict[str, Any]:
    force = solution.force
    nodes = _write_nodes(
        solution.wall_nodes, solution.wall_forces, solution.wall_slides
    )
    return {
        "anchor_forces": None,
        "wall": {
            "force_x_kN_per_m": kilonewton_from_newton(force.x),
            "force_y_kN_per_m": kilonewton_from_newton(force.y),
            "moment_about_foot_kN": kilonewton_from_newton(solution.moment_about_foot),
            "error_kN_per_m": kilonewton_from_newton(force.error),
        },
        "tension_kN_per_m": None,
        "sag_m": None,
        "nodes": nodes,
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


def _list_flags(solution: Solution | WallSolution, settings: Settings) -> list[Message]:
    """Remarks that a reader must know before using the numbers."""
    law = solution.scene.creep_law
    missed = _find_missed_accuracy(solution, settings)
    flags = _list_history_flags(getattr(solution, "history", None), solution.scene)
    if missed is not None:
        flags.append(missed)
    if getattr(solution, "is_released", False):
        flags.append(RELEASED)
    if not solution.scene.is_calibrated:
        low, high = law.calibrated
        flags.append(say("solution.uncalibrated", low=low, high=high, law=law.name))
    if law.exponent != FLUIDITY_EXPONENT:
        flags.append(say("solution.exponent", exponent=law.exponent))
    return flags


def _find_missed_accuracy(
    solution: Solution | WallSolution, settings: Settings
) -> Message | None:
    """Accuracy that was asked for and not reached, or that nobody asked for."""
    if isinstance(settings, StaggeredSettings):
        return say("solution.staggered_error")
    if isinstance(solution, WallSolution):
        pulls: tuple[EndPull, ...] = (solution.force,)
    else:
        pulls = solution.foot, solution.head
    error = max((one.error / one.size for one in pulls if one.size), default=0.0)
    if error <= (1.0 + 1e-9) * settings.accuracy:
        return None
    return say("solution.accuracy_missed", asked=settings.accuracy, error=error)


def _list_history_flags(history: History | None, scene: Scene) -> list[Message]:
    if history is None:
        return []
    flags = [_describe_clock(scene)] if scene.settles_as_stations else []
    plateau = history.plateau
    if plateau.was_left:
        flags.append(
            say(
                "solution.plateau_left",
                drift=float(plateau.drift or 0.0),
                strain=COUNTED_STRAIN,
            )
        )
    elif not plateau.reached:
        flags.append(say("solution.plateau_not_reached"))
    if history.ended:
        flags.append(say("solution.ended_early", reason=history.ended))
    if history.fallen_share > _NOTED_LOSS:
        flags.append(say("solution.fell_over", share=float(history.fallen_share)))
    return flags


def _describe_clock(scene: Scene) -> Message:
    n = scene.creep_law.exponent
    fluidity = fluidity_per_mpa_year(scene.creep_fluidity, n)
    return say("solution.settling_clock", fluidity=fluidity, exponent=n)
