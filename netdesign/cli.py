"""The command line: parses, calls, shows; no physics and no formatting of results.

Imports of anything heavy stand inside the commands that need it: help is instant.
"""

from __future__ import annotations

import gc
import json
import os
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NoReturn

import click

from netdesign import __version__
from netdesign.commands.bench import bench
from netdesign.commands.completion import COMPLETE_VARIABLE, answer_shell, completion
from netdesign.commands.config import (
    ENVIRONMENT_PREFIX,
    ConfiguredCommand,
    accept_variables,
    require_known_variables,
)
from netdesign.commands.diff import diff
from netdesign.commands.doctor import doctor
from netdesign.commands.dry_run import announce
from netdesign.commands.envelope import envelope
from netdesign.commands.faults import tell_faults
from netdesign.commands.glide import glide
from netdesign.commands.language import find_language, tell
from netdesign.commands.options import (
    accuracy_option,
    force_option,
    json_option,
    language_option,
    out_option,
    quiet_option,
)
from netdesign.commands.paper import paper
from netdesign.commands.report import DEFAULT_FOLDER, report
from netdesign.commands.report_options import list_wanted, report_options
from netdesign.commands.site_input import open_site, site_options, temporary_example
from netdesign.commands.solving import open_run, solving_options
from netdesign.commands.standards import standards
from netdesign.commands.usage import ToldGroup, UsageRefusal, describe_refusal
from netdesign.commands.verify import verify
from netdesign.edge.causes import explain_system
from netdesign.edge.given_files import make_printable
from netdesign.edge.streams import guard_streams, print_json
from netdesign.errors import (
    NetDesignError,
    OutputError,
    SiteDataError,
    StandardError,
)
from netdesign.fault import SENTENCE, Fault, catch_fault, describe_fault
from netdesign.outcome import Outcome, Verdict
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say
from netdesign.words.names import name_member

if TYPE_CHECKING:
    from collections.abc import Sequence

    from netdesign.checks import Standard
    from netdesign.coupling.scene import Scene
    from netdesign.coupling.steady.bound import PullBound
    from netdesign.report.page.solution_page import Solved
    from netdesign.site.model import Site
    from netdesign.solving.solve import Settings
    from netdesign.study.records import Study
    from netdesign.words.catalogue import Language

DEFAULT_STANDARD = "nf-p-95-304-style"
EXIT_CODES = {Verdict.PASS: 0, Verdict.FAIL: 1, Verdict.NOT_PROVEN: 4}
# Of a study almost nothing is ever thrown away: looking for it took a tenth of a run.
_OBJECTS = 100_000
_EXIT_USAGE, _EXIT_INTERNAL, _EXIT_INTERRUPTED = 2, 5, 130

_EPILOG = "Exit codes: 0 pass, 1 fail, 2 usage, 3 input refused, 4 not proven, \
5 internal error, 130 interrupted. A reader of the output who stops early changes \
none of them; a standard output that cannot be written to ends with 2."


@click.group(
    cls=ToldGroup,
    epilog=_EPILOG,
    context_settings={"help_option_names": ["-h", "--help"]},
)
@click.version_option(__version__)
@click.pass_context
def cli(context: click.Context) -> None:
    """Check the anchors of snow nets.

    \b
    netdesign check --example          a first look
    netdesign init site.xlsx           an input workbook to fill in
    netdesign check site.xlsx          verdict, report.html, report.xlsx, study.json
    netdesign diff old.json new.json   what changed between two studies
    """
    name = context.invoked_subcommand or ""
    require_known_variables(name, cli.commands[name])


cli.add_command(bench)
cli.add_command(completion)
cli.add_command(diff)
cli.add_command(doctor)
cli.add_command(envelope)
cli.add_command(glide)
cli.add_command(paper)
cli.add_command(report)
cli.add_command(standards)
cli.add_command(verify)


