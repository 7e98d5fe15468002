"""Chain with memory: each new snow is laid against the net as the old snow left it."""

from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from netdesign.addons.history.body import build_body
from netdesign.addons.history.instant import advance
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.addons.history.transient import follow
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from tests.addons.history.starts import begin


def follow_scenes(scenes, creep_times, steps=12):
    """Pulls on foot and head [N/m] at the end of each scene's time, (n_scenes, 2)."""
    points, places = None, None  # of the net: where it is, and unstressed lengths
    pulls = []
    for scene, creep_time in zip(scenes, creep_times, strict=True):
        start = "steady" if points is None else "straight"
        problem, state = begin(scene, start, TRANSIENT_LEVELS[1], densifies=False)
        if points is not None:
            state = lay(state, problem, points, places)
        before = 0.0
        for time in creep_time * np.geomspace(1e-3, 1.0, steps):
            instant = advance(
                problem,
                state,
                time - before,
                tolerance=1e-4,
                balance_tolerance=1e-9,
                max_iterations=30,
            )
            state, _ = follow(problem, state, instant, time - before)
            before = time
        ends = np.array([instant.foot_pull, instant.head_pull])
        pulls.append(np.hypot(*ends.T) * scene.force_scale)
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


def solve_alone(scenes, accuracy=5e-3):
    """Steady pulls on foot and head [N/m], (n_scenes, 2)."""
    found = [
        solve_steady(one, SolverSettings(accuracy=accuracy), on_failure="raise")
        for one in scenes
    ]
    return np.array([(one.foot.size, one.head.size) for one in found])
