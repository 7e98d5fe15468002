"""Least demand: the largest member forces under the guideline's load cases."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import product

import numpy as np

from netdesign.guideline.load_cases import (
    GuidelineResult,
    LoadCase,
    NetGeometry,
    find_pulls,
    list_load_cases,
    place_head,
    solve_load_case,
)
from netdesign.guideline.load_model import (
    LoadModel,
    compute_creep_factor,
)
from netdesign.numerics.arrays import Floats, Ints, measure_length
from netdesign.numerics.optimise import find_largest
from netdesign.outcome import ModelError
from netdesign.structure.anchors import compute_member_forces, measure_pull
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import CARRYING_MEMBERS, Member, NetPart
from netdesign.structure.splay import find_ways
from netdesign.words.message import Message, say

# Distance of the inclinations that are tried first, and parts of each other range.
SCAN_STEP = math.radians(1.0)
SCAN_PARTS = 8
_LOADED = (*CARRYING_MEMBERS, NetPart.MESH)
_HEAD, _TURN = "head_pull", "foot_turn"

Span = tuple[float, float]
Tried = Mapping[str, Floats]  # by layout, load case, end of the tension and point


@dataclass(frozen=True, slots=True, kw_only=True)
class NetRanges:
    """Nets that the ranges of a row allow.

    Attributes
    ----------
    net : NetGeometry
        Of the row; what follows takes the place of its numbers.
    inclinations : tuple of float
        Least and largest, from the slope normal [rad].
    thicknesses : tuple of float
        Of the snow, from the least to that of snow as high as the net [m].
    stiffnesses, slacks : tuple of float
        ES [N/m] and slack [-].
    find_glide_factors : callable
        Thicknesses of the snow [m] to the least and the largest N under each [-].
    """

    net: NetGeometry[float]
    inclinations: Span
    thicknesses: Span
    stiffnesses: Span
    slacks: Span
    find_glide_factors: Callable[[Floats], tuple[Floats, Floats]]


@dataclass(frozen=True, slots=True, kw_only=True)
class FloorForce:
    """Largest force of one member under the guideline's load.

    Attributes
    ----------
    member : str
        Key of the member.
    force : float
        Characteristic, on a support inside the row [N].
    net : NetGeometry
        That it is largest on, with its own inclination, snow, stiffness and slack.
    case : LoadCase
        That brings it.
    glide_factor : float
        N with which that brings it [-].
    """

    member: str
    force: float
    net: NetGeometry[float]
    case: LoadCase[float]
    glide_factor: float


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadSpan:
    """Span of what the load cases bring at head and foot, over all that is tried.

    Attributes
    ----------
    pull : float
        Largest pull of the net on a head, of a support inside the row [N].
    foot_least, foot_largest : float
        Inclination of the pull on the foot anchor, as `measure_pull` has it [rad].
    """

    pull: float
    foot_least: float
    foot_largest: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Floor:
    """Forces that no demand of a row may lie below.

    Attributes
    ----------
    head : HeadSpan or None
        What acts at head and foot; None where the floor is not available.
    forces : tuple of FloorForce
        One a member; empty where the floor is not available.
    reason : Message or None
        Why it is not available.
    """

    forces: tuple[FloorForce, ...] = ()
    head: HeadSpan | None = None
    reason: Message | None = None

    def find(self, member: str) -> FloorForce | None:
        """Force of a member; None where the floor is not available."""
        return next((force for force in self.forces if force.member == member), None)


def find_floors(
    model: LoadModel,
    ranges: NetRanges,
    altitude: float | None,
    layouts: Sequence[SupportLayout],
) -> list[Floor]:
    """Largest member forces of load cases 1 and 2 over the ranges of a row.

    One search for all layouts: the pulls of the net are the same. Theory:
    guideline/THEORY.md, eq. (G10).

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline; with its dimensioning form, where that counts.
    ranges : NetRanges
        Nets that count.
    altitude : float or None
        Of the row [m]; None is not known, and gets the largest factor.
    layouts : sequence of SupportLayout
        In the place of the net's own, which they differ from in tilt and distances.

    Returns
    -------
    list of Floor
        One a layout; not available where the closed forms fail at anything that is
        tried: the largest force may lie there.

    Verified by
    -----------
    tests/guideline/test_floor.py
    """
    scan = _Scan(model=model, ranges=ranges, altitude=altitude, layouts=tuple(layouts))
    try:
        points, largest = find_largest(scan.list_sought, _spread(ranges))
    except _FailedAtError as failed:
        if len(layouts) == 1:
            return [Floor(reason=failed.reason)]
        alone = (find_floors(model, ranges, altitude, (layout,)) for layout in layouts)
        return [floor for (floor,) in alone]
    count, tried = len(layouts), scan.try_points(points)
    own = np.split(np.arange(points.shape[1]), count)
    return [
        _take_floor(scan, place, points, largest[own[place]], own[place], tried)
        for place in range(count)
    ]


def _take_floor(
    scan: _Scan, layout: int, points: Floats, largest: Floats, own: Ints, tried: Tried
) -> Floor:
    """Floor on one layout, from the points at which its forces are largest."""
    place = cache(scan.place_one)  # members are often largest at the same place
    forces: list[FloorForce] = []
    for member in _LOADED:
        sizes = np.broadcast_to(tried[member], tried[Member.POST].shape)[layout]
        sizes = sizes[..., own]
        case, end, index = np.unravel_index(sizes.argmax(), sizes.shape)
        point = tuple(points[:, own[index]].tolist())
        net, snow, glide = place(point, int(case), int(end), layout)
        size = float(sizes[case, end, index])
        force = FloorForce(
            member=member, force=size, net=net, case=snow, glide_factor=glide
        )
        forces.append(force)
    return Floor(forces=tuple(forces), head=_measure_head(largest))


def _measure_head(largest: Floats) -> HeadSpan:
    """Span of what acts at head and foot, from the largest values of the search."""
    pull, turn, less_turn = map(float, largest[len(_LOADED) :])
    return HeadSpan(pull=pull, foot_least=-less_turn, foot_largest=turn)


def _spread(ranges: NetRanges) -> list[Floats]:
    """Axes of a grid: inclinations, thicknesses, shares of the range of N."""
    low, high = ranges.inclinations
    least, largest = ranges.find_glide_factors(np.array(ranges.thicknesses))
    spans = (
        (low, high, max(2, math.ceil((high - low) / SCAN_STEP))),
        (*ranges.thicknesses, SCAN_PARTS),
        (0.0, 1.0 if (least < largest).any() else 0.0, SCAN_PARTS),
    )
    return [
        np.linspace(low, high, parts + 1) if low < high else np.array([low])
        for low, high, parts in spans
    ]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Scan:
    """The guideline over the ranges of a row, at any points of them.

    A point is inclination [rad], thickness [m] and share of the range of N.
    """

    model: LoadModel
    ranges: NetRanges
    altitude: float | None
    layouts: tuple[SupportLayout, ...]

    def list_sought(self, points: Floats) -> Floats:
        """Values that are made as large as they can be, at points, shape (q, n).

        Of each layout member forces, pull on the head, direction of the foot's pull and
        less that direction.
        """
        tried = self.try_points(points)
        members = (tried[member] for member in _LOADED)
        sought = (*members, tried[_HEAD], tried[_TURN], -tried[_TURN])
        shape = (len(self.layouts), len(points.T))
        largest = [np.broadcast_to(one.max(axis=(-3, -2)), shape) for one in sought]
        values: Floats = np.stack(largest, axis=1).reshape(-1, shape[1])
        return values

    def try_points(self, points: Floats) -> dict[str, Floats]:
        """Forces of the members, pull on the head [N], direction of the foot's [rad].

        By layout, load case, end of the tension and point, (m, c, e, n); without the
        first dimension what is alike on all layouts.
        """
        net = self._place(points)
        snow, glide = self._load(points)
        try:
            _, pull = find_pulls(self.model, net, snow, glide)
        except ModelError:
            raise self._find_failed(points) from None
        spacing, (x_head, y_head) = net.layout.post_spacing, place_head(net)
        of_members, is_held = compute_member_forces(
            find_ways(self.layouts, (x_head[None, None], y_head[None, None])),
            foot_pull_per_m=pull.foot,
            head_pull_per_m=pull.head,
            post_spacing=spacing,
            is_foot_shared=self.layouts[0].is_foot_shared,
        )
        if not is_held.all():
            raise self._find_failed(points)
        return {
            **of_members,
            NetPart.MESH: pull.largest_tension,
            _HEAD: spacing * measure_length(*pull.head),
            _TURN: measure_pull(*pull.foot, Member.FOOT_ANCHOR),
        }

    def _place(self, points: Floats) -> NetGeometry[Floats]:
        """Nets at some points; each end of the tension is a row."""
        ranges = self.ranges
        inclination, thickness, _ = points
        ends = np.array(_list_ends(ranges))
        return NetGeometry(
            slope_angle=ranges.net.slope_angle,
            snow_thickness=thickness,
            net_height=ranges.net.net_height,
            inclination=inclination,
            stiffness=ends[:, :1],
            slack=ends[:, 1:],
            layout=ranges.net.layout,
        )

    def _load(self, points: Floats) -> tuple[LoadCase[Floats], Floats]:
        """All load cases as one, and N, at points; shapes that go with (c, 1, n).

        The dimensioning form has the height of the net at every point.
        """
        _, thickness, share = points
        cases = list_load_cases(self.model, self.ranges.net, self.altitude)
        numbers = [
            (case.density, case.normal_share, case.settled, self._find_creep(case))
            for case in cases
        ]
        density, normal, settled, creep = np.array(numbers).T[:, :, None, None]
        glide = self._find_glide(thickness, share)
        if self.model.dimensioning is not None:
            has_form = np.array([[[case.creep_factor is not None]] for case in cases])
            full = 0.0 * thickness + self.ranges.net.net_height
            glide = np.where(has_form, self._find_glide(full, share), glide)
            thickness = np.where(has_form, full, thickness)
        snow = LoadCase(
            name="all",
            density=density,
            height_vertical=thickness / math.cos(self.ranges.net.slope_angle),
            normal_share=normal,
            settled=settled,
            creep_factor=creep,
        )
        return snow, glide

    def _find_creep(self, case: LoadCase[float]) -> float:
        """K of a load case [-]."""
        if case.creep_factor is not None:
            return case.creep_factor
        slope = self.ranges.net.slope_angle
        return compute_creep_factor(self.model, case.density, slope)

    def _find_glide(self, thickness: Floats, share: Floats) -> Floats:
        """N under snow of some thicknesses, at shares of its range [-]."""
        least, largest = self.ranges.find_glide_factors(thickness)
        points: Floats = least + share * (largest - least)
        return points

    def place_one(
        self, point: tuple[float, ...], case: int, end: int, layout: int
    ) -> tuple[NetGeometry[float], LoadCase[float], float]:
        """One net on one layout, its load case and its N."""
        inclination, thickness, share = point
        stiffness, slack = _list_ends(self.ranges)[end]
        net = replace(
            self.ranges.net,
            snow_thickness=thickness,
            inclination=inclination,
            stiffness=stiffness,
            slack=slack,
            layout=self.layouts[layout],
        )
        snow = list_load_cases(self.model, net, self.altitude)[case]
        depth = thickness if snow.creep_factor is None else net.net_height
        glide = float(self._find_glide(np.array([depth]), np.array([share]))[0])
        return replace(net, snow_thickness=depth), snow, glide

    def _find_failed(self, points: Floats) -> _FailedAtError:
        """First of the points at which a load case fails, and why."""
        cases = list_load_cases(self.model, self.ranges.net, self.altitude)
        ends, layouts = _list_ends(self.ranges), self.layouts
        places = product(*(range(len(each)) for each in (cases, ends, layouts)))
        for point, place in product(points.T.tolist(), places):
            net, snow, glide = self.place_one(tuple(point), *place)
            result = solve_load_case(self.model, net, snow, glide)
            if result.anchors is None:
                return _FailedAtError(_explain(net, result))
        raise AssertionError  # what fails for many fails for one of them


class _FailedAtError(Exception):
    """A load case without forces."""

    def __init__(self, reason: Message) -> None:
        super().__init__()
        self.reason = reason


def _list_ends(ranges: NetRanges) -> list[tuple[float, float]]:
    """Stiffness and slack at which the chord tension is largest, and least."""
    (soft, stiff), (tight, slack) = ranges.stiffnesses, ranges.slacks
    ends = [(stiff, tight), (soft, slack)]
    return ends if ends[0] != ends[1] else ends[:1]


def _explain(net: NetGeometry[float], result: GuidelineResult) -> Message:
    return say(
        "floor.not_available",
        case=say(f"load_case.{result.case.name}"),
        inclination=math.degrees(net.inclination),
        reason=result.reason or "",
    )
