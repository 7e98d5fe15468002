"""Pressures of model and guideline; the part of friction, by hand."""

import random
from dataclasses import replace

import pytest

from netdesign.report.drawing.pressure_figure import (
    draw_pressure,
    find_friction,
    find_larger_case,
)
from tests.report.build_study import build_study

RECORD = next(x.guideline for x in build_study().rows if x.guideline)


def test_friction_is_what_the_pressure_does_not_hold():
    dice = random.Random(3)
    high, pressure = dice.uniform(1.3, 4.7), dice.uniform(2.1, 17.9)
    along = [(0.0, pressure), (0.37 * high, pressure), (high, 0.0)]
    area = pressure * high * (0.37 + 0.63 / 2)
    record = replace(RECORD, along_net=along, solved_load_kN_per_m=1.23 * area)
    assert find_friction(record) == pytest.approx(0.23 * area)
    assert find_friction(replace(record, along_net=[])) is None


def test_the_larger_load_case_is_shown_and_never_the_models_snow():
    loads = {"load_case_1": 11.7, "load_case_2": 13.9, "same_snow": 91.2}
    case = RECORD.cases[0]
    cases = [replace(case, name=x, load_kN_per_m=y) for x, y in loads.items()]
    assert find_larger_case(replace(RECORD, cases=cases)).load_kN_per_m == 13.9
    assert find_larger_case(replace(RECORD, cases=cases[2:])) is None


def test_without_a_solved_pressure_nothing_is_drawn():
    assert draw_pressure(replace(RECORD, along_net=[]), 3.0) == ""
