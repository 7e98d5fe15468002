"""Net rows solved on a grid of cases: soon done, for tests of what is made of forces.

What hides between the cases is estimated. Only a search bounds it: a study by a grid
proves nothing, and no command makes one.
"""

from itertools import product

import numpy as np

from netdesign.envelope.extremes import find_extremes
from netdesign.envelope.ranges import Case
from netdesign.envelope.result_reader import POST_PULLS
from netdesign.envelope.rows import RowEnvelope, RowTask
from netdesign.envelope.run import run_cases
from netdesign.search.maxima import Maxima, SearchSettings
from netdesign.study.row_to_check import build_row_task, build_scene

SAMPLES = 3  # of a quantity that ranges
KNOWN, MOST_KNOWN = {}, 1000  # cases that were solved, with their results


def build_cases(ranges, samples=SAMPLES):
    """All cases of a grid, the first quantity varying slowest."""
    names = [name for name, _ in ranges.intervals]
    values = [sample(span, samples) for _, span in ranges.intervals]
    return tuple(
        Case.of(dict(zip(names, one, strict=True))) for one in product(*values)
    )


def sample(span, samples):
    """Equally spaced values of a range, both ends included."""
    if span.low == span.high:
        return [span.low]
    return [float(value) for value in np.linspace(span.low, span.high, samples)]


def solve_site(site, run, runner=None, samples=SAMPLES):
    """All net rows on a grid over the ranges of each, as a search would give them."""
    found = []
    for row in site.rows:
        at_row = site.at_row(row)
        cases = build_cases(at_row.ranges, samples)
        tasks = [build_row_task(row, one, run.creep_law, run.settings) for one in cases]
        found.append(wrap_results(at_row, row, solve_tasks(tasks, runner), run))
    return found


def solve_tasks(tasks, runner=None):
    """Results of cases, each solved once in a process; a runner solves its own anew."""
    if runner is not None:
        return run_cases(tasks, runner)
    new = [one for one in dict.fromkeys(tasks) if one not in KNOWN]
    results = KNOWN | dict(zip(new, run_cases(new), strict=True))
    KNOWN.clear()
    KNOWN.update(list(results.items())[-MOST_KNOWN:])
    return [results[one] for one in tasks]


def wrap_results(site, row, results, run):
    """Envelope of a row by all cases of a grid."""
    found = find_extremes(results).items()
    largest = {name: one.force.value for name, one in found}
    upper = {name: largest[name] + estimate_hidden(one, results) for name, one in found}
    cases = [one.case for one in results]
    return RowEnvelope(
        task=RowTask(
            scene=build_scene(row, build_cases(site.ranges)[0], run.creep_law),
            ranges=site.ranges,
            layouts=(row.layout,),
            settings=run.settings,
            search=SearchSettings(),
            confirmed_by=None,
        ),
        members=tuple(largest),
        results=tuple(results),
        maxima=Maxima(
            points=(),
            values=(),
            doubts=(),
            maximum=tuple(largest.values()),
            upper_bound=tuple(upper.values()),
            governing=tuple(cases.index(one.governing.case) for _, one in found),
            is_closed=True,
            surrogate=None,
        ),
        confirmations=(),
        skipped=0,
        lifted={name: upper[name] for name in upper if name in POST_PULLS},
    )


def estimate_hidden(extreme, results):
    """Largest rise of a parabola over the samples beside a governing case [N].

    Through three neighbouring samples with second difference D it rises at most |D| / 8
    above the larger of two neighbours; the rises along the axes are added.
    """
    forces = {
        one.case: one.member_forces[extreme.member].value
        for one in results
        if extreme.member in one.member_forces
    }
    case, hidden = extreme.governing.case, 0.0
    for axis, at in case.values.items():
        samples = sorted({one.case.values[axis] for one in results})
        if len(samples) < 3:
            continue
        middle = min(max(samples.index(at), 1), len(samples) - 2)
        three = [
            forces.get(case.with_value(axis, samples[middle + k])) for k in (-1, 0, 1)
        ]
        if None not in three:
            before, here, after = three
            hidden += abs(before - 2.0 * here + after) / 8.0
    return hidden
