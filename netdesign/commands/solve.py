"""``netdesign solve``: one scene, printed or as a folder."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    take_options,
)
from netdesign.commands.running import (
    EXIT_CODES,
    print_document,
    print_faults,
    require_places,
    write_outputs,
)
from netdesign.commands.usage import speak, tell
from netdesign.outcome import SENTENCE, Fault, Outcome, Verdict, catch_fault
from netdesign.words.catalogue import render
from netdesign.words.message import Message, say
from netdesign.words.names import name_member

if TYPE_CHECKING:
    from collections.abc import Iterator

    from netdesign.coupling.scene import Scene
    from netdesign.coupling.solution import Solution
    from netdesign.files.scene import GivenScene
    from netdesign.report.page.solution_page import Solved
    from netdesign.solving.solve import Settings
    from netdesign.study.support_records import PanelRecord


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

    given, out = read_scene_file(scene_file, asked["method"]), asked["out"]
    scene, settings = given.scene, given.settings
    if out is not None:  # the page takes as long to import as all else
        require_places(out, _list_names(given), asked)
    start = time.perf_counter()
    solution, failed = _solve(scene, settings)
    elapsed = time.perf_counter() - start
    bound = None if failed else _bound_refused(scene, settings, solution)
    support, panel = _resolve_support(solution, given)
    document = write_solution_document(
        solution, settings, elapsed, bound, asked["language"], support
    )
    if out is not None:
        from netdesign.report.page.solution_page import render_solution

        shown = (solution, document, scene_file.name, speak(), panel)
        write_outputs(out, render_solution(*shown), asked)
    if asked["as_json"]:
        print_document(document)
    elif document["outcome"] == "converged":
        _show_solution(document)
    else:
        _show_refusal(solution, document)
    proven = document["outcome"] == "converged"
    proven = proven and document.get("plateau", {"reached": True})["reached"]
    sys.exit(failed or (0 if proven else EXIT_CODES[Verdict.NOT_PROVEN]))


def _solve(scene: Scene, settings: Settings) -> tuple[Solved, int]:
    """Solution of a scene, and the exit code of a fault; it is told on stderr."""
    from netdesign.coupling.solution import FailedSolution
    from netdesign.solving.solve import describe_case, solve_scene

    case = describe_case(scene, settings)
    solution = catch_fault(lambda: solve_scene(scene, settings), case)
    if not isinstance(solution, Fault):
        return solution, 0
    failed = FailedSolution(outcome=Outcome.PROGRAM_FAULT, reason=SENTENCE)
    return failed, print_faults({solution: ()})


def _resolve_support(
    solution: Solved, given: GivenScene
) -> tuple[dict[str, Any] | None, PanelRecord | None]:
    """Support of a net for the document, and its panel to be drawn.

    Both are None without a solution or a support.
    """
    if given.support is None:
        return None, None
    from netdesign.coupling.solution import Solution
    from netdesign.files.cases import resolve_support, write_support
    from netdesign.study.record_support import record_solved_panel

    if not isinstance(solution, Solution):
        return None, None
    result = resolve_support(solution, given.settings, given.support)
    panel = record_solved_panel(result)
    return write_support(result, given.support, speak()), panel


def _bound_refused(
    scene: Scene, settings: Settings, solution: object
) -> Solution | None:
    """Bound on the pulls of a net without a steady state; None if it has one."""
    from netdesign.coupling.scene import SolverSettings
    from netdesign.coupling.solution import FailedSolution
    from netdesign.coupling.steady.solve import bound_by_less_slack

    if isinstance(settings, SolverSettings) and isinstance(solution, FailedSolution):
        return bound_by_less_slack(scene, settings)
    return None


def _show_refusal(solution: Solved, document: dict[str, Any]) -> None:
    told = say("solve.ended", ended=solution.outcome.word, reason=document["reason"])
    tell(told)
    if bound := document.get("upper_bound"):
        limit = say(
            "solve.bound",
            slack=bound["slack"],
            foot=bound["foot_kN_per_m"],
            head=bound["head_kN_per_m"],
        )
        tell(limit)


def _show_solution(document: dict[str, Any]) -> None:
    for end, pull in (document["anchor_forces"] or {}).items():
        tell(_describe_end(end, pull))
    if document["wall"]:
        tell(_describe_wall(document["wall"]))
    else:
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


def _describe_wall(wall: dict[str, float]) -> Message:
    return say(
        "solve.wall",
        x=wall["force_x_kN_per_m"],
        y=wall["force_y_kN_per_m"],
        error=wall["error_kN_per_m"],
        moment=wall["moment_about_foot_kN"],
    )


def _describe_support(support: dict[str, Any] | None) -> Iterator[Message]:
    """Forces of both sets, ropes and row end, a line each."""
    if support is None:
        return
    from netdesign.report.page.solved_support import find_force, list_shown

    if "reason" in support:
        yield say("solve.support_lack", reason=support["reason"])
    for member in list_shown(support):
        forces = {
            name: force
            for name, part in (("section", "plain"), ("panel", "panel"))
            if (force := find_force(support[part], member)) is not None
        }
        if forces:
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


def _list_names(given: GivenScene) -> list[str]:
    """Names of the outputs of a scene."""
    from netdesign.report.page.solution_page import list_solution_files
    from netdesign.snow.wall import Wall
    from netdesign.solving.solve import method_of

    return list_solution_files(
        method_of(given.settings),
        is_wall=isinstance(given.scene.net, Wall),
        has_panel=given.support is not None and given.support.panel is not None,
    )
