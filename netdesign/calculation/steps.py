"""A calculation as the list of its named quantities, each after those it is made of.

The list is what a file holds, and what a reader follows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from netdesign.calculation.formula import require_formula, write_formula
from netdesign.calculation.quantity import Kind, Quantity
from netdesign.outcome import ContentError
from netdesign.words.message import say


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


def require_calculation(steps: Sequence[Step]) -> None:
    """Refuse steps of a document of which one does not rest on those before it.

    Raises
    ------
    ContentError
        With the symbol that occurs twice, or the formula.
    """
    known: set[str] = set()
    for step in steps:
        if step.symbol in known:
            raise ContentError(say("calculation.twice", symbol=step.symbol))
        if step.formula:
            require_formula(step.formula, known)
        known.add(step.symbol)
