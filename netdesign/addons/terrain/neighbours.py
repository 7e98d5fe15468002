"""Gap beside a row: the nearest work along it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from netdesign.addons.terrain.measure import MeasuredRow

_FARTHEST = 20.0  # from a row's end; beyond it the next work counts as none [m]


def find_gap(row: MeasuredRow, rows: Sequence[MeasuredRow]) -> float | None:
    """Free distance from a row's ends to the next row beside it [m].

    The larger one of its two ends, along which the end effect is larger; None where
    no row stands beside one of them.

    Parameters
    ----------
    row : MeasuredRow
        The row.
    rows : sequence of MeasuredRow
        All rows.

    Verified by
    -----------
    tests/addons/terrain/test_coverage.py
    """
    gaps = [_find_beside(row, rows, end) for end in (0, -1)]
    known = [one for one in gaps if one is not None]
    return max(known) if len(known) == len(gaps) else None


def _find_beside(
    row: MeasuredRow, rows: Sequence[MeasuredRow], end: int
) -> float | None:
    """Distance from an end along the row to the nearest row that stands there [m]."""
    start = row.posts[end, :2]
    outward = start - row.posts[1 if end == 0 else -2, :2]
    outward = outward / np.linalg.norm(outward)
    across = np.array((-outward[1], outward[0]))
    found = []
    for other in rows:
        if other is row:
            continue
        away = other.posts[:, :2] - start
        along, aside = away @ outward, np.abs(away @ across)
        beside = (along > 0.0) & (along <= _FARTHEST) & (aside <= row.line.net_height)
        found += [float(one) for one in along[beside]]
    return min(found, default=None)
