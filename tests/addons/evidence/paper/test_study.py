"""Real runs of the paper on the coarsest meshes."""

from dataclasses import replace

import pytest

from netdesign.addons.evidence.paper.study import (
    PaperSettings,
    find_exchange,
    find_history,
    find_steady,
    run_case,
)
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.snow.mesh import MeshSize

COARSE = MeshSize(net_spacing=0.34, corner=0.1, sectors=4, upslope_spacing=1.5)
THIN = PaperSettings(
    levels=(COARSE, TRANSIENT_LEVELS[0]),
    horizon=600.0,
    exchange_drag=0.2,
    exchange_time=5e-3,
)


def test_history_is_in_balance_with_its_nodes():
    run = run_case(replace(find_history(0.0), start="sagged"), THIN)
    track = run.track
    assert run.failure is None
    assert track.times[-1] == pytest.approx(600.0)
    # on a net normal to the slope the snow pushes downslope: the net pushes back
    assert (track.lower[0] < 0).all()
    assert (track.upper[0] < 0).all()
    assert track.heights[0] == pytest.approx(1.0, abs=0.5)
    assert track.heights[1] == pytest.approx(3.0, abs=0.5)
    assert track.at(600.0, "foot") == pytest.approx(track.foot[-1])
    assert run.solution.mesh_density.mean() > 366.8


def test_steady_run_is_that_of_the_scene():
    run = run_case(find_steady(find_history(0.0)), THIN)
    assert run.foot == pytest.approx(309.67e3, rel=0.01)  # FACTS.md, section 6
    assert run.head == pytest.approx(303.41e3, rel=0.01)
    assert run.track is None


def test_exchange_stops_at_its_creep_time():
    case = find_exchange(0.0)
    track = run_case(case, THIN).track
    step = track.times[1] - track.times[0]
    end = THIN.exchange_time * case.scene.time_scale
    assert end <= track.times[-1] < end + 1.001 * step
    assert track.plateau is None


def test_a_failure_is_a_result_with_its_reason(monkeypatch):
    from netdesign.addons.evidence.paper import study as runs
    from netdesign.outcome import Outcome, SolveError

    def fail(*_, **__):
        raise SolveError(Outcome.DIVERGED, "made to fail")

    monkeypatch.setattr(runs, "run_exchange", fail)
    run = run_case(find_exchange(0.0), THIN)
    assert str(run.failure) == "made to fail"
    assert run.track is None
    assert run.foot is None
