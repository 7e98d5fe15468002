"""Programs that some tests open outputs in; nothing else is left out for their lack."""

import os
import shutil

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
