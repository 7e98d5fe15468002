"""Completion of commands and options in the shell."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class


@click.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
@click.pass_context
def completion(context: click.Context, shell: str) -> None:
    """Print the script that completes commands and options in a shell.

    \b
    eval "$(netdesign completion bash)"                     in ~/.bashrc
    eval "$(netdesign completion zsh)"                      in ~/.zshrc
    netdesign completion fish > ~/.config/fish/completions/netdesign.fish
    """
    kind = get_completion_class(shell)
    assert kind is not None  # click knows all three
    command = context.find_root().command
    script = kind(command, {}, "netdesign", "_NETDESIGN_COMPLETE")
    # not source(): for bash it would first start a bash to ask for its version
    click.echo(script.source_template % script.source_vars())
