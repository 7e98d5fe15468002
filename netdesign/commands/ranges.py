"""Ranges on the command line: ``low:high`` or ``low:high:n``."""

from __future__ import annotations

import math
from dataclasses import dataclass

import click

from netdesign.commands.usage import ValueRefusal
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenRange:
    """A range as typed, in the engineer's unit; ``count`` is None where not given."""

    low: float
    high: float
    count: int | None


class RangeType(click.ParamType):  # type: ignore[type-arg]  # generic in click 8.5 only
    """``low:high[:n]``; every fault names the text and what is accepted."""

    name = "low:high[:n]"

    def convert(
        self,
        value: object,
        param: click.Parameter | None,
        ctx: click.Context | None,
    ) -> GivenRange:
        """Read a range.

        Raises
        ------
        click.BadParameter
            If it is malformed, reversed or empty.
        """
        if isinstance(value, GivenRange):
            return value
        text = str(value)
        parts = text.split(":")
        try:
            low, high = (float(part) for part in parts[:2])
            count = int(parts[2]) if len(parts) == 3 else None
        except ValueError:
            low = high = math.nan
            count = None
        if len(parts) not in (2, 3) or not (math.isfinite(low) and math.isfinite(high)):
            raise ValueRefusal(say("usage.range_form", text=text), ctx, param)
        if low > high:
            raise ValueRefusal(say("usage.range_reversed", text=text), ctx, param)
        if low == high:
            raise ValueRefusal(say("usage.range_empty", text=text), ctx, param)
        if count is not None and not 2 <= count <= 1000:
            raise ValueRefusal(say("usage.range_samples", text=text), ctx, param)
        return GivenRange(low=low, high=high, count=count)


RANGE = RangeType()
