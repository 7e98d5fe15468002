"""Histories of a net whose unstressed length changes, as its temperature does."""

from dataclasses import replace

import numpy as np

from netdesign.addons.history.instant import advance
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.addons.history.state import build_problem, build_start, find_start
from netdesign.addons.history.transient import follow
from netdesign.snow.mesh import build_template


def follow_lengths(scene, times, shares):
    """Pulls on foot and head [N/m], (n, 2), of a net of these shares of its length.

    ``times`` in creep time; it starts as it hangs at rest, and the snow keeps its law.
    """
    size = TRANSIENT_LEVELS[0]
    problem = build_problem(scene, densifies=False)
    pack = scene.snowpack
    template = build_template(
        pack.upslope_length / pack.thickness, size, scene.layer_tops
    )
    state = build_start(problem, template, find_start(scene, size, "steady"))
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
