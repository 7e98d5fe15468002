"""Then and now: what differs, by its place; what may be gone is named in gone.txt."""

import math
import re
from functools import cache
from pathlib import Path

TOLERANCE = 1e-9
# Of a residual, or a small difference of forces: it follows the order of a sum, and so
# the machine.
NOTHING = 1e-8
MISSING = "(no such place)"
GONE = Path(__file__).with_name("gone.txt")


@cache
def read_gone():
    """Patterns of the places that steps since then have deleted."""
    lines = GONE.read_text("utf-8").splitlines()
    return [re.compile(line) for line in lines if line and not line.startswith("#")]


def tell_differences(then, now, *, gone=()):
    """A line for each place of then that is another, or missing, now."""
    return [
        f"{place}: {was!r} -> {now.get(place, MISSING)!r}"
        for place, was in then.items()
        if not is_same(was, now.get(place, MISSING))
        and not any(one.fullmatch(place) for one in gone)
    ]


def is_same(one, other):
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=TOLERANCE, abs_tol=NOTHING)
    return one == other
