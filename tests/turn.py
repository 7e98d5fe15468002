"""Checks and rows with another verdict, by numbers and open points that give it."""

import math
from dataclasses import replace

from netdesign.checks import Proof
from netdesign.checks.rating import Open, OpenKind, rate_utilisation
from netdesign.outcome import Verdict
from netdesign.words.catalogue import as_given
from netdesign.words.message import Message, say

AS_IT_IS = -1.0
PROOF = Proof(document="Report G-17", author="B. R.", date="", cell="Declared!B2")
_USED = {Verdict.PASS: 0.5, Verdict.FAIL: 1.37, Verdict.DECLARED: 0.5}


def turn(check, verdict, *, utilisation=AS_IT_IS, reason=None, proof=None):
    """Check with a verdict, which its numbers and open points really give.

    Its ``utilisation`` stays where it allows the verdict; None: it is not known;
    infinite: nothing is left to resist. ``reason`` is the finding of a check without a
    force, else what is open.
    """
    told = reason if isinstance(reason, Message | None) else as_given(reason)
    bare = replace(check, open=[])
    turned = _turn_bare(bare, verdict, utilisation, told)
    if verdict is Verdict.NOT_PROVEN and (told or turned.verdict is not verdict):
        if turned.finding is None:
            told = told or say("check.no_case_solved")
            turned = turned.with_open(OpenKind.UNSOLVED, told)
    elif verdict is Verdict.DECLARED:
        found = proof or PROOF
        elsewhere = OpenKind.PROVEN_ELSEWHERE
        point = Open(kind=elsewhere, message=found.describe(), proof=found)
        turned = replace(turned, open=[*turned.open, point])
    elif verdict is Verdict.FAIL and told and turned.finding is None:
        kind = OpenKind.FAILS if utilisation == math.inf else OpenKind.UNSOLVED
        turned = turned.with_open(kind, told)
    assert turned.verdict is verdict
    return turned


def turn_row(row, verdict, **given):
    """Row of which every check has the same verdict."""
    return replace(row, checks=[turn(one, verdict, **given) for one in row.checks])


def use(check, utilisation):
    """Check with another utilisation; its forces change with it."""
    if utilisation is None or utilisation == math.inf:
        return _put(check, {"μ": None, "R_d": None, "R_k": None})
    resistance = check.resistance_kN
    if resistance is None:
        resistance = check.demand_kN / utilisation
        known = {"R_d": resistance, "R_k": resistance * (check.read("γ_R") or 1.0)}
        check = _put(check, known)
    design = utilisation * resistance
    forces = {
        step.symbol: design / check.read("γ_E")
        for step in check.steps
        if step.symbol[:2] in ("E_", "V_") and not check.utilisation
    }
    if check.utilisation:
        return _scale(check, utilisation / check.utilisation)
    return _put(check, forces | {"E_d": design, "μ": utilisation})


def _turn_bare(check, verdict, utilisation, told):
    if "μ" not in check.step_of:
        met = Verdict.PASS if verdict is Verdict.DECLARED else verdict
        return replace(check, met=met, finding=told or check.finding)
    if utilisation != AS_IT_IS:
        return use(check, utilisation)
    found = rate_utilisation(*check.utilisation_band)
    is_proven = (found, verdict) == (Verdict.PASS, Verdict.DECLARED)
    if found is verdict or verdict not in _USED or is_proven:
        return check
    return use(check, _USED[verdict])


def _put(check, values):
    steps = [
        replace(one, value=values[one.symbol], low=None, high=None)
        if one.symbol in values
        else one
        for one in check.steps
    ]
    return replace(check, steps=steps)


def _scale(check, factor):
    steps = []
    for one in check.steps:
        if one.symbol == "μ" or one.symbol[:2] in ("E_", "V_"):
            low, value, high = (x if x is None else x * factor for x in
                                (one.low, one.value, one.high))  # fmt: skip
            one = replace(one, low=low, value=value, high=high)
        steps.append(one)
    return replace(check, steps=steps)
