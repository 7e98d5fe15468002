"""Cost of what is built, from the prices of its types."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from netdesign.study.parts import PartRecord

NET = "net"  # name of the net among the types; its size is an area
Per = Literal["piece", "m", "m2"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Price:
    """Price of one type, in any currency.

    Attributes
    ----------
    amount : float
        0 or more.
    per : str
        "piece", "m" of its length, or "m2" of the net.
    """

    amount: float
    per: Per


# All prices of each type: a piece and its drilled metres may both cost something.
Prices = Mapping[str, tuple[Price, ...]]


def find_unit_cost(part: PartRecord, prices: Prices) -> float | None:
    """Cost of one part; None where a price or the size that it needs is not given."""
    found = prices.get(part.type_id or part.part, ())
    if part.size is None and any(one.per != "piece" for one in found):
        return None
    size = part.size or 0.0
    costs = [one.amount * (1.0 if one.per == "piece" else size) for one in found]
    return sum(costs) if costs else None


def add_costs(
    parts: Iterable[PartRecord], prices: Prices
) -> tuple[float, tuple[str, ...]]:
    """Cost of some parts, and the types of which it is not known."""
    total, unknown = 0.0, dict[str, None]()
    for part in parts:
        cost = find_unit_cost(part, prices)
        if cost is None or part.count is None:
            unknown[part.type_id or part.part] = None
        else:
            total += cost * part.count
    return total, tuple(unknown)
