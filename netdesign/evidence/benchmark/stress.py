"""Stress test: random scenes converge, are refused with a reason, or count as failed.

Refused is what the model names as outside of itself: before any solve, or while
solving with the outcome ``out_of_validity``, or ``no_equilibrium`` with its cause in
the scene. All else that does not converge fails.
"""

from __future__ import annotations

import re
import warnings
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Literal

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import FailedSolution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.evidence.benchmark.scenes import Tables, draw_scene
from netdesign.evidence.benchmark.truth import state_error
from netdesign.evidence.runner import Clock, spread, summarise_times
from netdesign.files.scene import SceneFile, build_scene
from netdesign.outcome import ModelError, Outcome
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

STRESS_SCHEMA = "netdesign.stress/1"
LARGEST_BALANCE = 1e-8  # of the weight
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
        Why it was refused or failed; "" if converged.
    tables : dict
        Its scene file.
    cpu_s : float
        Time of the solve, with everything that a first solve sets up [s].
    linear_solves : int
        Of all meshes.
    balance : float
        Force missing from the balance over the weight; nan unless converged.
    stated_error : float
        Larger relative error of the end forces that the solution states.
    """

    number: int
    kind: Kind
    reason: Message | str = ""
    tables: Tables = field(default_factory=dict)
    cpu_s: float = 0.0
    linear_solves: int = 0
    balance: float = float("nan")
    stated_error: float = float("nan")


def run_stress(
    count: int,
    seed: int,
    *,
    accuracy: float = DEFAULT_ACCURACY,
    jobs: int = 1,
    on_done: Callable[[Attempt], None] | None = None,
) -> list[Attempt]:
    """Attempts of scenes 0 to ``count`` - 1 of a seed.

    Verified by
    -----------
    tests/evidence/benchmark/test_stress_report.py
    """
    work = partial(attempt_scene, seed=seed, accuracy=accuracy)
    return spread(work, range(count), jobs=jobs, on_done=on_done)


def attempt_scene(
    number: int, *, seed: int, accuracy: float = DEFAULT_ACCURACY
) -> Attempt:
    """Draw, build and solve one scene; nothing that goes wrong is lost."""
    tables = draw_scene(seed, number)
    try:
        scene, _ = build_scene(SceneFile.model_validate(tables))
    except ModelError as error:
        return Attempt(
            number=number, kind="refused before", reason=error.message, tables=tables
        )
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # an overflow is a failure, not a remark
            return _solve(number, tables, scene, SolverSettings(accuracy=accuracy))
    except Exception as error:  # a bug in one scene must not hide the others
        reason = f"{type(error).__name__}: {error}"
        return Attempt(number=number, kind="failed", reason=reason, tables=tables)


def _solve(
    number: int, tables: Tables, scene: Scene, settings: SolverSettings
) -> Attempt:
    with Clock() as clock:
        solution = solve_steady(scene, settings)
    if isinstance(solution, FailedSolution):
        return Attempt(
            number=number,
            kind=("refused while solving" if solution.outcome in _NAMED else "failed"),
            reason=say(
                "bench.ended", outcome=solution.outcome.value, reason=solution.reason
            ),
            tables=tables,
            cpu_s=clock.cpu_s,
        )
    balance = solution.balance.relative_residual
    return Attempt(
        number=number,
        kind="converged" if balance <= LARGEST_BALANCE else "failed",
        reason=""
        if balance <= LARGEST_BALANCE
        else say("bench.balance", residual=balance),
        tables=tables,
        cpu_s=clock.cpu_s,
        linear_solves=solution.cost.linear_solves,
        balance=balance,
        stated_error=state_error(solution),
    )


def write_stress(
    attempts: Sequence[Attempt],
    seed: int,
    accuracy: float = DEFAULT_ACCURACY,
    language: Language = "en",
) -> dict[str, Any]:
    """Plain values in the form ``netdesign.stress/1``; reasons in a language."""
    converged = [one for one in attempts if one.kind == "converged"]
    solved = [one for one in attempts if one.kind != "refused before"]
    by_time = sorted(solved, key=lambda one: one.cpu_s, reverse=True)
    return {
        "schema": STRESS_SCHEMA,
        "scenes": len(attempts),
        "seed": seed,
        "accuracy": accuracy,
        "converged": len(converged),
        "pass": not any(one.kind == "failed" for one in attempts),
        "refused": _count_refusals(attempts, language),
        "failures": [
            _write_failure(one, language) for one in attempts if one.kind == "failed"
        ],
        "accuracy_missed": sum(not one.stated_error <= accuracy for one in converged),
        "worst_balance": max((one.balance for one in converged), default=None),
        "most_linear_solves": max((one.linear_solves for one in solved), default=0),
        "slowest_s": by_time[0].cpu_s if by_time else 0.0,
        **summarise_times([one.cpu_s for one in converged]),
        "slowest": [
            {"scene": one.number, "cpu_s": one.cpu_s, "kind": one.kind}
            for one in by_time[:_SLOWEST_SHOWN]
        ],
    }


def generalise(reason: str) -> str:
    """Reason without its numbers, so that equal reasons can be counted."""
    return _NUMBER.sub("...", reason)


def _count_refusals(
    attempts: Sequence[Attempt], language: Language
) -> list[dict[str, Any]]:
    counts = Counter(
        (generalise(render(one.reason, language)), one.kind.removeprefix("refused "))
        for one in attempts
        if one.kind.startswith("refused")
    )
    return [
        {"reason": reason, "when": when, "count": count}
        for (reason, when), count in counts.most_common()
    ]


def _write_failure(one: Attempt, language: Language) -> dict[str, Any]:
    reason = render(one.reason, language)
    return {"scene": one.number, "reason": reason, "tables": one.tables}
