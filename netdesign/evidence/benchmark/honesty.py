"""Are the stated errors honest? Random scenes against meshes four times finer.

What cannot be compared counts against the program, unless the model itself excludes
the scene: a share of those that happened to converge would flatter it.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from itertools import islice
from typing import Any

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import FailedSolution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.evidence.benchmark.scenes import build_tables, draw_scene
from netdesign.evidence.benchmark.truth import (
    find_level,
    solve_truth,
    state_error,
)
from netdesign.evidence.runner import (
    Clock,
    share,
    spread,
    summarise_times,
)
from netdesign.outcome import ModelError, Outcome, SolveError
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

ERRORS_SCHEMA = "netdesign.errors/1"
LEAST_SHARE = 0.95  # of scenes within the stated error, and within the accuracy


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One random scene; errors are those of the worse end, relative [-].

    Attributes
    ----------
    number : int
        Of the scene.
    missing : Message or str
        Why there is nothing to compare; "" otherwise.
    is_refused : bool
        The model excludes the scene, as found while solving.
    true_error : float
        Against the finer mesh.
    stated_error : float
        What the solution says.
    is_inside : bool
        Both ends' true errors lie within the stated ones.
    cpu_s : float
        Of the solve, its meshes included [s].
    """

    number: int
    missing: Message | str = ""
    is_refused: bool = False
    true_error: float = float("nan")
    stated_error: float = float("nan")
    is_inside: bool = False
    cpu_s: float = float("nan")


def study_errors(
    count: int,
    seed: int,
    accuracy: float,
    *,
    jobs: int = 1,
    on_done: Callable[[Finding], None] | None = None,
) -> list[Finding]:
    """Findings of the first ``count`` scenes of a seed that the model accepts.

    Verified by
    -----------
    tests/evidence/benchmark/test_honesty.py
    """
    work = partial(compare_scene, seed=seed, accuracy=accuracy)
    numbers = list(islice(list_accepted(seed), count))
    return spread(work, numbers, jobs=jobs, on_done=on_done)


def list_accepted(seed: int) -> Iterator[int]:
    """Numbers of the random scenes that are not refused before solving."""
    for number in itertools.count():
        with suppress(ModelError):
            build_tables(draw_scene(seed, number))
            yield number


def compare_scene(number: int, *, seed: int, accuracy: float) -> Finding:
    """Solve a random scene at the accuracy asked for, and on the finer mesh."""
    scene = build_tables(draw_scene(seed, number))
    try:
        return judge_scene(number, scene, SolverSettings(accuracy=accuracy))
    except SolveError as failure:
        return Finding(
            number=number, missing=say("bench.finer_mesh", reason=failure.message)
        )


def judge_scene(number: int, scene: Scene, settings: SolverSettings) -> Finding:
    """True and stated error of one scene.

    Raises
    ------
    SolveError
        If the finer mesh gives no converged solution.
    """
    with Clock() as clock:
        solution = solve_steady(scene, settings)
    if isinstance(solution, FailedSolution):
        return Finding(
            number=number,
            missing=solution.reason,
            is_refused=solution.outcome is Outcome.OUT_OF_VALIDITY,
        )
    truth = solve_truth(scene, find_level(solution, settings.levels), settings)
    pulls = (solution.foot, solution.head)
    stated = [pull.error / pull.size for pull in pulls]
    true = truth.compare_ends(solution)
    return Finding(
        number=number,
        true_error=max(true),
        stated_error=state_error(solution),
        is_inside=all(t <= s for t, s in zip(true, stated, strict=True)),
        cpu_s=clock.cpu_s,
    )


def write_errors(
    findings: Sequence[Finding], seed: int, accuracy: float, language: Language = "en"
) -> dict[str, Any]:
    """Plain values in the form ``netdesign.errors/1``; reasons in a language."""
    compared = [one for one in findings if not one.missing]
    counted = [one for one in findings if not one.is_refused]
    inside = share(one.is_inside for one in counted)
    below = share(one.true_error <= accuracy for one in counted)
    return {
        "schema": ERRORS_SCHEMA,
        "scenes": len(findings),
        "seed": seed,
        "accuracy": accuracy,
        "compared": len(compared),
        "refused_while_solving": len(findings) - len(counted),
        "share_inside_stated_error": inside,
        "share_below_accuracy": below,
        "pass": all(x is not None and x >= LEAST_SHARE for x in (inside, below)),
        **summarise_times([one.cpu_s for one in compared]),
        "outside": [
            {
                "scene": one.number,
                "true_error": one.true_error,
                "stated_error": one.stated_error,
            }
            for one in compared
            if not (one.is_inside and one.true_error <= accuracy)
        ],
        "not_compared": [
            {"scene": one.number, "reason": render(one.missing, language)}
            for one in findings
            if one.missing
        ],
    }
