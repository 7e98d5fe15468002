"""Histories of a net whose unstressed length changes, as its temperature does."""

from dataclasses import replace

import numpy as np

from netdesign.addons.history.instant import advance
from netdesign.addons.history.transient import follow
from tests.addons.history.starts import begin


def follow_lengths(scene, times, shares):
    """Pulls on foot and head [N/m], (n, 2), of a net of these shares of its length."""
    problem, state = begin(scene, "steady", densifies=False)
    full, before, share_before, pulls = problem.length, 0.0, 1.0, []
    for time, share in zip(times, shares, strict=True):
        problem = replace(problem, length=full * share)
        state = replace(state, lengths=state.lengths * (share / share_before))
        instant = advance(
            problem,
            state,
            time - before,
            tolerance=1e-4,
            balance_tolerance=1e-9,
            max_iterations=20,
        )
        state, _ = follow(problem, state, instant, time - before)
        before, share_before = time, share
        pulls.append((np.hypot(*instant.foot_pull), np.hypot(*instant.head_pull)))
    return np.array(pulls) * scene.force_scale
