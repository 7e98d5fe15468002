"""The program as from a shell: called in this process, or started in its own."""

import io
import os
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

import pytest

from netdesign import cli

PROGRAM = (str(Path(sys.executable).with_name("netdesign")),)
QUICK = ("--accuracy", "0.1", "--jobs", "1")
_WIDTH = "100"  # of the terminal


@dataclass(frozen=True)
class Ended:
    """How a command of the program ended."""

    code: int
    out: str
    err: str


class _Stream(io.TextIOWrapper):
    """Takes text and bytes, as a standard stream does."""

    def __init__(self):
        super().__init__(io.BytesIO(), encoding="utf-8", newline="")

    def read_all(self) -> str:
        self.seek(0)
        return self.read()


def call_program(*arguments, cwd=".", **environment) -> Ended:
    """Runs in this process: the start of another takes longer than most commands."""
    out, err = _Stream(), _Stream()
    with (
        pytest.MonkeyPatch.context() as patch,
        redirect_stdout(out),
        redirect_stderr(err),
    ):
        patch.chdir(cwd)
        for name, value in environment.items():
            patch.setenv(name, value)
        patch.setattr("sys.argv", ["netdesign", *map(str, arguments)])
        with pytest.raises(SystemExit) as caught:
            cli.main()
    return Ended(int(caught.value.code or 0), out.read_all(), err.read_all())


def start_program(
    *arguments, cwd, program=PROGRAM, stdout=subprocess.PIPE, **environment
) -> Ended:
    """Runs in a process of its own, as the installed command."""
    ended = subprocess.run(
        [*program, *map(str, arguments)],
        cwd=cwd,
        env={**os.environ, "COLUMNS": _WIDTH, **environment},
        stdin=subprocess.DEVNULL,
        stdout=stdout,
        stderr=subprocess.PIPE,
        text=True,
        encoding="utf-8",
        check=False,
    )
    return Ended(ended.returncode, ended.stdout or "", ended.stderr)


def spoilt_program(preparation):
    """The same program in a fresh interpreter, after some lines of Python."""
    return (sys.executable, "-c", f"{preparation}\nimport netdesign.cli as c\nc.main()")
