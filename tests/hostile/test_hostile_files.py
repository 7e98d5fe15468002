"""Hostile files are refused with a message, before they cost memory or time."""

import json
import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest

import netdesign
from netdesign.site.template.office_workbook import write_site_workbook
from tests.hostile.hostile_files import write_all
from tests.peak_memory import PEAK

pytestmark = pytest.mark.long
ROOT = Path(netdesign.__file__).parent.parent
MOST_MEGABYTES = 800  # above the idle program; a list of numbers as JSON needs most
MOST_SECONDS = 20.0  # of one file; on an idle machine none needs more than three
_CHILD = """
import contextlib, io, json, sys, time
from netdesign import cli
import netdesign.site.template.annotate, netdesign.study.records, openpyxl, pydantic
import netdesign.solving.solve, netdesign.study.check_site, netdesign.commands.check_run

idle = peak()
for name, command in json.load(sys.stdin).items():
    sys.argv = ["netdesign", command[0], name, *command[1:]]
    out, err, start = io.StringIO(), io.StringIO(), time.perf_counter()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            cli.main()
        except SystemExit as end:
            code = end.code
    seconds = time.perf_counter() - start
    print(json.dumps([name, code, err.getvalue(), peak() - idle, seconds]), flush=True)
"""


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (4 * 2**30, 4 * 2**30))


@pytest.fixture(scope="module")
def ends(tmp_path_factory):
    """Exit code, message, memory and time of every hostile file, by its name."""
    folder = tmp_path_factory.mktemp("hostile")
    base = folder / "base.xlsx"
    write_site_workbook(base, example=True)
    commands = write_all(folder, base)
    ended = subprocess.run(
        [sys.executable, "-c", PEAK + _CHILD],
        input=json.dumps(commands),
        capture_output=True,
        text=True,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        timeout=300,
        preexec_fn=limit_memory,
    )
    found = {}
    for line in ended.stdout.splitlines():
        name, *end = json.loads(line)
        found[name] = end
    assert found.keys() == commands.keys(), ended.stderr
    memory = max(end[2] for end in found.values())
    slowest = max(found, key=lambda name: found[name][3])
    print(  # noqa: T201  (shown with -s)
        f"\n{len(found)} files: at most {memory:.0f} MB above idle; the slowest is "
        f"{slowest} with {found[slowest][3]:.1f} s"
    )
    return found


def test_every_hostile_file_is_refused_as_input_with_a_message(ends):
    wrong = {
        name: (code, message[:200])
        for name, (code, message, _, _) in ends.items()
        if code != 3 or "Traceback" in message or "internal" in message
    }
    assert wrong == {}


def test_messages_are_short_enough_to_be_read(ends):
    assert max(len(message) for _, message, _, _ in ends.values()) < 20_000


def test_no_hostile_file_costs_memory(ends):
    assert max(memory for _, _, memory, _ in ends.values()) < MOST_MEGABYTES


def test_no_hostile_file_costs_time(ends):
    slow = {name: end[3] for name, end in ends.items() if end[3] > MOST_SECONDS}
    assert slow == {}


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("cells-in-one-row.xlsx", "elements and attributes"),
        ("cell-twice.xlsx", "twice"),
        ("last-row.xlsx", "row 1048576"),
        ("last-column.xlsx", "beyond column GR"),
        ("entity.xlsx", "declares entities"),
        ("encrypted.xlsx", "cannot be read as a workbook (it has a password)"),
        ("bzip2.xlsx", "packed in a way"),
        ("many", "MiB together"),
        ("points.toml", "more than 200 points"),
        ("brackets.toml", "nested too deep"),
        ("faults.toml", "more faults"),
        ("endless.toml", "is larger than 256 KiB"),
        ("brackets.json", "nested too deep"),
        ("twice.json", "a key twice"),
    ],
)
def test_the_message_says_what_is_wrong(ends, name, message):
    assert message in ends[name][1]
