"""Completion of commands and options in the shell."""

from __future__ import annotations

import os
from typing import ClassVar

import click
from click.shell_completion import (
    CompletionItem,
    ShellComplete,
    add_completion_class,
    get_completion_class,
    shell_complete,
)

from netdesign.commands.config import COMPLETE_VARIABLE, find_language
from netdesign.commands.help_texts import load_help
from netdesign.commands.options import take_options
from netdesign.commands.usage import UsageRefusal
from netdesign.words.message import say

# The words up to the cursor, one a line: a path of Windows may hold any other sign.
_SCRIPT = """\
Register-ArgumentCompleter -Native -CommandName %(prog_name)s -ScriptBlock {
    param($wordToComplete, $commandAst, $cursorPosition)
    $words = $commandAst.CommandElements |
        Where-Object { $_.Extent.StartOffset -lt $cursorPosition } |
        ForEach-Object { $_.ToString() }
    $env:%(complete_var)s = "powershell_complete"
    $env:COMP_WORDS = $words -join "`n"
    $env:COMP_CWORD = $wordToComplete
    try {
        %(prog_name)s | Where-Object { $_ } | ForEach-Object {
            $value, $help = $_ -split "`t", 2
            if (-not $help) { $help = $value }
            [System.Management.Automation.CompletionResult]::new(
                $value, $value, "ParameterValue", $help)
        }
    } finally {
        Remove-Item Env:%(complete_var)s, Env:COMP_WORDS, Env:COMP_CWORD
    }
}
"""


class PowerShellComplete(ShellComplete):
    """Completions by ``Register-ArgumentCompleter``; files are PowerShell's own."""

    name: ClassVar[str] = "powershell"
    source_template: ClassVar[str] = _SCRIPT

    def get_completion_args(self) -> tuple[list[str], str]:
        """Words before the one that is completed, and that one."""
        words = os.environ["COMP_WORDS"].split("\n")[1:]
        incomplete = os.environ["COMP_CWORD"]
        if incomplete and words and words[-1] == incomplete:
            words.pop()
        return [word.strip("'\"") for word in words], incomplete.strip("'\"")

    def format_completion(self, item: CompletionItem) -> str:
        """Value and help; nothing for a file, which PowerShell completes itself."""
        if item.type != "plain":
            return ""
        help_line = " ".join((item.help or "").split())
        return f"{item.value}\t{help_line}"

    def complete(self) -> str:
        """Lines of all completions, without the empty ones of files."""
        lines = super().complete().splitlines()
        return "\n".join(line for line in lines if line)


_PROGRAM = "netdesign"


@click.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish", "powershell"]))
@take_options("completion")
@click.pass_context
def completion(context: click.Context, shell: str) -> None:
    """Print the script that completes commands and options in a shell.

    \b
    eval "$(netdesign completion bash)"                     in ~/.bashrc
    eval "$(netdesign completion zsh)"                      in ~/.zshrc
    netdesign completion fish > ~/.config/fish/completions/netdesign.fish
    netdesign completion powershell >> $PROFILE             in PowerShell
    """
    kind = get_completion_class(shell)
    if kind is None:  # click knows the others
        raise UsageRefusal(say("usage.shell_unknown", shell=shell))
    command = context.find_root().command
    script = kind(command, {}, _PROGRAM, COMPLETE_VARIABLE)
    # not source(): for bash it would first start a bash to ask for its version
    click.echo(script.source_template % script.source_vars())


def answer_shell(command: click.Command, instruction: str) -> int:
    """Answer a shell that asks for completions; the exit code it expects."""
    shell = instruction.partition("_")[0]
    if kind := get_completion_class(shell):
        add_completion_class(_describe_in_language(kind), shell)
    return shell_complete(command, {}, _PROGRAM, COMPLETE_VARIABLE, instruction)


def _describe_in_language(kind: type[ShellComplete]) -> type[ShellComplete]:
    """Completion of a shell whose descriptions are in the language of the line."""

    class Told(kind):  # type: ignore[valid-type, misc]  # a class as an argument
        def get_completions(
            self, args: list[str], incomplete: str
        ) -> list[CompletionItem]:
            """Find the completions, then tell them."""
            items: list[CompletionItem] = super().get_completions(args, incomplete)
            told = load_help(find_language(self.cli, args))
            for item in items:
                item.help = item.help and told.tell(item.help)
            return items

    return Told


add_completion_class(PowerShellComplete, "powershell")
