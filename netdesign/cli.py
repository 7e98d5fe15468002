"""The command line: parses, calls, shows; no physics and no formatting of results.

Imports of anything heavy stand inside the commands that need it: help is instant.
"""

from __future__ import annotations

import gc
import io
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
from netdesign.commands.solving import judge_rows, open_rows, solving_options
from netdesign.commands.standards import standards
from netdesign.commands.verify import verify
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


@click.group(epilog=_EPILOG, context_settings={"help_option_names": ["-h", "--help"]})
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

    if example == (site_file is not None):
        raise click.UsageError(
            "give a site workbook, or --example for the built-in one"
        )
    site = _read_site(site_file, overwrite=force, **reading)
    profiles = _choose_profiles(standards, site)
    run = CheckRun(
        settings=SolverSettings(accuracy=accuracy),
        method=method,
        jobs=jobs or os.cpu_count() or 1,
        command=_own_command(),
        started=_now(),
    )
    if dry_run:
        sys.exit(announce(site, run, as_json=as_json, profiles=len(profiles)))
    folder = out or (None if as_json else Path(DEFAULT_FOLDER))
    kinds = list_wanted({"html": html, "excel": excel, "csv": csv, "pdf": pdf})
    names = name_files(folder, [p.id for p in profiles], [STUDY_FILE, *kinds])
    require_free([path for group in names for path in group], overwrite=force)
    style = ReportStyle(language=language, detail=detail)
    with open_rows(
        site,
        run,
        executor=executor,
        cache=cache,
        quiet=quiet,
        profiles=len(profiles),
    ) as solved:
        studies = judge_rows(site, run, solved, profiles)
        files = render_files(studies, names, style)
    failed = tell_faults(solved.runner.faults)
    write_files(files, overwrite=force)
    _show(studies, language, as_json=as_json, explain=explain)
    _report_places(names, quiet=quiet or as_json)
    sys.exit(failed or _exit_code(studies))


@cli.command()
@click.argument("site_file", type=click.Path(path_type=Path, dir_okay=False))
@click.option("--example", is_flag=True, help="Fill in the built-in example site.")
@language_option("Of headings, words and notes; all three are read.")
@click.option("--force", is_flag=True, help="Overwrite an existing file.")
def init(
    site_file: Path, *, example: bool, language: Literal["en", "fr", "de"], force: bool
) -> None:
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
    click.echo(f"wrote {site_file}", err=True)


