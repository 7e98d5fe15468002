"""Calculations drawn at random, and their value without a function of the package."""

import math

from netdesign.calculation.quantity import (
    Quantity,
    apply,
    at_value,
    find_dimension,
    largest,
    leaf,
    smallest,
)
from netdesign.calculation.steps import list_named

ANGLE = find_dimension("deg")
LEAVES = ("kN", "kN", "m", "m", "-", "-", "deg")
PLAIN = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "max": lambda *all_: max(all_),
    "min": lambda *all_: min(all_),
    "sqrt": lambda a: a**0.5,
    "sin": lambda a: math.sin(math.pi * a / 180.0),
    "cos": lambda a: math.cos(math.pi * a / 180.0),
    "tan": lambda a: math.tan(math.pi * a / 180.0),
    "=": lambda a: a,
}


def draw_calculation(random, *, has_bands=True, has_values=True):
    """Quantity under a symbol of some leaves and operations, all in their domain."""
    known = [draw_leaf(random, place, has_bands) for place in range(len(LEAVES))]
    for place in range(random.randint(2, 9)):
        made = operate(random, known, has_values=has_values)
        unit = name_unit(made.dimension)
        if unit and random.random() < 0.6:
            made = made.named(f"x_{place}", unit, f"({place})")
        known.append(made)
    last = next(one for one in reversed(known) if name_unit(one.dimension))
    return last.named("y", name_unit(last.dimension))


def draw_leaf(random, place, has_bands):
    unit = LEAVES[place]
    low, most = (3.0, 70.0) if unit == "deg" else (0.2, 5.0)
    ends = sorted(random.uniform(low, most) for _ in range(3))
    if not has_bands or random.random() < 0.4:
        ends = [ends[1]] * 3
    band = (ends[0], ends[2])
    return leaf(f"a_{place}", ends[1], unit, f"Nets!{'ABCDEFG'[place]}2", band=band)


def operate(random, known, *, has_values):
    """One operation on some of those that are known, which its domain allows."""
    one = random.choice([one for one in known if one.dimension != ANGLE])
    alike = random.choice([x for x in known if x.dimension == one.dimension])
    # what may be zero divides nothing
    factors = [x for x in known if x.dimension != ANGLE and x.low > 1e-3]
    factor, divisor = random.choice(factors), random.choice(factors)
    angle = random.choice([x for x in known if x.dimension == ANGLE])
    ways = [
        lambda: one + alike,
        lambda: one - alike,
        lambda: largest(one, alike, one),
        lambda: smallest(one, alike),
        lambda: factor * divisor,
        lambda: factor / divisor,
        lambda: 0.5 * factor,
        lambda: factor / 3 * divisor,
        lambda: apply("sqrt", factor * factor),
        lambda: (1 + divisor / divisor) / (factor / (divisor * factor)),
        lambda: one - (one - (alike - one)),
        lambda: apply(random.choice(("sin", "cos", "tan")), angle),
    ]
    if has_values:
        ways += [lambda: at_value(one), lambda: factor * at_value(divisor + divisor)]
    return random.choice(ways)()


def name_unit(dimension):
    """Unit as a workbook has it; "" of one that has several parts."""
    parts = {1: [], -1: []}
    for base, power in dimension:
        if abs(power) > 9:
            return ""
        sign = 1 if power > 0 else -1
        parts[sign].append(f"{base}{abs(power) if abs(power) > 1 else ''}")
    if max(map(len, parts.values())) > 1:
        return ""
    above, below = ("".join(parts[sign]) for sign in (1, -1))
    return f"{above or '1'}/{below}" if below else above or "-"


def list_leaves(quantity):
    return [one for one in list_named(quantity) if not one.operation]


def work_out(quantity: Quantity, inputs) -> float:
    """Value for some values of the leaves."""
    if quantity.symbol in inputs:
        return inputs[quantity.symbol]
    if not quantity.operation:
        return quantity.value
    if quantity.operation == "at_value":  # of the calculation, whatever the inputs
        return quantity.of[0].value
    operands = (work_out(one, inputs) for one in quantity.of)
    return PLAIN[quantity.operation](*operands)


def find_size(quantity: Quantity) -> float:
    """Largest number in a calculation, which its rounding follows."""
    ends = max(abs(quantity.low), abs(quantity.high))
    return max([ends, *map(find_size, quantity.of)])
