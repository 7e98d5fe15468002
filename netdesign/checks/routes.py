"""Ways from pull-out tests to a characteristic resistance, side by side.

The profile says which of them counts; the others decide nothing. Theory:
resistance/THEORY.md, (R1) and (R15) to (R17).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import ClassVar

from netdesign.calculation.quantity import Kind, Quantity, given
from netdesign.checks.forces import resist_by_fractile, resist_by_tests
from netdesign.checks.loader import Standard
from netdesign.checks.schema import (
    ACCEPTANCE_TEST,
    CORRELATION_LEAST,
    CORRELATION_MEAN,
    TEST_COUNT,
    TEST_SCATTER,
    Route,
)
from netdesign.outcome import ModelError
from netdesign.resistance.fractile import (
    Fractile,
    find_fractile,
    find_fractile_of_known_scatter,
)
from netdesign.resistance.pull_out import PullOutTests
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say
from netdesign.words.names import name

_CORRELATIONS = (CORRELATION_MEAN, CORRELATION_LEAST)


@dataclass(frozen=True, slots=True, kw_only=True)
class TestedResistance:
    """Characteristic pull-out resistance from tests.

    Attributes
    ----------
    routes : mapping of str to Quantity
        By each way [kN]; without a value with the reason.
    route : str
        Which of them counts.
    proof_factor : float or None
        Proof load of a test over the design force [-]; None where it does not follow.
    """

    __test__: ClassVar = False  # for pytest

    routes: Mapping[Route, Quantity]
    route: Route
    proof_factor: float | None

    @property
    def counting(self) -> Quantity:
        """Resistance that counts [kN]."""
        return self.routes[self.route]


def find_tested_resistance(
    tests: PullOutTests, standard: Standard, source: str, what: Message
) -> TestedResistance:
    """Characteristic pull-out resistance by each way, and which of them counts.

    Parameters
    ----------
    tests : PullOutTests
        On the site.
    standard : Standard
        Profile that gives correlation factors and scatter.
    source : str
        Cell of the tests.
    what : Message
        Type and cell, for a reason.
    """
    routes: dict[Route, Quantity] = {
        "correlation": _correlate(tests, standard, source, what),
        "scatter_known": _take_fractile(
            lambda: _find_with_scatter(tests, standard), tests, source
        ),
        "scatter_unknown": _take_fractile(
            lambda: find_fractile(tests.singles), tests, source
        ),
    }
    return TestedResistance(
        routes=routes, route=standard.route, proof_factor=find_proof_factor(standard)
    )


def _correlate(
    tests: PullOutTests, standard: Standard, source: str, what: Message
) -> Quantity:
    """By mean and least; what a held test bears beyond its load does not count."""
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


def _take_fractile(
    find: Callable[[], Fractile], tests: PullOutTests, source: str
) -> Quantity:
    if not tests.singles:
        lack = say("tests.singles_wanted")
        return given("R_k", None, "kN", source, lack=lack)
    try:
        found = find()
    except ModelError as error:
        return given("R_k", None, "kN", source, lack=error.message)
    median = given("R_G", kilonewton_from_newton(found.median), "kN", source)
    return resist_by_fractile(median, given("ξ_5", found.factor, "-", source))


def _find_with_scatter(tests: PullOutTests, standard: Standard) -> Fractile:
    scatter = standard.find(TEST_SCATTER)
    if scatter is None:
        factor = name("factor", TEST_SCATTER)
        raise ModelError(say("check.no_factor", factor=factor, id=TEST_SCATTER))
    return find_fractile_of_known_scatter(tests.singles, scatter.value)


def find_wanted(standard: Standard) -> int | None:
    """Number of tests of each type in each ground; None where no profile says it."""
    found = standard.find(TEST_COUNT)
    return None if found is None else math.ceil(found.value)


def find_proof_factor(standard: Standard) -> float | None:
    """Proof load over the design force of an anchor [-]; resistance/THEORY.md, (R18).

    So many tests as are wanted that hold it prove the anchor by the correlation
    factors; an acceptance test of the profile may ask for more. None where it does not
    follow.
    """
    count = find_wanted(standard)
    design = standard.find_resistance_factor("pull_out", "tested")
    if count is None or design is None:
        return None
    factors = [_find_correlation(count, standard, key) for key in _CORRELATIONS]
    known = [one for one in factors if one is not None]
    if len(known) < len(factors):
        return None
    acceptance = standard.find(ACCEPTANCE_TEST)
    return max(max(known) * design.value, acceptance.value if acceptance else 0.0)
