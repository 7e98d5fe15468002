"""Judges a run of mutmut: enough mutants are killed, and every other is explained.

The modules and their tests stand in ``[tool.mutmut]`` of pyproject.toml::

    mutmut run --max-children 2                          # all, about ten minutes
    mutmut run 'netdesign.units*' 'netdesign.structure.head*'
    python tests/mutation/judge.py

A line of ``survivors.txt`` is a function, a changed line of code and a reason, parted
by bars. Mutants that were not run do not count.
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

LEAST = 0.90
_NUMBER = re.compile(r"__mutmut_\d+$")
_DEAD = ("killed", "timeout", "caught by type check")


def call_mutmut(*arguments: str) -> str:
    return subprocess.run(
        [sys.executable, "-m", "mutmut", *arguments],
        check=True,
        capture_output=True,
        text=True,
    ).stdout


def read_ends() -> dict[str, str]:
    """How each mutant that was run ended."""
    lines = call_mutmut("results", "--all", "true").splitlines()
    pairs = (line.strip().rsplit(": ", 1) for line in lines if "__mutmut_" in line)
    return {name: end for name, end in pairs if end != "not checked"}


def show_change(name: str) -> str:
    """The line of a mutant that differs."""
    lines = call_mutmut("show", name).splitlines()
    return next(
        line[1:].strip()
        for line in lines
        if line.startswith("+") and not line.startswith("+++")
    )


def read_explained() -> dict[tuple[str, str], str]:
    text = Path(__file__).with_name("survivors.txt").read_text("utf-8")
    parts = [line.split(" | ") for line in text.splitlines() if line.strip()]
    return {(name, change): reason for name, change, reason in parts}


def main() -> None:
    ends, explained = read_ends(), read_explained()
    alive = [name for name, end in ends.items() if end not in _DEAD]
    modules: Counter[str] = Counter()
    killed: Counter[str] = Counter()
    for name, end in ends.items():
        module = name.rpartition(".")[0]
        modules[module] += 1
        killed[module] += end in _DEAD
    for module, count in sorted(modules.items()):
        share = killed[module] / count
        print(f"{module}: {killed[module]} of {count} killed ({share:.1%})")  # noqa: T201
    total = killed.total() / max(modules.total(), 1)
    print(f"all: {killed.total()} of {modules.total()} killed ({total:.1%})")  # noqa: T201
    unknown = []
    for name in alive:
        function, change = _NUMBER.sub("", name), show_change(name)
        reason = explained.get((function, change))
        print(f"  {ends[name]}: {function} | {change} | {reason or 'NOT EXPLAINED'}")  # noqa: T201
        unknown += [] if reason else [name]
    sys.exit(bool(unknown) or total < LEAST)


if __name__ == "__main__":
    main()
