"""Figures that sum up many measurements."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from statistics import quantiles

import numpy as np


def summarise_times(times: Sequence[float]) -> dict[str, float | None]:
    """Median and 95th percentile [s]; None of fewer than two."""
    if len(times) < 2:
        return {"median_s": None, "p95_s": None}
    parts = quantiles(times, n=20, method="inclusive")
    return {"median_s": parts[9], "p95_s": parts[18]}


def fit_order(sizes: Sequence[float], values: Sequence[float]) -> float:
    """Power p of the best fit values ~ sizes^p, on logarithms [-]."""
    slope, _ = np.polyfit(np.log(sizes), np.log(values), 1)
    return float(slope)


def share(holds: Iterable[bool]) -> float | None:
    """Share of the entries that hold; None without any."""
    found = list(holds)
    return sum(found) / len(found) if found else None
