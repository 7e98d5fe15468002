"""Lines through the space of scenes: forces may not jump by more than their errors.

A line is a random scene in which one quantity goes through its whole range. Two
meshes that agree by accident state an error that is too small; on a line that shows
as a jump between neighbours, wherever on the line it happens. A jump stays as large
where it is closed in on; a bend, as where the creep law changes its branch, does not.
"""

from __future__ import annotations

import copy
import itertools
import math
from collections.abc import Callable, Container, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.evidence.benchmark.scenes import (
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
from netdesign.evidence.benchmark.truth import solve_fine
from netdesign.evidence.runner import share, spread
from netdesign.evidence.scene import solve
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError, SolveError
from netdesign.snow.mesh import MeshSize
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message

LINES_SCHEMA = "netdesign.lines/1"
POINTS = 200
TRUTHS = 5  # points of a line that are held against a finer mesh
LARGEST_OUTSIDE = 0.05  # share of the true errors beyond the stated ones
LARGEST_EXCESS = 1.5  # of a true error over the stated one
ENDS = ("foot", "head")
_BISECTIONS = 5  # of the gap in which a pull seems to jump


# Truths: finer than any level in every direction, so that all have the same one.
_TRUE_SIZE = MeshSize(
    net_spacing=0.04, corner=1e-4, sectors=24, head_sectors=16, upslope_spacing=0.2
)
# Random scenes that are a line's own.
_MOST_ATTEMPTS = 1000
_TRUE_START = MeshSize(
    net_spacing=0.2, corner=1e-4, sectors=8, head_sectors=4, upslope_spacing=0.6
)


def _set_thickness(tables: Tables, value: float) -> None:
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


def _set_density(tables: Tables, value: float) -> None:
    """Set the density of uniform snow, or of the bottom layer."""
    snow = tables["snow"]
    (snow["layers"][0] if "layers" in snow else snow)["density_kg_m3"] = value


def _set_slip(tables: Tables, value: float) -> None:
    """Set the slip length over the thickness; the ground becomes a sliding one."""
    length = value * tables["snow"]["thickness_m"]
    tables["ground"] |= {"law": "sliding", "slip_length_m": length}


def _set(table: str, key: str) -> Callable[[Tables, float], None]:
    def change(tables: Tables, value: float) -> None:
        tables[table][key] = value

    return change


@dataclass(frozen=True, slots=True)
class Parameter:
    """A quantity that a line goes through: its range, and how a scene takes it."""

    name: str
    bounds: tuple[float, float]
    change: Callable[[Tables, float], None]
    is_log: bool = False

    def list_values(self, count: int) -> Floats:
        """Values from one end of the range to the other, shape (count,)."""
        return np.asarray(
            (np.geomspace if self.is_log else np.linspace)(*self.bounds, count)
        )


PARAMETERS = (
    Parameter("friction angle", FRICTION_DEG, _set("net", "friction_deg")),
    Parameter("slope angle", SLOPE_DEG, _set("slope", "angle_deg")),
    Parameter("snow thickness", THICKNESS_M, _set_thickness),
    Parameter("upslope length", UPSLOPE_LENGTH_M, _set("snow", "upslope_length_m")),
    Parameter("density", DENSITY_KG_M3, _set_density),
    Parameter("net inclination", INCLINATION_DEG, _set("net", "inclination_deg")),
    Parameter(
        "net stiffness", STIFFNESS_KN_PER_M, _set("net", "stiffness_kN_per_m"), True
    ),
    Parameter("slack", SLACK, _set("net", "slack")),
    Parameter("slip length", SLIP_LENGTH_RATIO, _set_slip, True),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Point:
    """One solved scene of a line: sizes of foot and head pull and their errors [N/m].

    ``true_over_stated`` is the larger ratio of true to stated error of the two ends;
    None where no truth was asked for.
    """

    place: int
    pulls: tuple[float, float]
    errors: tuple[float, float]
    elements: int
    true_over_stated: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """Result of a line.

    Attributes
    ----------
    number : int
        Of its random scene.
    parameter : str
        Which quantity it goes through.
    solved, refused : int
        Points.
    jumps : list of dict
        Places where a pull jumps by more than the stated errors.
    bends : int
        Places where it only seemed to.
    largest_jump : float
        Over the stated errors of both neighbours [-].
    ratios : list of float
        True over stated errors.
    missing : list of Message or str
        Why a truth gave nothing to compare with.
    reasons : list of Message or str
        Of refusals, each once.
    """

    number: int
    parameter: str
    solved: int
    refused: int
    jumps: list[dict[str, Any]]
    bends: int
    largest_jump: float
    ratios: list[float]
    missing: list[Message | str]
    reasons: list[Message | str]


def study_lines(
    count: int,
    seed: int,
    accuracy: float,
    *,
    points: int = POINTS,
    jobs: int = 1,
    on_done: Callable[[Line], None] | None = None,
) -> list[Line]:
    """Lines 0 to ``count`` - 1 of a seed; each goes through the next parameter.

    Verified by
    -----------
    tests/evidence/benchmark/test_lines.py
    """
    work = partial(follow_line, seed=seed, accuracy=accuracy, points=points)
    return spread(work, range(count), jobs=jobs, on_done=on_done)


def follow_line(number: int, *, seed: int, accuracy: float, points: int) -> Line:
    """Solve one line, and some of its points on a finer mesh."""
    parameter = PARAMETERS[number % len(PARAMETERS)]
    base = _draw_base(number, seed, parameter)
    values = parameter.list_values(points)
    settings = SolverSettings(accuracy=accuracy)
    scenes = _list_scenes(base, parameter, values)
    checked = _choose_truths(seed, number, points)
    solved, missing, reasons = _solve_points(scenes, checked, settings)
    steps = find_jumps(solved)
    seeming = [one for one in steps if one["over_stated"] > 1.0]

    def solve(value: float) -> Point:
        solution = _solve(_build(base, parameter, value), settings)
        return _record(0, solution, None)

    jumps = [close_in(one, values[one["place"] :][:2], solve) for one in seeming]
    small = [one for one in steps if one not in seeming]
    return Line(
        number=number,
        parameter=parameter.name,
        solved=len(solved),
        refused=points - len(solved),
        jumps=[one for one in jumps if one["over_stated"] > 1.0],
        bends=sum(one["over_stated"] <= 1.0 for one in jumps),
        largest_jump=max((one["over_stated"] for one in small + jumps), default=0.0),
        ratios=[p.true_over_stated for p in solved if p.true_over_stated is not None],
        missing=missing,
        reasons=reasons,
    )


def _solve_points(
    scenes: Sequence[Scene | ModelError],
    checked: Container[int],
    settings: SolverSettings,
) -> tuple[list[Point], list[Message | str], list[Message | str]]:
    """Solved points, reasons why a truth is missing, reasons of refusals, each once."""
    solved: list[Point] = []
    missing: list[Message | str] = []
    reasons: dict[str, Message | str] = {}
    for place, scene in enumerate(scenes):
        try:
            solution = _solve(scene, settings)
        except (ModelError, SolveError) as error:
            reasons[str(error)] = error.message
            continue
        assert isinstance(scene, Scene)
        ratio = None
        if place in checked:
            try:
                ratio = _compare(scene, solution, settings)
            except SolveError as error:
                missing.append(error.message)
        solved.append(_record(place, solution, ratio))
    return solved, missing, list(reasons.values())


def find_jumps(points: Sequence[Point]) -> list[dict[str, Any]]:
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
            step = there - here
            off = abs(step - ((here - before) + (after - there)) / 2.0)
            allowed = four[1].errors[end] + four[2].errors[end]
            found.append(
                {
                    "place": four[1].place,
                    "end": name,
                    "relative": off / here,
                    "over_stated": off / allowed,
                    "elements": [four[1].elements, four[2].elements],
                }
            )
    return found


def close_in(
    jump: dict[str, Any], gap: Floats, solve: Callable[[float], Point]
) -> dict[str, Any]:
    """Jump after its gap, two values, was bisected towards the larger step.

    Where a scene within the gap gives no result, the jump stays as it was.
    """
    end = ENDS.index(jump["end"])
    try:
        ends = [(value, solve(value)) for value in map(float, gap)]
        for _ in range(_BISECTIONS):
            middle = (ends[0][0] + ends[1][0]) / 2.0
            between = (middle, solve(middle))
            ends = max(
                ([ends[0], between], [between, ends[1]]),
                key=lambda pair: _step_between(pair[0][1], pair[1][1], end),
            )
    except (ModelError, SolveError):
        return jump
    here, there = (point for _, point in ends)
    step = _step_between(here, there, end)
    return jump | {
        "relative": step / here.pulls[end],
        "over_stated": step / (here.errors[end] + there.errors[end]),
        "elements": [here.elements, there.elements],
    }


def _solve(scene: Scene | ModelError, settings: SolverSettings) -> Solution:
    if isinstance(scene, ModelError):
        raise scene
    return solve(scene, settings)


def _step_between(here: Point, there: Point, end: int) -> float:
    return abs(there.pulls[end] - here.pulls[end])


def _list_scenes(
    base: Tables, parameter: Parameter, values: Floats
) -> list[Scene | ModelError]:
    """Scenes of a line; those that the model excludes beforehand as its error."""
    return [_build(base, parameter, float(value)) for value in values]


def _draw_base(number: int, seed: int, parameter: Parameter) -> Tables:
    """First random scene of a line's own sequence that can be built mid-range."""
    middle = float(parameter.list_values(3)[1])
    for attempt in itertools.count():
        base = draw_scene(seed, _MOST_ATTEMPTS * number + attempt)
        if isinstance(_build(base, parameter, middle), Scene):
            return base
    raise AssertionError("no scene can be built")


def _build(base: Tables, parameter: Parameter, value: float) -> Scene | ModelError:
    tables = copy.deepcopy(base)
    parameter.change(tables, value)
    try:
        return build_tables(tables)
    except ModelError as error:
        return error


def _choose_truths(seed: int, number: int, points: int) -> list[int]:
    rng = np.random.default_rng([seed, number, points])
    return sorted(rng.choice(points, min(TRUTHS, points), replace=False).tolist())


def _compare(scene: Scene, solution: Solution, settings: SolverSettings) -> float:
    fine = replace(settings, levels=(_TRUE_START, _TRUE_SIZE), balance_tolerance=1e-6)
    truth = solve_fine(scene, fine)
    true = truth.compare_ends(solution)
    ends = (solution.foot, solution.head)
    return max(t * p.size / p.error for t, p in zip(true, ends, strict=True))


def _record(place: int, solution: Solution, ratio: float | None) -> Point:
    ends = (solution.foot, solution.head)
    return Point(
        place=place,
        pulls=(ends[0].size, ends[1].size),
        errors=(ends[0].error, ends[1].error),
        elements=solution.cost.elements,
        true_over_stated=ratio,
    )


def write_lines(
    lines: Sequence[Line],
    seed: int,
    accuracy: float,
    language: Language = "en",
    *,
    points: int = POINTS,
) -> dict[str, Any]:
    """Plain values in the form ``netdesign.lines/1``; reasons in a language.

    A point without a true error counts as outside the stated one.
    """
    ratios = [ratio for line in lines for ratio in line.ratios]
    missing = [True for line in lines for _ in line.missing]
    outside = share([*(ratio > 1.0 for ratio in ratios), *missing])
    jumps = sum(len(line.jumps) for line in lines)
    return {
        "schema": LINES_SCHEMA,
        "lines": len(lines),
        "points": points,
        "seed": seed,
        "accuracy": accuracy,
        "solved": sum(line.solved for line in lines),
        "refused": sum(line.refused for line in lines),
        "compared": len(ratios),
        "without_truth": len(missing),
        "jumps": jumps,
        "bends": sum(line.bends for line in lines),
        "largest_jump": max((line.largest_jump for line in lines), default=None),
        "share_outside": outside,
        "largest_true_over_stated": max(ratios, default=None),
        "pass": (
            jumps == 0
            and outside is not None
            and outside <= LARGEST_OUTSIDE
            and max(ratios, default=math.inf) <= LARGEST_EXCESS
            and not missing  # what it would have shown nobody knows
        ),
        "of_lines": [_write_line(line, language) for line in lines],
    }


def _write_line(line: Line, language: Language) -> dict[str, Any]:
    def tell(reasons: list[Message | str]) -> list[Message | str]:
        return [render(reason, language) for reason in reasons]

    told = replace(line, missing=tell(line.missing), reasons=tell(line.reasons))
    return asdict(told)
