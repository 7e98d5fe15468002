"""``netdesign solve``: solves a scene, and prints it or writes a folder."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    take_options,
)
from netdesign.commands.running import (
    print_document,
    print_faults,
    require_places,
    speak,
    tell,
    write_outputs,
)
from netdesign.outcome import EXIT_CODES, SENTENCE, Fault, Outcome, Verdict, catch_fault
from netdesign.structure.members import SOLVED_MEMBERS, Member
from netdesign.words.catalogue import name_member, render
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from collections.abc import Iterator

    from netdesign.coupling.scene import Scene
    from netdesign.coupling.solution import FailedSolution, Solution
    from netdesign.files.scene import SceneToSolve
    from netdesign.solving.solve import Settings

    Solved = Solution | FailedSolution


_DOCUMENT, _HISTORY = "solution.json", "history.csv"


@click.command()
@click.argument("scene_file", type=click.Path(path_type=Path))
@take_options("solve")
def solve(scene_file: Path, **asked: Any) -> None:
    """Solve one scene, given as a TOML file.

    \b
    netdesign solve scene.toml
    netdesign solve scene.toml --json
    netdesign solve scene.toml --method transient --out history
    """
    import time

    from netdesign.files.scene import read_scene_file
    from netdesign.files.solution import write_solution_document

    to_solve, out = read_scene_file(scene_file, asked["method"]), asked["out"]
    scene, settings = to_solve.scene, to_solve.settings
    require_places(out, (_DOCUMENT, _HISTORY), asked)
    start = time.perf_counter()
    solution, failed = _solve(scene, settings)
    elapsed = time.perf_counter() - start
    support = _resolve_support(solution, to_solve)
    document = write_solution_document(
        solution, settings, elapsed, asked["language"], support
    )
    if out is not None:
        write_outputs(out, _render(document, solution), asked)
    if asked["as_json"]:
        print_document(document)
    elif document["outcome"] == "converged":
        _show_solution(document)
    else:
        ended = solution.outcome.word
        tell(say("solve.ended", ended=ended, reason=document["reason"]))
    proven = document["outcome"] == "converged"
    proven = proven and document.get("plateau", {"reached": True})["reached"]
    sys.exit(failed or (0 if proven else EXIT_CODES[Verdict.NOT_PROVEN]))


def _solve(scene: Scene, settings: Settings) -> tuple[Solved, int]:
    """Solution of a scene, and the exit code of a fault, which is printed on stderr."""
    from netdesign.coupling.solution import FailedSolution
    from netdesign.solving.solve import describe_case, solve_scene

    case = describe_case(scene, settings)
    solution = catch_fault(lambda: solve_scene(scene, settings), case)
    if not isinstance(solution, Fault):
        return solution, 0
    failed = FailedSolution(outcome=Outcome.PROGRAM_FAULT, reason=SENTENCE)
    return failed, print_faults({solution: ()})


def _resolve_support(solution: Solved, to_solve: SceneToSolve) -> dict[str, Any] | None:
    """Support of a net for the document; None without a solution or a support."""
    if to_solve.support is None:
        return None
    from netdesign.coupling.solution import Solution
    from netdesign.files.cases import resolve_support, write_support

    if not isinstance(solution, Solution):
        return None
    result = resolve_support(solution, to_solve.settings, to_solve.support)
    return write_support(result, to_solve.support, speak())


def _render(document: dict[str, Any], solution: Solved) -> dict[str, bytes]:
    """Contents of the outputs by name: the document, and the table of a history."""
    files = {_DOCUMENT: json.dumps(document, indent=1, allow_nan=False).encode()}
    if history := getattr(solution, "history", None):
        files[_HISTORY] = history.write_table()
    return files


def _show_solution(document: dict[str, Any]) -> None:
    for end, pull in document["anchor_forces"].items():
        tell(_describe_end(end, pull))
    tell(say("solve.sag", sag=document["sag_m"]))
    if document["history"]:
        tell(_describe_plateau(document))
    for line in _describe_support(document.get("support")):
        tell(line)
    residual = document["balance"]["relative_residual"]
    tell(say("solve.balance", residual=residual))
    for flag in document["flags"]:
        tell(say("cli.note", text=flag))


def _describe_end(end: str, pull: dict[str, float]) -> Message:
    return say(
        "solve.end",
        end=render(name_member(end), speak()),  # padded as a text
        size=pull["size_kN_per_m"],
        x=pull["x_kN_per_m"],
        y=pull["y_kN_per_m"],
        error=pull["error_kN_per_m"],
    )


def _describe_support(support: dict[str, Any] | None) -> Iterator[Message]:
    """Lines about the members' forces of section and panel."""
    if support is None:
        return
    if "reason" in support:
        yield say("solve.support_lack", reason=support["reason"])
    for member in SOLVED_MEMBERS:
        forces = {
            name: force
            for name, part in (("section", "plain"), ("panel", "panel"))
            if (force := (support[part] or {}).get(f"{member}_kN")) is not None
        }
        is_idle = member == Member.POST_FOOT and not any(forces.values())
        if forces and not is_idle:  # a post's foot is shown where the post pulls
            both = "panel" in forces
            key = "solve.support_with_panel" if both else "solve.support"
            name = render(name_member(member), speak())  # padded as a text
            yield say(key, member=name, **forces)
    if support["panel"]:
        yield from _describe_panel(support["panel"])
    if support["row_end"]:
        yield from _describe_end_of_row(support["row_end"])


def _describe_panel(panel: dict[str, Any]) -> Iterator[Message]:
    for name in ("lower", "upper"):
        rope = panel[f"{name}_rope"]
        shown = render(say(f"panel_view.{name}"), speak())
        yield say("solve.rope", rope=shown, along=rope["H_kN"], tension=rope["T_kN"])
    drop, lift = panel["mid_head_drop_m"], panel["foot_lift_m"]
    yield say("solve.mid_panel", drop=drop, lift=lift)


def _describe_end_of_row(end: dict[str, Any]) -> Iterator[Message]:
    yield say("solve.row_end", **end["foot_kN"], along=end["head_along_kN"])
    if end["end_guy_kN"] is not None:
        yield say("solve.end_guy", guy=end["end_guy_kN"], post=end["post_kN"])


def _describe_plateau(document: dict[str, Any]) -> Message:
    plateau = document["plateau"]
    if not plateau["reached"]:
        return say("solve.no_plateau", days=document["history"][-1]["time_d"])
    return say(
        "solve.plateau",
        days=plateau["time_d"],
        foot=plateau["foot_kN_per_m"],
        head=plateau["head_kN_per_m"],
        drift=plateau["drift_per_efold"],
    )
