"""Runs of ``check`` killed with SIGKILL; by ``-m faults`` a hundred of them."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

KILLER = Path(__file__).with_name("kill_runs.py")
FAILS = 1  # R7 of the example is too weak
IN_THE_SUITE, ALL = 5, 100

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="forks its runs")


def kill(site, folder, kills, seed):
    command = [sys.executable, KILLER, site, folder, str(kills), str(seed)]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr
    document = json.loads(ended.stdout)
    assert document["code"] == FAILS
    outputs = ["report.html", "report.xlsx", "study.json"]
    assert document["outputs"] == [".netdesign.json", *outputs]
    assert document["differs_from_old"]
    return document


@pytest.mark.long
def test_killed_runs_leave_nothing_half_and_continue_to_the_same_bytes(site, tmp_path):
    document = kill(site, tmp_path, IN_THE_SUITE, seed=4)
    assert document["faults"] == []
    assert document["in_time"] == IN_THE_SUITE


@pytest.mark.faults
def test_a_hundred_killed_runs(site, tmp_path):
    document = kill(site, tmp_path, ALL, seed=20)
    sys.stdout.write(
        f"{ALL} runs, {document['in_time']} of them killed before their end; "
        f"{document['steps']} steps to choose from; {len(document['faults'])} faults\n"
    )
    assert document["faults"] == []
    assert document["in_time"] >= 0.9 * ALL  # after the last step a run may be done
