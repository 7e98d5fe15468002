"""Measured series beside a history of the same row."""

import pytest

from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseTask
from netdesign.site.model import MonitoringSeries
from netdesign.solving.workers import Job
from netdesign.structure.layout import SupportLayout
from netdesign.study import record_monitoring as monitoring
from netdesign.study.record_monitoring import build_clock, follow_monitoring

DAY = 86400.0


def series(**changes):
    values = {
        "row_id": "R1",
        "member": "foot_anchor",
        "times": (0.0, 0.5 * DAY, DAY),
        "tensions": (10e3, None, 12e3),
        "air_temperatures": (263.15, 263.15, 263.15),
        "source": "Monitoring!A2",
    }
    return MonitoringSeries(**{**values, **changes})


def build_task(scene):
    return CaseTask(
        case=Case(density=366.8, friction_angle=0.5, inclination=0.5),
        job=scene and Job(scene=scene, settings=SolverSettings(accuracy=0.1)),
        refusal="" if scene else "the model refuses it",
        layout=SupportLayout(
            post_spacing=3.0, uphill_anchor_distance=4.0, downhill_anchor_distance=3.0
        ),
    )


def test_warmer_air_runs_the_clock_faster(a_scene):
    scene = a_scene()
    cold = build_clock(series(air_temperatures=(253.15,) * 3), scene)
    warm = build_clock(series(air_temperatures=(268.15,) * 3), scene)
    assert warm.to_creep_time(DAY) > 3.0 * cold.to_creep_time(DAY)


def test_snow_is_never_warmer_than_melting(a_scene):
    scene = a_scene()
    melting = build_clock(series(air_temperatures=(273.15,) * 3), scene)
    summer = build_clock(series(air_temperatures=(293.15,) * 3), scene)
    assert summer == melting


def test_without_temperatures_creep_time_is_time(a_scene):
    clock = build_clock(series(air_temperatures=(None,) * 3), a_scene())
    assert clock.to_creep_time(DAY) == DAY


def test_the_first_temperature_holds_before_it(a_scene):
    late = build_clock(series(air_temperatures=(None, 263.15, 263.15)), a_scene())
    whole = build_clock(series(), a_scene())
    assert late.to_creep_time(DAY) == pytest.approx(whole.to_creep_time(DAY))


def test_a_record_holds_both_in_units_of_the_edge(a_scene):
    task = build_task(a_scene(thickness_m=2.0, length_m=6.0, inclination_deg=30.0))
    (record,) = follow_monitoring(task, [series()])
    assert record.times_d == [0.0, 0.5, 1.0]
    assert record.tensions_kN == [10.0, None, 12.0]
    assert record.air_temperatures_C == pytest.approx([-10.0] * 3)
    assert record.model_reason is None
    assert len(record.model_times_d) == len(record.model_kN) > 5
    assert record.model_times_d[-1] == pytest.approx(1.0, rel=1e-6)
    # at rest within some per cent of the steady state: coupling/THEORY.md, section 6
    steady = solve_steady(task.job.scene, on_failure="raise")
    assert record.model_kN[-1] == pytest.approx(3.0 * steady.foot.size / 1e3, rel=0.12)


def test_a_refused_scene_leaves_its_reason():
    (record,) = follow_monitoring(build_task(None), [series()])
    assert record.model_kN == []
    assert str(record.model_reason) == "the model refuses it"
    assert record.tensions_kN == [10.0, None, 12.0]


def test_nothing_is_solved_without_a_measurement(monkeypatch):
    monkeypatch.setattr(monitoring, "solve_transient", None)
    assert follow_monitoring(build_task(None), []) == []