@cli.command(cls=ConfiguredCommand)
@click.argument("site_file", required=False, type=click.Path(path_type=Path))
@click.option("--example", is_flag=True, help="Use the built-in example site.")
@site_options
@click.option(
    "--standard",
    "standards",
    multiple=True,
    metavar="ID",
    help=f"Limit profile, or a folder with one; repeatable [{DEFAULT_STANDARD}].",
)
@accuracy_option("Relative error allowed in every end force of the net.", default=0.01)
@click.option(
    "--method",
    type=click.Choice(["steady", "transient"]),
    default="steady",
    show_default=True,
    help="Steady states; transient confirms governing cases by their histories.",
)
@solving_options
@out_option(f"Folder of the outputs [{DEFAULT_FOLDER}; with --json none].")
@report_options
@click.option("--explain", is_flag=True, help="Print what would flip each check.")
@json_option("study")
@click.option("--dry-run", is_flag=True, help="Read and count only; write nothing.")
@force_option
@quiet_option
def check(
    site_file: Path | None,
    *,
    example: bool,
    standards: tuple[str, ...],
    accuracy: float,
    method: Literal["steady", "transient"],
    jobs: int | None,
    executor: str,
    cache: bool,
    out: Path | None,
    language: Language,
    detail: Literal["summary", "full"],
    html: bool,
    excel: bool,
    csv: bool,
    pdf: bool,
    explain: bool,
    as_json: bool,
    dry_run: bool,
    force: bool,
    quiet: bool,
    **reading: Any,
) -> None:
    """Check every anchor of a site and write the reports.

    \b
    netdesign check --example
    netdesign check site.xlsx --out reports --jobs 2
    netdesign check site.xlsx --annotate site-marked.xlsx --dry-run
    netdesign check site.csv --delimiter ";" --decimal-mark comma
    netdesign check site.xlsx --standard eurocode --standard my-profile/ --explain
    netdesign check site.xlsx --json > study.json

    The site is an xlsx, xlsm, ods or csv file, or a folder of csv files. Defaults
    may stand in netdesign.toml beside it, or in variables such as
    NETDESIGN_CHECK_JOBS.
    """
    from netdesign.coupling.scene import SolverSettings
    from netdesign.edge.output import require_free, write_files
    from netdesign.report.files import (
        STUDY_FILE,
        ReportStyle,
        name_files,
        render_files,
    )
    from netdesign.study.cases import CheckRun
    from netdesign.study.check_site import check_site

    if example == (site_file is not None):
        raise UsageRefusal(say("usage.site_or_example"))
    site = _read_site(site_file, overwrite=force, language=language, **reading)
    profiles = _choose_profiles(standards, site)
    run = CheckRun(
        settings=SolverSettings(accuracy=accuracy),
        method=method,
        jobs=jobs or os.cpu_count() or 1,
        command=_own_command(),
        started=_now(),
    )
    if dry_run:
        sys.exit(
            announce(
                site,
                run,
                as_json=as_json,
                profiles=len(profiles),
                language=language,
            )
        )
    folder = out or (None if as_json else Path(DEFAULT_FOLDER))
    kinds = list_wanted({"html": html, "excel": excel, "csv": csv, "pdf": pdf})
    names = name_files(folder, [p.id for p in profiles], [STUDY_FILE, *kinds])
    require_free([path for group in names for path in group], overwrite=force)
    style = ReportStyle(language=language, detail=detail)
    with open_run(
        site,
        run,
        executor=executor,
        cache=cache,
        quiet=quiet,
        profiles=len(profiles),
        language=language,
    ) as (runner, progress):
        studies = check_site(site, profiles, run, runner, progress)
        progress.enter("reports")
        files = render_files(studies, names, style)
    failed = tell_faults(runner.faults, language)
    write_files(files, overwrite=force)
    _show(studies, language, as_json=as_json, explain=explain)
    _report_places(names, language, quiet=quiet or as_json)
    sys.exit(failed or _exit_code(studies))


@cli.command()
@click.argument("site_file", type=click.Path(path_type=Path, dir_okay=False))
@click.option("--example", is_flag=True, help="Fill in the built-in example site.")
@language_option("Of headings, words and notes; all three are read.")
@click.option("--force", is_flag=True, help="Overwrite an existing file.")
def init(site_file: Path, *, example: bool, language: Language, force: bool) -> None:
    """Write an input workbook to fill in.

    \b
    netdesign init site.xlsx
    netdesign init chantier.xlsx --language fr
    netdesign init example.xlsx --example
    """
    from netdesign.edge.output import require_free
    from netdesign.site.template.workbook import write_site_workbook

    require_free([site_file], overwrite=force)
    write_site_workbook(site_file, example=example, overwrite=force, language=language)
    tell(say("cli.wrote", path=str(site_file)), language, err=True)


