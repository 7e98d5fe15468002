"""Random scenes: whether they converge, and whether their stated errors are honest.

Refused is what the model names as outside of itself: before any solve, or while
solving with the outcome ``out_of_validity``, or ``no_equilibrium`` with its cause in
the scene. All else that does not converge fails. Of two questions on them, the first
looks at every scene that is drawn. The second compares those that the model accepts
with meshes four times finer: what cannot be compared counts against the program, for a
share of those that happened to converge would flatter it.
"""

from __future__ import annotations

import itertools
import re
import warnings
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from itertools import islice
from typing import Any, Literal

from netdesign.addons.evidence.benchmark.precision import (
    find_level,
    solve_truth,
    state_error,
)
from netdesign.addons.evidence.benchmark.scenes import Tables, build_tables, draw_scene
from netdesign.addons.evidence.measurements import Clock, share, spread, summarise_times
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import FailedSolution, Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import ModelError, Outcome, SolveError
from netdesign.words.message import Message, say

STRESS_SCHEMA, ERRORS_SCHEMA = "netdesign.stress/1", "netdesign.errors/1"
LARGEST_BALANCE = 1e-8  # of the weight
LEAST_SHARE = 0.95  # of scenes within the stated error, and within the accuracy
DEFAULT_ACCURACY = 0.005
_SLOWEST_SHOWN = 5
_NAMED = (Outcome.OUT_OF_VALIDITY, Outcome.NO_EQUILIBRIUM)

Kind = Literal["converged", "refused before", "refused while solving", "failed"]

# A number that stands alone, unlike those in names such as "zwinger-2007".
_NUMBER = re.compile(r"(?<![\w-])-?\d+([.,]\d+)?(e[+-]?\d+)?%?(?!\w)")


@dataclass(frozen=True, slots=True, kw_only=True)
class Attempt:
    """End of one random scene.

    Attributes
    ----------
    number : int
        Of the scene, with the seed its whole description.
    kind : str
        How it ended.
    reason : Message or str
        Why it was refused or failed, or why no finer mesh says how true it is.
    tables : dict
        Its scene file.
    cpu_s : float
        Time of the solve, with everything that a first solve sets up [s].
    linear_solves : int
        Of all meshes.
    balance : float
        Force missing from the balance over the weight; nan unless converged.
    stated_error, true_error : float
        Larger relative error of the end forces: what the solution states, and against
        the finer mesh; nan without one [-].
    is_inside : bool
        Both ends' true errors lie within the stated ones.
    """

    number: int
    kind: Kind
    reason: Message | str = ""
    tables: Tables = field(default_factory=dict)
    cpu_s: float = 0.0
    linear_solves: int = 0
    balance: float = float("nan")
    stated_error: float = float("nan")
    true_error: float = float("nan")
    is_inside: bool = False


def attempt_scenes(
    count: int,
    seed: int,
    *,
    accuracy: float = DEFAULT_ACCURACY,
    jobs: int = 1,
    is_compared: bool = False,
    on_done: Callable[[Attempt], None] | None = None,
) -> list[Attempt]:
    """Attempts of scenes 0 to ``count`` - 1 of a seed.

    ``is_compared`` takes the first scenes that are accepted, and holds each against a
    finer mesh.

    Verified by
    -----------
    tests/addons/evidence/benchmark/test_random_scenes.py
    """
    work = partial(attempt_scene, seed=seed, accuracy=accuracy, is_compared=is_compared)
    numbers = islice(list_accepted(seed), count) if is_compared else range(count)
    return spread(work, list(numbers), jobs=jobs, on_done=on_done)


def list_accepted(seed: int) -> Iterator[int]:
    """Numbers of the random scenes that are not refused before solving."""
    for number in itertools.count():
        with suppress(ModelError):
            build_tables(draw_scene(seed, number))
            yield number


def attempt_scene(
    number: int,
    *,
    seed: int,
    accuracy: float = DEFAULT_ACCURACY,
    is_compared: bool = False,
) -> Attempt:
    """Draw, build and solve one scene; nothing that goes wrong is lost."""
    tables = draw_scene(seed, number)
    attempt = partial(Attempt, number=number, tables=tables)
    try:
        scene = build_tables(tables)
    except ModelError as error:
        return attempt(kind="refused before", reason=error.message)
    settings = SolverSettings(accuracy=accuracy)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # an overflow is a failure, not a remark
            with Clock() as clock:
                solution = solve_steady(scene, settings)
    except Exception as error:  # a bug in one scene must not hide the others  # noqa: BLE001
        return attempt(kind="failed", reason=f"{type(error).__name__}: {error}")
    kind, reason = _judge(solution)
    if isinstance(solution, FailedSolution):
        return attempt(kind=kind, reason=reason, cpu_s=clock.cpu_s)
    compared: dict[str, Any] = {}
    if is_compared and kind == "converged":
        compared = _compare(scene, solution, settings)
    return attempt(
        kind=kind,
        cpu_s=clock.cpu_s,
        linear_solves=solution.cost.linear_solves,
        balance=solution.balance.relative_residual,
        stated_error=state_error(solution),
        **{"reason": reason, **compared},
    )


