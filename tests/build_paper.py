"""A study of the paper made up from formulas."""

from types import SimpleNamespace

import numpy as np

from netdesign.addons.evidence.paper.study import (
    PaperRun,
    PaperSettings,
    PaperStudy,
    Track,
    list_cases,
)
from netdesign.words.message import say

SETTINGS = PaperSettings()
PLATEAU = 1000.0  # [s]
TRIANGLE = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 4.0]])
CURVE = np.array([[0.0, 0.3, 0.0], [0.0, 2.0, 4.0]])


def build_study(pull=None, *, failing=()):
    """Study in which the foot carries ``pull(case)`` [N/m] at rest."""
    pull = pull or (lambda _: 3e5)
    runs = {}
    for case in list_cases():
        if case in failing:
            told = say("text.as_given", text="made to fail")
            runs[case] = PaperRun(case=case, failure=told)
        else:
            runs[case] = build_run(case, pull(case))
    return PaperStudy(settings=SETTINGS, runs=runs)


def build_run(case, size):
    solution = SimpleNamespace(
        mesh_nodes=TRIANGLE,
        mesh_triangles=np.array([[0], [1], [2]]),
        mesh_density=np.array([366.8]),
        net_curve=CURVE,
    )
    if case.method == "steady":
        return PaperRun(case=case, foot=size, head=size, solution=solution)
    times = np.geomspace(1.0, case.until or 1e5, 101)
    foot = size * (1.0 - np.exp(-times / 20.0))
    index = int(np.searchsorted(times, PLATEAU)) if times[-1] > PLATEAU else None
    node = np.array([-foot / 10.0, foot / 100.0])
    track = Track(
        times=times,
        foot=foot,
        head=0.9 * foot,
        lower=node,
        upper=node,
        heights=(1.0, 3.0),
        plateau=index,
    )
    at_rest = None if index is None else float(foot[index])
    return PaperRun(
        case=case,
        foot=at_rest,
        head=None if at_rest is None else 0.9 * at_rest,
        foot_error=1e3,
        head_error=1e3,
        track=track,
        solution=solution,
    )
