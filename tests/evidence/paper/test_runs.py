"""Real runs on the coarsest meshes: what a track records is the run's."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.history.settings import TRANSIENT_LEVELS
from netdesign.evidence.paper.runs import (
    PaperSettings,
    Shape,
    find_exchange,
    find_history,
    find_steady,
    list_cases,
    run_case,
    run_study,
)
from netdesign.snow.mesh import MeshSize
from netdesign.words.message import say
from tests.build_paper import CURVE, TRIANGLE

COARSE = MeshSize(net_spacing=0.34, corner=0.1, sectors=4, upslope_spacing=1.5)
THIN = PaperSettings(
    levels=(COARSE, TRANSIENT_LEVELS[0]),
    horizon=600.0,
    undensified_horizon=300.0,
    exchange_drag=0.2,
    exchange_time=5e-3,
    drags=(0.2, 0.1),
    trend_time=5e-3,
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
    assert run.shape.mean_density > 366.8


def test_steady_run_is_that_of_the_scene():
    run = run_case(find_steady(find_history(0.0)), THIN)
    assert run.foot == pytest.approx(309.67e3, rel=0.01)  # FACTS.md, section 6
    assert run.head == pytest.approx(303.41e3, rel=0.01)
    assert run.track is None


def test_exchange_stops_at_its_creep_time():
    case = find_exchange(0.0, THIN)
    track = run_case(case, THIN).track
    step = track.times[1] - track.times[0]
    end = THIN.exchange_time * case.scene.time_scale
    assert end <= track.times[-1] < end + 1.001 * step
    assert track.plateau is None


def test_a_failure_is_a_result_with_its_reason(monkeypatch):
    from netdesign.evidence.paper import runs
    from netdesign.outcome import Outcome, SolveError

    def fail(*_, **__):
        raise SolveError(Outcome.DIVERGED, "made to fail")

    monkeypatch.setattr(runs, "run_exchange", fail)
    run = run_case(find_exchange(0.0, THIN), THIN)
    assert str(run.failure) == "made to fail"
    assert run.track is None
    assert run.foot is None


def test_study_runs_every_case_once(monkeypatch):
    from netdesign.evidence.paper import runs as module
    from netdesign.evidence.paper.runs import PaperRun

    done = []
    monkeypatch.setattr(
        module,
        "run_case",
        lambda case, **_: PaperRun(case=case, failure=say("outcome.diverged")),
    )
    study = run_study(THIN, on_done=done.append)
    assert list(study.runs) == list_cases(THIN)
    assert len(done) == len(study.runs) == len(set(study.runs))


def test_mean_density_is_weighted_by_area():
    nodes = np.column_stack([TRIANGLE, [4.0, 4.0]])
    shape = Shape(
        nodes=np.column_stack([nodes, [0.0, 12.0]]),
        triangles=np.array([[0, 2], [1, 1], [2, 4]]),
        density=np.array([300.0, 600.0]),
        curve=CURVE,
        sag=0.3,
    )
    # areas 8 and 16 m2
    assert shape.mean_density == pytest.approx((300.0 * 8 + 600.0 * 16) / 24)
