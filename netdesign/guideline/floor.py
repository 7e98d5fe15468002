"""Floor of the demand: the largest forces that the guideline's load cases bring."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from netdesign.guideline.comparison import (
    GuidelineResult,
    LoadCase,
    NetGeometry,
    list_load_cases,
    solve_load_case,
)
from netdesign.guideline.load_model import LoadModel, SnowLoad
from netdesign.guideline.net_pull import NetPull
from netdesign.structure.anchors import AnchorForces
from netdesign.structure.axis import measure_pull
from netdesign.structure.members import Member
from netdesign.words.message import Message, say

# Distance of the inclinations that are tried. Between two of them a force rises above
# both by less than 1e-5 of its size (tests/guideline/test_floor.py).
SCAN_STEP = math.radians(0.1)
# Fields of HeadSpan.
SPANS = ("head_pull", "least_tension", "foot_least", "foot_largest")


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedNet:
    """One net that the ranges of a row allow; the scan replaces its inclination.

    Attributes
    ----------
    net : NetGeometry
        Of the row.
    glide_factor : float
        N [-].
    """

    net: NetGeometry
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
    case: LoadCase
    load: SnowLoad
    pull: NetPull


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
        values count with the other sign.
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


def find_floor(
    model: LoadModel,
    nets: Iterable[LoadedNet],
    *,
    inclinations: tuple[float, float],
    altitude: float | None,
) -> Floor:
    """Largest member forces of load cases 1 and 2 over the ranges of a row.

    Every net is tried at inclinations `SCAN_STEP` apart, both ends included. Theory:
    guideline/THEORY.md, eq. (G10).

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    nets : iterable of LoadedNet
        Corners of the row's ranges of slack, stiffness, glide factor and height.
    inclinations : tuple of float
        Least and largest, from the slope normal [rad].
    altitude : float or None
        Of the row [m].

    Returns
    -------
    Floor
        Not available where the closed forms fail anywhere in the ranges: the largest
        force may lie there.

    Verified by
    -----------
    tests/guideline/test_floor.py
    """
    largest: dict[str, FloorForce] = {}
    for at in _list_tried(nets, inclinations):
        for case in list_load_cases(model, at.net, altitude):
            result = solve_load_case(model, at.net, case, at.glide_factor)
            if result.anchors is None or result.load is None or result.pull is None:
                return Floor(reason=_explain(at, result))
            sizes = {**result.anchors.member_forces, **_measure(result.anchors)}
            for member, force in sizes.items():
                known = largest.get(member)
                if known is None or force > known.force:
                    largest[member] = FloorForce(
                        member=member,
                        force=force,
                        at=at,
                        case=case,
                        load=result.load,
                        pull=result.pull,
                    )
    forces = [one for key, one in largest.items() if key not in SPANS]
    spans = [one for key, one in largest.items() if key in SPANS]
    return Floor(forces=tuple(forces), spans=tuple(spans), head=_read_span(spans))


def _measure(anchors: AnchorForces) -> dict[str, float]:
    """Sizes at head and foot of which the largest counts, by the keys `SPANS`."""
    foot = anchors.foot_anchor
    turn = measure_pull(foot.x, foot.y, Member.FOOT_ANCHOR)
    tension = anchors.head.uphill_guy_tension + anchors.head.downhill_guy_tension
    sizes = (math.hypot(*anchors.head_pull), -tension, -turn, turn)
    return dict(zip(SPANS, sizes, strict=True))


def _read_span(spans: Sequence[FloorForce]) -> HeadSpan | None:
    """Span of all states tried; None of none."""
    if not spans:
        return None
    sizes = {one.member: one.force for one in spans}
    pull, tension, least, largest = (sizes[key] for key in SPANS)
    return HeadSpan(
        pull=pull, least_tension=-tension, foot_least=-least, foot_largest=largest
    )


def _list_tried(
    nets: Iterable[LoadedNet], inclinations: tuple[float, float]
) -> Iterator[LoadedNet]:
    for one in nets:
        for inclination in list_inclinations(*inclinations):
            yield replace(one, net=replace(one.net, inclination=inclination))


def list_inclinations(low: float, high: float) -> Sequence[float]:
    """Inclinations from low to high, at most `SCAN_STEP` apart.

    Parameters
    ----------
    low, high : float
        Both included [rad].
    """
    steps = math.ceil((high - low) / SCAN_STEP - 1e-9)
    if steps < 1:
        return [low]
    return [low + (high - low) * k / steps for k in range(steps)] + [high]


def _explain(at: LoadedNet, result: GuidelineResult) -> Message:
    return say(
        "floor.not_available",
        case=say(f"load_case.{result.name}"),
        inclination=math.degrees(at.net.inclination),
        reason=result.reason or "",
    )
