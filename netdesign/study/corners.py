"""Rows at the ends of the ranges that the guideline's load and rules depend on."""

from __future__ import annotations

from itertools import product

from netdesign.envelope.ranges import USUAL, Case, Ranges
from netdesign.site.model import NetRow


def list_corners(row: NetRow, ranges: Ranges) -> list[NetRow]:
    """Rows at all ends of what ranges beside the usual three and is in the load.

    The load knows no length of the snowpack.
    """
    names = [name for name in ranges.further if name != "upslope_length"]
    usual = {name: ranges[name].low for name in USUAL}
    ends = product(*({ranges[name].low, ranges[name].high} for name in names))
    return [
        row.at(Case.of({**usual, **dict(zip(names, one, strict=True))})) for one in ends
    ]
