"""`netdesign validate`: measured structures beside the bands of the model, on a page.

``measured.toml`` has the structures.
"""

from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import AliasChoices, Field, TypeAdapter

from netdesign import __version__
from netdesign.addons.charts import draw_decades, draw_tiles
from netdesign.addons.evidence.measurements import (
    NUMBER_TEXTS,
    RANGES,
    TEXTS,
    tabulate,
)
from netdesign.addons.evidence.scene import build_scene
from netdesign.coupling.scene import SolverSettings
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import build_task, run_cases
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError
from netdesign.panel.inputs import Panel, Rope
from netdesign.report.blocks import Figure, Paragraph, Table, masthead, section
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    PALE,
    TEXT_PT,
    WIDTH,
    Chart,
    Frame,
    measure_words,
)
from netdesign.report.page import render_page
from netdesign.report.words import ENGLISH, show_member
from netdesign.snow.ground import (
    build_ground_from_glide_factor,
)
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import Member
from netdesign.words.catalogue import load_texts
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

    def judge(self, measured: Measurement) -> str:
        """That place, and the share of the cases below, in words."""
        share = 100.0 * self.share_below
        return ENGLISH(f"validation.{self.place(measured)}", share=share)


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


CaseForces = Mapping[str, float]  # of a case [kN], by member


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
    good = [case for case in forces if not isinstance(case, str)]
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
        reasons=tuple(dict.fromkeys(case for case in forces if isinstance(case, str))),
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


def _solve(point: Mapping[str, float]) -> CaseForces | str:
    """Forces of a case, or why there are none."""
    try:
        return _solve_net(point)
    except ModelError as error:
        return str(error)


def _solve_net(point: Mapping[str, float]) -> CaseForces:
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
    task = build_task(case, lambda _: scene, (layout,), _SETTINGS, panels)
    (result,) = run_cases([task])
    if not result.is_converged:
        raise ModelError(result.reason or result.outcome.message)
    return {name: 0.0 for name in map(str, Member)} | {
        name: band.value / 1e3 for name, band in result.member_forces.items()
    }


def _find_band(
    member: str, measured: Measurement, forces: Sequence[CaseForces]
) -> MemberBand:
    values: Floats = np.array([case[member] for case in forces if member in case])
    low, high = np.percentile(values, _MIDDLE)
    return MemberBand(
        member=member,
        low=float(values.min()),
        high=float(values.max()),
        middle=(float(low), float(high)),
        share_below=float((values < measured.value).mean()),
    )


_LINE = 13.0  # of a list [pt]
_BELOW = 32.0  # a list: its ticks, the name of its axis [pt]
_FEEBLE = 1.0  # least force of the axis [kN]: a slack guy has none


def draw_bands(validations: Sequence[Validation]) -> str:
    """Bands of the model and what was measured, one bar a member."""
    bars: list[tuple[str, MemberBand | None, float]] = []
    for validation in validations:
        bars.append((validation.structure.title, None, 0.0))
        bars += [
            (
                f"{pair.measured.name}: {name_validated(band.member)}",
                band,
                pair.measured.value,
            )
            for pair in validation.comparisons
            for band in pair.bands
        ]
    largest = max(value for _, band, x in bars if band for value in (band.high, x))
    left = max(measure_words(name, TEXT_PT) for name, band, _ in bars if band) + 10.0
    frame = Frame(
        left=left,
        top=2.0,
        width=WIDTH - left - 4.0,
        height=_LINE * len(bars),
        x_low=math.log10(_FEEBLE / 1.3),
        x_high=math.log10(1.3 * largest),
        y_low=len(bars),
        y_high=0.0,
    )
    chart = Chart(language="en")
    for place, (name, band, value) in enumerate(bars):
        y = frame.y(place + 0.5)
        if band is None:
            chart.text(2.0, y + TEXT_PT / 3, name, bold=True)
            continue
        chart.text(frame.left - 6.0, y + TEXT_PT / 3, name, anchor="end")
        _draw_bar(chart, frame, y, band, value)
    return _end(chart, frame)


