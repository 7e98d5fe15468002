"""Completion in PowerShell, which click does not know."""

from __future__ import annotations

import os
from typing import ClassVar

from click.shell_completion import CompletionItem, ShellComplete

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
