"""Bands of the forces on a support, against every moved pull resolved on its own."""

import math
import random

import numpy as np
import pytest

from netdesign.checks.inputs import Band
from netdesign.coupling.solution import EndPull
from netdesign.envelope.panel_forces import Pulls, hold_pulls
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout, place_support

DRAWN = random.Random(20261123)


def draw_support():
    layout = SupportLayout(
        post_spacing=DRAWN.uniform(2.07, 4.93),
        post_tilt=DRAWN.uniform(-0.1, 0.3),
        uphill_anchor_distance=DRAWN.choice([0.0, DRAWN.uniform(1.13, 5.71)]),
        downhill_anchor_distance=DRAWN.uniform(0.83, 5.37),
    )
    head = (DRAWN.uniform(0.11, 2.31), DRAWN.uniform(1.53, 3.97))
    error = DRAWN.uniform(1.7, 830.0)
    foot = EndPull(x=DRAWN.uniform(1e3, 9e4), y=DRAWN.uniform(0.0, 6e4), error=error)
    pull = EndPull(x=DRAWN.uniform(-1e3, 8e4), y=-DRAWN.uniform(1e3, 5e4), error=error)
    return layout, head, foot, pull


def resolve(layout, place, foot, head, moved=(0.0, 0.0, 0.0, 0.0)):
    x, y, along, normal = moved
    found = compute_anchor_forces(
        place_support(layout, place),
        foot_pull_per_m=(foot.x + x * foot.error, foot.y + y * foot.error),
        head_pull_per_m=(head.x + along * head.error, head.y + normal * head.error),
        post_spacing=layout.post_spacing,
    )
    return found if isinstance(found, FailedSupport) else found.member_forces


def hold(layout, place, pulls):
    """Bands of the members under each of some pulls on foot and head, or a failure."""
    ends = np.array([(foot.x, foot.y, head.x, head.y) for foot, head in pulls])
    errors = np.array([(foot.error,) * 2 + (head.error,) * 2 for foot, head in pulls])
    held = hold_pulls([layout], place, Pulls(ends, errors))
    if not held.is_held.all():
        return held.explain([layout], place)
    return [
        {
            member: Band(low=low, value=value, high=high)
            for member, bands in held.bands.items()
            for low, value, high in [bands[0, :, place].tolist()]
        }
        for place in range(len(pulls))
    ]


def hold_one(layout, place, foot, head):
    found = hold(layout, place, [(foot, head)])
    return found if isinstance(found, FailedSupport) else found[0]


def test_each_error_is_that_of_all_moved_pulls():
    held = 0
    for _ in range(60):
        support = draw_support()
        found, values = hold_one(*support), resolve(*support)
        moved = [
            [
                resolve(*support, [share * (k == n) for n in range(4)])
                for share in (-1, 1)
            ]
            for k in range(4)
        ]
        failed = [one for pair in moved for one in pair if not isinstance(one, dict)]
        if failed or isinstance(values, FailedSupport):
            assert isinstance(found, FailedSupport)
            continue
        held += 1
        for member, band in found.items():
            error = 0.0
            for pair in moved:
                error += max(abs(one[member] - values[member]) for one in pair)
            assert band.value == pytest.approx(values[member], rel=1e-14)
            assert band.high == pytest.approx(values[member] + error, rel=1e-13)
            low = max(0.0, values[member] - error)
            assert band.low == pytest.approx(low, rel=1e-13, abs=1e-9)
    assert held > 20


def test_many_pulls_are_resolved_as_each_alone_and_one_that_fails_is_told():
    layout, place, foot, head = draw_support()
    pulls, alone = [], []
    while len(alone) < 7:
        _, _, foot, head = draw_support()
        found = hold_one(layout, place, foot, head)
        if not isinstance(found, FailedSupport):
            pulls.append((foot, head))
            alone.append(found)
    assert hold(layout, place, pulls) == alone
    spoilt = EndPull(x=foot.x, y=foot.y, error=math.nan)
    failed = hold(layout, place, [*pulls[:3], (spoilt, head), *pulls[3:]])
    assert isinstance(failed, FailedSupport)


@pytest.mark.parametrize("error", [math.inf, math.nan, 1e308])
def test_an_error_that_is_no_number_or_leads_to_none_leaves_no_forces(error):
    layout, place, foot, head = draw_support()
    spoilt = EndPull(x=foot.x, y=foot.y, error=error)
    assert isinstance(hold_one(layout, place, spoilt, head), FailedSupport)
    assert isinstance(hold_one(layout, place, foot, spoilt), FailedSupport)
