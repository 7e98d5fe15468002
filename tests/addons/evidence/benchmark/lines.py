"""Lines through the space of scenes: forces may not jump by more than their errors.

A line is a random scene in which one quantity goes through its whole range. Two
meshes that agree by accident state an error that is too small; on a line that shows
as a jump between neighbours, wherever on the line it happens. A jump stays as large
where it is closed in on; a bend, as where the creep law changes its branch, does not.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from netdesign.addons.evidence.benchmark.precision import solve_fine
from netdesign.addons.evidence.benchmark.scenes import (
    DENSITY_KG_M3,
    FRICTION_DEG,
    INCLINATION_DEG,
    SLACK,
    SLIP_LENGTH_RATIO,
    SLOPE_DEG,
    STIFFNESS_KN_PER_M,
    THICKNESS_M,
    UPSLOPE_LENGTH_M,
    Tables,
    build_tables,
    draw_scene,
)
from netdesign.addons.evidence.measurements import spread
from netdesign.addons.evidence.scene import solve
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError, SolveError
from netdesign.snow.mesh import MeshSize

Row = dict[str, Any]
Done = Callable[[Row], None] | None

POINTS = 200
TRUTHS = 5  # points of a line that are held against a finer mesh
ENDS = ("foot", "head")
_BISECTIONS = 5  # of the gap in which a pull seems to jump
_OWN_SCENES = 1000  # random scenes that are a line's own

# Truths: finer than any level in every direction, so that all have the same one.
_TRUE_LEVELS = (
    MeshSize(
        net_spacing=0.2, corner=1e-4, sectors=8, head_sectors=4, upslope_spacing=0.6
    ),
    MeshSize(
        net_spacing=0.04, corner=1e-4, sectors=24, head_sectors=16, upslope_spacing=0.2
    ),
)


@dataclass(frozen=True, slots=True)
class Parameter:
    """A quantity that a line goes through: its range, and how a scene takes it."""

    name: str
    bounds: tuple[float, float]
    change: Callable[[Tables, float], None]
    is_log: bool = False

    def list_values(self, count: int) -> Floats:
        """Values from one end of the range to the other, shape (count,)."""
        space = np.geomspace if self.is_log else np.linspace
        return np.asarray(space(*self.bounds, count))


def set_thickness(tables: Tables, value: float) -> None:
    """Set the thickness, layers in proportion; the net stays at least as high."""
    snow, net = tables["snow"], tables["net"]
    ratio = value / snow["thickness_m"]
    for layer in snow.get("layers", []):
        layer["thickness_m"] *= ratio
    net["height_m"] = max(value, net["height_m"] * ratio)
    snow["thickness_m"] = value
    if layers := snow.get("layers"):
        rest = sum(layer["thickness_m"] for layer in layers[:-1])
        layers[-1]["thickness_m"] = value - rest


def set_density(tables: Tables, value: float) -> None:
    """Set the density of uniform snow, or of the bottom layer."""
    snow = tables["snow"]
    (snow["layers"][0] if "layers" in snow else snow)["density_kg_m3"] = value


def set_slip(tables: Tables, value: float) -> None:
    """Set the slip length over the thickness; the ground becomes a sliding one."""
    length = value * tables["snow"]["thickness_m"]
    tables["ground"] |= {"law": "sliding", "slip_length_m": length}


def setter(table: str, key: str) -> Callable[[Tables, float], None]:
    """Change of one value of a scene's tables."""
    return lambda tables, value: tables[table].update({key: value})


PARAMETERS = (
    Parameter("friction angle", FRICTION_DEG, setter("net", "friction_deg")),
    Parameter("slope angle", SLOPE_DEG, setter("slope", "angle_deg")),
    Parameter("snow thickness", THICKNESS_M, set_thickness),
    Parameter("upslope length", UPSLOPE_LENGTH_M, setter("snow", "upslope_length_m")),
    Parameter("density", DENSITY_KG_M3, set_density),
    Parameter("net inclination", INCLINATION_DEG, setter("net", "inclination_deg")),
    Parameter(
        "net stiffness", STIFFNESS_KN_PER_M, setter("net", "stiffness_kN_per_m"), True
    ),
    Parameter("slack", SLACK, setter("net", "slack")),
    Parameter("slip length", SLIP_LENGTH_RATIO, set_slip, True),
)


@dataclass(frozen=True, slots=True)
class Point:
    """One solved scene of a line: pulls on foot and head, and their errors [N/m]."""

    place: int
    pulls: tuple[float, float]
    errors: tuple[float, float]


def study_lines(
    count: int, seed: int, *, accuracy: float, jobs: int = 1, on_done: Done = None
) -> list[Row]:
    """Lines 0 to ``count`` - 1 of a seed; each goes through the next parameter."""
    work = partial(study_line, seed=seed, accuracy=accuracy)
    return spread(work, range(count), jobs=jobs, chunk=1, on_done=on_done)


