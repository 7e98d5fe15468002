"""The scene file (TOML) and the solution document (JSON): one scene at the edge."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from netdesign import __version__
from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import EndPull, FailedSolution, Solution
from netdesign.errors import ModelError, SceneFileError
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.snow.ground import GroundKind, GroundLaw, build_ground_from_glide_factor
from netdesign.snow.snowpack import GravityMode, Snowpack, compute_thickness
from netdesign.units import kilonewton_from_newton, newton_from_kilonewton

Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class SlopeTable(_Table):
    """``[slope]``."""

    angle_deg: Annotated[float, Field(ge=0, le=80)]


class SnowTable(_Table):
    """``[snow]``; one of thickness and vertical height."""

    thickness_m: Positive | None = None
    height_vertical_m: Positive | None = None
    upslope_length_m: Positive
    density_kg_m3: Annotated[float, Field(gt=0, lt=917)]
    creep_law: str = "boutillier-2004"
    creep_exponent: Annotated[float, Field(ge=3, le=3)] = 3.0
    fluidity_per_MPa3_a: Positive = 20.0
    temperature_C: Annotated[float, Field(ge=-60, le=0)] | None = None


class GroundTable(_Table):
    """``[ground]``."""

    law: GroundKind = "free"
    slip_length_m: Positive | None = None
    glide_factor: Annotated[float, Field(ge=1, allow_inf_nan=False)] | None = None
    contact: Literal["two-sided"] = "two-sided"


class NetTable(_Table):
    """``[net]``."""

    kind: Literal["cable"] = "cable"
    inclination_deg: Annotated[float, Field(ge=0, lt=90)] = 30.0
    height_m: Positive | None = None
    stiffness_kN_per_m: Positive
    slack: Annotated[float, Field(ge=0, le=0.5)] = 0.0
    friction_deg: Annotated[float, Field(ge=0, le=60)]


class GravityTable(_Table):
    """``[gravity]``."""

    mode: GravityMode = "full"


class SolveTable(_Table):
    """``[solve]``; start and horizon matter for histories only."""

    method: Literal["steady"] = "steady"
    accuracy: Annotated[float, Field(ge=1e-4, le=0.1)] = 0.005
    start: Literal["straight", "sagged"] = "sagged"
    horizon_days: Positive = 30.0


class SceneFile(_Table):
    """A whole scene file."""

    slope: SlopeTable
    snow: SnowTable
    ground: GroundTable = GroundTable()
    net: NetTable
    gravity: GravityTable = GravityTable()
    solve: SolveTable = SolveTable()


def read_scene(path: Path) -> tuple[Scene, SolverSettings]:
    """Scene and settings from a TOML file.

    Raises
    ------
    SceneFileError
        With every fault of the file: key, value, what is accepted.
    """
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise SceneFileError(f"{path}: cannot be read as TOML: {error}") from None
    try:
        return build_scene(SceneFile.model_validate(tables))
    except ValidationError as error:
        lines = [_describe(fault) for fault in error.errors()]
        raise SceneFileError("\n".join(f"{path}: {line}" for line in lines)) from None
    except ModelError as error:
        raise SceneFileError(f"{path}: {error}") from None


def build_scene(file: SceneFile) -> tuple[Scene, SolverSettings]:
    """Scene and settings in SI units."""
    slope = math.radians(file.slope.angle_deg)
    thickness = _thickness(file.snow, slope)
    if file.snow.creep_law not in CREEP_LAWS:
        known = ", ".join(CREEP_LAWS)
        raise ModelError(f"snow.creep_law = {file.snow.creep_law!r}: known are {known}")
    scene = Scene(
        snowpack=Snowpack(
            slope_angle=slope,
            thickness=thickness,
            upslope_length=file.snow.upslope_length_m,
            density=file.snow.density_kg_m3,
            gravity=file.gravity.mode,
        ),
        ground=_ground(file.ground, thickness),
        net=Net(
            height_normal=file.net.height_m or thickness,
            inclination=math.radians(file.net.inclination_deg),
            stiffness_per_m=newton_from_kilonewton(file.net.stiffness_kN_per_m),
            slack=file.net.slack,
            friction_angle=math.radians(file.net.friction_deg),
        ),
        creep_law=CREEP_LAWS[file.snow.creep_law],
    )
    return scene, SolverSettings(accuracy=file.solve.accuracy)


def write_solution_document(
    solution: Solution | FailedSolution, settings: SolverSettings, wall_s: float
) -> dict[str, Any]:
    """Solution as plain values in the form ``netdesign.solution/1``."""
    if isinstance(solution, FailedSolution):
        return {
            "schema": "netdesign.solution/1",
            "outcome": solution.outcome.value,
            "reason": solution.reason,
        }
    balance, cost = solution.balance, solution.cost
    return {
        "schema": "netdesign.solution/1",
        "outcome": solution.outcome.value,
        "method": solution.method,
        "anchor_forces": {
            "foot": _write_pull(solution.foot),
            "head": _write_pull(solution.head),
        },
        "wall": None,
        "tension_kN_per_m": {
            "foot": kilonewton_from_newton(solution.foot.size),
            "head": kilonewton_from_newton(solution.head.size),
            "min": kilonewton_from_newton(solution.tension_min),
            "max": kilonewton_from_newton(solution.tension_max),
        },
        "sag_m": solution.sag,
        "balance": {
            "weight_along_slope_kN_per_m": kilonewton_from_newton(
                balance.weight_along_slope
            ),
            "relative_residual": balance.relative_residual,
            "friction_excess": balance.friction_excess,
            "suction_share": balance.suction_share,
            "ground_tension_share": balance.ground_tension_share,
        },
        "nodes": [
            {
                "x_m": float(x),
                "y_m": float(y),
                "force_x_kN_per_m": kilonewton_from_newton(float(force_x)),
                "force_y_kN_per_m": kilonewton_from_newton(float(force_y)),
                "sliding": bool(slides),
            }
            for (x, y), (force_x, force_y), slides in zip(
                solution.net_curve.T,
                solution.net_forces.T,
                solution.net_slides,
                strict=False,  # a free end above the snow carries no nodal force
            )
        ],
        "history": None,
        "cost": {
            "wall_s": wall_s,
            "linear_solves": cost.linear_solves,
            "rounds": cost.rounds,
            "elements": cost.elements,
            "degrees_of_freedom": cost.degrees_of_freedom,
        },
        "provenance": {
            "version": __version__,
            "creep_law": solution.scene.creep_law.name,
            "settings": {
                "accuracy": settings.accuracy,
                "stress_tolerance": settings.stress_tolerance,
                "shape_tolerance": settings.shape_tolerance,
                "balance_tolerance": settings.balance_tolerance,
            },
        },
    }


def _thickness(snow: SnowTable, slope: float) -> float:
    if (snow.thickness_m is None) == (snow.height_vertical_m is None):
        raise ModelError(
            "snow.thickness_m and snow.height_vertical_m: give exactly one of them"
        )
    if snow.thickness_m is not None:
        return snow.thickness_m
    return compute_thickness(snow.height_vertical_m or 0.0, slope)


def _ground(ground: GroundTable, thickness: float) -> GroundLaw:
    slip, glide = ground.slip_length_m, ground.glide_factor
    if ground.law != "sliding":
        if slip is not None or glide is not None:
            raise ModelError(
                "ground.slip_length_m and ground.glide_factor belong to a sliding "
                f"ground; ground.law is {ground.law!r}"
            )
        return GroundLaw(kind=ground.law)
    if (slip is None) == (glide is None):
        raise ModelError(
            "ground.slip_length_m and ground.glide_factor: a sliding ground needs "
            "exactly one of them"
        )
    if slip is not None:
        return GroundLaw(kind="sliding", slip_length=slip)
    return build_ground_from_glide_factor(glide or 1.0, thickness)


def _describe(fault: Any) -> str:
    place = ".".join(str(part) for part in fault["loc"]) or "file"
    value = fault.get("input")
    shown = f" = {value!r}" if isinstance(value, (str, int, float)) else ""
    return f"{place}{shown}: {fault['msg']}"


def _write_pull(pull: EndPull) -> dict[str, float]:
    return {
        "x_kN_per_m": kilonewton_from_newton(pull.x),
        "y_kN_per_m": kilonewton_from_newton(pull.y),
        "size_kN_per_m": kilonewton_from_newton(pull.size),
        "error_kN_per_m": kilonewton_from_newton(pull.error),
    }
