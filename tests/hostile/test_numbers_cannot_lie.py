"""Whatever goes wrong between a solver and a verdict, the verdict is no pass."""

import contextlib
import math
import random
import sqlite3
from dataclasses import replace
from functools import lru_cache

import pytest

from netdesign.checks import load_standard
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import FailedSolution
from netdesign.outcome import Outcome, Verdict
from netdesign.solving import store as store_module
from netdesign.solving import workers as workers_module
from netdesign.solving.runner import Runner
from netdesign.solving.solve import solve_scene
from netdesign.solving.store import CaseStore
from netdesign.solving.workers import OwnProcess
from netdesign.structure.members import MEMBER_MODES
from netdesign.study.cases import search_site
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun
from tests import small_site
from tests.each import each
from tests.grid import solve_site
from tests.small_site import RANGES as GRID
from tests.small_site import STRONG, WEAK, build_row, resist
from tests.solving.made_up_workers import Spoiling

PROFILE = "nf-p-95-304-style"
RUN = CheckRun(settings=SolverSettings(accuracy=0.05, levels=MESH_LEVELS[:3]))
SEARCHED = replace(GRID)
solve_once = lru_cache(maxsize=None)(solve_scene)


def build_site(ranges=GRID, *, strength=STRONG, **missing):
    """Site of one row; ``missing`` are members and modes without that resistance."""
    row = build_row("R1", resistances=resist(strength, **missing))
    return small_site.build_site(row, ranges=ranges)


def judge(site, runner=None, standard=None):
    """Study of a site, searched or on a grid by its ranges."""
    standard = standard or load_standard(PROFILE)
    solve = search_site if site.ranges is SEARCHED else solve_site
    return judge_site(site, solve(site, RUN, runner or Runner()), standard, RUN)


@pytest.fixture(autouse=True)
def _remembered(monkeypatch):
    monkeypatch.setattr(workers_module, "solve_scene", solve_once)


@pytest.fixture
def spoil(monkeypatch):
    """Let a fault happen in the solves of these numbers; how many there were."""

    def spoil_calls(fault, is_hit):
        calls, scenes = [], set()

        def solve(scene, settings):
            """A scene that was hit stays so: a search tries it again."""
            solution = solve_once(scene, settings)
            calls.append(settings)
            if is_hit(len(calls) - 1):
                scenes.add(scene)
            return fault(solution) if scene in scenes else solution

        monkeypatch.setattr(workers_module, "solve_scene", solve)
        return calls

    return spoil_calls


# --- solvers that lie or die ---------------------------------------------------------


def end_by(outcome):
    return lambda solution: FailedSolution(
        scene=solution.scene, outcome=outcome, reason="spoilt", rounds=1, history=None
    )


def die_of(error):
    def die(_):
        raise error

    return die


def change(part, **values):
    if part is None:
        return lambda solution: replace(solution, **values)
    return lambda solution: replace(
        solution, **{part: replace(getattr(solution, part), **values)}
    )


def spoil_curve(solution):
    curve = solution.net_curve.copy()
    curve[0, -1] = math.nan
    return replace(solution, net_curve=curve)


FAULTS = {
    **{o.value: end_by(o) for o in Outcome if o is not Outcome.CONVERGED},
    "floating point": die_of(FloatingPointError("overflow")),
    "memory": die_of(MemoryError()),
    "recursion": die_of(RecursionError()),
    "foot is nan": change("foot", x=math.nan),
    "foot is infinite": change("foot", y=math.inf),
    "head is nan": change("head", y=math.nan),
    "error is nan": change("foot", error=math.nan),
    "error is infinite": change("head", error=math.inf),
    "error is negative": change("head", error=-1.0),
    "tension is nan": change(None, tension_max=math.nan),
    "balance is nan": change("balance", relative_residual=math.nan),
    "friction is nan": change("balance", friction_excess=math.nan),
    "shape is nan": spoil_curve,
}


@pytest.mark.parametrize("ranges", [GRID, SEARCHED], ids=["grid", "search"])
def test_the_sound_site_passes(ranges):
    assert judge(build_site(ranges)).verdict is Verdict.PASS


def list_hits(places, count):
    """Each fault in some of these places, and in each place some of the faults."""
    return [
        (fault, places[(number + turn * 4) % len(places)])
        for number, fault in enumerate(FAULTS)
        for turn in range(count)
    ]


def tell_open(row):
    """Reason of the first check that does not pass."""
    return next(str(x.reason) for x in row.checks if x.verdict is not Verdict.PASS)


@each("fault, hit", list_hits(range(9), 2))
def test_a_fault_in_any_case_of_a_grid_is_no_pass(spoil, fault, hit):
    calls = spoil(FAULTS[fault], lambda call: call == hit)
    row = judge(build_site()).rows[0]
    assert len(calls) == 9
    assert row.verdict is Verdict.NOT_PROVEN
    assert "1 of 9 cases failed" in tell_open(row)


@pytest.fixture
def number(spoil):
    """Solves of a sound search."""
    calls = spoil(None, lambda _: False)
    judge(build_site(SEARCHED))
    return len(calls)


@each("fault, hit", list_hits((0, 7, -1), 1))
def test_a_fault_in_any_case_of_a_search_is_no_pass(spoil, number, fault, hit):
    """The last solves are those that confirm the governing cases."""
    place = hit % number
    calls = spoil(FAULTS[fault], lambda call: call == place)
    row = judge(build_site(SEARCHED)).rows[0]
    assert len(calls) > place
    assert row.verdict is Verdict.NOT_PROVEN
    told = tell_open(row)
    assert "failed" in told or "could not be calculated again" in told


