"""Quantities of a check: value, band, unit, origin, and the operation that made them.

A quantity is given, solved or worked out. Arithmetic on quantities checks the unit,
carries the band and keeps the operands: `steps` writes them as a formula, in a file, in
a spreadsheet. Dimensions and the table of operations stand first. Theory: THEORY.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from typing import NamedTuple

from netdesign.outcome import ModelError
from netdesign.words.message import Message, say

# Powers of the base units: ``(("kN", 1), ("m", -2))``, in their order.
Dimension = tuple[tuple[str, int], ...]
PURE: Dimension = ()
_POWERS = tuple("123456789")
# A row is judged at many corners, most of whose quantities are alike.
_remember = lru_cache(maxsize=4096, typed=True)


@lru_cache
def multiply_dimension(first: Dimension, other: Dimension, power: int = 1) -> Dimension:
    """Dimension of the product with a power of another one."""
    sums = dict(first)
    for base, count in other:
        sums[base] = sums.get(base, 0) + power * count
    return tuple(sorted((base, count) for base, count in sums.items() if count))


def halve_dimension(square: Dimension) -> Dimension | None:
    """Dimension of the square root; None where it has none."""
    if any(count % 2 for _, count in square):
        return None
    return tuple((base, count // 2) for base, count in square)


@lru_cache
def find_dimension(unit: str) -> Dimension:
    """Dimension of a unit such as "kN", "kN/m2", "deg"; "-" is a pure number."""
    above, _, below = unit.partition("/")
    dimension = PURE
    for part, sign in ((above, 1), (below, -1)):
        base = part[:-1] if part[-1:] in _POWERS else part
        if base not in ("", "-"):
            power = int(part[len(base) :] or 1)
            dimension = multiply_dimension(dimension, ((base, 1),), sign * power)
    return dimension


def name_dimension(dimension: Dimension) -> str:
    """Unit in words: ``kN m2``."""
    return " ".join(f"{b}{'' if n == 1 else n}" for b, n in dimension) or "-"


class Kind(StrEnum):
    """Origin of a quantity."""

    GIVEN = "given"  # a cell of the workbook, or what follows from some of them
    PROFILE = "profile"  # a value of the limit profile
    SOLVED = "solved"  # a force of the solved cases, or of the guideline's load
    WORKED = "worked"  # an operation on others


class Operation(NamedTuple):
    """A function of numbers, and how it goes with each of them.

    ``ways`` has 1 where it grows with an operand, -1 where it falls, 0 where it takes
    the operand's value alone; the last one counts for all further operands. It goes
    that way while its operands lie between ``least`` and ``most``. ``arity`` is the
    number of operands; 0 is any.
    """

    of: Callable[..., float]
    ways: tuple[int, ...]
    dimension: Callable[..., Dimension | None]
    arity: int
    least: float = -math.inf
    most: float = math.inf

    def way(self, place: int) -> int:
        """Way of the operand at a place."""
        return self.ways[place] if place < len(self.ways) else self.ways[-1]


def _divide(above: Dimension, below: Dimension) -> Dimension:
    return multiply_dimension(above, below, -1)


def _keep(*all_: Dimension) -> Dimension | None:
    first, *others = all_ or (PURE,)
    return None if any(other != first for other in others) else first


def _turn(angle: Dimension) -> Dimension | None:
    return PURE if angle == find_dimension("deg") else None


def _of_degrees(function: Callable[[float], float]) -> Callable[[float], float]:
    return lambda angle: function(math.radians(angle))


# Where an operation turns, its ends are not those of its operands any more.
_POSITIVE = (0.0, math.inf)
_QUARTER_TURN = (0.0, 90.0)
OPERATIONS: dict[str, Operation] = {
    "=": Operation(float, (1,), _keep, 1),
    "+": Operation(lambda a, b: a + b, (1, 1), _keep, 2),
    "-": Operation(lambda a, b: a - b, (1, -1), _keep, 2),
    "*": Operation(lambda a, b: a * b, (1, 1), multiply_dimension, 2, *_POSITIVE),
    "/": Operation(lambda a, b: a / b, (1, -1), _divide, 2, *_POSITIVE),
    "max": Operation(lambda *all_: max(all_), (1,), _keep, 0),
    "min": Operation(lambda *all_: min(all_), (1,), _keep, 0),
    "sqrt": Operation(math.sqrt, (1,), halve_dimension, 1, *_POSITIVE),
    "sin": Operation(_of_degrees(math.sin), (1,), _turn, 1, *_QUARTER_TURN),
    "cos": Operation(_of_degrees(math.cos), (-1,), _turn, 1, *_QUARTER_TURN),
    "tan": Operation(_of_degrees(math.tan), (1,), _turn, 1, *_QUARTER_TURN),
    "at_value": Operation(float, (0,), _keep, 1),
}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Quantity:
    """One quantity of a calculation.

    Attributes
    ----------
    low, value, high : float or None
        Band in which it lies and its value, low <= value <= high; None of a quantity
        that is missing.
    dimension : Dimension
        Of its unit.
    symbol, unit : str
        As in the theory pages; "" of a part of a formula.
    kind : Kind
        Origin.
    source : str
        Cell, id of the profile's value, key of the solved force; of a quantity that is
        worked out the clause. "" where there is none.
    operation : str
        Key of ``OPERATIONS``; "" of a leaf.
    of : tuple of Quantity
        Operands.
    lacks : tuple of Message
        Reasons why it is missing; empty if it is not.
    """

    low: float | None
    value: float | None
    high: float | None
    dimension: Dimension = PURE
    symbol: str = ""
    unit: str = ""
    kind: Kind = Kind.WORKED
    source: str = ""
    operation: str = ""
    of: tuple[Quantity, ...] = ()
    lacks: tuple[Message, ...] = ()

    def __post_init__(self) -> None:
        """Refuse a band in disorder, NaN and infinity."""
        ends = low, value, high = self.low, self.value, self.high
        if low is None or value is None or high is None:
            is_sound = bool(self.lacks) and ends == (None, None, None)
        else:
            is_sound = not self.lacks and -math.inf < low <= value <= high < math.inf
        if not is_sound:
            raise ModelError(
                say("calculation.disorder", symbol=self.symbol, ends=f"{ends}")
            )

    @property
    def is_known(self) -> bool:
        """It has a value."""
        return self.value is not None

    def order(self, way: int) -> tuple[float, float, float]:
        """Band in which something grows (1), falls (-1), or takes the value alone (0).

        Raises
        ------
        ValueError
            If the quantity is missing.
        """
        if self.low is None or self.value is None or self.high is None:
            raise ValueError(f"{self.symbol} is missing")
        if way == 0:
            return self.value, self.value, self.value
        ends = (self.low, self.value, self.high)
        return ends if way > 0 else ends[::-1]

    def __add__(self, other: Operand) -> Quantity:
        return apply("+", self, other)

    def __radd__(self, other: float) -> Quantity:
        return apply("+", other, self)

    def __sub__(self, other: Operand) -> Quantity:
        return apply("-", self, other)

    def __mul__(self, other: Operand) -> Quantity:
        return apply("*", self, other)

    def __rmul__(self, other: float) -> Quantity:
        return apply("*", other, self)

    def __truediv__(self, other: Operand) -> Quantity:
        return apply("/", self, other)

    def __rtruediv__(self, other: float) -> Quantity:
        return apply("/", other, self)

    def named(self, symbol: str, unit: str, clause: str = "") -> Quantity:
        """The quantity under a symbol, its unit checked; it keeps its first one.

        Raises
        ------
        ModelError
            If its dimension is not that of the unit: a force times a length is no
            force.
        """
        return _give_name(self, symbol, unit, clause)


Operand = Quantity | float


@_remember
def leaf(
    symbol: str,
    value: float | None,
    unit: str,
    source: str,
    *,
    kind: Kind = Kind.GIVEN,
    band: tuple[float, float] | None = None,
    lack: Message | None = None,
) -> Quantity:
    """Leaf of a calculation: given, of the profile, or solved.

    Parameters
    ----------
    symbol, unit, source
        As those of a `Quantity`.
    value : float or None
        In ``unit``; None where it is missing.
    kind : Kind
        Origin.
    band : (float, float), optional
        Low and high end; the value itself unless told otherwise.
    lack : Message, optional
        Reason why it is missing; has to be there without a value, and not with one.
    """
    if value is None and lack is None:
        lack = say("calculation.missing", symbol=symbol)
    low, high = (None, None) if value is None else band or (value, value)
    if value is not None and low is not None and high is not None:
        low, value, high = low + 0.0, value + 0.0, high + 0.0  # never -0
    return Quantity(
        low=low,
        value=value,
        high=high,
        dimension=find_dimension(unit),
        symbol=symbol,
        unit=unit,
        kind=kind,
        source=source,
        lacks=() if lack is None else (lack,),
    )


@_remember
def _give_name(of: Quantity, symbol: str, unit: str, clause: str) -> Quantity:
    if find_dimension(unit) != of.dimension:
        dimension = name_dimension(of.dimension)
        raise ModelError(
            say("calculation.unit", symbol=symbol, unit=unit, found=dimension)
        )
    made = apply("=", of) if of.symbol else of
    return Quantity(
        low=made.low,
        value=made.value,
        high=made.high,
        dimension=made.dimension,
        symbol=symbol,
        unit=unit,
        kind=made.kind,
        source=clause,
        operation=made.operation,
        of=made.of,
        lacks=made.lacks,
    )


def constant(value: float) -> Quantity:
    """Pure number of a formula."""
    return Quantity(low=value, value=value, high=value)


@_remember
def apply(operation: str, *operands: Operand) -> Quantity:
    """Quantity that an operation makes of others; of a missing one a missing one.

    It is missing, too, where an operand lies outside the range of the operation.

    Each end takes the ends of the operands that make it so: a difference is largest
    with the least of what is taken away.

    Raises
    ------
    ModelError
        If units do not fit.
    """
    rule = OPERATIONS[operation]
    of = tuple([x if isinstance(x, Quantity) else constant(x) for x in operands])
    low = value = high = None
    lacks = _list_lacks(operation, rule, of)
    if not lacks:
        bands = [x.order(rule.way(place)) for place, x in enumerate(of)]
        lows, values, highs = zip(*bands, strict=True)
        low = value = high = rule.of(*values)
        if not lows == values == highs:
            low, high = rule.of(*lows), rule.of(*highs)
    return Quantity(
        low=low,
        value=value,
        high=high,
        dimension=_find_dimension(operation, rule, of),
        operation=operation,
        of=of,
        lacks=lacks,
    )


def _find_dimension(
    operation: str, rule: Operation, of: Sequence[Quantity]
) -> Dimension:
    dimension = rule.dimension(*[x.dimension for x in of])
    if dimension is None and rule.dimension is _keep:  # zero has any unit
        dimension = _keep(*[x.dimension for x in of if not _is_zero(x)])
    if dimension is None:
        units = ", ".join(name_dimension(x.dimension) for x in of)
        raise ModelError(say("calculation.units", operation=operation, units=units))
    return dimension


def _name(quantity: Quantity) -> str:
    """Symbol, or the operation with its quantities where none is given."""
    parts = [_name(operand) for operand in quantity.of]
    return quantity.symbol or f" {quantity.operation} ".join(parts)


def _list_lacks(
    operation: str, rule: Operation, of: Sequence[Quantity]
) -> tuple[Message, ...]:
    """Lacks of the operands, or that of a result which does not follow from their ends.

    That is where an end lies beyond the turn of the operation.
    """
    lacks = [lack for x in of for lack in x.lacks]
    if lacks:
        return tuple(dict.fromkeys(lacks))
    for x in of:
        if rule.least > (x.low or 0.0) or rule.most < (x.high or 0.0):
            lack = say("calculation.outside", operation=operation, symbol=_name(x))
            return (lack,)
    if operation == "/" and of[1].low == 0.0:
        return (say("calculation.over_nothing", symbol=_name(of[1])),)
    return ()


def _is_zero(quantity: Quantity) -> bool:
    is_constant = not (quantity.symbol or quantity.operation)
    return is_constant and quantity.value == 0.0


def largest(first: Quantity, *others: Operand) -> Quantity:
    """Largest of several quantities; all of them stay in the calculation."""
    return apply("max", first, *others)


def smallest(first: Quantity, *others: Operand) -> Quantity:
    """Smallest of several quantities."""
    return apply("min", first, *others)


def sqrt(quantity: Quantity) -> Quantity:
    """Square root."""
    return apply("sqrt", quantity)


def sin(angle: Quantity) -> Quantity:
    """Sine of an angle in degrees."""
    return apply("sin", angle)


def cos(angle: Quantity) -> Quantity:
    """Cosine of an angle in degrees."""
    return apply("cos", angle)


def tan(angle: Quantity) -> Quantity:
    """Tangent of an angle in degrees."""
    return apply("tan", angle)


def at_value(quantity: Quantity) -> Quantity:
    """The value alone, without the band."""
    return apply("at_value", quantity)