@cli.command()
@click.argument("scene_file", type=click.Path(path_type=Path))
@click.option(
    "--method",
    type=click.Choice(["steady", "transient", "staggered"]),
    help="Steady state, history, or the source paper's exchange [the scene's].",
)
@json_option("solution")
@out_option("Folder for a page with drawings, the solution, a history's table.")
@force_option
def solve(
    scene_file: Path,
    *,
    method: Literal["steady", "transient", "staggered"] | None,
    as_json: bool,
    out: Path | None,
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
    solution, failed = _solve(scene, settings)
    elapsed = time.perf_counter() - start
    bound = None if failed else _bound_refused(scene, settings, solution)
    document = write_solution_document(solution, settings, elapsed, bound)
    if out is not None:
        written = write_solution_folder(
            out, solution, document, scene_file.name, overwrite=force
        )
        _report_places([written], quiet=as_json)
    if as_json:
        click.echo(json.dumps(document, indent=1, allow_nan=False))
    elif document["outcome"] == "converged":
        _show_solution(document)
    else:
        _show_refusal(document)
    proven = document["outcome"] == "converged"
    proven = proven and document.get("plateau", {"reached": True})["reached"]
    sys.exit(failed or (0 if proven else EXIT_CODES[Verdict.NOT_PROVEN]))


def _solve(scene: Scene, settings: Settings) -> tuple[Solved, int]:
    """Solution of a scene, and the exit code of a fault; it is told on stderr."""
    from netdesign.coupling.solution import FailedSolution
    from netdesign.solving.describe import describe_case
    from netdesign.solving.solve import solve_scene

    case = describe_case(scene, settings)
    solution = catch_fault(lambda: solve_scene(scene, settings), case)
    if not isinstance(solution, Fault):
        return solution, 0
    failed = FailedSolution(outcome=Outcome.PROGRAM_FAULT, reason=SENTENCE)
    return failed, tell_faults({solution: ()})


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


def _show_refusal(document: dict[str, Any]) -> None:
    click.echo(f"{document['outcome']}: {document['reason']}")
    if bound := document.get("upper_bound"):
        click.echo(
            f"With a slack of {bound['slack']:.3g} the net pulls with at most "
            f"{bound['foot_kN_per_m']:.1f} kN/m at its foot and "
            f"{bound['head_kN_per_m']:.1f} kN/m at its head; more slack lowers both."
        )


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
        reason = streams.fault.strerror
        click.echo(f"error: standard output cannot be written to: {reason}", err=True)
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
        click.echo(f"interrupted; to continue: {_own_command()}", err=True)
        sys.exit(_EXIT_INTERRUPTED)
    except click.ClickException as error:
        error.show(shown := io.StringIO())
        click.echo(make_printable(shown.getvalue()), nl=False, err=True)
        sys.exit(_EXIT_USAGE)
    except SiteDataError as error:
        click.echo(f"{error}\n{_count_findings(error)}", err=True)
        sys.exit(error.exit_code)
    except NetDesignError as error:
        click.echo(f"error: {make_printable(str(error))}", err=True)
        sys.exit(error.exit_code)
    except Exception as error:  # the one place where a bug ends
        if os.environ.get("NETDESIGN_TRACEBACK"):
            raise
        sys.exit(_tell_unexpected(error))
    sys.exit(0)


def _tell_unexpected(error: Exception) -> int:
    """Say what nobody handled: what given paths can cause, their readers have."""
    return tell_faults({describe_fault(error): ()})


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
        raise StandardError(f"{site.file_name} › {place}: {error}") from None


def _load_profiles(names: Sequence[str]) -> list[Standard]:
    from netdesign.checks import load_standard

    profiles = [load_standard(name) for name in names]
    if len({profile.id for profile in profiles}) < len(profiles):
        raise click.UsageError("two of the profiles have the same id")
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


def _show_solution(document: dict[str, Any]) -> None:
    for end, pull in (document["anchor_forces"] or {}).items():
        click.echo(
            f"{end:5} {pull['size_kN_per_m']:10.2f} kN/m  "
            f"(x {pull['x_kN_per_m']:.2f}, y {pull['y_kN_per_m']:.2f}, "
            f"error {pull['error_kN_per_m']:.2f})"
        )
    if document["wall"]:
        wall = document["wall"]
        click.echo(
            f"wall  x {wall['force_x_kN_per_m']:.2f}, y {wall['force_y_kN_per_m']:.2f} "
            f"kN/m, error {wall['error_kN_per_m']:.2f}; moment about the foot "
            f"{wall['moment_about_foot_kN']:.2f} kN"
        )
    else:
        click.echo(f"sag   {document['sag_m']:10.4f} m")
    if document["history"]:
        _show_plateau(document)
    balance = document["balance"]
    click.echo(f"balance residual {balance['relative_residual']:.1e} of the weight")
    for flag in document["flags"]:
        click.echo(f"note: {flag}")


def _show_plateau(document: dict[str, Any]) -> None:
    plateau = document["plateau"]
    if not plateau["reached"]:
        click.echo(f"no plateau within {document['history'][-1]['time_d']:.3g} days")
        return
    click.echo(
        f"plateau after {plateau['time_d']:.3g} days: foot "
        f"{plateau['foot_kN_per_m']:.2f}, head {plateau['head_kN_per_m']:.2f} kN/m, "
        f"drift {plateau['drift_per_efold']:+.1%} per e-fold of time; above are the "
        "largest while the snow is the scene's"
    )


def _report_places(names: list[list[Path]], *, quiet: bool) -> None:
    for path in [] if quiet else [path for group in names for path in group]:
        click.echo(f"wrote {path}", err=True)


def _exit_code(studies: Sequence[Study]) -> int:
    from netdesign.outcome import merge_verdicts

    return EXIT_CODES[merge_verdicts(study.verdict for study in studies)]


def _count_findings(error: SiteDataError) -> str:
    count = len(error.findings)
    return f"{count} finding{'s' if count != 1 else ''}; nothing was checked"


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
        raise click.UsageError(
            f"SOURCE_DATE_EPOCH = {epoch!r}: must be whole seconds since 1970"
        ) from None
    return time.isoformat(timespec="seconds")
