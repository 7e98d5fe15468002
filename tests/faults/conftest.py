"""A small site that takes a second, and the program on it in a process of its own."""

import os
import subprocess
import sys

import pytest

from tests.make import write_rows

PROGRAM = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n\
from netdesign.cli import main; main()"


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """Two net rows of the example, four cases each; the second row fails."""
    path = tmp_path_factory.mktemp("site") / "site.xlsx"
    write_rows(path, ["R1", "R7"])
    return path


@pytest.fixture
def begin(site, tmp_path):
    """Starts ``check`` of the site in the test's folder; the store lies there too."""

    def start(*options, before="", under=(), **more):
        environment = {"SOURCE_DATE_EPOCH": "1700000000", **more.pop("env", {})}
        command = [*under, sys.executable, "-c", before + PROGRAM, "check", str(site)]
        return subprocess.Popen(
            [*command, "--accuracy", "0.1", *(str(one) for one in options)],
            cwd=tmp_path,
            env=os.environ
            | {"NETDESIGN_STORE": str(tmp_path / "cases.sqlite")}
            | environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            **more,
        )

    return start


@pytest.fixture(scope="session")
def clean(site, tmp_path_factory):
    """Outputs of a run that nothing befalls."""
    folder = tmp_path_factory.mktemp("clean")
    command = [sys.executable, "-c", PROGRAM, "check", str(site), "--accuracy", "0.1"]
    ended = subprocess.run(
        [*command, "--out", "out", "--jobs", "1"],
        cwd=folder,
        env=os.environ
        | {
            "NETDESIGN_STORE": str(folder / "cases.sqlite"),
            "SOURCE_DATE_EPOCH": "1700000000",
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 1, ended.stderr
    return {one.name: one.read_bytes() for one in (folder / "out").iterdir()}
