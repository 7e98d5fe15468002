"""Formulas of quantities as text: for a reader, a file, a spreadsheet; and back.

``b_e / b * (g * E_s + A)`` is the text of a file. It is read by Python's own grammar,
of which nothing counts but names, numbers and the operations of a quantity.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache

from netdesign.calculation.quantity import OPERATIONS, Quantity, apply, constant
from netdesign.outcome import ContentError
from netdesign.words.message import say

_RANK = {"+": 1, "-": 1, "*": 2, "/": 2}
_SIGNS: dict[type[ast.operator], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
}
_MOST_SIGNS = 500  # of a formula that is read


@dataclass(frozen=True, slots=True, kw_only=True)
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


def write_formula(
    quantity: Quantity,
    leaf: Callable[[Quantity, int], str],
    notation: Notation = PLAIN,
    end: int = 0,
) -> str:
    """Right side of the equation that makes a quantity; "" of a leaf.

    Parameters
    ----------
    quantity : Quantity
        Under a symbol or not.
    leaf : callable
        Text of a quantity under a symbol, and of the end that is wanted of it.
    notation : Notation
        How signs and functions are written.
    end : int
        Of the quantity: -1 for its low end, 0 for its value, 1 for its high end.
    """
    if not quantity.operation:
        return ""
    return _write_operation(quantity, leaf, notation, end, 0)


def _write(
    quantity: Quantity,
    leaf: Callable[[Quantity, int], str],
    notation: Notation,
    end: int,
    rank: int,
) -> str:
    if quantity.symbol:
        return leaf(quantity, end)
    if not quantity.operation:
        return notation.number(quantity.value or 0.0)
    return _write_operation(quantity, leaf, notation, end, rank)


def _write_operation(
    quantity: Quantity,
    leaf: Callable[[Quantity, int], str],
    notation: Notation,
    end: int,
    rank: int,
) -> str:
    name = quantity.operation
    way = OPERATIONS[name].way
    if name == "=" or notation.templates.get(name) == "{}":  # nothing is to be seen
        return _write(quantity.of[0], leaf, notation, end * way(0), rank)
    own = _RANK.get(name, 0)
    parts = [
        _write(one, leaf, notation, end * way(place), own + (place and name in "-/"))
        for place, one in enumerate(quantity.of)
    ]
    if own:
        text = notation.signs[name].join(parts)
        return f"({text})" if own < rank else text
    listed = notation.comma.join(parts)
    if name in notation.templates:
        return notation.templates[name].format(listed)
    return f"{notation.functions.get(name, name)}({listed})"


def read_formula(text: str, known: Mapping[str, Quantity]) -> Quantity:
    """Quantity that a formula makes of those that are known by their symbols.

    Raises
    ------
    ContentError
        If it is no formula of such quantities.
    """
    try:
        if len(text) > _MOST_SIGNS:
            raise SyntaxError
        return _build(_parse(text), known)
    except (SyntaxError, ValueError, OverflowError, MemoryError, RecursionError):
        raise ContentError(say("calculation.no_formula", text=text[:80])) from None


@lru_cache(maxsize=1024)
def _parse(text: str) -> ast.expr:
    """Tree of a formula: a study has a few hundred, each many times."""
    return ast.parse(text, mode="eval").body


def _build(tree: ast.expr, known: Mapping[str, Quantity]) -> Quantity:
    match tree:
        case ast.Constant(value=int() | float() as number) if not isinstance(
            number, bool
        ):
            return constant(float(number))
        case ast.Name(id=symbol) if symbol in known:
            return known[symbol]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _SIGNS:
            return apply(_SIGNS[type(op)], _build(left, known), _build(right, known))
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if (
            name in OPERATIONS and args and OPERATIONS[name].arity in (0, len(args))
        ):
            return apply(name, *(_build(one, known) for one in args))
    raise SyntaxError
