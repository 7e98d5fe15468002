"""A calculation as the list of its named quantities, each after those it is made of.

The list is what a file holds, and what a reader follows. `evaluate` works it out again
from its leaves, so that a number that does not follow is found.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

from netdesign.calculation.formula import read_formula, write_formula
from netdesign.calculation.quantity import Kind, Quantity, given
from netdesign.outcome import ContentError
from netdesign.words.message import Message, say

SAME = 1e-9  # relative; of a stored number and the same worked out again


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """One named quantity of a calculation, as a file has it.

    ``low`` and ``high`` are None where they are the value; ``value`` is None where it
    is missing. ``formula`` is "" of a leaf.
    """

    LEAVES_OUT_NONE: ClassVar[bool] = True

    symbol: str
    unit: str
    value: float | None = None
    low: float | None = None
    high: float | None = None
    kind: Kind
    source: str = ""
    formula: str = ""

    @property
    def ends(self) -> tuple[float | None, float | None, float | None]:
        """Low end, value, high end."""
        low = self.value if self.low is None else self.low
        return low, self.value, self.value if self.high is None else self.high


def list_named(quantity: Quantity) -> list[Quantity]:
    """Quantities under a symbol that one rests on, and itself, in their order."""
    found: dict[str, Quantity] = {}
    _collect(quantity, found)
    return list(found.values())


def _collect(quantity: Quantity, found: dict[str, Quantity]) -> None:
    known = found.get(quantity.symbol) if quantity.symbol else None
    if known is not None:
        if known is not quantity and _differ(known, quantity):
            raise ValueError(f"two quantities are called {quantity.symbol}")
        return
    for one in quantity.of:
        _collect(one, found)
    if quantity.symbol:
        found[quantity.symbol] = quantity


def _differ(one: Quantity, other: Quantity) -> bool:
    ends = ((x.low, x.value, x.high, x.operation) for x in (one, other))
    return len(set(ends)) > 1


def list_steps(quantity: Quantity) -> list[Step]:
    """Steps of a calculation; a quantity under the same symbol stands once."""
    return [_record(one) for one in list_named(quantity)]


def _record(one: Quantity) -> Step:
    return Step(
        symbol=one.symbol,
        unit=one.unit,
        value=one.value,
        low=None if one.low == one.value else one.low,
        high=None if one.high == one.value else one.high,
        kind=one.kind,
        source=one.source,
        formula=write_formula(one),
    )


def evaluate(steps: Sequence[Step]) -> dict[str, Quantity]:
    """Quantities of a calculation by their symbols, worked out from its leaves.

    Raises
    ------
    ContentError
        If a step is none of a calculation, or rests on one that comes later.
    ModelError
        If units do not fit.
    """
    known: dict[str, Quantity] = {}
    for step in steps:
        if step.symbol in known:
            raise ContentError(say("calculation.twice", symbol=step.symbol))
        if step.formula:
            made = read_formula(step.formula, known)
            known[step.symbol] = made.named(step.symbol, step.unit, step.source)
        else:
            known[step.symbol] = _read_leaf(step)
    return known


def _read_leaf(step: Step) -> Quantity:
    low, value, high = step.ends
    band = None if low is None or high is None else (low, high)
    lack = say("calculation.missing", symbol=step.symbol) if value is None else None
    return given(
        *(step.symbol, value, step.unit, step.source),
        kind=step.kind,
        band=band,
        lack=lack,
    )


def compare_steps(steps: Sequence[Step]) -> Iterator[Message]:
    """Sentences on the steps whose stored numbers do not follow from the leaves."""
    again = evaluate(steps)
    for step in steps:
        found = again[step.symbol]
        pairs = zip(step.ends, (found.low, found.value, found.high), strict=True)
        for stored, follows in pairs:
            if not is_same(stored, follows):
                yield say(
                    "calculation.unequal",
                    symbol=step.symbol,
                    stored=_show(stored),
                    follows=_show(follows),
                )
                break


def _show(number: float | None) -> Message:
    return say("value.none") if number is None else say("value.number", number=number)


def is_same(one: float | None, other: float | None) -> bool:
    """Both are the same number but for rounding, or both are missing."""
    if one is None or other is None:
        return one is other
    return math.isclose(one, other, rel_tol=SAME, abs_tol=1e-12)
