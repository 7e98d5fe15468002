"""Demand with its error band against a limit: pass, fail or not proven."""

from __future__ import annotations

import math
from dataclasses import replace

from netdesign.checks.loader import Standard, StandardValue
from netdesign.checks.result import Band, CheckResult, Declaration, GivenResistance
from netdesign.checks.schema import (
    ACTION_FACTOR,
    CORRELATION_LEAST,
    CORRELATION_MEAN,
)
from netdesign.outcome import Verdict
from netdesign.resistance.pull_out import compute_pull_out_from_tests
from netdesign.words.message import Message, say
from netdesign.words.names import name, name_member, name_mode


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
        Range that is accepted, both ends included, in the unit of the band; ``most``
        may be infinite.
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
    is_known = all(math.isfinite(number) for number in (low, high, least))
    if not (is_known and low <= high and most > -math.inf):
        return Verdict.NOT_PROVEN
    if low > most or high < least:
        return Verdict.FAIL
    if is_complete and least <= low and high <= most:
        return Verdict.PASS
    return Verdict.NOT_PROVEN


def check_member(
    action: Band | None,
    resistance: GivenResistance,
    standard: Standard,
    *,
    gap: Message | None,
    doubt: Message | None = None,
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
    gap : Message or None
        Why the action does not cover every case ("3 of 40 cases failed"); None if it
        does. With a gap nothing passes.
    doubt : Message, optional
        Why the model itself may not hold for the action. With a doubt nothing passes.

    Returns
    -------
    CheckResult
        Never a pass where anything needed is missing.
    """
    if action is None:
        gap = gap or say("check.no_case_solved")
    on_action = standard.find(ACTION_FACTOR)
    on_resistance = standard.find_resistance_factor(resistance.mode, resistance.basis)
    demand = action.times(on_action.value_si) if action and on_action else None
    characteristic, lack = find_characteristic(resistance, standard)
    strength = _design_resistance(characteristic, on_resistance)
    utilisation = demand.over(strength) if demand and strength else None
    open_points = [one for one in (gap, doubt) if one]
    gaps = [*open_points, *([lack] if lack else [])]
    gaps += _missing(resistance, standard, on_action, on_resistance)
    is_slack = action is not None and action.high == 0.0
    verdict = _judge_utilisation(utilisation, is_complete=not open_points)
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
        resistance=characteristic,
        resistance_factor=on_resistance.value_si if on_resistance else None,
        design_resistance=strength,
        utilisation=utilisation,
        assumed=list_assumed(on_action, on_resistance),
        correlation=find_correlation(resistance, standard),
    )


def declare(result: CheckResult, declaration: Declaration | None) -> CheckResult:
    """Check with what somebody declares of it: never a pass, and no failure less.

    What is computed stays beside it: numbers, and what they say.
    """
    if declaration is None:
        return result
    told = {"reason": result.reason, "proof": declaration.proof}
    if result.verdict is Verdict.FAIL:
        reason = say("check.fails_though_declared", **told)
        return replace(result, reason=reason, declaration=declaration)
    return replace(
        result,
        verdict=Verdict.DECLARED,
        reason=say("check.declared", **told),
        declaration=declaration,
    )


def withhold(result: CheckResult, reason: Message) -> CheckResult:
    """Check whose numbers are information only, and prove nothing either way."""
    told = not_proven(reason)
    return replace(result, verdict=Verdict.NOT_PROVEN, reason=told, is_unbounded=False)


def find_characteristic(
    resistance: GivenResistance, standard: Standard
) -> tuple[float | None, Message | None]:
    """Characteristic resistance, and what is missing for it.

    Parameters
    ----------
    resistance : GivenResistance
        A value, or tests from which it follows.
    standard : Standard
        Profile that gives the correlation factors of tests.

    Returns
    -------
    float or None
        [N]; None where it cannot be known.
    Message or None
        Why it cannot be known, or is not usable; None if it can.
    """
    what = _name_place(resistance)
    if resistance.value is not None:
        if _is_usable(resistance.value):
            return resistance.value, None
        value = resistance.value
        return value, say("check.resistance_not_usable", value=value, what=what)
    if resistance.tests is None:
        return None, resistance.lack or say("check.no_resistance", what=what)
    factors = find_correlation(resistance, standard)
    if factors is None:
        count = resistance.tests.count
        return None, say("check.no_correlation", count=count, what=what)
    on_mean, on_least = factors
    value = compute_pull_out_from_tests(
        resistance.tests, correlation_mean=on_mean, correlation_least=on_least
    )
    return value, None


def find_correlation(
    resistance: GivenResistance, standard: Standard
) -> tuple[float, float] | None:
    """Factors on mean and least of tests; None without tests, or without factors."""
    if resistance.value is not None or resistance.tests is None:
        return None
    tables = map(standard.find_table, (CORRELATION_MEAN, CORRELATION_LEAST))
    factors = [one.find(resistance.tests.count) if one else None for one in tables]
    on_mean, on_least = factors
    return None if on_mean is None or on_least is None else (on_mean, on_least)


def _name_place(resistance: GivenResistance) -> Message:
    """Type, or member and mode, with the cell of a resistance."""
    if resistance.type_id:
        kind = say("check.type", type=resistance.type_id)
    else:
        member, mode = name_member(resistance.member), name_mode(resistance.mode)
        kind = say("check.member_in_mode", member=member, mode=mode)
    return say("check.of_cell", what=kind, cell=resistance.source)


def _judge_utilisation(utilisation: Band | None, *, is_complete: bool) -> Verdict:
    if utilisation is None:
        return Verdict.NOT_PROVEN
    return judge(
        utilisation.low, utilisation.high, least=0.0, most=1.0, is_complete=is_complete
    )


def _design_resistance(
    value: float | None, factor: StandardValue | None
) -> float | None:
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
) -> list[Message]:
    """List the factors that a utilisation lacks, by their names."""
    lacks = []
    if on_action is None:
        lacks.append(lack_factor(ACTION_FACTOR))
    if on_resistance is None and not _has_factor_of_some_basis(resistance, standard):
        lacks.append(_lack_resistance_factor(resistance, standard))
    return lacks


def lack_factor(factor: str) -> Message:
    """Lack of a profile's value, by its name and its id."""
    return say("check.no_factor", factor=name("factor", factor), id=factor)


def _lack_resistance_factor(resistance: GivenResistance, standard: Standard) -> Message:
    """Lack of a factor of a mode; it may have one on another basis."""
    mode = name_mode(resistance.mode)
    of_mode = f"resistance.{resistance.mode}"
    ids = (value.id for value in standard.values)
    known = [
        one.removeprefix(f"{of_mode}.") for one in ids if one.startswith(f"{of_mode}.")
    ]
    if not known:
        factor = say("factor.resistance", mode=mode)
        return say("check.no_factor", factor=factor, id=of_mode)
    return say(
        "check.no_factor_of_basis",
        mode=mode,
        basis=name("basis", resistance.basis),
        known=tuple(name("basis", one) for one in known),
    )


def _has_factor_of_some_basis(resistance: GivenResistance, standard: Standard) -> bool:
    """Without a resistance there is no basis yet, and no factor to miss."""
    prefix = f"resistance.{resistance.mode}."
    return not resistance.basis and any(
        value.id.startswith(prefix) for value in standard.values
    )


def _explain(verdict: Verdict, gaps: list[Message], *, is_slack: bool) -> Message:
    """One sentence without digits, so that rounding cannot contradict it."""
    also = tuple(gaps)
    if verdict is Verdict.FAIL:
        if also:
            return say("check.fails_besides", gaps=also)
        return say("check.fails")
    if verdict is Verdict.NOT_PROVEN:
        return not_proven(*also or (say("check.band_spans_resistance"),))
    return say("check.slack") if is_slack else say("check.passes")


def not_proven(*gaps: Message) -> Message:
    """The sentence of a check that is not proven, with what is missing."""
    return say("check.not_proven", gaps=gaps)


def list_assumed(*values: StandardValue | None) -> tuple[str, ...]:
    """Ids of those values of a profile that nobody has confirmed."""
    return tuple(v.id for v in values if v is not None and v.status == "assumed")
