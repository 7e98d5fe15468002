"""Searches of net rows: which cases each solves next, until its envelope is known.

A ``RowSearch`` solves no case. `ask` gives the batches to solve, `tell` takes their
ends. Theory: envelope/THEORY.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import islice, product

from netdesign.edge.progress import Wave
from netdesign.envelope.cases import Cases, FirstCases, FrictionSkip
from netdesign.envelope.result_reader import ResultReader, bound_lifted
from netdesign.envelope.rows import Confirmation, RowEnvelope, RowTask
from netdesign.envelope.run import CaseResult
from netdesign.outcome import ModelError
from netdesign.search.maxima import Maxima, MaximaSearch
from netdesign.solving.runner import Runner
from netdesign.solving.workers import Batch, Ends
from netdesign.words.message import say


class RowSearch:
    """Search of one row's envelope: asks for the ends of batches, and is told.

    Attributes
    ----------
    task : RowTask
        What is searched.

    Verified by
    -----------
    tests/envelope/test_search.py
    """

    def __init__(self, task: RowTask) -> None:
        """Begin a search with nothing known of the row's cases."""
        self.task = task
        self._result: RowEnvelope | None = None
        self._search = MaximaSearch(len(task.ranges.axes), task.search)
        self._reader = ResultReader(
            layouts=task.layouts, has_panel=bool(task.panels), has_end=task.has_end
        )
        self._skip = FrictionSkip(task.ranges.axes)
        self._results: list[CaseResult] = []
        self._maxima: Maxima | None = None  # known once only confirmations are open
        self._cases: Cases | FirstCases = FirstCases(
            task, self._search.ask(), self._skip, self._reader.find_near
        )
        self._advance()

    @property
    def result(self) -> RowEnvelope:
        """Envelope of the row; the same for the same ends.

        Raises
        ------
        ModelError
            While something is still asked for.
        """
        if self._result is None:
            raise ModelError(say("envelope.not_ended"))
        return self._result

    @property
    def gap(self) -> float:
        """Largest gap left after the last round, over its quantity [-]."""
        return self._search.gap

    def ask(self) -> list[Batch]:
        """Batches to be solved next; none once the envelope is known."""
        return self._cases.ask()

    def tell(self, answers: Sequence[Ends]) -> None:
        """Take the ends of the batches asked for, in their order."""
        self._cases.tell(answers)
        self._advance()

    def _advance(self) -> None:
        """Go on until something has to be solved, or the envelope is known."""
        while self._result is None and not self._cases.ask():
            answered = self._cases.finish()
            if self._maxima is None:
                self._go_on(answered)
            else:
                self._finish(self._maxima, answered)

    def _go_on(self, answered: list[CaseResult]) -> None:
        """Tell the search what was found, and ask what it wants next."""
        self._results += answered
        search, reader = self._search, self._reader
        values = reader.read(answered)
        doubts = reader.read_doubts(answered, self._cases.rough)
        search.tell(values, reader.watch(), doubts)
        if points := search.ask():
            self._cases = Cases(self.task, points, self._skip)
        elif search.result is not None:
            self._confirm(search.result)

    def _confirm(self, maxima: Maxima) -> None:
        """Ask for the governing cases once more."""
        self._maxima = self._reader.bound_members(maxima)
        points = [maxima.points[place] for place in self._list_confirmed(maxima)]
        apart = FrictionSkip(())  # each is solved
        self._cases = Cases(self.task, points, apart, self.task.confirmed_by)

    def _list_confirmed(self, maxima: Maxima) -> list[int]:
        """Places of the cases that govern a member, each once."""
        if self.task.confirmed_by is None:
            return []
        return sorted(set(self._find_governing(maxima).values()))

    def _find_governing(self, maxima: Maxima) -> dict[str, int]:
        """Place of the governing case of each member that carries a force."""
        peaks = zip(maxima.maximum, maxima.governing, strict=True)  # none, unsolved
        return {
            member: place
            for member, (force, place) in zip(self._reader.members, peaks, strict=False)
            if force > 0.0
        }

    def _finish(self, maxima: Maxima, confirmed: Sequence[CaseResult]) -> None:
        again = dict(zip(self._list_confirmed(maxima), confirmed, strict=True))
        self._result = RowEnvelope(
            task=self.task,
            members=self._reader.members,
            quantities=self._reader.quantities,
            results=tuple(self._results),
            maxima=maxima,
            confirmations=tuple(
                Confirmation(
                    member=member,
                    screened=self._results[place],
                    confirmed=again[place],
                )
                for member, place in self._find_governing(maxima).items()
                if place in again
            ),
            skipped=self._skip.skipped,
            skips_tested=self._skip.tested,
            lifted=bound_lifted(
                self.task.layouts, maxima.points, self._results, self.task.search
            ),
        )


def search_rows(
    tasks: Sequence[RowTask],
    runner: Runner,
    on_wave: Callable[[Wave], None] = lambda _: None,
) -> list[RowEnvelope]:
    """Envelopes of all rows, searched together: a wave has the next cases of every row.

    Parameters
    ----------
    tasks : sequence of RowTask
        One a row.
    runner : Runner
        Where cases are solved and kept; rows with the same net and snow share cases.
    on_wave : callable, optional
        Called after each wave.

    Returns
    -------
    list of RowEnvelope
        In the order of the tasks; equal tasks share one.
    """
    searches = {task: RowSearch(task) for task in dict.fromkeys(tasks)}
    while asked := _ask_rows(searches.values()):
        ends = iter(runner.solve_batches([batch for _, its in asked for batch in its]))
        for search, batches in asked:
            search.tell(list(islice(ends, len(batches))))
        on_wave(_describe_wave(_ask_rows(searches.values())))
    return [searches[task].result for task in tasks]


_Asked = list[tuple[RowSearch, list[Batch]]]


def _ask_rows(searches: Iterable[RowSearch]) -> _Asked:
    """Searches that go on, with the batches that each waits for."""
    return [(search, batches) for search in searches if (batches := search.ask())]


def _describe_wave(asked: _Asked) -> Wave:
    return Wave(
        rows_open=len(asked),
        cases_waiting=sum(len(batch) for _, batches in asked for batch in batches),
        gap=max((search.gap for search, _ in asked), default=0.0),
    )


def run_grid(
    task: RowTask, counts: Mapping[str, int], runner: Runner
) -> tuple[list[CaseResult], int]:
    """Cases of a grid with so many samples of each axis, and how many took no solve."""
    sizes = [counts[name] for name in task.ranges.axes]
    points = list(product(*([k / (n - 1) for k in range(n)] for n in sizes)))
    skip = FrictionSkip(task.ranges.axes)
    cases = Cases(task, points, skip)
    while batches := cases.ask():
        cases.tell(runner.solve_batches(batches))
    return cases.finish(), skip.skipped
