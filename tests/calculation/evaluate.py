"""A stored calculation worked out again from its leaves, by Python's own grammar."""

import ast

from netdesign.calculation.quantity import apply, constant, leaf

SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}


def evaluate(steps):
    """Quantities of a calculation by their symbols."""
    known = {}
    for step in steps:
        if step.formula:
            made = read_formula(step.formula, known)
            known[step.symbol] = made.named(step.symbol, step.unit, step.source)
        else:
            known[step.symbol] = read_leaf(step)
    return known


def read_leaf(step):
    low, value, high = step.ends
    return leaf(
        *(step.symbol, value, step.unit, step.source),
        kind=step.kind,
        band=None if low is None or high is None else (low, high),
        lack="missing" if value is None else None,
    )


def read_formula(text, known):
    """Quantity that a formula makes of those that are known by their symbols."""
    return build(ast.parse(text, mode="eval").body, known)


def build(tree, known):
    match tree:
        case ast.Constant(value=number):
            return constant(float(number))
        case ast.Name(id=symbol):
            return known[symbol]
        case ast.BinOp(left=left, op=op, right=right):
            return apply(SIGNS[type(op)], build(left, known), build(right, known))
        case ast.Call(func=ast.Name(id=name), args=args):
            return apply(name, *(build(one, known) for one in args))
    raise SyntaxError