def _draw_bar(
    chart: Chart, frame: Frame, y: float, band: MemberBand, value: float
) -> None:
    """Band of a member, its middle, and what was measured."""
    for ends, color in (((band.low, band.high), PALE), (band.middle, GREY)):
        left, right = (frame.x(math.log10(max(end, _FEEBLE))) for end in ends)
        width = max(right - left, 0.5)
        draw_tiles(chart, [(left, y - 3.5, width, 7.0, color)])
    x = frame.x(math.log10(max(value, _FEEBLE)))
    chart.line(((x, y - 5.5), (x, y + 5.5)), stroke=ACCENT, width=2.2)


def _end(chart: Chart, frame: Frame) -> str:
    chart.axes(frame, x_ticks=False, y_ticks=False)
    draw_decades(chart, frame, across=True)
    bottom = frame.top + frame.height
    middle, axis = frame.left + frame.width / 2.0, ENGLISH("validation.bands_axis")
    chart.text(middle, bottom + _BELOW - 6.0, axis, anchor="middle")
    return chart.write(bottom + _BELOW, ENGLISH("validation.bands_title"))


def name_validated(member: str) -> str:
    """Member of the model that a measured value may be."""
    key = f"validation_member.{member}"
    return ENGLISH(key) if key in load_texts("en") else show_member(ENGLISH, member)


PAGE_FILE, DOCUMENT_FILE = "validation.html", "validation.json"


def render_validation(validations: Sequence[Validation]) -> dict[str, bytes]:
    """Page and document, by the names of their files."""
    document = json.dumps(write_validations(validations), indent=1, allow_nan=False)
    return {
        PAGE_FILE: _render_page(validations).encode(),
        DOCUMENT_FILE: document.encode(),
    }


def _render_page(validations: Sequence[Validation]) -> str:
    compared = [pair for validation in validations for pair in validation.comparisons]
    lead = ENGLISH(
        "validation.lead",
        measured=len(compared),
        inside=sum(pair.is_inside for pair in compared),
        middle=sum(pair.is_in_the_middle for pair in compared),
    )
    blocks = (
        masthead(
            f"netdesign validate · {__version__}",
            ENGLISH("validation.heading"),
            Paragraph(text=lead, look="lead"),
        ),
        section(
            "structures",
            ENGLISH("validation.structures"),
            Paragraph(text=ENGLISH("validation.structures_text"), look="text"),
            Figure(
                svg=draw_bands(validations),
                caption=ENGLISH("validation.bands_caption"),
                id="plate-bands",
                look="plate",
            ),
            _tabulate(validations).shown("study"),
            look="page",
        ),
    )
    return render_page(blocks, ENGLISH("validation.title"), "en")


def _tabulate(validations: Sequence[Validation]) -> Table:
    """A line for each measured force and member that it may be."""
    columns = (
        ("validation.structure", TEXTS),
        ("validation.measured", TEXTS),
        ("kN", NUMBER_TEXTS),
        ("validation.mark", TEXTS),
        ("validation.member", TEXTS),
        ("validation.band", RANGES),
        ("validation.middle", RANGES),
        ("validation.value", TEXTS),
    )
    lines = [
        (
            *(validation.structure.title, pair.measured.name),
            *(_show_measured(pair.measured), pair.measured.mark),
            *(name_validated(band.member), (band.low, band.high)),
            *(band.middle, band.judge(pair.measured)),
        )
        for validation in validations
        for pair in validation.comparisons
        for band in pair.bands
    ]
    return tabulate("", columns, lines)


def _show_measured(measured: Measurement) -> str:
    uncertain = f" ± {measured.uncertainty:g}" if measured.uncertainty else ""
    return f"{measured.value:g}{uncertain}"


def write_validations(validations: Sequence[Validation]) -> dict[str, Any]:
    """Plain values of the page in the form ``netdesign.validation/1``."""
    return {
        "schema": "netdesign.validation/1",
        "version": __version__,
        "structures": [_write_structure(validation) for validation in validations],
    }


def _write_structure(validation: Validation) -> dict[str, Any]:
    return {
        **asdict(validation.structure),
        "solved": validation.solved,
        "failed": validation.failed,
        "reasons": list(validation.reasons),
        "measured": [
            {
                **asdict(comparison.measured),
                "is_inside": comparison.is_inside,
                "is_in_the_middle": comparison.is_in_the_middle,
                "bands": [asdict(band) for band in comparison.bands],
            }
            for comparison in validation.comparisons
        ],
    }