@cli.command()
@click.argument("scene_file", type=click.Path(path_type=Path))
@click.option(
    "--method",
    type=click.Choice(["steady", "transient", "staggered"]),
    help="Steady state, history, or the source paper's exchange [the scene's].",
)
@json_option("solution")
@out_option("Folder for a page with drawings, the solution, a history's table.")
@language_option("Of what is printed, and of reasons and remarks.")
@force_option
def solve(
    scene_file: Path,
    *,
    method: Literal["steady", "transient", "staggered"] | None,
    as_json: bool,
    out: Path | None,
    language: Language,
    force: bool,
) -> None:
    """Solve one scene, given as a TOML file.

    \b
    netdesign solve scene.toml
    netdesign solve scene.toml --json
    netdesign solve scene.toml --method transient --out history
    """
    import time

    from netdesign.commands.solve_folder import (
        require_free_folder,
        write_solution_folder,
    )
    from netdesign.files.scene import read_scene
    from netdesign.files.solution import write_solution_document

    scene, settings = read_scene(scene_file, method)
    if out is not None:
        require_free_folder(out, scene, settings, overwrite=force)
    start = time.perf_counter()
    solution, failed = _solve(scene, settings, language)
    elapsed = time.perf_counter() - start
    bound = None if failed else _bound_refused(scene, settings, solution)
    document = write_solution_document(solution, settings, elapsed, bound, language)
    if out is not None:
        written = write_solution_folder(
            out,
            solution,
            document,
            scene_file.name,
            overwrite=force,
            language=language,
        )
        _report_places([written], language, quiet=as_json)
    if as_json:
        click.echo(json.dumps(document, indent=1, allow_nan=False))
    elif document["outcome"] == "converged":
        _show_solution(document, language)
    else:
        _show_refusal(solution, document, language)
    proven = document["outcome"] == "converged"
    proven = proven and document.get("plateau", {"reached": True})["reached"]
    sys.exit(failed or (0 if proven else EXIT_CODES[Verdict.NOT_PROVEN]))


def _solve(scene: Scene, settings: Settings, language: Language) -> tuple[Solved, int]:
    """Solution of a scene, and the exit code of a fault; it is told on stderr."""
    from netdesign.coupling.solution import FailedSolution
    from netdesign.solving.describe import describe_case
    from netdesign.solving.solve import solve_scene

    case = describe_case(scene, settings)
    solution = catch_fault(lambda: solve_scene(scene, settings), case)
    if not isinstance(solution, Fault):
        return solution, 0
    failed = FailedSolution(outcome=Outcome.PROGRAM_FAULT, reason=SENTENCE)
    return failed, tell_faults({solution: ()}, language)


def _bound_refused(
    scene: Scene, settings: Settings, solution: object
) -> PullBound | None:
    """What a net without a steady state stays below; None if it has one."""
    from netdesign.coupling.scene import SolverSettings
    from netdesign.coupling.solution import FailedSolution
    from netdesign.coupling.steady.bound import bound_by_less_slack

    if isinstance(settings, SolverSettings) and isinstance(solution, FailedSolution):
        return bound_by_less_slack(scene, settings)
    return None


def _show_refusal(
    solution: Solved, document: dict[str, Any], language: Language
) -> None:
    told = say("solve.ended", ended=solution.outcome.word, reason=document["reason"])
    tell(told, language)
    if bound := document.get("upper_bound"):
        limit = say(
            "solve.bound",
            slack=bound["slack"],
            foot=bound["foot_kN_per_m"],
            head=bound["head_kN_per_m"],
        )
        tell(limit, language)


accept_variables(cli)


def main() -> NoReturn:
    """Entry point: every way of ending has its own exit code.

    A reader who stops reading changes none of them: what was asked for was done. A
    standard output that cannot be written to is the user's to mend.
    """
    streams = guard_streams()
    try:
        _run()
    except SystemExit as end:
        code = end.code
    streams.flush()
    if streams.fault and code in (None, *EXIT_CODES.values()):
        cause = explain_system(streams.fault)
        tell(say("cli.output_lost", cause=cause), _speak(), err=True)
        streams.flush()
        code = OutputError.exit_code
    sys.exit(code)


def _run() -> NoReturn:
    gc.set_threshold(_OBJECTS)
    if instruction := os.environ.get(COMPLETE_VARIABLE):
        sys.exit(answer_shell(cli, instruction))
    _unset_empty("SOURCE_DATE_EPOCH")
    try:
        # not cli.main(): click has exit codes of its own
        with cli.make_context(
            "netdesign", sys.argv[1:], auto_envvar_prefix=ENVIRONMENT_PREFIX
        ) as context:
            cli.invoke(context)
    except click.exceptions.Exit as end:
        sys.exit(end.exit_code)
    except (click.Abort, KeyboardInterrupt):
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # a second one changes nothing
        tell(say("cli.interrupted", command=_own_command()), _speak(), err=True)
        sys.exit(_EXIT_INTERRUPTED)
    except click.ClickException as error:
        shown = describe_refusal(error, _speak())
        click.echo(make_printable(shown), nl=False, err=True)
        sys.exit(_EXIT_USAGE)
    except SiteDataError as error:
        lines = say("text.lines", lines=(error.message, _count_findings(error)))
        click.echo(make_printable(render(lines, _speak())), err=True)
        sys.exit(error.exit_code)
    except NetDesignError as error:
        told = render(say("cli.error", reason=error.message), _speak())
        click.echo(make_printable(told), err=True)
        sys.exit(error.exit_code)
    except Exception as error:  # the one place where a bug ends
        if os.environ.get("NETDESIGN_TRACEBACK"):
            raise
        sys.exit(_tell_unexpected(error))
    sys.exit(0)


