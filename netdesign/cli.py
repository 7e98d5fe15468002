"""The command line as a whole: its commands, and every way in which it ends.

Imports of anything heavy stand inside the commands that need it: help is instant.
"""

from __future__ import annotations

import gc
import logging
import os
import shlex
import signal
import sys
import traceback
from collections import UserDict
from importlib import import_module
from io import StringIO
from typing import Any, NoReturn

import click

from netdesign import addon_table
from netdesign.commands.running import (
    UsageRefusal,
    own_command,
    print_faults,
    tell,
)
from netdesign.edge.input_files import explain, make_printable
from netdesign.edge.output import flush_streams, guard_streams
from netdesign.outcome import (
    EXIT_CODES,
    NetDesignError,
    OutputError,
    SiteDataError,
    describe_fault,
)
from netdesign.words.message import Message, say

# Of a study almost nothing is ever thrown away: looking for it took a tenth of a run.
_OBJECTS = 100_000
COMPLETE_VARIABLE = "_NETDESIGN_COMPLETE"  # of click, by which a shell asks
_EXIT_USAGE, _EXIT_INTERRUPTED = 2, 130


class CommandTable(UserDict[str, Any]):
    """Commands of the program; their names are known before they are imported."""

    def __getitem__(self, name: str) -> click.Command:
        """Return a command, imported when it is asked for."""
        place = self.data[name]
        if isinstance(place, str):
            self.data[name] = _load_command(name, place)
        command: click.Command = self.data[name]
        return command


def _load_command(name: str, place: str) -> click.Command:
    """Command at a place; without its add-on, a command that names the add-on."""
    if ":" not in place:
        module, function = place.split(".")
        command: click.Command = getattr(
            import_module(f"netdesign.commands.{module}"), function
        )
    elif addon_table.is_there(place):
        command = addon_table.load(name, place)
    else:
        command = click.Command(
            name,
            callback=lambda: addon_table.load(name, place),
            context_settings={"ignore_unknown_options": True, "allow_extra_args": True},
            add_help_option=False,
            hidden=True,
        )
    return command


# Commands as the help shows them: by those who use them.
_GROUPS = {
    "Office": (
        *("init", "map", "check", "table", "report", "diff"),
        *("verify", "standards", "doctor"),
    ),
    "Add-ons": ("winter", "terrain"),
    "Research": ("solve", "envelope", "snowpack", "bench", "paper", "validate"),
}
_ELSEWHERE = {
    "diff": "report.diff",
    "init": "site_input.init",
    "map": "site_input.map_headings",
    **addon_table.COMMANDS,
}
_COMMANDS = CommandTable(
    {
        name: _ELSEWHERE.get(name, f"{name}.{name}")
        for names in _GROUPS.values()
        for name in names
    }
)
_SITES = (".xlsx", ".xlsm", ".csv")


