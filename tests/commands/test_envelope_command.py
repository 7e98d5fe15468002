"""The command as a user runs it: documents, exit codes, kills and interrupts."""

import contextlib
import json
import os
import signal
import sqlite3
import subprocess
import sys
import time

import pytest

from tests.program import call_program
from tests.small_scene import SMALL_SCENE

RANGES = ("--density", "250:450", "--friction", "15:45")
PROGRAM = (sys.executable, "-c", "from netdesign.cli import main; main()")


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "scene.toml"
    path.write_text(SMALL_SCENE)
    return path


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    """One store for the tests that do not ask how many cases are solved."""
    return tmp_path_factory.mktemp("store") / "cases.sqlite"


def environment(store):
    return {"NETDESIGN_STORE": str(store), "SOURCE_DATE_EPOCH": "1700000000"}


def run(*arguments, store):
    where = () if "--executor" in arguments else ("--jobs", "1")
    return call_program(*arguments, *where, **environment(store))


def document(*arguments, store):
    result = run("envelope", *arguments, "--json", "--quiet", store=store)
    assert result.code == 0, result.err
    return json.loads(result.out)


def without_run(found):
    """What must not depend on how a run came about."""
    counts = {k: v for k, v in found["cases"].items() if k not in ("solved", "reused")}
    return found | {"cases": counts, "cost": None}


def test_the_document_is_that_of_the_interface(scene, store):
    found = document(scene, *RANGES, "--accuracy", "0.02", store=store)
    assert found["schema"] == "netdesign.envelope/1"
    assert found["ranges"] == {
        "density_kg_m3": [250.0, 450.0],
        "friction_deg": [15.0, 45.0],
    }
    assert [one["quantity"] for one in found["extremes"]] == [
        "foot_size_kN_per_m", "head_size_kN_per_m", "tension_max_kN_per_m",
    ]  # fmt: skip
    for one in found["extremes"]:
        assert one["max"] <= one["upper_bound"] <= one["max"] * 1.02 * (1 + 1e-6)
        assert (
            one["low"] <= one["max"] <= one["upper_bound"] <= one["high"] * (1 + 1e-12)
        )
        assert set(one["case"]) == {"density_kg_m3", "friction_deg", "inclination_deg"}
        assert len(one["coincident"]) == 2
        assert one["confirmation"]["difference_percent"] is not None
    assert set(found["cases"]) >= {"solved", "reused", "skipped", "failed"}
    assert found["cases"]["failed"] == 0


@pytest.mark.parametrize(
    ("arguments", "code", "told"),
    [
        (("--density", "250-450"), 2, "accepted is low:high"),
        ((), 2, "no range is given: accepted are --density"),
        (("--density", "250:450:3", "--friction", "15:45"), 2, "give n in all of them"),
        (
            ("--density", "250:450:401", "--friction", "15:45:250"),
            2,
            "100250 cases: at most 100000 in a grid",
        ),
        (("--density", "250:950"), 3, "snow density = 950.0: must lie from 10 to 908"),
        (("--friction", "15:80"), 3, "friction"),
        (
            ("--glide", "1:50"),
            3,
            'ground law "no-slip" does not slide, but the envelope',
        ),
        (("--density", "250:300", "--executor", "slurm"), 2, "dask://HOST:PORT"),
        (("--density", "250:300", "--accuracy", "0"), 2, "accuracy"),
    ],
)
def test_bad_input_is_refused_by_name_and_nothing_is_written(
    scene, tmp_path, arguments, code, told
):
    result = run(
        "envelope", scene, *arguments, "--out", tmp_path / "o", store=tmp_path / "s"
    )
    assert result.code == code
    assert told in result.err
    assert result.out == ""
    assert not (tmp_path / "o").exists()


# --- kills and interrupts ------------------------------------------------------------


def start(scene, store, out):
    return subprocess.Popen(
        [*PROGRAM, "envelope", str(scene), *RANGES, "--inclination", "25:35",
         "--out", str(out), "--force"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env=os.environ | environment(store), start_new_session=True,
        # a shell that runs tests in the background lets its children ignore SIGINT
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )  # fmt: skip


def outputs(folder):
    """All outputs; of the document without what tells of the run itself.

    A kill in the middle of writing leaves a hidden file under a temporary name.
    """
    paths = [path for path in folder.iterdir() if not path.name.startswith(".")]
    found = {path.name: path.read_text() for path in paths}
    found["envelope.json"] = without_run(json.loads(found["envelope.json"]))
    return found


@pytest.mark.long
def test_a_killed_run_continues_to_the_same_bytes(scene, tmp_path):
    """Killed twice; ``tests/faults/kill_runs.py`` kills at random moments."""
    whole = start(scene, tmp_path / "whole.sqlite", tmp_path / "whole")
    assert whole.wait(timeout=120) == 0
    whole.communicate()
    store = tmp_path / "killed.sqlite"
    for moment in (0.9, 1.4):
        process = start(scene, store, tmp_path / "killed")
        try:
            process.communicate(timeout=moment)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
    last = start(scene, store, tmp_path / "killed")
    assert last.wait(timeout=120) == 0
    last.communicate()
    assert outputs(tmp_path / "killed") == outputs(tmp_path / "whole")


def count_kept(store):
    """Number of cases in a store; none before it is there."""
    try:
        with contextlib.closing(sqlite3.connect(store)) as base:
            return base.execute("SELECT count(*) FROM cases").fetchone()[0]
    except sqlite3.Error:
        return 0


def test_ctrl_c_stops_within_two_seconds_and_tells_how_to_continue(scene, tmp_path):
    store = tmp_path / "cases.sqlite"
    process = start(scene, store, tmp_path / "o")
    while count_kept(store) < 9:  # the first wave is over
        assert process.poll() is None
        time.sleep(0.02)
    asked = time.monotonic()
    os.killpg(process.pid, signal.SIGINT)
    _, rest = process.communicate(timeout=30)
    assert time.monotonic() - asked < 2.0
    assert process.returncode == 130
    assert f"to continue: netdesign envelope {scene}" in rest
    assert "Traceback" not in rest
    assert not (tmp_path / "o").exists()
    again = run("envelope", scene, *RANGES, "--inclination", "25:35", "--json",
                "--quiet", store=store)  # fmt: skip
    assert json.loads(again.out)["cases"]["reused"] >= 9
