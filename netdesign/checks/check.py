"""Demand with its error band against a limit: pass, fail or not proven."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from netdesign.calculation.quantity import Kind, Quantity, given
from netdesign.checks.forces import rate
from netdesign.checks.loader import Standard, StandardValue
from netdesign.checks.result import CheckResult, Declaration, GivenResistance
from netdesign.checks.schema import ACTION_FACTOR, list_action_factors
from netdesign.checks.tested import find_tested_resistance
from netdesign.outcome import Verdict
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say
from netdesign.words.names import name, name_member, name_mode

_NET = "net"


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
    action: Quantity,
    resistance: GivenResistance,
    standard: Standard,
    *,
    gap: Message | None,
    doubt: Message | None = None,
    strength: Quantity | None = None,
) -> CheckResult:
    """Check one member in one mode: design force against design resistance.

    Parameters
    ----------
    action : Quantity
        Largest characteristic force over the solved cases, per anchor [kN]; without a
        value if no case was solved.
    resistance : GivenResistance
        Names member and mode; its value may be missing.
    standard : Standard
        Profile that gives the partial factors.
    gap : Message or None
        Why the action does not cover every case ("3 of 40 cases failed"); None if it
        does. With a gap nothing passes.
    doubt : Message, optional
        Why the model itself may not hold for the action. With a doubt nothing passes.
    strength : Quantity, optional
        R_k [kN]; that of ``resistance`` unless told otherwise.

    Returns
    -------
    CheckResult
        Never a pass where anything needed is missing.
    """
    strength = strength or find_resistance(resistance, standard)
    on_action = find_action_factor(standard, resistance.mode)
    on_resistance, clause = _find_resistance_factor(resistance, standard, strength)
    used = rate(action, on_action, strength, on_resistance)
    open_points = tuple(one for one in (gap, doubt) if one)
    gaps = tuple(dict.fromkeys((*open_points, *used.lacks)))
    verdict = judge_utilisation(used.low, used.high, is_complete=not open_points)
    return CheckResult(
        id=f"{resistance.member}.{resistance.mode}",
        clause=clause,
        member=resistance.member,
        mode=resistance.mode,
        verdict=verdict,
        reason=_explain(verdict, gaps, is_slack=action.high == 0.0),
        used=used,
    )


def conclude(
    mode: str,
    verdict: Verdict,
    reason: Message,
    limit: StandardValue | None = None,
    *,
    member: str = _NET,
) -> CheckResult:
    """Check that compares no force with a resistance: of the geometry, or of a member.

    ``limit`` is the value of the profile whose clause stands beside it.
    """
    subject = "geometry" if member == _NET else member
    return CheckResult(
        id=f"{subject}.{mode}",
        clause=limit.clause if limit else "-",
        member=member,
        mode=mode,
        verdict=verdict,
        reason=reason,
    )


def find_action_factor(standard: Standard, mode: str = "") -> Quantity:
    """Factor on the action, gamma_E: on that of uplift its own, where there is one."""
    values = map(standard.find, list_action_factors(mode))
    found = next((one for one in values if one), None)
    lack = None if found else lack_factor(ACTION_FACTOR)
    source = found.id if found else ACTION_FACTOR
    return given(
        *("γ_E", found.value_si if found else None, "-", source),
        kind=Kind.PROFILE,
        lack=lack,
    )


def find_profile_value(standard: Standard, key: str, symbol: str) -> Quantity:
    """Value of a profile under its symbol, in the profile's unit."""
    found = standard.find(key)
    return given(
        symbol,
        found.value if found else None,
        found.unit if found else "-",
        key,
        kind=Kind.PROFILE,
        lack=None if found else lack_factor(key),
    )


def find_missing_force(reason: Message) -> Quantity:
    """Characteristic force that is not known."""
    return given("E_k", None, "kN", "", kind=Kind.SOLVED, lack=reason)


