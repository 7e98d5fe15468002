"""Demand with its error band against a resistance, or a number against a limit.

First: characteristic resistances and proof loads from pull-out tests. Theory:
resistance/THEORY.md, (R1) and (R15).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from netdesign.calculation.quantity import Kind, Quantity, leaf
from netdesign.calculation.steps import list_steps
from netdesign.checks.check import Check
from netdesign.checks.forces import rate, resist_by_tests
from netdesign.checks.inputs import GivenResistance
from netdesign.checks.loader import Standard
from netdesign.checks.rating import Open, OpenKind, Rating
from netdesign.checks.schema import (
    ACCEPTANCE_TEST,
    ACTION_FACTOR,
    CORRELATION_LEAST,
    CORRELATION_MEAN,
    TEST_COUNT,
    UPLIFT_FACTOR,
    StandardValue,
)
from netdesign.outcome import Verdict
from netdesign.resistance.ground import PullOutTests
from netdesign.units import kilonewton_from_newton
from netdesign.words.catalogue import name, name_member, name_mode
from netdesign.words.message import Message, say

_CORRELATIONS = (CORRELATION_MEAN, CORRELATION_LEAST)


def find_tested_resistance(
    tests: PullOutTests, standard: Standard, source: str, what: Message
) -> Quantity:
    """Characteristic pull-out resistance from tests, R_k [kN].

    By mean and least; what a held test bears beyond its load does not count. Without a
    value, with the reason, where the profile has no factor for so many tests.

    Parameters
    ----------
    tests : PullOutTests
        On the site.
    standard : Standard
        Profile that gives correlation factors.
    source : str
        Cell of the tests.
    what : Message
        Type and cell, for a reason.
    """
    factors = _find_correlations(tests.count, standard)
    if factors is None:
        lack = say("check.no_correlation", count=tests.count, what=what)
        return leaf("R_k", None, "kN", source, lack=lack)
    on_mean, on_least = (
        leaf(symbol, factor, "-", key, kind=Kind.PROFILE)
        for symbol, factor, key in zip(
            ("ξ_m", "ξ_min"), factors, _CORRELATIONS, strict=True
        )
    )
    mean, least = (
        leaf(symbol, kilonewton_from_newton(force), "kN", source)
        for symbol, force in (("R_m", tests.mean), ("R_min", tests.least))
    )
    return resist_by_tests(mean, on_mean, least, on_least)


def _find_correlations(count: int, standard: Standard) -> list[float] | None:
    """Factors on mean and least of so many tests [-]; None where one is missing."""
    tables = [standard.find_table(key) for key in _CORRELATIONS]
    factors = [table.find(count) if table else None for table in tables]
    stated = [factor for factor in factors if factor is not None]
    return stated if len(stated) == len(factors) else None


def find_proof_factor(standard: Standard) -> float | None:
    """Proof load over the design force of an anchor [-]; resistance/THEORY.md, (R15).

    So many tests as are wanted that hold it prove the anchor by the correlation
    factors; an acceptance test of the profile may ask for more. None where it does not
    follow.
    """
    limit = standard.find(TEST_COUNT)
    design = standard.find_resistance_factor("pull_out", "tested")
    if limit is None or design is None:
        return None
    factors = _find_correlations(math.ceil(limit.value), standard)
    acceptance = standard.find(ACCEPTANCE_TEST)
    least = acceptance.value if acceptance else 0.0
    return None if factors is None else max(max(factors) * design.value, least)


_NET = "net"


@dataclass(frozen=True, slots=True, kw_only=True)
class RatedForce:
    """A force on a member against its resistance, whose steps are not written yet.

    Attributes
    ----------
    resistance : GivenResistance
        Names member and mode.
    used : Quantity
        Utilisation with all that it follows from [-].
    clause : str
        Of the partial factor on the resistance.
    open : tuple of Open
        What is open of force and resistance.
    """

    resistance: GivenResistance
    used: Quantity
    clause: str
    open: tuple[Open, ...]

    @property
    def rating(self) -> Rating:
        """How far the check is met."""
        demand = self.used.of[0]
        return Rating(
            low=self.used.low,
            high=self.used.high,
            open=self.open,
            demand=demand.high,
        )

    def with_open(self, kind: OpenKind, *messages: Message) -> RatedForce:
        """The same with further open points of a kind."""
        points = (Open(kind=kind, message=message) for message in messages)
        return replace(self, open=(*self.open, *points))

    def write(self, beside: Sequence[Quantity] = ()) -> Check:
        """Check with its steps; ``beside`` are forces beside the one that decides."""
        resistance = self.resistance
        return Check(
            id=f"{resistance.member}.{resistance.mode}",
            clause=self.clause,
            member=resistance.member,
            mode=resistance.mode,
            resistance_basis=resistance.basis,
            resistance_type=resistance.type_id,
            resistance_cell=resistance.source,
            steps=list_steps(*beside, self.used),
            open=list(self.open),
        )


def rate_member(
    action: Quantity,
    resistance: GivenResistance,
    standard: Standard,
    points: Sequence[Open] = (),
    *,
    strength: Quantity | None = None,
) -> RatedForce:
    """Rate one member in one mode: design force against design resistance.

    Parameters
    ----------
    action : Quantity
        Largest characteristic force over the solved cases, per anchor [kN]; without a
        value if no case was solved.
    resistance : GivenResistance
        Names member and mode; its value may be missing.
    standard : Standard
        Profile that gives the partial factors.
    points : sequence of Open
        What is open of force and resistance, as "3 of 40 cases failed". With any of
        them nothing passes.
    strength : Quantity, optional
        R_k [kN]; that of ``resistance`` unless told otherwise.

    Returns
    -------
    RatedForce
        Never a pass where anything needed is missing: that is an open point, too.
    """
    strength = strength or find_resistance(resistance, standard)
    on_action = find_action_factor(standard, resistance.mode)
    on_resistance, clause = _find_resistance_factor(resistance, standard, strength)
    used = rate(action, on_action, strength, on_resistance)
    rated = RatedForce(
        resistance=resistance, used=used, clause=clause, open=tuple(points)
    )
    messages = {point.message for point in points}
    lacks = (lack for lack in used.lacks if lack not in messages)
    return rated.with_open(OpenKind.RESISTANCE_MISSING, *lacks)


def compare(
    mode: str,
    met: Verdict,
    finding: Message | None,
    limit: StandardValue | None = None,
    *,
    member: str = _NET,
) -> Check:
    """Check that compares no force with a resistance: of the geometry, or of a member.

    ``met`` is its verdict by the numbers alone, ``finding`` the sentence of that;
    ``limit`` is the value of the profile whose clause stands beside it.
    """
    subject = "geometry" if member == _NET else member
    return Check(
        id=f"{subject}.{mode}",
        clause=limit.clause if limit else "-",
        member=member,
        mode=mode,
        met=met,
        finding=finding,
    )


def leave_open(
    mode: str, kind: OpenKind, *reasons: Message, member: str = _NET
) -> Check:
    """Check that compares nothing, since something is missing."""
    return compare(mode, Verdict.NOT_PROVEN, None, member=member).with_open(
        kind, *reasons
    )


def find_action_factor(standard: Standard, mode: str = "") -> Quantity:
    """Factor on the action, gamma_E: on that of uplift its own, where there is one."""
    is_uplift = mode == "tension" and standard.find(UPLIFT_FACTOR) is not None
    key = UPLIFT_FACTOR if is_uplift else ACTION_FACTOR
    return find_profile_value(standard, key, "γ_E")


def find_profile_value(standard: Standard, key: str, symbol: str) -> Quantity:
    """Value of a profile under its symbol, in the profile's unit."""
    limit = standard.find(key)
    return leaf(
        symbol,
        limit.value if limit else None,
        limit.unit if limit else "-",
        key,
        kind=Kind.PROFILE,
        lack=None if limit else lack_factor(key),
    )