def _speak() -> Language:
    """Language of this run, also where its command line was refused."""
    return find_language(cli, sys.argv[1:])


def _tell_unexpected(error: Exception) -> int:
    """Say what nobody handled: what given paths can cause, their readers have."""
    return tell_faults({describe_fault(error): ()}, _speak())


def _read_site(site_file: Path | None, **reading: Any) -> Site:
    """Site from a file; the example goes through a real workbook too."""
    if site_file is not None:
        return open_site(site_file, **reading)
    with temporary_example() as path:
        return open_site(path, **reading)


def _choose_profiles(names: Sequence[str], site: Site) -> list[Standard]:
    """Profiles of the command line, else that of the site, else the default."""
    named = site.project.standard
    if names or not named:
        return _load_profiles(names or (DEFAULT_STANDARD,))
    try:
        return _load_profiles((named,))
    except StandardError as error:
        place = site.project_cells["standard"].replace("!", " › ")
        raise StandardError(
            say(
                "standard.in_site",
                file=site.file_name,
                place=place,
                fault=error.message,
            )
        ) from None


def _load_profiles(names: Sequence[str]) -> list[Standard]:
    from netdesign.checks import load_standard

    profiles = [load_standard(name) for name in names]
    if len({profile.id for profile in profiles}) < len(profiles):
        raise UsageRefusal(say("usage.same_profiles"))
    return profiles


def _show(
    studies: Sequence[Study], language: Language, *, as_json: bool, explain: bool
) -> None:
    from netdesign.study.records import write_document

    if not as_json:
        from netdesign.report.terminal import (
            open_console,
            print_changes,
            print_summary,
        )

        console = open_console()
        for study in studies:
            print_summary(study, console, language)
            if explain:
                print_changes(study, console, language)
    elif len(studies) == 1:
        print_json(write_document(studies[0]))
    else:
        documents = ",\n".join(write_document(study) for study in studies)
        print_json(f'{{"schema": "netdesign.studies/1", "studies": [\n{documents}\n]}}')


def _show_solution(document: dict[str, Any], language: Language) -> None:
    for end, pull in (document["anchor_forces"] or {}).items():
        tell(_describe_end(end, pull, language), language)
    if document["wall"]:
        tell(_describe_wall(document["wall"]), language)
    else:
        tell(say("solve.sag", sag=document["sag_m"]), language)
    if document["history"]:
        tell(_describe_plateau(document), language)
    residual = document["balance"]["relative_residual"]
    tell(say("solve.balance", residual=residual), language)
    for flag in document["flags"]:
        tell(say("cli.note", text=flag), language)


def _describe_end(end: str, pull: dict[str, float], language: Language) -> Message:
    return say(
        "solve.end",
        end=render(name_member(end), language),  # padded as a text
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


def _report_places(names: list[list[Path]], language: Language, *, quiet: bool) -> None:
    for path in [] if quiet else [path for group in names for path in group]:
        tell(say("cli.wrote", path=str(path)), language, err=True)


def _exit_code(studies: Sequence[Study]) -> int:
    from netdesign.outcome import merge_verdicts

    return EXIT_CODES[merge_verdicts(study.verdict for study in studies)]


def _count_findings(error: SiteDataError) -> Message:
    count = len(error.findings)
    if count == 1:
        return say("finding.count_one")
    return say("finding.count", count=count)


def _own_command() -> str:
    import shlex

    return make_printable(shlex.join(["netdesign", *sys.argv[1:]]))


def _unset_empty(name: str) -> None:
    """An empty variable counts as none; numpy would stumble over this one."""
    if not os.environ.get(name):
        os.environ.pop(name, None)


def _now() -> str:
    """Time of the run, or that of SOURCE_DATE_EPOCH for reproducible outputs."""
    from datetime import UTC, datetime

    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    try:
        time = datetime.fromtimestamp(int(epoch), UTC) if epoch else datetime.now(UTC)
    except (ValueError, OverflowError, OSError):
        raise UsageRefusal(say("usage.epoch", epoch=epoch or "")) from None
    return time.isoformat(timespec="seconds")