def _find_resistance_factor(
    resistance: GivenResistance, standard: Standard, strength: Quantity
) -> tuple[Quantity, str]:
    """Factor of the mode on its basis, gamma_R, and its clause."""
    found = standard.find_resistance_factor(resistance.mode, resistance.basis)
    if found is not None:
        factor = given("γ_R", found.value_si, "-", found.id, kind=Kind.PROFILE)
        return factor, found.clause
    source = f"resistance.{resistance.mode}"
    ids = (value.id for value in standard.values)
    bases = [
        one.removeprefix(f"{source}.") for one in ids if one.startswith(f"{source}.")
    ]
    lack = _lack_resistance_factor(resistance, bases)
    # without a resistance there is no basis yet, and no factor to miss
    if bases and not resistance.basis and strength.lacks:
        lack = strength.lacks[0]
    return given("γ_R", None, "-", source, kind=Kind.PROFILE, lack=lack), "-"


def declare(result: CheckResult, declaration: Declaration | None) -> CheckResult:
    """Check with what somebody declares of it: never a pass, and no failure less.

    What is computed stays beside it: numbers, and what they say.
    """
    if declaration is None:
        return result
    told = {"reason": result.reason, "proof": declaration.proof.describe()}
    if result.verdict is Verdict.FAIL:
        reason = say("check.fails_though_declared", **told)
        return replace(result, reason=reason, declared=declaration.proof)
    return replace(
        result,
        verdict=Verdict.DECLARED,
        reason=say("check.declared", **told),
        declared=declaration.proof,
    )


def withhold(result: CheckResult, reason: Message) -> CheckResult:
    """Check whose numbers are information only, and prove nothing either way."""
    told = not_proven(reason)
    return replace(result, verdict=Verdict.NOT_PROVEN, reason=told, is_unbounded=False)


def find_resistance(resistance: GivenResistance, standard: Standard) -> Quantity:
    """Characteristic resistance, R_k [kN], as given or from tests.

    Without a value, with the reason, where it cannot be known or used.
    """
    what, source = _name_place(resistance), resistance.source
    value, tests = resistance.value, resistance.tests
    if value is not None:
        if not 0.0 < value < math.inf:
            lack = say("check.resistance_not_usable", value=value, what=what)
            return given("R_k", None, "kN", source, lack=lack)
        return given("R_k", kilonewton_from_newton(value), "kN", source)
    if tests is None:
        lack = resistance.lack or say("check.no_resistance", what=what)
        return given("R_k", None, "kN", source, lack=lack)
    return find_tested_resistance(tests, standard, source, what)


def _name_place(resistance: GivenResistance) -> Message:
    """Type, or member and mode, with the cell of a resistance."""
    if resistance.type_id:
        kind = say("check.type", type=resistance.type_id)
    else:
        member, mode = name_member(resistance.member), name_mode(resistance.mode)
        kind = say("check.member_in_mode", member=member, mode=mode)
    return say("check.of_cell", what=kind, cell=resistance.source)


def judge_utilisation(
    low: float | None, high: float | None, *, is_complete: bool
) -> Verdict:
    """Verdict on the band of a utilisation [-]; not proven where it is not known."""
    if low is None or high is None:
        return Verdict.NOT_PROVEN
    return judge(low, high, least=0.0, most=1.0, is_complete=is_complete)


def lack_factor(factor: str) -> Message:
    """Lack of a profile's value, by its name and its id."""
    return say("check.no_factor", factor=name("factor", factor), id=factor)


def _lack_resistance_factor(
    resistance: GivenResistance, known: Sequence[str]
) -> Message:
    """Lack of a factor of a mode; it may have one on other bases, which are known."""
    mode = name_mode(resistance.mode)
    if not known:
        factor = say("factor.resistance", mode=mode)
        of_mode = f"resistance.{resistance.mode}"
        return say("check.no_factor", factor=factor, id=of_mode)
    return say(
        "check.no_factor_of_basis",
        mode=mode,
        basis=name("basis", resistance.basis),
        known=tuple(name("basis", one) for one in known),
    )


def _explain(verdict: Verdict, also: Sequence[Message], *, is_slack: bool) -> Message:
    """One sentence without digits, so that rounding cannot contradict it."""
    if verdict is Verdict.FAIL:
        if also:
            return say("check.fails_besides", gaps=tuple(also))
        return say("check.fails")
    if verdict is Verdict.NOT_PROVEN:
        return not_proven(*also or (say("check.band_spans_resistance"),))
    return say("check.slack") if is_slack else say("check.passes")


def not_proven(*gaps: Message) -> Message:
    """The sentence of a check that is not proven, with what is missing."""
    return say("check.not_proven", gaps=gaps)
