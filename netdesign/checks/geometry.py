"""Geometry of a net row against the limits of a profile, and of its type approval."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from netdesign.checks.check import Check
from netdesign.checks.comparison import compare, leave_open
from netdesign.checks.inputs import Proof
from netdesign.checks.loader import Standard
from netdesign.checks.rating import OpenKind, judge
from netdesign.checks.schema import (
    GROUND_FRICTION,
    HEIGHT_RATIO,
    INCLINATIONS,
    MAX_GAP,
    PLAUSIBLE_SLOPES,
    SLOPES,
    SPACING_CAP,
    StandardValue,
)
from netdesign.outcome import SEVERITY, Verdict
from netdesign.units import degree_from_radian, radian_from_percent
from netdesign.words.message import Message, say


def _compare(
    mode: str,
    limit: StandardValue | None,
    band: tuple[float, float],
    span: tuple[float, float],
    show: Callable[[float], float] = float,
) -> Check:
    """Check that a size, which lies in a band, lies in a span; as `judge` has it."""
    (low, high), (least, most) = band, span
    met = judge(low, high, least=least, most=most)
    numbers = {"low": low, "high": high, "least": least, "most": most}
    shown = {name: show(size) for name, size in numbers.items() if size != math.inf}
    return compare(mode, met, say(f"geometry.{mode}_{met.value}", **shown), limit)


def _compare_angle(
    mode: str, limits: tuple[str, str], standard: Standard, low: float, high: float
) -> Check | None:
    """Check of an angle [rad] against two values of the profile; None without them."""
    least, most = map(standard.find, limits)
    if least is None or most is None:
        return None
    span = (least.value_si, most.value_si)
    return _compare(mode, least, (low, high), span, degree_from_radian)


def check_inclination(low: float, high: float, standard: Standard) -> Check:
    """Check a row's range of net inclination against the profile's range.

    Parameters
    ----------
    low, high : float
        Range of the angle between net and slope normal [rad].
    standard : Standard
        Profile that gives the limits.

    Returns
    -------
    Check
        Pass if the range lies inside, fail if it lies outside, else not proven.
    """
    check = _compare_angle("inclination", INCLINATIONS, standard, low, high)
    reason = say("geometry.no_inclination_limits")
    return check or leave_open("inclination", OpenKind.RESISTANCE_MISSING, reason)


def check_slope(slope_angle: float, standard: Standard) -> Check:
    """Check the slope angle [rad] against limits, and whether it can be one at all.

    Outside the profile's limits it fails. Outside the plausible range it is not proven:
    it may be a percentage given as degrees, and all forces follow from it.
    """
    inside, plausible = (
        _compare_angle("slope", limits, standard, slope_angle, slope_angle)
        for limits in (SLOPES, PLAUSIBLE_SLOPES)
    )
    if inside and inside.verdict is not Verdict.PASS:
        return inside
    least, most = map(standard.find, PLAUSIBLE_SLOPES)
    if least is None or most is None or plausible is None:
        reason = say("geometry.no_plausible_slope")
        return leave_open("slope", OpenKind.RESISTANCE_MISSING, reason)
    if plausible.verdict is Verdict.PASS:
        return inside or plausible
    slope = degree_from_radian(slope_angle)
    span = {"least": least.value, "most": most.value}
    reason = say("geometry.slope_not_plausible", slope=slope, **span)
    if slope_angle > most.value_si:
        meant = degree_from_radian(radian_from_percent(slope))
        reason = say("geometry.percentage", reason=reason, slope=slope, meant=meant)
    check = compare("slope", Verdict.NOT_PROVEN, None, least)
    return check.with_open(OpenKind.VALUE_ASKED, reason)


def check_height(
    net_height: float, snow_thickness: float, standard: Standard
) -> Check | None:
    """Check the net's height against the snow, both normal to the slope [m].

    A net below its snow fails under every profile; else None where the profile has no
    such limit.
    """
    ratio = standard.find(HEIGHT_RATIO)
    if ratio is None and net_height >= snow_thickness:
        return None
    needed = max(1.0, ratio.value if ratio else 0.0) * snow_thickness
    return _compare("height", ratio, (net_height, net_height), (needed, math.inf))


def compute_largest_row_spacing(
    slope_angle: float, net_height: float, ground_friction: float
) -> float:
    """Largest distance of rows along the slope, L = f_L H_K.

    Theory: checks/THEORY.md.

    Parameters
    ----------
    slope_angle : float
        psi [rad].
    net_height : float
        D_K, normal to the slope [m]; H_K = D_K / cos psi.
    ground_friction : float
        tan phi of the ground [-].

    Returns
    -------
    float
        [m]; infinite where the ground alone holds the snow.
    """
    slope = math.tan(slope_angle)
    if slope <= ground_friction:
        return math.inf
    factor = 2.0 * slope / (slope - ground_friction)
    return factor * net_height / math.cos(slope_angle)


def read_reach(standard: Standard) -> Callable[[float, float], float] | None:
    """Largest distance of rows [m] by slope [rad] and net height [m], at most the cap.

    None of a profile without the friction of the ground.
    """
    friction, cap = standard.find(GROUND_FRICTION), standard.find(SPACING_CAP)
    if friction is None:
        return None

    def find_reach(slope: float, net_height: float) -> float:
        most = cap.value * net_height / math.cos(slope) if cap else math.inf
        return min(most, compute_largest_row_spacing(slope, net_height, friction.value))

    return find_reach


def check_row_spacing(
    slope_angle: float, net_height: float, length: float, standard: Standard
) -> Check | None:
    """Check the distance of the rows; None where the profile has no formula.

    Nothing is proven beyond the profile's cap on f_L, nor without one.

    Parameters
    ----------
    slope_angle : float
        psi [rad].
    net_height : float
        D_K, normal to the slope [m].
    length : float
        To the next row, along the slope [m].
    standard : Standard
        Profile that gives the limits.
    """
    friction, cap = standard.find(GROUND_FRICTION), standard.find(SPACING_CAP)
    if friction is None:
        return None
    most = compute_largest_row_spacing(slope_angle, net_height, friction.value)
    proven = cap.value * net_height / math.cos(slope_angle) if cap else 0.0
    check = _compare("spacing", friction, (length, length), (0.0, most))
    if most == math.inf and check.verdict is Verdict.PASS:
        check = compare("spacing", Verdict.PASS, say("geometry.spacing_any"), friction)
    if length <= proven:
        return check
    capped = say("geometry.spacing_capped", length=length, most=proven)
    reason = capped if cap else say("geometry.no_cap")
    return check.with_open(OpenKind.UNSOLVED, reason)


def check_gap(gap: float, standard: Standard) -> Check | None:
    """Check the gap beside a row [m]; None where the profile has no limit of it.

    None, too, of a free end without a stated neighbour, which is a condition.
    """
    most = standard.find(MAX_GAP)
    if most is None or gap == math.inf:
        return None
    return _compare("gap", most, (gap, gap), (0.0, most.value))


@dataclass(frozen=True, slots=True, kw_only=True)
class StatedValue:
    """A number of an approval or of its maker, with its cell; SI."""

    value: float
    cell: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Approval:
    """Limits of a type approval, and what the maker states beside them.

    A limit that it does not state is None: it proves nothing then. So is a force.

    Attributes
    ----------
    document, cell : str
        What approves the net, and where that stands; "" where only the maker's forces
        are given.
    height : StatedValue or None
        Largest D_K, normal to the slope [m].
    glide_factor : StatedValue or None
        Largest N [-].
    altitude_factor : StatedValue or None
        Largest f_c [-].
    spacing : StatedValue or None
        Largest distance of the posts [m].
    foot_force, uphill_force, downhill_force : StatedValue or None
        Characteristic force on the anchor, as the maker states it [N].
    """

    document: str = ""
    cell: str = ""
    height: StatedValue | None = None
    glide_factor: StatedValue | None = None
    altitude_factor: StatedValue | None = None
    spacing: StatedValue | None = None
    foot_force: StatedValue | None = None
    uphill_force: StatedValue | None = None
    downhill_force: StatedValue | None = None

    def prove(self) -> Proof:
        """Document as the proof of what it approves."""
        return Proof(document=self.document, author="", date="", cell=self.cell)


MODE = "approval"
# What an approval limits, with its name and unit.
_LIMITS = {
    "height": ("approval.height", " m"),
    "glide_factor": ("approval.glide_factor", ""),
    "altitude_factor": ("approval.altitude_factor", ""),
    "spacing": ("approval.spacing", " m"),
}
_ROUNDING = 1e-9  # relative, of a factor that is worked out


def check_approval(
    approval: Approval, actual: Mapping[str, tuple[float, float]]
) -> Check:
    """Check of a row against the limits of the approval of its net type.

    Parameters
    ----------
    approval : Approval
        With a document.
    actual : mapping of str to tuple of float
        Least and largest value of the row by the limits' names in `Approval`, SI.

    Returns
    -------
    Check
        It fails where a value surely exceeds its limit. A limit that the approval does
        not state is not proven, and neither is a value that may exceed its own.
    """
    beyond: dict[Verdict, list[Message]] = {}
    for of, (text, unit) in _LIMITS.items():
        limit: StatedValue | None = getattr(approval, of)
        name, (low, high) = say(text), actual[of]
        if limit is None:
            message = say("approval.unstated", name=name)
            beyond.setdefault(Verdict.NOT_PROVEN, []).append(message)
            continue
        most = limit.value * (1.0 + _ROUNDING)
        met = judge(low, high, least=0.0, most=most)
        key = "approval.beyond" if low == high else "approval.may_be_beyond"
        if met is Verdict.PASS:
            key = "approval.within"
        message = say(key, name=name, low=low, high=high, limit=limit.value, unit=unit)
        beyond.setdefault(met, []).append(message)
    met = next(verdict for verdict in SEVERITY if verdict in beyond)
    by_verdict = {Verdict.PASS: "approval.inside", Verdict.FAIL: "approval.outside"}
    finding = say(
        by_verdict.get(met, "approval.open"),
        values=tuple(beyond[met]),
        document=approval.document,
    )
    return compare(MODE, met, finding)
