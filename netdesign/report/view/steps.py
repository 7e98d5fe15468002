"""The calculation of a check, line by line: symbols, numbers, result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from netdesign.calculation.formula import PRINTED, write_formula
from netdesign.calculation.quantity import Quantity
from netdesign.calculation.steps import evaluate
from netdesign.report.view.check_view import name_case
from netdesign.report.words import MISSING, UNBOUNDED, Words, show_check
from netdesign.study.records import CheckRecord

Show = Callable[[Quantity], str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """One line of a worked calculation: ``symbols = numbers = result``."""

    symbols: str
    numbers: str
    result: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Worked:
    """The calculation of one check with its numbers put in."""

    title: str
    steps: tuple[Step, ...]
    needed: str


def work_out(check: CheckRecord, words: Words) -> Worked:
    """Worked calculation of a check of a force."""
    demand = check.known.get("E_d")
    _, needed = check.read_band("E_d")
    unit = demand.unit if demand else ""
    return Worked(
        title=words(
            "show.row_at_case",
            check=show_check(words, check),
            case=name_case(check, words),
        ),
        steps=list_steps(check, words),
        needed=words(
            "show.needed",
            verdict=words(f"verdict.{check.verdict}"),
            force=words.show_symbol("E_d", unit, needed),
        ),
    )


def list_steps(check: CheckRecord, words: Words) -> tuple[Step, ...]:
    """Every quantity that is worked out, from the solved force to the utilisation."""
    found = evaluate(check.steps).values()
    is_derived = bool(check.resistance_derivation)
    return tuple(
        _describe(one, check, words)
        for one in found
        if one.operation or (one.symbol == "R_k" and is_derived)
    )


def _describe(one: Quantity, check: CheckRecord, words: Words) -> Step:
    symbol = one.symbol
    if check.is_unbounded and symbol in ("R_d", "μ"):  # nothing is left to resist
        if symbol == "R_d":
            reason = words.show(check.reason)
            return Step(symbols=symbol, numbers=reason, result=MISSING)
        told = words("show.nothing_resists")
        return Step(symbols=symbol, numbers=told, result=UNBOUNDED)

    def show(quantity: Quantity) -> str:
        return words.show_symbol(quantity.symbol, quantity.unit, quantity.value)

    if not one.operation:  # from dimensions, in the words of its derivation
        told = words.show(check.resistance_derivation)
        return Step(symbols=symbol, numbers=told, result=show(one))
    symbols = write_numbers(one, lambda quantity: quantity.symbol, words)
    return Step(
        symbols=f"{symbol} = {symbols}",
        numbers=write_numbers(one, show, words),
        result=_show_ratio(check, words) if symbol == "μ" else show(one),
    )


def write_numbers(quantity: Quantity, show: Show, words: Words) -> str:
    """Formula of a quantity with what is shown of each one that it is made of."""
    notation = replace(PRINTED, number=words.show_given)
    return write_formula(quantity, lambda one, _: show(one), notation)


def _show_ratio(check: CheckRecord, words: Words) -> str:
    low, high = check.used_band
    return words(
        "show.with_band",
        value=words.show_number("utilisation", check.used),
        band=words.show_band("utilisation", low, high),
    )
