"""A study made up from formulas: what the findings have to say of it is known."""

import math

import numpy as np

from netdesign.evidence.paper.runs import (
    PaperRun,
    PaperSettings,
    PaperStudy,
    Shape,
    Track,
    list_cases,
)
from netdesign.words.message import say

SETTINGS = PaperSettings()
TRIANGLE = np.array([[0.0, 4.0, 0.0], [0.0, 0.0, 4.0]])
CURVE = np.array([[0.0, 0.3, 0.0], [0.0, 2.0, 4.0]])


def build_study(pull=None, *, swings=0, plateau=1000.0, density=400.0, failing=()):
    """Study in which the foot carries ``pull(case)`` [N/m] at rest.

    Staggered runs turn back ``swings`` times; all begin their plateau at ``plateau``
    seconds, None: never.
    """
    pull = pull or (lambda _: 3e5)
    runs = {}
    for case in list_cases(SETTINGS):
        if case in failing:
            runs[case] = PaperRun(
                case=case, failure=say("text.as_given", text="made to fail")
            )
            continue
        runs[case] = build_run(case, pull(case), swings, plateau, density)
    return PaperStudy(settings=SETTINGS, runs=runs)


def build_run(case, size, swings, plateau, density):
    shape = Shape(
        nodes=TRIANGLE,
        triangles=np.array([[0], [1], [2]]),
        density=np.array([366.8 if case.until else density]),
        curve=CURVE,
        sag=size / 1e6,
    )
    if case.method == "steady":
        return PaperRun(case=case, foot=size, head=size, shape=shape)
    times = np.geomspace(1.0, case.until or 1e5, 101)
    foot = size * (1.0 - np.exp(-times / 20.0))
    if case.method == "staggered" and swings:
        phase = np.linspace(0.0, math.pi * swings, 101)
        foot = size * (1.0 + 0.3 * np.sin(phase + 1e-9))
    index = None
    if plateau is not None and plateau < times[-1]:
        index = int(np.searchsorted(times, plateau))
    node = np.array([-foot / 10.0, foot / 100.0])
    track = Track(
        times=times,
        foot=foot,
        head=0.9 * foot,
        lower=node,
        upper=node,
        heights=(1.0, 3.0),
        density=np.full(101, 0.45),
        plateau=index,
        ended=None,
    )
    at_rest = None if index is None else float(foot[index])
    return PaperRun(
        case=case,
        foot=at_rest,
        head=None if at_rest is None else 0.9 * at_rest,
        foot_error=1e3,
        head_error=1e3,
        track=track,
        shape=shape,
    )