def study_line(number: int, *, seed: int, accuracy: float, points: int = POINTS) -> Row:
    """Follow one line, and solve some of its points on meshes finer than any level.

    The largest jump is over the stated errors of both neighbours; ``ratios`` are true
    over stated errors, and what has no finer solution is ``missing``.
    """
    parameter = PARAMETERS[number % len(PARAMETERS)]
    base, values = draw_base(number, seed), parameter.list_values(points)
    settings = SolverSettings(accuracy=accuracy)
    solved, steps = follow(base, parameter, values, settings)
    rng = np.random.default_rng([seed, number, points])
    drawn = rng.choice(points, min(TRUTHS, points), replace=False).tolist()
    checked = set(drawn) & {point.place for point in solved}
    ratios = []
    for place in checked:
        with suppress(SolveError):
            ratios.append(compare(build(base, parameter, values[place]), settings))
    return {
        "number": number,
        "parameter": parameter.name,
        "solved": len(solved),
        "jumps": [one for one in steps if one["over_stated"] > 1.0],
        "largest_jump": max((one["over_stated"] for one in steps), default=0.0),
        "ratios": ratios,
        "missing": len(checked) - len(ratios),
    }


def draw_base(number: int, seed: int) -> Tables:
    """First random scene of a line's own sequence that can be built mid-range."""
    parameter = PARAMETERS[number % len(PARAMETERS)]
    middle = parameter.list_values(3)[1]
    first = _OWN_SCENES * number
    drawn = (draw_scene(seed, first + attempt) for attempt in range(_OWN_SCENES))
    return next(base for base in drawn if can_be_built(base, parameter, middle))


def can_be_built(base: Tables, parameter: Parameter, value: float) -> bool:
    """The model accepts the scene of a value."""
    try:
        return bool(build(base, parameter, value))
    except ModelError:
        return False


def build(base: Tables, parameter: Parameter, value: float) -> Scene:
    """Scene of a line with this value of its quantity."""
    tables = copy.deepcopy(base)
    parameter.change(tables, float(value))
    return build_tables(tables)


def follow(
    base: Tables, parameter: Parameter, values: Floats, settings: SolverSettings
) -> tuple[list[Point], list[Row]]:
    """Solved points of a line, and its steps; what seems to jump is closed in on."""

    def solve_at(value: float, place: int = 0) -> Point:
        return record(place, solve(build(base, parameter, value), settings))

    solved = []
    for place, value in enumerate(values):
        try:
            solved.append(solve_at(value, place))
        except (ModelError, SolveError):
            continue  # what the model excludes says nothing
    steps = find_jumps(solved)
    for number, one in enumerate(steps):
        if one["over_stated"] > 1.0:
            steps[number] = close_in(one, values[one["place"] :][:2], solve_at)
    return solved, steps


def find_jumps(points: Sequence[Point]) -> list[Row]:
    """Every step of a line against its neighbours' mean, over the stated errors.

    A step from point to point may differ from the mean of the steps before and after
    it by the errors of its two ends. Only four solved points in a row say something.
    """
    found = []
    for four in zip(points, points[1:], points[2:], points[3:], strict=False):
        if four[3].place - four[0].place != 3:
            continue
        for end, name in enumerate(ENDS):
            before, here, there, after = (point.pulls[end] for point in four)
            off = abs(there - here - ((here - before) + (after - there)) / 2.0)
            allowed = four[1].errors[end] + four[2].errors[end]
            jump = {"place": four[1].place, "end": name, "over_stated": off / allowed}
            found.append(jump)
    return found


def close_in(jump: Row, gap: Floats, solve_at: Callable[[float], Point]) -> Row:
    """Jump after its gap, two values, was bisected towards the larger step.

    Where a scene within the gap gives no result, the jump stays as it was.
    """
    end = ENDS.index(jump["end"])

    def step(pair: Sequence[tuple[float, Point]]) -> float:
        return abs(pair[1][1].pulls[end] - pair[0][1].pulls[end])

    try:
        ends = [(value, solve_at(value)) for value in map(float, gap)]
        for _ in range(_BISECTIONS):
            middle = (ends[0][0] + ends[1][0]) / 2.0
            between = (middle, solve_at(middle))
            ends = max(([ends[0], between], [between, ends[1]]), key=step)
    except (ModelError, SolveError):
        return jump
    errors = sum(point.errors[end] for _, point in ends)
    return jump | {"over_stated": step(ends) / errors}


def record(place: int, solution: Solution) -> Point:
    """Point of a solution."""
    foot, head = solution.foot, solution.head
    return Point(place, (foot.size, head.size), (foot.error, head.error))


def compare(scene: Scene, settings: SolverSettings) -> float:
    """Larger ratio of true to stated error of the two ends, by the finest meshes."""
    solution = solve(scene, settings)
    fine = replace(settings, levels=_TRUE_LEVELS, balance_tolerance=1e-6)
    true = solve_fine(scene, fine).compare_ends(solution)
    ends = (solution.foot, solution.head)
    return max(t * p.size / p.error for t, p in zip(true, ends, strict=True))
