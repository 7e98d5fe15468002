"""Floor of the demand: the largest forces that the guideline's load cases bring."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from itertools import product

import numpy as np

from netdesign.guideline.comparison import (
    GuidelineResult,
    LoadCase,
    NetGeometry,
    find_pulls,
    list_load_cases,
    place_head,
    solve_load_case,
)
from netdesign.guideline.load_model import LoadModel, NetPull, SnowLoad
from netdesign.numerics.arrays import Floats
from netdesign.numerics.optimise import find_largest
from netdesign.outcome import ModelError
from netdesign.structure.anchors import (
    AnchorForces,
    ManyForces,
    compute_many_forces,
    measure_pull,
)
from netdesign.structure.members import CARRYING_MEMBERS, Member, NetPart
from netdesign.words.message import Message, say

# Distance of the inclinations that are tried first, and parts of each other range.
SCAN_STEP = math.radians(0.25)
SCAN_PARTS = 8
_LOADED = (*CARRYING_MEMBERS, NetPart.MESH)
# Keys of what is sought at head and foot beside their forces.
SPANS = ("head_pull", "least_tension", "foot_least", "foot_largest")

Span = tuple[float, float]


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
        Of the snow, held or not [m].
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
class LoadedNet:
    """One net that the ranges of a row allow.

    Attributes
    ----------
    net : NetGeometry
        With its own inclination, snow, stiffness and slack.
    glide_factor : float
        N [-].
    """

    net: NetGeometry[float]
    glide_factor: float


@dataclass(frozen=True, slots=True, kw_only=True)
class FloorForce:
    """Largest force of one member under the guideline's load.

    Attributes
    ----------
    member : str
        Key of the member.
    force : float
        Characteristic, on a support inside the row [N].
    at : LoadedNet
        Net, inclination and glide factor at which it is largest.
    case : LoadCase
        That brings it.
    load, pull : SnowLoad, NetPull
        From which it follows, for each metre of width.
    """

    member: str
    force: float
    at: LoadedNet
    case: LoadCase[float]
    load: SnowLoad[float]
    pull: NetPull[float]


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadSpan:
    """Span of what the load cases bring at head and foot, over all that is tried.

    Attributes
    ----------
    pull : float
        Largest pull of the net on a head, of a support inside the row [N].
    least_tension : float
        Least tension of the guys at work [N].
    foot_least, foot_largest : float
        Inclination of the pull on the foot anchor, as `measure_pull` has it [rad].
    """

    pull: float
    least_tension: float
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
    spans : tuple of FloorForce
        States that bring what ``head`` says, by the keys `SPANS`; those of least
        values count with the other sign. Between two signs of the guys' tension lies
        none at all: then the state with the least is told.
    reason : Message or None
        Why it is not available.
    """

    forces: tuple[FloorForce, ...] = ()
    spans: tuple[FloorForce, ...] = ()
    head: HeadSpan | None = None
    reason: Message | None = None

    def find(self, member: str) -> FloorForce | None:
        """Force of a member; None where the floor is not available."""
        return next((one for one in self.forces if one.member == member), None)


def find_floor(model: LoadModel, ranges: NetRanges, altitude: float | None) -> Floor:
    """Largest member forces of load cases 1 and 2 over the ranges of a row.

    Theory: guideline/THEORY.md, eq. (G10).

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    ranges : NetRanges
        Nets that count.
    altitude : float or None
        Of the row [m]; None is not known, and gets the largest factor.

    Returns
    -------
    Floor
        Not available where the closed forms fail at anything that is tried: the
        largest force may lie there.

    Verified by
    -----------
    tests/guideline/test_floor.py
    """
    scan = _Scan(model=model, ranges=ranges, altitude=altitude)
    try:
        points, largest = find_largest(scan.list_sought, _spread(ranges))
    except _FailedAtError as failed:
        return Floor(reason=failed.reason)
    reached = scan.try_points(points)
    solve = cache(scan.solve_one)  # members are often largest at the same place
    found: dict[str, FloorForce] = {}
    for key, sizes in _list_sizes(reached).items():
        case, end, number = np.unravel_index(sizes.argmax(), sizes.shape)
        point = tuple(points[:, number])
        at, snow, result = solve(point, int(case), int(end))
        if result.solved is None:
            return Floor(reason=_explain(at, result))
        load, pull, anchors = result.solved
        found[key] = FloorForce(
            member=key,
            force=_measure(anchors, pull)[key],
            at=at,
            case=snow,
            load=load,
            pull=pull,
        )
    return Floor(
        forces=tuple(found[member] for member in _LOADED),
        spans=tuple(found[key] for key in SPANS),
        head=_measure_head(largest),
    )


def _list_sizes(tried: ManyForces) -> dict[str, Floats]:
    """Sizes of which the largest counts, at all that was tried."""
    uphill, downhill = (tried.of_members[guy] for guy in _GUYS)
    turn = tried.foot_turn
    spans = (tried.head_pull, -(uphill + downhill), -turn, turn)
    return {**tried.of_members, **dict(zip(SPANS, spans, strict=True))}


def _measure(anchors: AnchorForces, pull: NetPull[float]) -> dict[str, float]:
    """Sizes of one state, as `_list_sizes` has them of many."""
    foot = anchors.foot_anchor
    turn = measure_pull(foot.x, foot.y, Member.FOOT_ANCHOR)
    tension = anchors.head.uphill_guy_tension + anchors.head.downhill_guy_tension
    sizes = (math.hypot(*anchors.head_pull), -tension, -turn, turn)
    found = {**anchors.member_forces, **dict(zip(SPANS, sizes, strict=True))}
    return {**found, NetPart.MESH: pull.largest_tension}


