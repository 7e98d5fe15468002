"""Programs that some tests open outputs in; nothing else is left out for their lack."""

import os
import shutil
import subprocess
import tempfile
from functools import cache

import pytest

REQUIRED = "NETDESIGN_SUITE_NEED_PROGRAMS"  # set by .ci/run where apt can bring them


def require_program(*names: str) -> str:
    """Path of the first program that is there; without one the test is skipped.

    Where the programs are required, their lack is a failure, never silence.
    """
    found = next(filter(None, map(shutil.which, names)), None)
    if found is not None:
        return found
    message = f"{names[0]} is not installed: nothing was opened in it"
    if os.environ.get(REQUIRED):
        pytest.fail(message)
    pytest.skip(message)


@cache
def make_profile() -> str:
    """Folder of LibreOffice's settings, made once in each process."""
    return tempfile.mkdtemp(prefix="netdesign-tests-office-")


def convert(kind, folder, *sources) -> None:
    """Files written by LibreOffice as another kind into a folder, all in one run."""
    soffice = require_program("soffice")
    profile = f"-env:UserInstallation=file://{make_profile()}"
    options = ("--headless", "--convert-to", kind, "--outdir", str(folder))
    subprocess.run(
        [soffice, profile, *options, *map(str, sources)],
        check=True,
        capture_output=True,
        timeout=180,
    )
