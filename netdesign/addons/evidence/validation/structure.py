"""Measured structures of ``measured.toml``, and the model's forces on them."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import AliasChoices, Field, TypeAdapter

from netdesign.addons.evidence.scene import build_scene
from netdesign.coupling.scene import SolverSettings
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import build_task, run_cases
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError
from netdesign.panel.inputs import Panel, Rope
from netdesign.snow.ground import (
    build_ground_from_glide_factor,
)
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import Member
from netdesign.words.message import say

Mark = Literal["read", "assumed", "unknown", "measured"]
_Number = Annotated[float, Field(ge=0, allow_inf_nan=False, strict=True)]


def _named(*names: str) -> Any:
    """Field under one of several names in the file."""
    return Field(validation_alias=AliasChoices(*names))


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """Knowledge of one input: a value, or a range with its reason."""

    __pydantic_config__: ClassVar = {"extra": "forbid"}
    low: Annotated[_Number, _named("low", "value")]
    high: Annotated[_Number, _named("high", "value")]
    mark: Mark
    reason: str = ""

    def at(self, share: float) -> float:
        """Value at a share of the range, 0 to 1."""
        return self.low + share * (self.high - self.low)


@dataclass(frozen=True, slots=True, kw_only=True)
class Measurement:
    """One measured force, and the members of the model that it may be."""

    __pydantic_config__: ClassVar = {"extra": "forbid"}
    name: str
    members: tuple[str, ...]
    value: Annotated[_Number, _named("value_kN")]  # [kN]
    mark: Mark = "measured"
    uncertainty: Annotated[_Number, _named("uncertainty_kN")] = 0.0
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Structure:
    """One measured structure.

    Attributes
    ----------
    id, title, source, note : str
        What it is, and where that stands.
    measured : tuple of Measurement
        Forces.
    inputs : mapping of str to Span
        By the names of the file.
    open : tuple of str
        What is not known, and the public document that would close it.
    """

    __pydantic_config__: ClassVar = {"extra": "forbid"}
    id: str
    title: str
    source: str
    measured: tuple[Measurement, ...]
    inputs: Mapping[str, Span]
    note: str = ""
    open: tuple[str, ...] = ()


@lru_cache(maxsize=1)
def load_structures() -> tuple[Structure, ...]:
    """Measured structures that come with the program."""
    text = files(__package__).joinpath("measured.toml").read_text(encoding="utf-8")
    reader = TypeAdapter(tuple[Structure, ...])
    return reader.validate_python(tuple(tomllib.loads(text)["structure"]))


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
        Least and largest [kN].
    middle : tuple of float
        Between which four of five cases lie.
    share_below : float
        Part of the cases below the measured value [-].
    """

    member: str
    low: float
    high: float
    middle: tuple[float, float]
    share_below: float

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
        """The measured value lies in a band."""
        return any(band.place(self.measured) == "inside" for band in self.bands)

    @property
    def is_in_the_middle(self) -> bool:
        """The measured value lies among the middle four fifths of a band's cases."""
        value, uncertainty = self.measured.value, self.measured.uncertainty
        return any(
            band.middle[0] <= value + uncertainty
            and value - uncertainty <= band.middle[1]
            for band in self.bands
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Validation:
    """Structure, and its measured forces beside the bands of the model.

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
class CaseForces:
    """Forces of a case [kN] by member, or why there are none."""

    values: dict[str, float]
    reason: str = ""


def validate_structure(structure: Structure, samples: int = SAMPLES) -> Validation:
    """Solve a structure over its ranges, and place what was measured in them.

    Parameters
    ----------
    structure : Structure
        Values and ranges of its inputs.
    samples : int
        Number of cases.

    Raises
    ------
    ModelError
        If no case has a result.
    """
    points = _draw(structure, samples)
    forces = [_solve(point) for point in points]
    good = [case for case in forces if case.values]
    if not good:
        raise ModelError(say("measured.none_solved", name=structure.id[:200]))
    return Validation(
        structure=structure,
        comparisons=tuple(
            Comparison(
                measured=measured,
                bands=tuple(
                    _find_band(member, measured, good) for member in measured.members
                ),
            )
            for measured in structure.measured
        ),
        solved=len(good),
        failed=len(forces) - len(good),
        reasons=tuple(dict.fromkeys(case.reason for case in forces if case.reason)),
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


def _solve(point: dict[str, float]) -> CaseForces:
    try:
        return _solve_net(point)
    except ModelError as error:
        return CaseForces(values={}, reason=str(error))


def _solve_net(point: dict[str, float]) -> CaseForces:
    spacing, height = point["post_spacing_m"], point["net_height_m"]
    layout = SupportLayout(
        post_spacing=spacing,
        uphill_anchor_distance=point["uphill_anchor_ratio"] * height,
        downhill_anchor_distance=height,
    )
    panels: tuple[Panel, ...] = ()
    if "rope_sag" in point:
        rope = Rope(stiffness=point["rope_stiffness_kN"] * 1e3, sag=point["rope_sag"])
        panels = (Panel(post_spacing=spacing, lower=rope, upper=rope, cut="upper"),)
    case = Case(
        density=point["density_kg_m3"],
        friction_angle=math.radians(point["friction_deg"]),
        inclination=math.radians(point["inclination_deg"]),
    )
    thickness = height * point["filled"]
    scene = build_scene(
        (thickness, point["density_kg_m3"]),
        slope=point["slope_deg"],
        length=point["upslope_length_m"],
        ground=build_ground_from_glide_factor(point["glide_factor"], thickness),
        lean=point["inclination_deg"],
        friction=point["friction_deg"],
        height=height,
        stiffness=point["stiffness_kN_per_m"] * 1e3,
        slack=point["slack"],
    )
    task = build_task(case, lambda _: scene, layout, _SETTINGS, panels)
    (result,) = run_cases([task])
    if not result.is_converged:
        return CaseForces(values={}, reason=str(result.reason))
    bands = result.member_forces
    values = {name: 0.0 for name in map(str, Member)} | {
        name: band.value / 1e3 for name, band in bands.items()
    }
    return CaseForces(values=values)


def _find_band(
    member: str, measured: Measurement, forces: Sequence[CaseForces]
) -> MemberBand:
    solved = [case.values[member] for case in forces if member in case.values]
    if not solved:
        raise ModelError(say("measured.no_member", member=member[:200]))
    values: Floats = np.array(solved)
    low, high = np.percentile(values, _MIDDLE)
    return MemberBand(
        member=member,
        low=float(values.min()),
        high=float(values.max()),
        middle=(float(low), float(high)),
        share_below=float((values < measured.value).mean()),
    )
