"""The envelope of a row on the real solver, coarse; and of many rows together."""

from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS
from netdesign.coupling.solution import FailedSolution
from netdesign.envelope.panel_forces import POST_PULLS
from netdesign.envelope.ranges import PARAMETERS
from netdesign.envelope.rows import build_point_task, refine_settings
from netdesign.envelope.search import run_grid, search_rows
from netdesign.outcome import Outcome
from netdesign.search.maxima import SearchSettings
from netdesign.solving.runner import Runner
from netdesign.solving.workers import ProcessPool
from netdesign.words.message import say
from tests.envelope.tasks import build_row
from tests.solving.made_up_workers import Spoiling
from tests.solving.small_scene import COARSE, LAYOUT, solve_case

TASK = build_row((250.0, 400.0), (15.0, 45.0))
RANGES = TASK.ranges


@pytest.fixture(scope="module")
def found(runner):
    finer = refine_settings(replace(COARSE, levels=MESH_LEVELS[:4]))
    (one,) = search_rows([replace(TASK, confirmed_by=finer)], runner)
    return one


@pytest.fixture(scope="module")
def grid():
    return run_grid(TASK, {"density": 7, "friction_angle": 9}, Runner())[0]


def test_a_grid_is_even_in_its_values(grid):
    for name, count in (("density", 7), ("friction_angle", 9)):
        span = RANGES[name]
        values = sorted({getattr(result.case, name) for result in grid})
        assert values == pytest.approx(np.linspace(span.low, span.high, count))


def test_no_case_of_a_grid_exceeds_the_bound(found, grid):
    assert found.gap is None
    assert not found.lifted  # the net hangs below its head, between the cases too
    assert found.extremes[POST_PULLS[0]].widened.high == 0.0
    for result in grid:
        for member, band in result.member_forces.items():
            assert band.value <= found.extremes[member].widened.high
            if member in POST_PULLS:
                continue
            place = found.members.index(member)
            bound = found.maxima.upper_bound[place]
            assert band.value <= bound * (1.0 + 1e-9), (member, result.case)


def test_the_maximum_is_that_of_its_governing_case_with_all_coincident_forces(found):
    for place, member in enumerate(found.members):
        governing = found.extremes[member].governing
        assert governing.member_forces[member].value == found.maxima.maximum[place]
        assert set(governing.member_forces) == {*found.members, POST_PULLS[0]}


def test_what_may_lift_a_post_between_the_cases_is_in_the_band(found):
    lifted = replace(found, lifted={POST_PULLS[0]: 7e3, "uphill_guy": 9e9})
    assert lifted.extremes[POST_PULLS[0]].widened.high == 7e3
    assert lifted.extremes["uphill_guy"].upper_bound == pytest.approx(9e9, rel=1e-12)
    assert lifted.extremes["post"].hidden == found.extremes["post"].hidden


def test_the_band_holds_numerical_error_and_what_hides(found):
    for place, member in enumerate(found.members):
        band = found.extremes[member].widened
        hidden = found.maxima.upper_bound[place] - found.maxima.maximum[place]
        largest = max(r.member_forces[member].high for r in found.results)
        assert band.high >= largest + hidden - 1e-9
        assert band.value == found.maxima.maximum[place]


def test_governing_cases_are_confirmed_on_a_finer_mesh(found):
    assert {one.member for one in found.confirmations} == {
        member for member in found.members if found.extremes[member].widened.value > 0.0
    }
    for one in found.confirmations:
        assert one.confirmed.case == one.screened.case
        assert (
            one.confirmed.solution.cost.elements > one.screened.solution.cost.elements
        )
        forces = [
            r.member_forces[one.member].value for r in (one.confirmed, one.screened)
        ]
        assert one.difference == pytest.approx(forces[0] / forces[1] - 1.0)
        assert abs(one.difference) < 0.1
        assert (
            found.extremes[one.member].widened.high
            >= one.confirmed.member_forces[one.member].high
        )


def test_rows_that_share_net_and_snow_share_cases(found):
    other = replace(LAYOUT, post_spacing=2.5)
    runner = Runner()
    one, two = search_rows([TASK, replace(TASK, layouts=(other,))], runner)
    foot = one.members.index("foot_anchor")
    assert one.maxima.maximum[foot] / two.maxima.maximum[foot] == pytest.approx(1.4)
    assert runner.counts.reused >= len(one.results) - 15


def spoil_rough_dense(job, end):
    spoilt = job.scene.net.friction_angle > 0.7 and job.scene.snowpack.density > 390.0
    return (
        FailedSolution(
            outcome=Outcome.DIVERGED, reason=say("text.as_given", text="spoilt")
        )
        if spoilt
        else end
    )


def test_a_failed_case_leaves_a_gap_by_name():
    (found,) = search_rows([TASK], Runner(workers=Spoiling(spoil_rough_dense)))
    assert "failed (spoilt)" in str(found.gap)
    assert all(found.extremes[m].governing.is_converged for m in found.members)


def test_no_gap_is_closed_beyond_the_accuracy_of_the_cases():
    """Asked for 0.01 % of cases that are good to some per cent: few are solved."""
    closest = replace(TASK, search=SearchSettings(gap=1e-4))
    (found,) = search_rows([closest], Runner())
    assert found.maxima.is_closed
    assert len(found.results) <= 60
    foot = found.extremes["foot_anchor"].governing.member_forces["foot_anchor"]
    assert found.extremes["foot_anchor"].hidden <= 0.5 * (foot.high - foot.value) * (
        1 + 1e-9
    )


def test_without_a_layout_the_nets_tensions_are_followed_per_metre():
    (found,) = search_rows([replace(TASK, layouts=())], Runner())
    assert found.members == ("foot", "head", "rope")
    foot, head, rope = found.maxima.maximum
    assert rope >= max(foot, head) * (1.0 - 1e-12)
    governing = found.extremes["foot"].governing
    assert governing.solution.foot.size == foot


# --- a grid in lines of ascending friction -------------------------------------------


def find_share(name, span, value):
    """Share of a range at which a value lies: even in a power of it."""
    power = PARAMETERS[name].power
    low, high = span.low**power, span.high**power
    return (value**power - low) / (high - low)


def test_cases_of_a_grid_are_those_of_each_on_its_own(grid):
    for result in grid[::5]:
        if result.solution is None:
            continue
        values = result.case.density, result.case.friction_angle
        place = tuple(
            find_share(name, one, value)
            for value, (name, one) in zip(values, RANGES.intervals, strict=True)
        )
        own = solve_case(build_point_task(TASK, place))
        for member, band in own.member_forces.items():
            slack = 0.2 * (band.high - band.value)  # snow that sticks is not solved
            assert result.member_forces[member].value == pytest.approx(
                band.value, abs=slack
            )


def test_a_grid_does_not_depend_on_where_its_lines_are_solved(grid):
    with closing(ProcessPool(2, worth=1)) as pool:
        runner = Runner(workers=pool)
        other = run_grid(TASK, {"density": 7, "friction_angle": 9}, runner)[0]
    for one, two in zip(grid, other, strict=True):
        assert one.member_forces == two.member_forces
