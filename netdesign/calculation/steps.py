"""Formulas of quantities as text, and the steps of a calculation in their order.

A file holds ``b_e / b * (g * E_s + A)``. Python's grammar parses it; only names,
numbers and the operations of a quantity are accepted. Each step stands after its
operands.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import ClassVar, cast

from netdesign.calculation.quantity import OPERATIONS, Kind, Quantity
from netdesign.outcome import ContentError
from netdesign.words.message import say

_RANK = {"+": 1, "-": 1, "*": 2, "/": 2}
_OPERATORS = {"+": ast.Add(), "-": ast.Sub(), "*": ast.Mult(), "/": ast.Div()}
_SIGNS = {type(operator): sign for sign, operator in _OPERATORS.items()}
_MOST_SIGNS = 500  # of a formula that is read


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Notation:
    """Signs and names of one way to write a formula."""

    signs: Mapping[str, str]
    functions: Mapping[str, str] = field(default_factory=dict)
    templates: Mapping[str, str] = field(default_factory=dict)
    comma: str = ", "
    number: Callable[[float], str] = repr


PLAIN = Notation(signs={sign: f" {sign} " for sign in _RANK})
PRINTED = Notation(
    signs={"+": " + ", "-": " − ", "*": " · ", "/": " / "},
    templates={"at_value": "{}", "sqrt": "√({})"},
    comma="; ",
    number=lambda value: f"{value:.12g}",
)
SPREADSHEET = Notation(
    signs={sign: sign for sign in _RANK},
    functions={"max": "MAX", "min": "MIN", "sqrt": "SQRT"},
    templates={
        **{name: f"{name.upper()}(RADIANS({{}}))" for name in ("sin", "cos", "tan")},
        "at_value": "{}",
    },
    comma=",",
)


# Text of a formula, or a symbol in it with the end that is wanted of its quantity.
_Part = str | tuple[str, int]
# What makes a quantity: a symbol, a number with its text, an operation and its parts.
_Shape = str | tuple[str, "float | tuple[_Shape, ...]"]


def write_formula(quantity: Quantity) -> str:
    """Right side of the equation that makes a quantity, of symbols; "" of a leaf."""
    return _write(_find_shape(quantity, is_whole=True)) if quantity.operation else ""


def _find_shape(quantity: Quantity, *, is_whole: bool = False) -> _Shape:
    """What makes a quantity; of a part under a symbol the symbol alone."""
    if quantity.symbol and not is_whole:
        return quantity.symbol
    if not quantity.operation:
        number = quantity.value or 0.0
        return repr(number), number
    return quantity.operation, tuple(map(_find_shape, quantity.of))


@lru_cache(maxsize=4096)
def _write(shape: _Shape) -> str:
    """Formula of that shape: a study has a few hundred, each many times."""
    parts = _list_parts(_build_tree(shape), PLAIN, 0, 0)
    return "".join(part if isinstance(part, str) else part[0] for part in parts)


def translate(
    formula: str,
    notation: Notation,
    leaf: Callable[[str, int], str] = lambda symbol, _: symbol,
    end: int = 0,
) -> str:
    """Formula in another notation.

    Parameters
    ----------
    formula : str
        As `write_formula` writes it.
    notation : Notation
        How signs and functions are written.
    leaf : callable
        Text of a symbol, and of the end that is wanted of its quantity.
    end : int
        Of the result: -1 for its low end, 0 for its value, 1 for its high end.

    Raises
    ------
    SyntaxError
        If it is no formula.
    """
    return "".join(
        part if isinstance(part, str) else leaf(*part)
        for part in _split(formula, notation, end)
    )


def list_operands(formula: str, end: int) -> list[tuple[str, int]]:
    """Symbols that an end of the result is made of, with the end of each.

    Raises
    ------
    SyntaxError
        If it is no formula.
    """
    parts = _split(formula, PLAIN, end)
    return [part for part in parts if not isinstance(part, str)]


@lru_cache(maxsize=4096)
def _split(formula: str, notation: Notation, end: int) -> tuple[_Part, ...]:
    """Parts of a formula: a study has a few hundred, each many times."""
    return tuple(_list_parts(_parse(formula), notation, end, 0))


def _list_parts(
    tree: ast.expr, notation: Notation, end: int, rank: int
) -> Iterator[_Part]:
    """Parts of an operand that stands within an operation of some rank."""
    if isinstance(tree, ast.Name):
        yield tree.id, end
        return
    if isinstance(tree, ast.Constant):
        number = cast("float", tree.value)
        if type(number) not in (int, float) or not math.isfinite(number):
            raise SyntaxError
        yield notation.number(number)
        return
    name, of = _read_operation(tree)
    way = OPERATIONS[name].way
    if notation.templates.get(name) == "{}":  # nothing is to be seen
        yield from _list_parts(of[0], notation, end * way(0), rank)
        return
    own = _RANK.get(name, 0)
    before, between, after = _find_signs(name, notation, is_set_apart=0 < own < rank)
    yield before
    for place, operand in enumerate(of):
        if place:
            yield between
        inner = own + (place and name in "-/")
        yield from _list_parts(operand, notation, end * way(place), inner)
    yield after


def _find_signs(
    name: str, notation: Notation, *, is_set_apart: bool
) -> tuple[str, str, str]:
    """Signs before, between and after the operands of an operation."""
    if name in _RANK:
        opened, closed = ("(", ")") if is_set_apart else ("", "")
        return opened, notation.signs[name], closed
    function = notation.functions.get(name, name)
    before, after = notation.templates.get(name, f"{function}({{}})").split("{}")
    return before, notation.comma, after


def _build_tree(shape: _Shape) -> ast.expr:
    if isinstance(shape, str):
        return ast.Name(id=shape)
    operation, parts = shape
    if not isinstance(parts, tuple):
        return ast.Constant(value=parts)
    of = [_build_tree(part) for part in parts]
    if operation == "=":
        return of[0]
    if operation in _RANK:
        return ast.BinOp(left=of[0], op=_OPERATORS[operation], right=of[1])
    return ast.Call(func=ast.Name(id=operation), args=of, keywords=[])


def require_formula(text: str, symbols: Container[str]) -> None:
    """Refuse the formula of a document that is none of quantities known before it.

    Raises
    ------
    ContentError
        With the text.
    """
    try:
        if len(text) > _MOST_SIGNS:
            raise SyntaxError
        if all(symbol in symbols for symbol, _ in list_operands(text, 0)):
            return
    except (SyntaxError, ValueError, OverflowError, MemoryError, RecursionError):
        pass
    raise ContentError(say("calculation.no_formula", text=text[:80]))


@lru_cache(maxsize=1024)
def _parse(text: str) -> ast.expr:
    """Tree of a formula."""
    return ast.parse(text, mode="eval").body


def _read_operation(tree: ast.expr) -> tuple[str, Sequence[ast.expr]]:
    """Key of ``OPERATIONS`` and its operands."""
    match tree:
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _SIGNS:
            return _SIGNS[type(op)], (left, right)
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if (
            name in OPERATIONS and args and OPERATIONS[name].arity in (0, len(args))
        ):
            return name, args
    raise SyntaxError


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


def list_named(*quantities: Quantity) -> list[Quantity]:
    """Quantities under a symbol that some rest on, and themselves, in their order."""
    named: dict[str, Quantity] = {}
    for quantity in quantities:
        _collect(quantity, named)
    return list(named.values())


def _collect(quantity: Quantity, named: dict[str, Quantity]) -> None:
    listed = named.get(quantity.symbol) if quantity.symbol else None
    if listed is not None:
        if listed is not quantity and _differ(listed, quantity):
            raise ValueError(f"two quantities are called {quantity.symbol}")
        return
    for operand in quantity.of:
        _collect(operand, named)
    if quantity.symbol:
        named[quantity.symbol] = quantity


def _differ(first: Quantity, second: Quantity) -> bool:
    ends = ((x.low, x.value, x.high, x.operation) for x in (first, second))
    return len(set(ends)) > 1


def list_steps(*quantities: Quantity) -> list[Step]:
    """Steps of calculations; a quantity under the same symbol stands once."""
    return [_record(quantity) for quantity in list_named(*quantities)]


def _record(quantity: Quantity) -> Step:
    return Step(
        symbol=quantity.symbol,
        unit=quantity.unit,
        value=quantity.value,
        low=None if quantity.low == quantity.value else quantity.low,
        high=None if quantity.high == quantity.value else quantity.high,
        kind=quantity.kind,
        source=quantity.source,
        formula=write_formula(quantity),
    )


def require_calculation(steps: Sequence[Step]) -> None:
    """Refuse steps of a document of which one does not rest on those before it.

    Raises
    ------
    ContentError
        With the symbol that occurs twice, or the formula.
    """
    symbols: set[str] = set()
    for step in steps:
        if step.symbol in symbols:
            raise ContentError(say("calculation.twice", symbol=step.symbol))
        if step.formula:
            require_formula(step.formula, symbols)
        symbols.add(step.symbol)
