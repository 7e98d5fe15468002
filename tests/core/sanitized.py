"""Child of ``test_sanitizers.py``: scenes, steps and spoilt arrays in a checked core.

python sanitized.py LIBRARY SCENES; the sanitizer ends it at the first finding.
"""

import sys
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np

from netdesign.addons.evidence.benchmark.scenes import build_tables, draw_scene
from netdesign.addons.history.instant import advance
from netdesign.addons.history.settings import TransientSettings
from netdesign.addons.history.state import build_problem as build_history
from netdesign.addons.history.transient import run_history
from netdesign.cable.net import Net
from netdesign.core import library
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.compiled import prepare_rounds
from netdesign.coupling.steady.net import find_contact_curve, start_net
from netdesign.coupling.steady.solve import _build_problem, solve_steady
from netdesign.outcome import ModelError, SolveError
from netdesign.panel.equations import build_problem, guess_points
from netdesign.panel.inputs import CUTS, Panel, Rope
from netdesign.panel.solve import _solve_compiled, solve_panel
from netdesign.panel.strips import take_strip
from netdesign.snow.compiled import build_plan
from netdesign.snow.element import share_template
from netdesign.snow.kernel import SingularError


def spoil(values, rng):
    """The same with some entries that are no numbers, or huge ones."""
    spoilt = values.copy()
    places = rng.random(values.shape) < rng.choice([0.01, 0.3])
    spoilt[places] = rng.choice([np.nan, np.inf, -np.inf, 1e308, -1e-308, 0.0])
    return spoilt


def try_spoilt_plan(scene, rng):
    """The order of nodes of triangles one of whose numbers is spoilt."""
    template = share_template(
        scene.modelled_aspect, SolverSettings().levels[0], scene.layer_tops
    )
    triangles = np.ascontiguousarray(template.triangles.T, dtype=np.int32)
    triangles.flat[rng.integers(triangles.size)] = rng.integers(-(2**31), 2**31)
    net = np.ascontiguousarray(template.net, dtype=np.int32)
    with suppress(ValueError):
        build_plan(library.find_core(), triangles, template.nodes.copy(), net)


def try_spoilt_rounds(scene, rng):
    """Rounds along spoilt curves, from spoilt states, and nets under spoilt forces."""
    problem = _build_problem(scene, SolverSettings().levels[0])
    rounds = prepare_rounds(problem, SolverSettings(max_iterations=30), 1e9)
    if rounds is None:
        return
    net = start_net(problem, rounds.hang)
    curve = find_contact_curve(problem, net)
    for spoilt in (curve, spoil(curve, rng)):
        with suppress(SolveError, SingularError):  # what counts is the sanitizer
            found = rounds.take(spoilt, None, net, 1e-3)
            found.condense()
            rounds.take(curve, found.state, found.net, 1e-3)
            state = replace(found.state, stress=spoil(found.state.stress, rng))
            rounds.take(curve, state, found.net, 1e-3)
    with suppress(SolveError):
        on_net = net.forces[:, : problem.template.net.size]
        rounds.hang(spoil(on_net, rng), net.cable.pull, net.parts)


def try_spoilt_history(scene, rng):
    """First steps of a history, and steps of spoilt stresses, places and lengths."""
    scene = replace(scene, ground_contact="two-sided", net_contact="two-sided")
    states, start = [], str(rng.choice(["steady", "sagged", "straight"]))
    settings = TransientSettings(start=start, max_steps=3)
    run_history(scene, settings.levels[0], settings, 1.0, on_state=states.append)
    problem = build_history(scene, densifies=True)
    for name in ("stress", "velocity", "lengths", "moved"):
        with suppress(SolveError, ModelError):
            state = replace(states[-1], **{name: spoil(getattr(states[-1], name), rng)})
            advance(
                problem,
                state,
                1e-5,
                tolerance=1e-4,
                balance_tolerance=1e-9,
                max_iterations=10,
            )


def try_spoilt_panel(solution, rng):
    """A panel of the net, and one of spoilt forces."""
    panel = Panel(
        post_spacing=rng.uniform(2, 6),
        lower=Rope(stiffness=2e7, sag=rng.uniform(0, 0.15)),
        upper=Rope(stiffness=1e7, sag=rng.uniform(0, 0.15)),
        cut=str(rng.choice(CUTS)),
        has_mid_anchors=bool(rng.random() < 0.5),
    )
    stations = int(rng.integers(1, 11))
    solve_panel(solution, panel, stations=stations)
    with suppress(SolveError):  # no net is left
        problem = build_problem(take_strip(solution), [panel], stations)
        deflection = spoil(problem.ropes.deflection, rng)
        spoilt = replace(problem, ropes=replace(problem.ropes, deflection=deflection))
        for one, points in (
            (spoilt, guess_points(problem)),
            (problem, spoil(guess_points(problem), rng)),
        ):
            _solve_compiled(library.find_core(), one, points)


def main():
    library.LIBRARY = Path(sys.argv[1])
    assert library.find_core() is not None
    solved = 0
    with np.errstate(all="ignore"):
        for number in range(int(sys.argv[2])):
            with suppress(ModelError):
                scene = build_tables(draw_scene(9, number))
                found = solve_steady(scene, SolverSettings(accuracy=0.05))
                rng = np.random.default_rng([9, number])
                try_spoilt_plan(scene, rng)
                if isinstance(scene.net, Net):
                    with suppress(SolveError):
                        try_spoilt_rounds(scene, rng)
                    with suppress(SolveError):
                        try_spoilt_history(scene, rng)
                    if isinstance(found, Solution):
                        try_spoilt_panel(found, rng)
                solved += 1
    sys.stdout.write(f"{solved} scenes, 0 findings\n")


if __name__ == "__main__":
    main()
