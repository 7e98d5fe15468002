"""Winters that count in return values: known, bounded, left out.

Theory: addons/winter/THEORY.md, section 10.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property

from netdesign.addons.winter.maxima import AnnualMaximum
from netdesign.addons.winter.statistics import (
    LEAST_ABOVE,
    LEAST_WINTERS,
    Gumbel,
    LimitedGumbel,
    fit_gumbel,
    fit_limited,
)
from netdesign.words.message import Message, say

LEFT_OUT = 0.1  # of the complete winters may count for nothing


@dataclass(frozen=True, kw_only=True)
class Sample:
    """Complete winters of a row.

    Attributes
    ----------
    maxima : tuple of AnnualMaximum
        One of each winter, in their order.
    """

    maxima: tuple[AnnualMaximum, ...]

    @property
    def counted(self) -> list[AnnualMaximum]:
        """Winters with a proven maximum or a bound."""
        return [one for one in self.maxima if one.is_proven or one.bound is not None]

    @property
    def bounds(self) -> list[float]:
        """Bounds of the winters that are known by one alone [N/m]."""
        return [one.bound for one in self.maxima if one.bound is not None]

    @property
    def proven(self) -> list[AnnualMaximum]:
        """All winters; none where one of them has no proven maximum."""
        is_whole = all(one.is_proven for one in self.maxima)
        return list(self.maxima) if is_whole else []

    @property
    def left_out(self) -> list[str]:
        """Names of the winters with neither, in which the net held the snow."""
        return [
            one.winter
            for one in self.maxima
            if one.ending == "doubtful" and one.bound is None
        ]

    @cached_property
    def fit(self) -> Gumbel | LimitedGumbel | None:
        """Distribution of the maxima [N/m]; by moments where all counted are known.

        None where ``lack`` says why.
        """
        pulls = [one.foot for one in self.counted]
        if self._find_obstacle():
            return None
        return (
            fit_limited(pulls, max(self.bounds)) if self.bounds else fit_gumbel(pulls)
        )

    @property
    def lack(self) -> Message | None:
        """Reason why there are no return values; None where there are."""
        obstacle = self._find_obstacle()
        if obstacle or self.fit:
            return obstacle
        if len(self.counted) < LEAST_WINTERS:
            count = len(self.counted)
            return say("winter_sample.few", least=LEAST_WINTERS, count=count)
        return say("winter_sample.few_above", least=LEAST_ABOVE)

    def _find_obstacle(self) -> Message | None:
        """Reason why the winters may not stand for all; None where they may."""
        above = [one.winter for one in self.maxima if one.ending == "overtopped"]
        if above:
            return say("winter_sample.overtopped", winters=tuple(above))
        if len(self.left_out) > LEFT_OUT * len(self.maxima):
            return say("winter_sample.unbounded", winters=tuple(self.left_out))
        return None


def choose_sample(maxima: Sequence[AnnualMaximum], complete: Collection[str]) -> Sample:
    """Sample of the complete winters.

    Parameters
    ----------
    maxima : sequence of AnnualMaximum
        Of one row.
    complete : collection of str
        Names of the complete winters.
    """
    return Sample(maxima=tuple(one for one in maxima if one.winter in complete))