def find_missing_force(reason: Message) -> Quantity:
    """Characteristic force that is not known."""
    return leaf("E_k", None, "kN", "", kind=Kind.SOLVED, lack=reason)


def find_partial_factor(
    resistance: GivenResistance, standard: Standard
) -> StandardValue | None:
    """Factor on a resistance by its mode and basis; the largest of several modes.

    None where the profile lacks one of them. A tendon that may be a rope has those of
    steel and of ropes: resistance/THEORY.md, (R31).
    """
    factors = [factor for _, factor in _list_factors(resistance, standard)]
    stated = [factor for factor in factors if factor is not None]
    is_whole = len(stated) == len(factors)
    return max(stated, key=lambda factor: factor.value_si) if is_whole else None


def _list_factors(
    resistance: GivenResistance, standard: Standard
) -> list[tuple[str, StandardValue | None]]:
    """Factors by the modes that they are of."""
    modes = resistance.factored_as or (resistance.mode,)
    return [
        (mode, standard.find_resistance_factor(mode, resistance.basis))
        for mode in modes
    ]


def _find_resistance_factor(
    resistance: GivenResistance, standard: Standard, strength: Quantity
) -> tuple[Quantity, str]:
    """Factor of the mode on its basis, gamma_R, and its clause."""
    limit = find_partial_factor(resistance, standard)
    if limit is not None:
        factor = leaf("γ_R", limit.value_si, "-", limit.id, kind=Kind.PROFILE)
        return factor, limit.clause
    factors = _list_factors(resistance, standard)
    mode = next(mode for mode, factor in factors if factor is None)
    source = f"resistance.{mode}"
    ids = (value.id for value in standard.values)
    bases = [key.removeprefix(f"{source}.") for key in ids if f"{source}." in key]
    if not bases:
        named = say("factor.resistance", mode=name_mode(mode))
        lack = say("check.no_factor", factor=named, id=source)
    elif strength.lacks and not resistance.basis:
        # without a resistance there is no basis yet, and no factor to miss
        lack = strength.lacks[0]
    else:
        lack = say(
            "check.no_factor_of_basis",
            mode=name_mode(mode),
            basis=name("basis", resistance.basis),
            known=tuple(name("basis", base) for base in bases),
        )
    return leaf("γ_R", None, "-", source, kind=Kind.PROFILE, lack=lack), "-"


