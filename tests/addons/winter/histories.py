"""Nets that keep their past: under snow that is new, and of lengths that change."""

from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from netdesign.addons.history.body import build_body
from netdesign.addons.history.instant import advance
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.addons.history.transient import follow
from tests.addons.history.starts import begin


def step_on(problem, state, step):
    """State after a step, and the pulls on foot and head over the scene's scale."""
    instant = advance(
        *(problem, state, step),
        tolerance=1e-4,
        balance_tolerance=1e-9,
        max_iterations=30,
    )
    state, _ = follow(problem, state, instant, step)
    return state, np.hypot(*np.array([instant.foot_pull, instant.head_pull]).T)


def follow_scenes(scenes, creep_times, steps=12):
    """Pulls on foot and head [N/m] at the end of each scene's time, (n_scenes, 2)."""
    points, places = None, None  # of the net: where it is, and unstressed lengths
    pulls = []
    for scene, creep_time in zip(scenes, creep_times, strict=True):
        start = "steady" if points is None else "straight"
        problem, state = begin(scene, start, TRANSIENT_LEVELS[1], densifies=False)
        if points is not None:
            state = lay(state, problem, points, places)
        times = creep_time * np.geomspace(1e-3, 1.0, steps)
        for step in np.diff(times, prepend=0.0):
            state, pull = step_on(problem, state, step)
        pulls.append(pull * scene.force_scale)
        points = state.body.vertices[:, state.body.topology.net]
        places = np.append(0.0, np.cumsum(state.lengths))
        if places.size > points.shape[1]:  # snow that settled leaves the head free
            points = np.column_stack([points, problem.head])
    return np.array(pulls)


def lay(state, problem, points, places):
    """New snow against the net as it is."""
    template = state.body.topology.template
    ways = np.append(0.0, np.cumsum(np.hypot(*np.diff(points))))
    wanted = template.net_fractions * ways[-1]
    lengths = np.diff(CubicSpline(ways, places)(wanted[::2]))
    curve = CubicSpline(ways, points, axis=1)(wanted)
    body = build_body(problem.snow, template, curve)
    return replace(
        state, body=body, lengths=lengths, moved=np.zeros_like(body.vertices)
    )


def follow_lengths(scene, times, shares):
    """Pulls on foot and head [N/m], (n, 2), of a net of these shares of its length."""
    problem, state = begin(scene, "steady", densifies=False)
    full, share_before, pulls = problem.length, 1.0, []
    steps = np.diff(times, prepend=0.0)
    for step, share in zip(steps, shares, strict=True):
        problem = replace(problem, length=full * share)
        state = replace(state, lengths=state.lengths * (share / share_before))
        state, pull = step_on(problem, state, step)
        share_before = share
        pulls.append(pull)
    return np.array(pulls) * scene.force_scale
