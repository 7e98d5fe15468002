"""Completion of commands and options in the shell."""

from __future__ import annotations

import click

from netdesign.commands.usage import UsageRefusal
from netdesign.words.message import say

COMPLETE_VARIABLE = "_NETDESIGN_COMPLETE"
_PROGRAM = "netdesign"


@click.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish", "powershell"]))
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
    from click.shell_completion import shell_complete

    _add_powershell()
    return shell_complete(command, {}, _PROGRAM, COMPLETE_VARIABLE, instruction)


def _add_powershell() -> None:
    """Make PowerShell known to click."""
    from click.shell_completion import add_completion_class

    from netdesign.commands.powershell import PowerShellComplete

    add_completion_class(PowerShellComplete, "powershell")