def find_resistance(resistance: GivenResistance, standard: Standard) -> Quantity:
    """Characteristic resistance, R_k [kN], as given or from tests.

    Without a value, with the reason, where it cannot be known or used.
    """
    what, source = _name_place(resistance), resistance.source
    value, tests = resistance.value, resistance.tests
    if value is not None:
        if not 0.0 < value < math.inf:
            lack = say("check.resistance_not_usable", value=value, what=what)
            return leaf("R_k", None, "kN", source, lack=lack)
        ends = (value, max(value, resistance.best or 0.0))
        low, high = map(kilonewton_from_newton, ends)
        return leaf("R_k", low, "kN", source, band=(low, high))
    if tests is None:
        lack = resistance.lack or say("check.no_resistance", what=what)
        return leaf("R_k", None, "kN", source, lack=lack)
    return find_tested_resistance(tests, standard, source, what)


def _name_place(resistance: GivenResistance) -> Message:
    """Type, or member and mode, with the cell of a resistance."""
    if resistance.type_id:
        kind = say("check.type", type=resistance.type_id)
    else:
        member, mode = name_member(resistance.member), name_mode(resistance.mode)
        kind = say("check.member_in_mode", member=member, mode=mode)
    return say("check.of_cell", what=kind, cell=resistance.source)


def lack_factor(factor: str) -> Message:
    """Message that a profile lacks a value, by its name and its id."""
    return say("check.no_factor", factor=name("factor", factor), id=factor)
