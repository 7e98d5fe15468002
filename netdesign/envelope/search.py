"""The envelope of one net row: its searched maxima, with forces and confirmation."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import chain, islice, product
from typing import NamedTuple, TypeVar

from netdesign.checks.result import Band
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.adaptive import (
    Maxima,
    Point,
    SearchSettings,
    Values,
    Watched,
    search_maxima,
)
from netdesign.envelope.extremes import (
    Extreme,
    describe_gap,
    find_extreme,
    find_extremes,
)
from netdesign.envelope.friction import FrictionSkip
from netdesign.envelope.grid import Case
from netdesign.envelope.known_search import KnownSearch
from netdesign.envelope.parameters import Box, build_case, place_scene
from netdesign.envelope.result_reader import ResultReader
from netdesign.envelope.run import (
    CaseResult,
    CaseTask,
    build_job,
    build_task,
    resolve_case,
)
from netdesign.envelope.runner import Runner
from netdesign.envelope.state import CaseEnd
from netdesign.envelope.workers import Batch, Ends
from netdesign.solving.solve import Settings
from netdesign.structure.layout import SupportLayout
from netdesign.words.message import Message, say

# A confirmation is solved to this share of the accuracy, on finer meshes.
_CONFIRMED_SHARE = 0.5
_TIGHTEST = 1e-4  # what ``SolverSettings`` accepts
_WORTH_SHARING = 3  # cases alike but for friction; two take longer than one by one

Conversation = Generator[list[Batch], list[Ends], "RowEnvelope"]
_End = TypeVar("_End")
_Search = Generator[tuple[Point, ...], Sequence[Values | None], _End]
_Watch = Callable[[], Mapping[int, Watched]]


@dataclass(frozen=True, slots=True, kw_only=True)
class RowTask:
    """What is searched: a scene, the ranges around it, and how.

    Attributes
    ----------
    scene : Scene
        Holds whatever the box leaves alone.
    box : Box
        Ranges.
    layout : SupportLayout or None
        Support of the net; None follows the net's own tensions per metre.
    settings : SolverSettings
        Of every case.
    search : SearchSettings
        When the search ends.
    confirmed_by : Settings or None
        How the governing cases are solved again; None leaves that out.
    build : callable or None
        Scene of a case, where the values of the box cannot be put into ``scene`` one
        by one.
    """

    scene: Scene
    box: Box
    layout: SupportLayout | None
    settings: SolverSettings
    search: SearchSettings
    confirmed_by: Settings | None
    build: Callable[[Case], Scene] | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Confirmation:
    """A governing case solved again by another fidelity."""

    member: str
    screened: CaseResult
    confirmed: CaseResult

    @property
    def difference(self) -> float | None:
        """Confirmed over screened force, less 1 [-]; None without a result."""
        if not self.confirmed.is_converged:
            return None
        screened = self.screened.member_forces[self.member].value
        confirmed = self.confirmed.member_forces[self.member].value
        return confirmed / screened - 1.0 if screened > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RowEnvelope:
    """End of a row's search. Forces in N per anchor, or N/m without a layout.

    Attributes
    ----------
    task : RowTask
        What was searched.
    members : tuple of str
        The quantities that are reported, in the order of ``maxima``.
    quantities : tuple of str
        All that were modelled: the members, and the signed forces behind them.
    results : tuple of CaseResult
        Every case, in the order of ``maxima.points``.
    maxima : Maxima
        Maxima, upper bounds, log and model.
    confirmations : tuple of Confirmation
        One for each member that carries a force.
    skipped, skips_tested : int
        Cases known without a solve because the snow stuck with less friction
        already, and how many of those were solved all the same as a test.
    """

    task: RowTask
    members: tuple[str, ...]
    quantities: tuple[str, ...]
    results: tuple[CaseResult, ...]
    maxima: Maxima
    confirmations: tuple[Confirmation, ...]
    skipped: int
    skips_tested: int

    @property
    def gap(self) -> Message | None:
        """Why the maxima do not cover every case; None if they do."""
        failed = describe_gap(self.results) or self._describe_unconfirmed()
        if failed or self.maxima.is_closed:
            return failed
        return say("envelope.may_exceed", count=len(self.results))

    def _describe_unconfirmed(self) -> Message | None:
        """Which governing case could not be solved again; None if all could."""
        for one in self.confirmations:
            if not one.confirmed.is_converged:
                return say(
                    "envelope.unconfirmed",
                    member=say(f"envelope_member.{one.member}"),
                    reason=one.confirmed.reason or "",
                )
        return None

    def hidden(self, member: str) -> float:
        """How much larger a member's force may be between the cases [N]."""
        place = self.members.index(member)
        return max(0.0, self.maxima.upper_bound[place] - self.maxima.maximum[place])

    def force(self, member: str) -> Band:
        """Largest force of a member at the cases, with its numerical error.

        A confirmation that lies above the bound raises the upper end.
        """
        bands = [one.member_forces[member] for one in self.results if one.is_converged]
        confirmed = [
            one.confirmed.member_forces[member].high - self.hidden(member)
            for one in self.confirmations
            if one.confirmed.is_converged
        ]
        return Band(
            low=max(band.low for band in bands),
            value=max(band.value for band in bands),
            high=max([*(band.high for band in bands), *confirmed]),
        )

    def bound(self, member: str) -> Band:
        """Largest force of a member over the whole box, with everything unsure.

        The band's upper end adds what may hide between the cases.
        """
        force = self.force(member)
        return replace(force, high=force.high + self.hidden(member))

    def upper_bound(self, member: str) -> float:
        """Largest force with what may hide, without the numerical error [N]."""
        return self.force(member).value + self.hidden(member)

    def governing(self, member: str) -> CaseResult:
        """Case of a member's largest force; carries the coincident forces."""
        return find_extreme(member, self.results).governing

    @property
    def extremes(self) -> dict[str, Extreme]:
        """Largest forces by member, without what may hide between the cases."""
        found = find_extremes(self.results)
        return {
            member: replace(one, force=self.force(member))
            for member, one in found.items()
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class Wave:
    """Where a search of several rows stands; ``gap`` is the largest left [-]."""

    rows_open: int
    cases_waiting: int
    gap: float


def refine_settings(settings: SolverSettings) -> SolverSettings:
    """Settings of a confirmation: coarsest meshes left out, tighter accuracy.

    A screening ends on the second mesh or a little above; this starts on the third
    where there are enough, so that it ends on a finer one.
    """
    left_out = max(0, min(2, len(settings.levels) - 2))
    accuracy = max(_TIGHTEST, _CONFIRMED_SHARE * settings.accuracy)
    return replace(settings, accuracy=accuracy, levels=settings.levels[left_out:])


def search_row(
    task: RowTask,
    on_gap: Callable[[float], None] = lambda _: None,
    known: KnownSearch | None = None,
    keep: Callable[[KnownSearch], None] = lambda _: None,
) -> Conversation:
    """Ask for the ends of batches until the row's envelope is known.

    Parameters
    ----------
    task : RowTask
        What is searched.
    on_gap : callable, optional
        Takes the largest gap left after each round of a search [-].
    known : KnownSearch, optional
        Of the same task, in an earlier run; repeated instead of searching.
    keep : callable, optional
        Takes a search that was not known.

    Yields
    ------
    list of Batch
        To be answered with their ends, in the same order.

    Returns
    -------
    RowEnvelope
        The same for the same ends.

    Verified by
    -----------
    tests/envelope/test_search.py
    """
    found = None
    if known is not None:
        found, row = yield from _converse(task, known.repeat)
    if found is None:
        search = partial(search_maxima, len(task.box.axes), task.search, on_gap)
        found, row = yield from _converse(task, search)
        if not any(one.fault for one in row.results):
            keep(KnownSearch(maxima=found, watched=row.reader.watch()))
    maxima, members = row.reader.bound_members(found), row.reader.members
    confirmations = yield from _confirm(task, members, row.results, maxima)
    return RowEnvelope(
        task=task,
        members=members,
        quantities=row.reader.quantities,
        results=tuple(row.results),
        maxima=maxima,
        confirmations=confirmations,
        skipped=row.skip.skipped,
        skips_tested=row.skip.tested,
    )


def search_rows(
    tasks: Sequence[RowTask],
    runner: Runner,
    on_wave: Callable[[Wave], None] = lambda _: None,
) -> list[RowEnvelope]:
    """Search all rows together: each wave holds the next cases of every row.

    Parameters
    ----------
    tasks : sequence of RowTask
        One a row.
    runner : Runner
        Where cases are solved and kept, and what was found from them; rows with the
        same net and snow share cases.
    on_wave : callable, optional
        Called after each wave.

    Returns
    -------
    list of RowEnvelope
        In the order of the tasks; equal tasks share one.
    """
    distinct = list(dict.fromkeys(tasks))
    finished: dict[RowTask, RowEnvelope] = {}
    gaps = dict.fromkeys(distinct, math.inf)
    open_rows = {
        task: search_row(
            task,
            partial(gaps.__setitem__, task),
            runner.find_search(task),
            partial(runner.keep_search, task),
        )
        for task in distinct
    }
    # None begins a talk; it ends at once where the model refuses every case
    answers: dict[RowTask, list[Ends] | None] = dict.fromkeys(distinct)
    is_begun = False
    while answers:
        asked: dict[RowTask, list[Batch]] = {}
        for task, answer in answers.items():
            try:
                asked[task] = open_rows[task].send(answer)  # type: ignore[arg-type]
            except StopIteration as end:
                finished[task] = end.value
        if is_begun:
            waiting = sum(len(batch) for batches in asked.values() for batch in batches)
            gap = max((gaps[task] for task in asked), default=0.0)
            on_wave(Wave(rows_open=len(asked), cases_waiting=waiting, gap=gap))
        is_begun = True
        ends = iter(runner.solve_batches(list(chain.from_iterable(asked.values()))))
        answers = {task: list(islice(ends, len(one))) for task, one in asked.items()}
    return [finished[task] for task in tasks]


class Grid(NamedTuple):
    """All cases of a tensor grid, and how many of them needed no solve."""

    results: list[CaseResult]
    skipped: int


def run_grid(task: RowTask, counts: Mapping[str, int | None], runner: Runner) -> Grid:
    """Solve a tensor grid with so many samples of each axis."""
    points = list_grid([counts[name] or 2 for name in task.box.axes])
    skip = FrictionSkip(task.box.axes)
    if max(map(len, skip.list_lines(points))) >= _WORTH_SHARING:
        task = replace(task, settings=replace(task.settings, shares_start=True))
    tasks = [build_point_task(task, point) for point in points]
    asking = _ask(points, tasks, skip)
    answer: list[Ends] | None = None  # a generator begins with None
    while True:
        try:
            # the model may have refused every case: then nothing is asked
            batches = asking.send(answer)  # type: ignore[arg-type]
        except StopIteration as end:
            results = [resolve_case(*one) for one in zip(tasks, end.value, strict=True)]
            return Grid(results=results, skipped=skip.skipped)
        answer = runner.solve_batches(batches)


def list_grid(counts: Sequence[int]) -> list[Point]:
    """All points of a grid with so many samples of each axis, at least two."""
    return list(product(*([k / (count - 1) for k in range(count)] for count in counts)))


def build_point_task(
    task: RowTask, point: Point, settings: Settings | None = None
) -> CaseTask:
    """Task of one point of a row's box; the row's settings unless others are given."""
    values = task.box.place(point)
    return build_task(
        build_case(task.scene, values),
        task.build or (lambda _: place_scene(task.scene, values)),
        task.layout,
        settings or task.settings,
    )


def _converse(
    task: RowTask, begin: Callable[[_Watch], _Search[_End]]
) -> Generator[list[Batch], list[Ends], tuple[_End, _RowCases]]:
    """Lead a search to its end, and what was learned of the row's cases."""
    row = _RowCases(
        reader=ResultReader(layout=task.layout), skip=FrictionSkip(task.box.axes)
    )
    search = begin(row.reader.watch)
    points = next(search)
    while True:
        tasks = [build_point_task(task, point) for point in points]
        ends = yield from _ask(points, tasks, row.skip)
        answered = [resolve_case(*one) for one in zip(tasks, ends, strict=True)]
        row.results += answered
        try:
            points = search.send(row.reader.read(answered))
        except StopIteration as end:
            return end.value, row


def _ask(
    points: Sequence[Point], tasks: Sequence[CaseTask], skip: FrictionSkip
) -> Generator[list[Batch], list[Ends], list[CaseEnd | None]]:
    """Ends of some cases; those that friction cannot change are not solved."""
    asked = zip(points, map(build_job, tasks), strict=True)
    jobs = {point: job for point, job in asked if job is not None}
    ends: dict[Point, CaseEnd] = {}
    while lines := skip.list_lines([point for point in jobs if point not in ends]):
        answers = yield [tuple(jobs[point] for point in line) for line in lines]
        for line, answer in zip(lines, answers, strict=True):
            for point, end in zip(line, answer, strict=False):  # until it sticks
                ends[point] = end
                skip.learn(point, end)
    ends |= {point: skip.recall(point) for point in jobs if point not in ends}
    return [ends.get(point) for point in points]


@dataclass(slots=True, kw_only=True)
class _RowCases:
    """The cases of a row during a search, and what reads and spares them."""

    reader: ResultReader
    skip: FrictionSkip
    results: list[CaseResult] = field(default_factory=list)


def _confirm(
    task: RowTask,
    members: Sequence[str],
    results: Sequence[CaseResult],
    maxima: Maxima,
) -> Generator[list[Batch], list[Ends], tuple[Confirmation, ...]]:
    """Solve the governing cases again by the other fidelity, each once."""
    if task.confirmed_by is None:
        return ()
    loaded = {
        member: maxima.governing[place]
        for place, member in enumerate(members)
        if maxima.maximum[place] > 0.0
    }
    places = sorted(set(loaded.values()))
    tasks = [
        build_point_task(task, maxima.points[p], task.confirmed_by) for p in places
    ]
    batches: list[Batch] = [(job,) for job in map(build_job, tasks) if job is not None]
    ends = (yield batches) if batches else []
    again = {
        place: resolve_case(one, end)
        for place, one, (end,) in zip(places, tasks, ends, strict=True)
    }
    return tuple(
        Confirmation(member=member, screened=results[place], confirmed=again[place])
        for member, place in loaded.items()
    )
