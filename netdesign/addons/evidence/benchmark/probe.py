"""Script for another version's Python: it times commands of that version from within.

It is run by its path, with any version, so it imports nothing of this one: only the
command line, which every version has. Of two lists of commands, given as JSON, it runs
the first for what the second one needs, and prints the times of the second as JSON.
"""

import contextlib
import io
import json
import os
import sys
import time
from collections.abc import Sequence


def read_clocks() -> tuple[float, float]:
    """Wall time, and processor time of this process and its ended children [s]."""
    ended = os.times()
    cpu = time.process_time() + ended.children_user + ended.children_system
    return time.perf_counter(), cpu


def run(words: Sequence[str]) -> object:
    """Exit code of a command; what it prints is not shown."""
    from netdesign.cli import main

    sys.argv = ["netdesign", *words]
    with contextlib.redirect_stdout(io.StringIO()):
        try:
            main()
        except SystemExit as end:
            return end.code or 0


if __name__ == "__main__":
    warming, timed = json.loads(sys.argv[1])
    codes = [run(words) for words in warming]
    before = read_clocks()
    codes += [run(words) for words in timed]
    wall, cpu = (b - a for a, b in zip(before, read_clocks(), strict=True))
    times = {"wall_s": wall, "cpu_s": cpu}
    sys.stdout.write(json.dumps({"times": times, "codes": codes}))
