"""Completion of commands and options in the shell."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from netdesign.commands.help_texts import load_help
from netdesign.commands.language import find_language
from netdesign.commands.options import language_option
from netdesign.commands.usage import UsageRefusal
from netdesign.words.message import say

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem, ShellComplete

COMPLETE_VARIABLE = "_NETDESIGN_COMPLETE"
_PROGRAM = "netdesign"


@click.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish", "powershell"]))
@language_option("Of this help.", expose_value=False)
@click.pass_context
def completion(context: click.Context, shell: str) -> None:
    """Print the script that completes commands and options in a shell.

    \b
    eval "$(netdesign completion bash)"                     in ~/.bashrc
    eval "$(netdesign completion zsh)"                      in ~/.zshrc
    netdesign completion fish > ~/.config/fish/completions/netdesign.fish
    netdesign completion powershell >> $PROFILE             in PowerShell
    """
    from click.shell_completion import get_completion_class

    _add_powershell()

    kind = get_completion_class(shell)
    if kind is None:  # click knows the others
        raise UsageRefusal(say("usage.shell_unknown", shell=shell))
    command = context.find_root().command
    script = kind(command, {}, _PROGRAM, COMPLETE_VARIABLE)
    # not source(): for bash it would first start a bash to ask for its version
    click.echo(script.source_template % script.source_vars())


def answer_shell(command: click.Command, instruction: str) -> int:
    """Answer a shell that asks for completions; the exit code it expects."""
    from click.shell_completion import (
        add_completion_class,
        get_completion_class,
        shell_complete,
    )

    _add_powershell()
    shell = instruction.partition("_")[0]
    if kind := get_completion_class(shell):
        add_completion_class(_tell_in_language(kind), shell)
    return shell_complete(command, {}, _PROGRAM, COMPLETE_VARIABLE, instruction)


def _tell_in_language(kind: type[ShellComplete]) -> type[ShellComplete]:
    """Completion of a shell whose descriptions are in the language of the line."""

    class Told(kind):  # type: ignore[valid-type, misc]  # a class as an argument
        def get_completions(
            self, args: list[str], incomplete: str
        ) -> list[CompletionItem]:
            """Find the completions, then tell them."""
            items: list[CompletionItem] = super().get_completions(args, incomplete)
            told = load_help(find_language(self.cli, args))
            for item in items:
                item.help = told.tell(item.help) if told and item.help else item.help
            return items

    return Told


def _add_powershell() -> None:
    """Make PowerShell known to click."""
    from click.shell_completion import add_completion_class

    from netdesign.commands.powershell import PowerShellComplete

    add_completion_class(PowerShellComplete, "powershell")
