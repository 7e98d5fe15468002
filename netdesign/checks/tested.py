"""From pull-out tests to a characteristic resistance, and to the load of a test.

Theory: resistance/THEORY.md, (R1) and (R15).
"""

from __future__ import annotations

import math

from netdesign.calculation.quantity import Kind, Quantity, given
from netdesign.checks.forces import resist_by_tests
from netdesign.checks.loader import Standard
from netdesign.checks.schema import (
    ACCEPTANCE_TEST,
    CORRELATION_LEAST,
    CORRELATION_MEAN,
    TEST_COUNT,
)
from netdesign.resistance.pull_out import PullOutTests
from netdesign.units import kilonewton_from_newton
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
    factors = [_find_correlation(tests.count, standard, key) for key in _CORRELATIONS]
    if None in factors:
        lack = say("check.no_correlation", count=tests.count, what=what)
        return given("R_k", None, "kN", source, lack=lack)
    on_mean, on_least = (
        given(symbol, factor, "-", key, kind=Kind.PROFILE)
        for symbol, factor, key in zip(
            ("ξ_m", "ξ_min"), factors, _CORRELATIONS, strict=True
        )
    )
    mean, least = (
        given(symbol, kilonewton_from_newton(force), "kN", source)
        for symbol, force in (("R_m", tests.mean), ("R_min", tests.least))
    )
    return resist_by_tests(mean, on_mean, least, on_least)


def _find_correlation(count: int, standard: Standard, key: str) -> float | None:
    table = standard.find_table(key)
    return table.find(count) if table else None


def find_wanted(standard: Standard) -> int | None:
    """Number of tests of each type in each ground; None where no profile says it."""
    limit = standard.find(TEST_COUNT)
    return None if limit is None else math.ceil(limit.value)


def find_proof_factor(standard: Standard) -> float | None:
    """Proof load over the design force of an anchor [-]; resistance/THEORY.md, (R15).

    So many tests as are wanted that hold it prove the anchor by the correlation
    factors; an acceptance test of the profile may ask for more. None where it does not
    follow.
    """
    count = find_wanted(standard)
    design = standard.find_resistance_factor("pull_out", "tested")
    if count is None or design is None:
        return None
    factors = [_find_correlation(count, standard, key) for key in _CORRELATIONS]
    stated = [factor for factor in factors if factor is not None]
    if len(stated) < len(factors):
        return None
    acceptance = standard.find(ACCEPTANCE_TEST)
    return max(max(stated) * design.value, acceptance.value if acceptance else 0.0)