@each("fault", FAULTS)
@each("ranges", [GRID, SEARCHED])
def test_a_fault_in_every_case_is_no_pass(spoil, fault, ranges):
    spoil(FAULTS[fault], lambda _: True)
    assert judge(build_site(ranges)).verdict is Verdict.NOT_PROVEN


@each("fault", FAULTS)
def test_a_fault_does_not_hide_a_sure_failure(spoil, fault):
    spoil(FAULTS[fault], lambda call: call == 0)
    assert judge(build_site(strength=WEAK)).verdict is Verdict.FAIL


# --- limits that are missing ---------------------------------------------------------


@each("name", [f"{member}__{mode}" for member, mode in MEMBER_MODES])
def test_no_resistance_is_no_pass_even_of_a_slack_member(name):
    study = judge(build_site(**{name: None}))
    check = next(
        one for one in study.rows[0].checks if one.id == name.replace("__", ".")
    )
    assert check.read("E_k") is not None
    assert study.verdict is check.verdict is Verdict.NOT_PROVEN


# Of the height a profile need not say anything; no anchor here is only computed or
# bends, that of the post beside the snow is, and nothing lifts a post. The ground has a
# cover, and no strength. The values of the end effect come together.
NOT_NEEDED = {
    "geometry.height.ratio",
    "resistance.pull_out.computed",
    "resistance.bending",
    "resistance.tension",
    *("resistance.wedge", "soil.cohesion", "soil.friction"),
    *("post.efficiency", "post.efficiency.per_glide"),
    "tests.count",  # no anchor here has single tests
}
LIMITS = {
    "end." if one.id.startswith("end.") else one.id
    for one in load_standard(PROFILE).values
}


@each("left_out", sorted(LIMITS))
def test_a_limit_that_is_left_out_is_no_pass_where_a_check_needs_it(left_out):
    standard = load_standard(PROFILE)
    kept = tuple(one for one in standard.values if not one.id.startswith(left_out))
    less = replace(standard, values=kept)
    expected = Verdict.PASS if left_out in NOT_NEEDED else Verdict.NOT_PROVEN
    assert judge(build_site(), standard=less).verdict is expected
    assert judge(build_site(strength=WEAK), standard=less).verdict is not Verdict.PASS


# --- stores of another time ----------------------------------------------------------


def lie(_, end):
    """Forces a thousand times too small, as of a solver with a fault long mended."""
    pulls = {
        name: replace(pull, x=pull.x / 1e3, y=pull.y / 1e3)
        for name, pull in (("foot", end.foot), ("head", end.head))
    }
    return replace(end, **pulls)


@pytest.fixture
def stored(tmp_path):
    """Judge a site with the store of this test, by sound workers or others.

    Without a floor by the guideline's load: the solved forces alone decide.
    """
    standard = replace(load_standard(PROFILE), floor="none")

    def judge_stored(site, workers=None):
        with CaseStore(tmp_path / "cases.sqlite", lambda _: None) as store:
            runner = Runner(store=store, workers=workers or OwnProcess())
            return judge(site, runner, standard=standard), runner.counts

    return judge_stored


def test_a_store_of_another_solver_decides_nothing(stored, monkeypatch):
    weak = build_site(strength=2e4)
    monkeypatch.setattr(store_module, "identify_solver", lambda: "0.0+old")
    lied, _ = stored(weak, Spoiling(lie))
    assert lied.verdict is not Verdict.FAIL  # the store would turn the verdict
    monkeypatch.undo()
    study, counts = stored(weak)
    assert study.verdict is Verdict.FAIL
    assert (counts.reused, counts.solved) == (0, 9)


def test_entries_exchanged_in_a_store_decide_nothing(stored, tmp_path):
    site = build_site()
    sound, _ = stored(site)
    with contextlib.closing(sqlite3.connect(tmp_path / "cases.sqlite")) as base:
        rows = base.execute("SELECT * FROM cases ORDER BY name").fetchall()
        names = [row[0] for row in rows]
        for name, row in zip([*names[1:], names[0]], rows, strict=True):
            base.execute(
                "UPDATE cases SET numbers = ?, seal = ? WHERE name = ?",
                (*row[1:], name),
            )
        base.commit()
    study, counts = stored(site)
    assert (counts.reused, counts.solved) == (0, 9)
    assert study == sound


# --- cases out of order, units exchanged ---------------------------------------------


class Shuffled(OwnProcess):
    """Gives its ends in an order of its own, as processes do."""

    def __init__(self, seed):
        self._draw = random.Random(seed)

    def solve(self, jobs):
        ends = list(super().solve(jobs))
        return iter(self._draw.sample(ends, len(ends)))


@each("ranges", [GRID, SEARCHED])
@each("seed", range(3))
@each("strength", [STRONG, WEAK])
def test_the_order_in_which_cases_end_changes_nothing(ranges, seed, strength):
    site = build_site(ranges, strength=strength)
    assert judge(site, Runner(workers=Shuffled(seed))) == judge(site)


class Forgetful(OwnProcess):
    """Loses the end of one job."""

    def solve(self, jobs):
        return iter(list(super().solve(jobs))[:-1])


class Lazy(OwnProcess):
    """Loses the end of one job but arrives with another in its place."""

    def solve(self, jobs):
        for place, end in super().solve(jobs):
            yield place or 1, end


@pytest.mark.parametrize("ranges", [GRID, SEARCHED], ids=["grid", "search"])
@pytest.mark.parametrize("workers", [Forgetful, Lazy])
def test_a_lost_case_gives_no_study(workers, ranges):
    with pytest.raises(KeyError):
        judge(build_site(ranges), Runner(workers=workers()))
