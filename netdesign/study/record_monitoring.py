"""Measured tension beside the model's history of the same net row."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from netdesign.coupling.history.clock import Clock
from netdesign.coupling.history.net_start import Start
from netdesign.coupling.history.staggered import StaggeredSettings
from netdesign.coupling.history.transient import TransientSettings, solve_transient
from netdesign.coupling.moments import HistoryPoint
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import FailedSolution, Solution
from netdesign.envelope.run import CaseTask
from netdesign.fault import SENTENCE, Fault, catch_fault
from netdesign.site.model import MonitoringSeries
from netdesign.snow.fluidity import COLDEST, FLUIDITY_EXPONENT, WARMEST
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout, place_support
from netdesign.study.records import MonitoringRecord
from netdesign.units import (
    celsius_from_kelvin,
    day_from_second,
    kilonewton_from_newton,
    kilonewton_if_known,
)
from netdesign.words.message import Message, say

_START: Start = "steady"


@dataclass(frozen=True, slots=True, kw_only=True)
class _Modelled:
    """Member force against time, or why there is none."""

    times_d: list[float]
    forces_kN: list[float]
    reason: Message | None = None


def follow_monitoring(
    task: CaseTask,
    series: Sequence[MonitoringSeries],
    on_fault: Callable[[Fault], None] = lambda _: None,
) -> list[MonitoringRecord]:
    """Record measured series with the history of one case beside each.

    Parameters
    ----------
    task : CaseTask
        Case of the net row that stands for it.
    series : sequence of MonitoringSeries
        Of this net row; without any, nothing is solved.
    on_fault : callable, optional
        Takes what failed in the program.

    Returns
    -------
    list of MonitoringRecord
        One for each series. A history that fails leaves its reason.
    """
    return [_record(one, _guard(task, one, on_fault)) for one in series]


def build_clock(series: MonitoringSeries, scene: Scene) -> Clock:
    """Clock of the air temperatures, no warmer than melting; else the scene's.

    Snow follows the air late and less; nothing else is measured.
    """
    known = [
        (time, min(max(kelvin, COLDEST), WARMEST))
        for time, kelvin in zip(series.times, series.air_temperatures, strict=True)
        if kelvin is not None
    ]
    if not known or scene.creep_law.exponent != FLUIDITY_EXPONENT:
        return Clock()
    if known[0][0] > 0.0:
        known.insert(0, (0.0, known[0][1]))
    times, kelvins = (np.array(part) for part in zip(*known, strict=True))
    return Clock.of_temperatures(times, kelvins, scene.creep_fluidity)


def _guard(
    task: CaseTask, series: MonitoringSeries, on_fault: Callable[[Fault], None]
) -> _Modelled:
    """History of a series; that the program failed is a reason of its own."""
    case = f"history beside the readings of {series.source}"
    found = catch_fault(partial(_follow, task, series), case)
    if not isinstance(found, Fault):
        return found
    on_fault(found)
    return _Modelled(times_d=[], forces_kN=[], reason=SENTENCE)


def _record(series: MonitoringSeries, modelled: _Modelled) -> MonitoringRecord:
    return MonitoringRecord(
        member=series.member,
        source=series.source,
        times_d=[day_from_second(time) for time in series.times],
        tensions_kN=[kilonewton_if_known(value) for value in series.tensions],
        air_temperatures_C=[
            None if value is None else celsius_from_kelvin(value)
            for value in series.air_temperatures
        ],
        model_times_d=modelled.times_d,
        model_kN=modelled.forces_kN,
        model_start=_START,
        model_reason=modelled.reason,
    )


def _follow(task: CaseTask, series: MonitoringSeries) -> _Modelled:
    if task.job is None:
        return _Modelled(times_d=[], forces_kN=[], reason=task.refusal)
    scene, asked = task.job.scene, task.job.settings
    reason: Message | None
    if task.layout is None or isinstance(asked, StaggeredSettings):
        reason = say("monitoring.needs_support")
        return _Modelled(times_d=[], forces_kN=[], reason=reason)
    if not series.times[-1] > 0.0:
        reason = say("monitoring.single_reading")
        return _Modelled(times_d=[], forces_kN=[], reason=reason)
    clock = build_clock(series, scene)
    settings = TransientSettings(
        accuracy=asked.accuracy, start=_START, horizon=series.times[-1]
    )
    solution = solve_transient(scene, settings, clock=clock)
    if isinstance(solution, FailedSolution):
        return _Modelled(times_d=[], forces_kN=[], reason=solution.reason)
    if solution.history is None:
        reason = say("monitoring.no_history")
        return _Modelled(times_d=[], forces_kN=[], reason=reason)
    return _read_member(task.layout, solution, solution.history.moments, series.member)


def _read_member(
    layout: SupportLayout,
    solution: Solution,
    moments: Sequence[HistoryPoint],
    member: str,
) -> _Modelled:
    points = place_support(layout, solution.head_point)
    found = _Modelled(times_d=[], forces_kN=[])
    for moment in moments:
        foot, head = moment.foot.tolist(), moment.head.tolist()
        forces = compute_anchor_forces(
            points,
            foot_pull_per_m=(foot[0], foot[1]),
            head_pull_per_m=(head[0], head[1]),
            post_spacing=layout.post_spacing,
        )
        if isinstance(forces, FailedSupport):
            return replace(found, reason=forces.reason)
        found.times_d.append(day_from_second(moment.time))
        found.forces_kN.append(kilonewton_from_newton(forces.member_forces[member]))
    return found
