"""Demand with its error band against a limit: pass, fail or not proven."""

from __future__ import annotations

import math

from netdesign.checks.loader import Standard, StandardValue
from netdesign.checks.result import Band, CheckResult, GivenResistance
from netdesign.checks.schema import ACTION_FACTOR, MAX_INCLINATION, MIN_INCLINATION
from netdesign.outcome import Verdict
from netdesign.units import degree_from_radian


def judge(
    low: float, high: float, *, least: float, most: float, is_complete: bool = True
) -> Verdict:
    """Verdict on a quantity that lies in a band and must lie in a range.

    The only place where numbers become a verdict. Each answer but "not proven" has
    to be earned by a comparison that holds, which NaN never does.

    Parameters
    ----------
    low, high : float
        Band of the quantity; finite, or nothing is proven.
    least, most : float
        Range that is accepted, both ends included, in the unit of the band.
    is_complete : bool
        Every case is in the band. Without that nothing passes; what lies outside
        the range all the same fails.

    Examples
    --------
    >>> judge(0.8, 1.0, least=0.0, most=1.0).value
    'pass'
    >>> judge(0.9, 1.1, least=0.0, most=1.0).value
    'not_proven'
    """
    if not (math.isfinite(low) and math.isfinite(high) and low <= high):
        return Verdict.NOT_PROVEN
    if low > most or high < least:
        return Verdict.FAIL
    if is_complete and least <= low and high <= most:
        return Verdict.PASS
    return Verdict.NOT_PROVEN


def check_member(
    action: Band | None, resistance: GivenResistance, standard: Standard, *, gap: str
) -> CheckResult:
    """Check one member in one mode: factored action against factored resistance.

    Parameters
    ----------
    action : Band or None
        Largest characteristic force over the solved cases, per anchor [N]; None if
        no case was solved.
    resistance : GivenResistance
        Names member and mode; its value [N] may be missing.
    standard : Standard
        Profile that gives the partial factors.
    gap : str
        Why the action does not cover every case ("3 of 40 cases failed"); "" if it
        does. With a gap nothing passes.

    Returns
    -------
    CheckResult
        Never a pass where anything needed is missing.
    """
    if action is None:
        gap = gap or "no case was solved"
    on_action = standard.find(ACTION_FACTOR)
    on_resistance = standard.find_resistance_factor(resistance.mode, resistance.basis)
    demand = action.times(on_action.value_si) if action and on_action else None
    strength = _design_resistance(resistance, on_resistance)
    utilisation = demand.over(strength) if demand and strength else None
    gaps = [gap] if gap else []
    gaps += _missing(resistance, standard, on_action, on_resistance)
    is_slack = action is not None and action.high == 0.0 and not gap
    if is_slack:  # nothing to resist: the utilisation is 0 of any resistance
        utilisation, gaps = action, []
    verdict = _judge_utilisation(utilisation, is_complete=not gap)
    return CheckResult(
        id=f"{resistance.member}.{resistance.mode}",
        clause=on_resistance.clause if on_resistance else "-",
        member=resistance.member,
        mode=resistance.mode,
        verdict=verdict,
        reason=_explain(verdict, gaps, is_slack=is_slack),
        action=action,
        action_factor=on_action.value_si if on_action else None,
        demand=demand,
        resistance=resistance.value,
        resistance_factor=on_resistance.value_si if on_resistance else None,
        design_resistance=strength,
        utilisation=utilisation,
        assumed=_assumed(on_action, on_resistance),
    )


def _judge_utilisation(utilisation: Band | None, *, is_complete: bool) -> Verdict:
    if utilisation is None:
        return Verdict.NOT_PROVEN
    return judge(
        utilisation.low, utilisation.high, least=0.0, most=1.0, is_complete=is_complete
    )


def _design_resistance(
    resistance: GivenResistance, factor: StandardValue | None
) -> float | None:
    value = resistance.value
    if factor is None or value is None or not _is_usable(value):
        return None
    return value / factor.value_si


def _is_usable(resistance: float) -> bool:
    return 0.0 < resistance < math.inf


def _missing(
    resistance: GivenResistance,
    standard: Standard,
    on_action: StandardValue | None,
    on_resistance: StandardValue | None,
) -> list[str]:
    """List what a utilisation lacks, each by the name under which it is found."""
    lacks = []
    named = f" of type {resistance.type_id}" if resistance.type_id else ""
    what = f"{resistance.member} ({resistance.mode}){named}, cell {resistance.source}"
    if resistance.value is None:
        lacks.append(f"no resistance is given for {what}")
    elif not _is_usable(resistance.value):
        lacks.append(f"the resistance {resistance.value!r} N is not usable for {what}")
    if on_action is None:
        lacks.append(f"the profile has no factor {ACTION_FACTOR}")
    if on_resistance is None and not _has_factor_of_some_basis(resistance, standard):
        basis = f" with basis {resistance.basis!r}" if resistance.basis else ""
        lacks.append(f"the profile has no factor resistance.{resistance.mode}{basis}")
    return lacks


def _has_factor_of_some_basis(resistance: GivenResistance, standard: Standard) -> bool:
    """Without a resistance there is no basis yet, and no factor to miss."""
    prefix = f"resistance.{resistance.mode}."
    return not resistance.basis and any(
        value.id.startswith(prefix) for value in standard.values
    )


def _explain(verdict: Verdict, gaps: list[str], *, is_slack: bool) -> str:
    """One sentence without digits, so that rounding cannot contradict it."""
    also = "; ".join(gaps)
    if verdict is Verdict.FAIL:
        finding = "The demand exceeds the resistance over its whole band"
        return f"{finding}; besides, {also}." if gaps else f"{finding}."
    if verdict is Verdict.NOT_PROVEN:
        return f"Not proven: {also or 'the band of the demand spans the resistance'}."
    if is_slack:
        return "The member is slack in every case and needs no resistance."
    return "The demand stays within the resistance over its whole band."


def _assumed(*values: StandardValue | None) -> tuple[str, ...]:
    return tuple(v.id for v in values if v is not None and v.status == "assumed")


def check_inclination(low: float, high: float, standard: Standard) -> CheckResult:
    """Check a row's range of net inclination against the profile's range.

    Parameters
    ----------
    low, high : float
        Range of the angle between net and slope normal [rad].
    standard : Standard
        Profile that gives the limits.

    Returns
    -------
    CheckResult
        Pass if the range lies inside, fail if it lies outside, else not proven.
    """
    least, most = standard.find(MIN_INCLINATION), standard.find(MAX_INCLINATION)
    if least is None or most is None:
        verdict, clause = Verdict.NOT_PROVEN, "-"
        reason = "Not proven: the profile has no limits of the net inclination."
    else:
        verdict = judge(low, high, least=least.value_si, most=most.value_si)
        clause = least.clause
        reason = _explain_inclination(verdict, low, high, least.value, most.value)
    return CheckResult(
        id="geometry.inclination",
        clause=clause,
        member="net",
        mode="inclination",
        verdict=verdict,
        reason=reason,
        assumed=_assumed(least, most),
    )


def _explain_inclination(
    verdict: Verdict, low: float, high: float, least: float, most: float
) -> str:
    place = {
        Verdict.PASS: "lies inside",
        Verdict.FAIL: "lies outside",
        Verdict.NOT_PROVEN: "is not all inside",
    }[verdict]
    given = f"{degree_from_radian(low):g} to {degree_from_radian(high):g} degrees"
    return f"The net inclination {given} {place} {least:g} to {most:g} degrees."