def _measure_head(largest: Floats) -> HeadSpan:
    """Span at head and foot, of the largest of all that is sought.

    A tension with a sign is that of the uphill guy, or less that of the downhill one.
    Between nets with one sign and nets with the other lies one without tension.
    """
    at_head = largest[len(_LOADED) :]
    pull, turn, less_turn, *signed = (float(one) for one in at_head)
    tensions = [
        max(0.0, -less, -most)
        for most, less in zip(signed[::2], signed[1::2], strict=True)
    ]
    return HeadSpan(
        pull=pull,
        least_tension=min(tensions),
        foot_least=-less_turn,
        foot_largest=turn,
    )


def _spread(ranges: NetRanges) -> list[Floats]:
    """Axes of a grid: inclinations, thicknesses, shares of the range of N.

    Snow that just reaches the head is among the thicknesses: there forces have a kink.
    """
    low, high = ranges.inclinations
    least, largest = ranges.find_glide_factors(np.array(ranges.thicknesses))
    spans = (
        (low, high, max(2, math.ceil((high - low) / SCAN_STEP))),
        (*ranges.thicknesses, SCAN_PARTS),
        (0.0, 1.0 if (least < largest).any() else 0.0, SCAN_PARTS),
    )
    axes = [
        np.linspace(low, high, parts + 1) if low < high else np.array([low])
        for low, high, parts in spans
    ]
    if axes[1][0] < ranges.net.net_height < axes[1][-1]:
        axes[1] = np.union1d(axes[1], ranges.net.net_height)
    return axes


@dataclass(frozen=True, slots=True, kw_only=True)
class _Scan:
    """The guideline over the ranges of a row, at any points of them.

    A point is inclination [rad], thickness [m] and share of the range of N.
    """

    model: LoadModel
    ranges: NetRanges
    altitude: float | None

    def list_sought(self, points: Floats) -> Floats:
        """Values that are made as large as they can be, at points, shape (3, n).

        Member forces, pull on the head, direction of the foot's pull and less that
        direction, and of each load case the tension with a sign and less that.
        """
        tried = self.try_points(points)
        turn = tried.foot_turn
        uphill, downhill = (tried.of_members[guy] for guy in _GUYS)
        signed = uphill - downhill
        members = (tried.of_members[one] for one in _LOADED)
        of_all = np.array([*members, tried.head_pull, turn, -turn]).max(axis=(1, 2))
        of_case = np.array([signed, -signed]).max(axis=2)
        return np.concatenate([of_all, *of_case.transpose(1, 0, 2)])

    def try_points(self, points: Floats) -> ManyForces:
        """Forces by load case, end of the tension and point, shape (2, e, n)."""
        net, glide = self._place(points)
        cases = list_load_cases(self.model, net, self.altitude)
        snow = LoadCase(
            name="both",
            density=np.array([[one.density] for one in cases]),
            height_vertical=np.array([[one.height_vertical] for one in cases]),
        )
        try:
            _, pull = find_pulls(self.model, net, snow, glide)
        except ModelError:
            raise self._find_failed(points) from None
        forces = compute_many_forces(
            net.layout,
            place_head(net),
            foot_pull_per_m=pull.foot,
            head_pull_per_m=pull.head,
        )
        if not forces.is_held.all():
            raise self._find_failed(points)
        found: dict[str, Floats] = {**forces.of_members}
        found[NetPart.MESH] = pull.largest_tension
        return replace(forces, of_members=found)

    def _place(self, points: Floats) -> tuple[NetGeometry[Floats], Floats]:
        """Nets and glide factors at points; the ends of the tension are rows."""
        given = self.ranges
        inclination, thickness, share = points
        least, largest = given.find_glide_factors(thickness)
        ends = np.array(_list_ends(given))
        net = NetGeometry(
            slope_angle=given.net.slope_angle,
            snow_thickness=np.minimum(thickness, given.net.net_height),
            net_height=given.net.net_height,
            inclination=inclination,
            stiffness=ends[:, :1],
            slack=ends[:, 1:],
            layout=given.net.layout,
        )
        return net, least + share * (largest - least)

    def solve_one(
        self, point: tuple[float, ...], case: int, end: int
    ) -> tuple[LoadedNet, LoadCase[float], GuidelineResult]:
        """One net and load case as everywhere else."""
        nets, glide = self._place(np.array(point)[:, None])
        net = replace(
            self.ranges.net,
            snow_thickness=float(nets.snow_thickness[0]),
            inclination=float(point[0]),
            stiffness=float(nets.stiffness[end, 0]),
            slack=float(nets.slack[end, 0]),
        )
        at = LoadedNet(net=net, glide_factor=float(glide[0]))
        snow = list_load_cases(self.model, net, self.altitude)[case]
        return at, snow, solve_load_case(self.model, net, snow, at.glide_factor)

    def _find_failed(self, points: Floats) -> _FailedAtError:
        """First of the points at which a load case fails, and why."""
        ends = range(len(_list_ends(self.ranges)))
        for point, case, end in product(points.T, (0, 1), ends):
            at, _, result = self.solve_one(tuple(point), case, end)
            if result.anchors is None:
                return _FailedAtError(_explain(at, result))
        raise AssertionError  # what fails for many fails for one of them


_GUYS = (Member.UPHILL_GUY, Member.DOWNHILL_GUY)


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


def _explain(at: LoadedNet, result: GuidelineResult) -> Message:
    return say(
        "floor.not_available",
        case=say(f"load_case.{result.name}"),
        inclination=math.degrees(at.net.inclination),
        reason=result.reason or "",
    )
