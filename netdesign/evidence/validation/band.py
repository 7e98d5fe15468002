"""Forces of the model over what is not known of a measured structure."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import build_task, run_cases
from netdesign.evidence.scene import build_scene, solve_wall
from netdesign.evidence.validation.structure import (
    ALONG_SLOPE,
    Measurement,
    Span,
    Structure,
)
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError, SolveError
from netdesign.panel.inputs import Panel, Rope
from netdesign.snow.ground import build_ground_from_glide_factor
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import Member
from netdesign.words.message import say

SAMPLES = 120
_SEED = 20_261_122  # of the sample, so that the page is the same each time
_SETTINGS = SolverSettings(accuracy=0.02)
_MIDDLE = (10.0, 90.0)  # per cent of the cases, the band in which most of them lie
Place = Literal["below", "inside", "above"]


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberBand:
    """Force of one member over all solved cases.

    Attributes
    ----------
    member : str
        Its key.
    low, high : float
        Least and largest [kN], or [kN/m] of a wall.
    middle : tuple of float
        Between which four of five cases lie.
    share_below : float
        Part of the cases below the measured value [-].
    numerical_error : float
        Largest numerical error of a case, over its largest force [-].
    """

    member: str
    low: float
    high: float
    middle: tuple[float, float]
    share_below: float
    numerical_error: float

    def place(self, measured: Measurement) -> Place:
        """Place of the measured value, with its own uncertainty."""
        if measured.value - measured.uncertainty > self.high:
            return "above"
        return "below" if measured.value + measured.uncertainty < self.low else "inside"


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """One measured value beside the bands of the members that it may be."""

    measured: Measurement
    bands: tuple[MemberBand, ...]

    @property
    def is_inside(self) -> bool:
        """The measured value lies in the band of one of them."""
        return any(band.place(self.measured) == "inside" for band in self.bands)

    @property
    def is_in_the_middle(self) -> bool:
        """It lies where four of five cases do, of one of them."""
        value, uncertainty = self.measured.value, self.measured.uncertainty
        return any(
            band.middle[0] <= value + uncertainty
            and value - uncertainty <= band.middle[1]
            for band in self.bands
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Validation:
    """Structure with its comparisons; of one with all inputs known a misfit.

    Attributes
    ----------
    structure : Structure
        As given.
    comparisons : tuple of Comparison
        One for each measured force.
    solved, failed : int
        Cases.
    reasons : tuple of str
        Why some failed, each once.
    """

    structure: Structure
    comparisons: tuple[Comparison, ...]
    solved: int
    failed: int
    reasons: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class _Forces:
    """Forces of one case [kN], error over the largest, or why there are none."""

    values: dict[str, float]
    error: float = 0.0
    reason: str = ""


def validate_structure(structure: Structure, samples: int = SAMPLES) -> Validation:
    """Solve a structure over its ranges, and place what was measured in them.

    Parameters
    ----------
    structure : Structure
        What is known and what ranges.
    samples : int
        Cases of a structure with any range; one with none has one case.

    Raises
    ------
    ModelError
        If no case has a result.
    """
    points = _draw(structure, 1 if structure.is_known else samples)
    forces = [_solve(structure, point) for point in points]
    good = [one for one in forces if one.values]
    reasons = tuple(dict.fromkeys(one.reason for one in forces if one.reason))
    if not good:
        raise ModelError(say("measured.none_solved", name=structure.id[:200]))
    return Validation(
        structure=structure,
        comparisons=tuple(
            Comparison(
                measured=one,
                bands=tuple(_find_band(member, one, good) for member in one.members),
            )
            for one in structure.measured
        ),
        solved=len(good),
        failed=len(forces) - len(good),
        reasons=reasons,
    )


def _draw(structure: Structure, count: int) -> list[dict[str, float]]:
    """Latin hypercube over the ranges: each is cut in as many parts as cases."""
    names = list(structure.inputs)
    random = np.random.default_rng(_SEED)
    cells = np.array([random.permutation(count) for _ in names])
    shares = (cells + random.uniform(size=cells.shape)) / count
    spans: Sequence[Span] = list(structure.inputs.values())
    return [
        {
            name: span.at(share)
            for name, span, share in zip(names, spans, row, strict=True)
        }
        for row in shares.T
    ]


def _solve(structure: Structure, point: dict[str, float]) -> _Forces:
    try:
        if structure.kind == "wall":
            return _solve_wall(point)
        return _solve_net(point, has_ropes=structure.has_ropes)
    except ModelError as error:
        return _Forces(values={}, reason=str(error))
    except SolveError as failure:
        return _Forces(values={}, reason=str(failure.reason))


def _solve_wall(point: dict[str, float]) -> _Forces:
    friction = math.radians(point["friction_deg"])
    force = solve_wall(_build(point), _SETTINGS, friction_angle=friction).force
    return _Forces(
        values={ALONG_SLOPE: force.x / 1e3, "size": force.size / 1e3},
        error=force.error / force.size,
    )


def _solve_net(point: dict[str, float], *, has_ropes: bool) -> _Forces:
    spacing, height = point["post_spacing_m"], point["net_height_m"]
    layout = SupportLayout(
        post_spacing=spacing,
        uphill_anchor_distance=point["uphill_anchor_ratio"] * height,
        downhill_anchor_distance=height,
    )
    panels: tuple[Panel, ...] = ()
    if has_ropes:
        rope = Rope(stiffness=point["rope_stiffness_kN"] * 1e3, sag=point["rope_sag"])
        panels = (Panel(post_spacing=spacing, lower=rope, upper=rope, cut="upper"),)
    case = Case(
        density=point["density_kg_m3"],
        friction_angle=math.radians(point["friction_deg"]),
        inclination=math.radians(point["inclination_deg"]),
    )
    scene = _build(
        point,
        height=height,
        stiffness=point["stiffness_kN_per_m"] * 1e3,
        slack=point["slack"],
    )
    task = build_task(case, lambda _: scene, layout, _SETTINGS, panels)
    (result,) = run_cases([task])
    if not result.is_converged:
        return _Forces(values={}, reason=str(result.reason))
    bands = result.member_forces
    largest = max(band.value for band in bands.values())
    error = max((band.high - band.low) / 2.0 for band in bands.values())
    values = {name: 0.0 for name in map(str, Member)} | {
        name: band.value / 1e3 for name, band in bands.items()
    }
    return _Forces(values=values, error=error / largest)


def _build(point: dict[str, float], **net: Any) -> Scene:
    thickness = point["net_height_m"] * point["filled"]
    return build_scene(
        (thickness, point["density_kg_m3"]),
        slope=point["slope_deg"],
        length=point["upslope_length_m"],
        ground=build_ground_from_glide_factor(point["glide_factor"], thickness),
        lean=point["inclination_deg"],
        friction=point["friction_deg"],
        **net,
    )


def _find_band(
    member: str, measured: Measurement, forces: Sequence[_Forces]
) -> MemberBand:
    found = [one.values[member] for one in forces if member in one.values]
    if not found:
        raise ModelError(say("measured.no_member", member=member[:200]))
    values: Floats = np.array(found)
    low, high = np.percentile(values, _MIDDLE)
    return MemberBand(
        member=member,
        low=float(values.min()),
        high=float(values.max()),
        middle=(float(low), float(high)),
        share_below=float((values < measured.value).mean()),
        numerical_error=max(one.error for one in forces),
    )