def _judge(solution: Solution | FailedSolution) -> tuple[Kind, Message | str]:
    """End of a solve, and its reason."""
    if isinstance(solution, FailedSolution):
        kind: Kind = "refused while solving" if solution.outcome in _NAMED else "failed"
        outcome = solution.outcome.value
        return kind, say("bench.ended", outcome=outcome, reason=solution.reason)
    balance = solution.balance.relative_residual
    if balance <= LARGEST_BALANCE:
        return "converged", ""
    return "failed", say("bench.balance", residual=balance)


def _compare(
    scene: Scene, solution: Solution, settings: SolverSettings
) -> dict[str, Any]:
    """True errors by the mesh four times finer, or why it has no solution."""
    try:
        truth = solve_truth(scene, find_level(solution, settings.levels), settings)
    except SolveError as failure:
        return {"reason": say("bench.finer_mesh", reason=failure.message)}
    true = truth.compare_ends(solution)
    stated = [pull.error / pull.size for pull in (solution.foot, solution.head)]
    is_inside = all(t <= s for t, s in zip(true, stated, strict=True))
    return {"true_error": max(true), "is_inside": is_inside}


def write_stress(
    attempts: Sequence[Attempt],
    seed: int,
    accuracy: float = DEFAULT_ACCURACY,
) -> dict[str, Any]:
    """Plain values in the form ``netdesign.stress/1``."""
    converged = [attempt for attempt in attempts if attempt.kind == "converged"]
    solved = [attempt for attempt in attempts if attempt.kind != "refused before"]
    by_time = sorted(solved, key=lambda attempt: attempt.cpu_s, reverse=True)
    return {
        "schema": STRESS_SCHEMA,
        "scenes": len(attempts),
        "seed": seed,
        "accuracy": accuracy,
        "converged": len(converged),
        "pass": not any(attempt.kind == "failed" for attempt in attempts),
        "refused": _count_refusals(attempts),
        "failures": [
            _write_failure(attempt) for attempt in attempts if attempt.kind == "failed"
        ],
        "accuracy_missed": sum(
            not attempt.stated_error <= accuracy for attempt in converged
        ),
        "worst_balance": max((attempt.balance for attempt in converged), default=None),
        "most_linear_solves": max(
            (attempt.linear_solves for attempt in solved), default=0
        ),
        "slowest_s": by_time[0].cpu_s if by_time else 0.0,
        **summarise_times([attempt.cpu_s for attempt in converged]),
        "slowest": [
            {"scene": attempt.number, "cpu_s": attempt.cpu_s, "kind": attempt.kind}
            for attempt in by_time[:_SLOWEST_SHOWN]
        ],
    }


def generalise(reason: str) -> str:
    """Reason without its numbers, so that equal reasons can be counted."""
    return _NUMBER.sub("...", reason)


def _count_refusals(attempts: Sequence[Attempt]) -> list[dict[str, Any]]:
    counts = Counter(
        (generalise(str(attempt.reason)), attempt.kind.removeprefix("refused "))
        for attempt in attempts
        if attempt.kind.startswith("refused")
    )
    return [
        {"reason": reason, "when": when, "count": count}
        for (reason, when), count in counts.most_common()
    ]


def _write_failure(attempt: Attempt) -> dict[str, Any]:
    reason = str(attempt.reason)
    return {"scene": attempt.number, "reason": reason, "tables": attempt.tables}


def write_errors(
    attempts: Sequence[Attempt],
    seed: int,
    accuracy: float = DEFAULT_ACCURACY,
) -> dict[str, Any]:
    """Plain values in the form ``netdesign.errors/1``."""
    compared = [attempt for attempt in attempts if not attempt.reason]
    counted = [
        attempt for attempt in attempts if not attempt.kind.startswith("refused")
    ]
    inside = share(attempt.is_inside for attempt in counted)
    below = share(attempt.true_error <= accuracy for attempt in counted)
    return {
        "schema": ERRORS_SCHEMA,
        "scenes": len(attempts),
        "seed": seed,
        "accuracy": accuracy,
        "compared": len(compared),
        "refused_while_solving": len(attempts) - len(counted),
        "share_inside_stated_error": inside,
        "share_below_accuracy": below,
        "pass": all(x is not None and x >= LEAST_SHARE for x in (inside, below)),
        **summarise_times([attempt.cpu_s for attempt in compared]),
        "outside": [
            {
                "scene": attempt.number,
                "true_error": attempt.true_error,
                "stated_error": attempt.stated_error,
            }
            for attempt in compared
            if not (attempt.is_inside and attempt.true_error <= accuracy)
        ],
        "not_compared": [
            {"scene": attempt.number, "reason": str(attempt.reason)}
            for attempt in attempts
            if attempt.reason
        ],
    }
