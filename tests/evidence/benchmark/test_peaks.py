"""Made-up peaks: what they are, and that a search of them is told apart."""

import numpy as np
import pytest

from netdesign.evidence.benchmark.envelope import build_peak, measure_peaks, search_peak
from netdesign.search.maxima import RESOLVED_SHARE


def test_a_peak_is_as_wide_at_half_its_height_as_asked():
    """Along a line through its top, a plane taken away by symmetric differences."""
    sharp, blunt = build_peak(3, 0.1), build_peak(3, 1e6)
    rng = np.random.default_rng(3)
    top, height = rng.uniform(0.0, 1.0, 3), rng.uniform(1.0, 10.0)
    at = top + np.array([[0.0, 0.0, 0.0], [0.05, 0.0, 0.0], [0.0, -0.05, 0.0]])
    bell = sharp(at) - (blunt(at) - height)
    assert bell == pytest.approx([height, height / 2, height / 2], rel=1e-4)


def test_a_wide_peak_is_bounded_and_a_needle_is_missed():
    wide, excess = search_peak(build_peak(2, RESOLVED_SHARE))
    assert wide.is_closed
    assert excess <= 0.0
    needles = [search_peak(build_peak(seed, 0.1))[1] for seed in range(4)]
    assert max(needles) > 0.0


def test_misses_are_counted_by_width():
    (point,) = measure_peaks(2, (RESOLVED_SHARE,))
    assert (point["searches"], point["missed"], point["not_closed"]) == (2, 0, 0)