class GroupedCommands(click.Group):
    """Commands in groups; a site instead of a command is answered by what to type."""

    def format_commands(
        self, ctx: click.Context, formatter: click.HelpFormatter
    ) -> None:
        """Write the commands of each group, with what each does."""
        width = max(map(len, self.commands))
        for title, names in _GROUPS.items():
            commands = {name: self.get_command(ctx, name) for name in names}
            room = formatter.width - width - 6
            lines = [
                (f"{name:{width}}", command.get_short_help_str(room))
                for name, command in commands.items()
                if command and not command.hidden
            ]
            if lines:
                with formatter.section(title):
                    formatter.write_dl(lines)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that is asked for.

        Raises
        ------
        click.UsageError
            If there is none; of a site it names the command line that checks it.
        """
        if args[0] not in self.commands and args[0].lower().endswith(_SITES):
            command = shlex.join(["netdesign", "check", *args])
            raise UsageRefusal(say("usage.check_site", command=command))
        return super().resolve_command(ctx, args)


def _print_version(context: click.Context, _: click.Parameter, asked: bool) -> None:
    """Print version, core and profiles, and end; neither NumPy nor a solver is read."""
    if not asked or context.resilient_parsing:
        return
    import tomllib

    from netdesign import __version__
    from netdesign.core.library import name_core
    from netdesign.edge.input_files import find_resource

    click.echo(f"netdesign {__version__}\ncore     {name_core()}")
    for path in sorted(find_resource("standards").glob("*/document.toml")):
        profile = tomllib.loads(path.read_text(encoding="utf-8"))
        edition = f"version {profile['version']}, edition {profile['edition']}"
        click.echo(f"profile  {profile['id']}: {edition}")
    context.exit()


_EPILOG = "Exit codes: 0 pass, 1 fail, 2 usage, 3 input refused, 4 not proven, \
5 internal error, 6 declared (nothing fails, but some checks rest on a declaration), \
130 interrupted. A reader of the output who stops early changes \
none of them; a standard output that cannot be written to ends with 2."


@click.group(
    cls=GroupedCommands,
    commands=_COMMANDS,
    epilog=_EPILOG,
    context_settings={"help_option_names": ["-h", "--help"]},
)
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_print_version,
    help="Show the version, the core and the limit profiles, and exit.",
)
def cli() -> None:
    """Check the anchors of snow nets.

    \b
    netdesign check --example          a first look
    netdesign init site.xlsx           an input workbook to fill in
    netdesign map site.xlsx            what the headings of your own workbook mean
    netdesign table site.xlsx          the guideline's forces on every anchor, at once
    netdesign check site.xlsx          verdict, report.html, report.xlsx, study.json
    netdesign diff old new             what changed between two studies
    """


def main() -> NoReturn:
    """Entry point: every way of ending has its own exit code.

    A reader who stops reading changes none of them: what was asked for was done. A
    standard output that cannot be written to is the user's to mend.
    """
    output = guard_streams()
    try:
        _run()
    except SystemExit as end:
        code = end.code
    flush_streams()
    if output and output.fault and code in (None, *EXIT_CODES.values()):
        cause = explain(output.fault)
        tell(say("cli.output_lost", cause=cause), err=True)
        flush_streams()
        code = OutputError.exit_code
    sys.exit(code)


class _LogPrinter(logging.Handler):
    """Prints on stderr what the rooms below have logged."""

    def emit(self, record: logging.LogRecord) -> None:
        """Print a note."""
        text = record.msg if isinstance(record.msg, Message) else record.getMessage()
        tell(say("cli.note", text=text), err=True)


def _run() -> NoReturn:
    gc.set_threshold(_OBJECTS)
    logging.getLogger("netdesign").handlers[:] = [_LogPrinter()]
    if instruction := os.environ.get(COMPLETE_VARIABLE):
        from click.shell_completion import shell_complete

        sys.exit(shell_complete(cli, {}, "netdesign", COMPLETE_VARIABLE, instruction))
    if not os.environ.get("SOURCE_DATE_EPOCH"):
        # an empty one counts as none; numpy would stumble over it
        os.environ.pop("SOURCE_DATE_EPOCH", None)
    try:
        # not cli.main(): click has exit codes of its own
        with cli.make_context("netdesign", sys.argv[1:]) as context:
            cli.invoke(context)
    except click.exceptions.Exit as end:
        sys.exit(end.exit_code)
    except (click.Abort, KeyboardInterrupt):
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # a second one changes nothing
        tell(say("cli.interrupted", command=own_command()), err=True)
        sys.exit(_EXIT_INTERRUPTED)
    except click.ClickException as error:
        error.show(shown := StringIO())
        click.echo(make_printable(shown.getvalue()), nl=False, err=True)
        sys.exit(_EXIT_USAGE)
    except SiteDataError as error:
        lines = (error.message, _count_findings(error))
        language = context.meta.get("language", "en")
        tell(say("text.lines", lines=lines), language, err=True)
        sys.exit(error.exit_code)
    except NetDesignError as error:
        tell(say("cli.error", reason=error.message), err=True)
        sys.exit(error.exit_code)
    except Exception as error:  # the one place where a bug ends  # noqa: BLE001
        if os.environ.get("NETDESIGN_TRACEBACK"):
            traceback.print_exc()  # raised, it would end like a check that fails
        # what given paths can cause, their readers have handled
        sys.exit(print_faults({describe_fault(error): ()}))
    sys.exit(0)


def _count_findings(error: SiteDataError) -> Message:
    """Number of the faults; remarks on how a file was read are none."""
    count = sum(finding.severity == "error" for finding in error.findings)
    if count == 1:
        return say("finding.count_one")
    return say("finding.count", count=count)
