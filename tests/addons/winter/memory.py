"""Chain with memory: each new snow is laid against the net as the old snow left it.

What is kept is the net's curve and where its material sits; the snow is new.
"""

from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from netdesign.addons.history.body import build_body
from netdesign.addons.history.instant import advance
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.addons.history.state import build_problem, build_start, find_start
from netdesign.addons.history.transient import follow
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.mesh import build_template


def follow_scenes(scenes, creep_times, steps=12, size=TRANSIENT_LEVELS[1]):
    """Pulls on foot and head [N/m] at the end of each scene's time, (n_scenes, 2).

    Net and slope are the same in all, their snow gets no thinner; ``creep_times`` are
    of each scene.
    """
    points, places = None, None  # of the net [m]: where it is, and unstressed lengths
    pulls = []
    for scene, creep_time in zip(scenes, creep_times, strict=True):
        thickness = scene.snowpack.thickness
        problem = build_problem(scene, densifies=False)
        template = build_template(
            scene.snowpack.upslope_length / thickness, size, scene.layer_tops
        )
        first = find_start(scenes[0], size, "steady") if points is None else "straight"
        state = build_start(problem, template, first)
        if points is not None:
            state = lay(
                state, problem, template, points / thickness, places / thickness
            )
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
        points, places = read_net(state, problem, thickness)
    return np.array(pulls)


def read_net(state, problem, thickness):
    """Positions of the net from foot to head, and unstressed lengths to them [m]."""
    points = state.body.vertices[:, state.body.topology.net]
    places = np.append(0.0, np.cumsum(state.lengths))
    if places.size > points.shape[1]:  # snow that settled leaves the head free
        points = np.column_stack([points, problem.head])
    return points * thickness, places * thickness


def lay(state, problem, template, points, places):
    """New snow against the net as it is: all in units of the new thickness."""
    if problem.has_freeboard:  # the surface cuts the net
        above = int(np.flatnonzero(points[1] > 1.0)[0])
        share = (1.0 - points[1, above - 1]) / (points[1, above] - points[1, above - 1])
        cut = points[:, above - 1] + share * (points[:, above] - points[:, above - 1])
        place = places[above - 1] + share * (places[above] - places[above - 1])
        points = np.column_stack([points[:, :above], cut])
        known = np.append(places[:above], place)
    else:
        known = places
    ways = np.append(0.0, np.cumsum(np.hypot(*np.diff(points))))
    wanted = template.net_fractions * ways[-1]
    smooth = CubicSpline(ways, points, axis=1)
    own = CubicSpline(ways, known)(wanted[::2])
    lengths = np.diff(own)
    if problem.has_freeboard:
        lengths = np.append(lengths, places[-1] - own[-1])
    body = build_body(problem.snow, template, smooth(wanted))
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
