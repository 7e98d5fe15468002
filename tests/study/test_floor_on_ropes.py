"""The guideline's load on the ropes of panels that nobody gives: (P12), (P13)."""

import math
import random
from dataclasses import fields, replace

import numpy as np
import pytest

from netdesign.cable.funicular import build_alike
from netdesign.envelope.panel_forces import PanelForces, Pulls
from netdesign.envelope.row_pulls import (
    find_rope_factors,
    list_panels,
    read_heads,
)
from netdesign.guideline.floor import Floor, FloorForce, HeadSpan
from netdesign.panel.solve import PanelSolution, solve_strips
from netdesign.panel.strips import build_strip
from netdesign.structure.members import Member, RopeForce
from tests.each import each
from tests.panel.test_assumed import assume_all, draw_case, list_ends

LOWER = (RopeForce.LOWER_ALONG, RopeForce.LOWER_TENSION)


def make_floor(foot, head):
    """Floor that pulls so much on foot and head [N]."""
    force = FloorForce(
        member=Member.FOOT_ANCHOR, force=foot, net=None, case=None, glide_factor=1.0
    )
    span = HeadSpan(pull=head, foot_least=0.0, foot_largest=0.0)
    return Floor(forces=(force,), head=span)


def measure_foot(solution):
    return math.hypot(*np.add(solution.foot, solution.mid_foot))


def take_largest(results, rope):
    """Largest force of a rope over all cases and panels [N]."""
    return max(panel.ropes[rope][1].max() for panel in list_panels(results))


def take_alone(result, place):
    """The case with one of its panels alone."""
    (panel,) = list_panels([result])
    own, solved = [place], panel.solved
    names = (x.name for x in fields(solved) if x.name not in ("panels", "failures"))
    arrays = {name: getattr(solved, name)[own] for name in names}
    alone = PanelForces(
        solved=replace(solved, panels=(solved.panels[place],), **arrays),
        pulls=Pulls(*(each[own] for each in panel.pulls)),
        ropes={name: band[:, own] for name, band in panel.ropes.items()},
    )
    return replace(result, panel=alone)


def draw_assumed(seed, mid):
    """Draws of a seed, what solves its cases, and all panels that may be built."""
    solve, _, spacing = draw_case(seed)
    return random.Random(seed), solve, assume_all(spacing, mid)


@each("mid", [False, True])
@each("seed", range(40, 50))
def test_each_panel_that_may_be_built_is_raised_as_if_it_were_given(seed, mid):
    """The force of each rope is that of the worst of them: H and T by one factor."""
    draw, solve, panels = draw_assumed(seed, mid)
    results = [solve(panels, draw.uniform(0.6, 1.3)) for _ in range(3)]
    if len(list_panels(results)) < len(results):
        pytest.skip("a case without panels")
    solved = list_panels(results)[0].solved
    solutions = [solved.describe(place) for place in range(len(panels))]
    foot = draw.uniform(0.5, 2.5) * max(map(measure_foot, solutions))
    head = draw.uniform(0.5, 2.5) * max(math.hypot(*one.head) for one in solutions)
    floor = make_floor(foot, head)
    together = find_rope_factors(results, floor)
    for rope in RopeForce:
        name = "lower" if rope in LOWER else "ridge"
        raised = getattr(together, name) * take_largest(results, rope)
        alone = []
        for place in range(len(solutions)):
            given = [take_alone(result, place) for result in results]
            factor = getattr(find_rope_factors(given, floor), name)
            alone.append(factor * take_largest(given, rope))
        assert (1.0 - 1e-12) * max(alone) <= raised <= 1.01 * max(alone)


@each("mid", [False, True])
@each("seed", range(50, 56))
def test_cases_at_the_ends_of_a_range_are_raised_as_if_each_end_were_typed(seed, mid):
    """No typed density asks more of a rope, nor pulls more on a head."""
    draw, solve, panels = draw_assumed(seed, mid)
    shares = (0.6, draw.uniform(0.7, 1.1), 1.3)
    results = [
        replace(one, case=replace(one.case, density=share))
        for one, share in ((solve(panels, share), share) for share in shares)
    ]
    if len(list_panels(results)) < len(results):
        pytest.skip("a case without panels")
    heads = read_heads(panels[0].post_spacing, results)
    head = draw.uniform(0.5, 2.5) * float(np.hypot(*heads.pulls).max())
    floor = make_floor(0.0, head)
    raised = [
        find_rope_factors(some, floor).ridge * take_largest(some, RopeForce.UPPER_ALONG)
        for some in (results, *([one] for one in results))
    ]
    assert max(raised[1], raised[3]) <= raised[0] * (1.0 + 1e-12)
    assert raised[0] <= 1.01 * max(raised[1:])
    sizes = [math.hypot(*pull) for _, pull in heads.list_outermost(head)]
    most = max(head, float(np.hypot(*heads.pulls).max()))
    assert max(sizes) == pytest.approx(most, rel=1e-9)


@each("mid", [False, True])
@each("seed", range(2100, 2106))
def test_raised_ropes_pull_no_less_than_any_panel_under_that_load(seed, mid):
    """All 48 ends of what is built, each under the load that reaches the floor."""
    draw = random.Random(seed)
    solve, net, spacing = draw_case(seed)
    result = solve(assume_all(spacing, mid))
    state = result.solution
    strip = build_strip(net, state.net_curve, state.net_forces, state.foot)
    solved = solve_strips(strip, list_ends(spacing, mid))
    panels = [
        solved.describe(place)
        for place in range(len(solved.panels))
        if place not in solved.failures
    ]
    share = draw.uniform(1.0, 2.5)
    foot, head = (share * end.size * spacing for end in (state.foot, state.head))
    factors = find_rope_factors([result], make_floor(foot, head))
    lower = factors.lower * take_largest([result], RopeForce.LOWER_ALONG)
    ridge = factors.ridge * take_largest([result], RopeForce.UPPER_ALONG)
    for one in panels:
        at_foot = solve_raised(strip, one, foot / measure_foot(one))
        at_head = solve_raised(strip, one, head / math.hypot(*one.head))
        assert at_foot is None or at_foot.lower.along <= lower
        assert at_head is None or at_head.upper.along <= ridge


def solve_raised(strip, solution, factor):
    """Panel under so many times its load; None where it lies on the ground then."""
    forces = max(1.0, factor) * strip.forces
    raised = replace(
        strip,
        forces=forces,
        foot_pull=max(1.0, factor) * strip.foot_pull,
        alike=build_alike(forces, strip.shares, strip.stiffness),
    )
    solved = solve_strips(raised, (solution.panel,)).describe(0)
    return solved if isinstance(solved, PanelSolution) else None
