"""A mesh that rounding makes impossible ends a solve; it is no fault of the input."""

import pytest

from netdesign.addons.evidence.verification.rigid import Wall, put_wall, solve_rigid
from netdesign.addons.history.settings import TransientSettings
from netdesign.addons.history.transient import solve_transient
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import FailedSolution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.mesh import MeshSize

TOO_FINE = MeshSize(net_spacing=0.04, corner=1e-7, sectors=12, upslope_spacing=0.2)


def build_wall(a_scene):
    scene = a_scene(length_m=27.3, thickness_m=3.1)
    return put_wall(scene, Wall(inclination=0.21, height_normal=3.1))


def build_net(a_scene):
    return a_scene(length_m=27.3, thickness_m=3.1, slack=0.03, inclination_deg=22.0)


SOLVES = {
    "steady": (solve_steady, build_net, SolverSettings),
    "rigid": (solve_rigid, build_wall, SolverSettings),
    "transient": (solve_transient, build_net, TransientSettings),
}


# Of a history the first mesh only: a whole one comes before the second.
@pytest.mark.parametrize(
    ("name", "levels"),
    [
        *((name, (TOO_FINE, TOO_FINE)) for name in SOLVES),
        *((name, (MESH_LEVELS[0], TOO_FINE)) for name in ("steady", "rigid")),
    ],
)
def test_a_mesh_too_fine_is_an_outcome(a_scene, name, levels):
    solve, build, settings = SOLVES[name]
    scene, chosen = build(a_scene), settings(levels=levels, accuracy=1e-3)
    failed = solve(scene, chosen)
    assert isinstance(failed, FailedSolution)
    assert failed.outcome is Outcome.OUT_OF_VALIDITY
    assert "too fine" in str(failed.reason)
    assert "allow a larger error, or join thin layers" in str(failed.reason)
    if name == "steady":
        with pytest.raises(SolveError, match="too fine"):
            solve_steady(scene, chosen, on_failure="raise")
