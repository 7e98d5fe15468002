"""Thousands of cases: memory and file handles stay flat; by ``-m faults`` 20,000."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
IN_THE_SUITE, ALL = 200, 20_000
GROWTH = 1.05  # largest, from the middle to the end

pytestmark = pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="needs proc")


def soak(cases, processes):
    command = [sys.executable, "-m", "tests.faults.soak", str(cases), str(processes)]
    ended = subprocess.run(
        command, cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert ended.returncode == 0, ended.stderr
    lines = [json.loads(line) for line in ended.stdout.splitlines()]
    assert lines[-1]["cases"] == cases
    assert sum(line["failed"] for line in lines) == 0
    return lines


def test_no_file_stays_open_after_its_case():
    lines = soak(IN_THE_SUITE, 1)
    assert len({line["files"] for line in lines}) == 1
    assert lines[-1]["memory_MiB"] < 200.0


@pytest.mark.faults
@pytest.mark.parametrize("processes", [1, 2])
def test_memory_and_file_handles_stay_flat(processes):
    lines = soak(ALL, processes)
    middle, end = lines[len(lines) // 2 - 1], lines[-1]
    for line in (lines[0], middle, end):
        sys.stdout.write(f"{processes} processes: {json.dumps(line)}\n")
    assert end["memory_MiB"] <= GROWTH * middle["memory_MiB"]
    assert {line["files"] for line in lines} == {end["files"]}
