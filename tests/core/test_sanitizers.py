"""The compiled core under the sanitizers of addresses and of undefined behaviour."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from netdesign.core.sources import compile_core
from tests.core.test_library import ROOT, needs_compiler

CHECKED = (
    *("-fsanitize=address,undefined", "-fno-sanitize-recover=all"),
    *("-g", "-O1", "-fno-omit-frame-pointer"),
)


@needs_compiler
@pytest.mark.slow
def test_nothing_is_found(tmp_path):
    """``pytest -m slow tests/core/test_sanitizers.py``; SANITIZED_SCENES=10000 draws
    as many scenes, in a quarter of an hour.
    """
    if shutil.which("gcc") is None:
        pytest.skip("needs gcc, to find its runtime")
    found = subprocess.run(
        ["gcc", "-print-file-name=libasan.so"], capture_output=True, text=True
    ).stdout.strip()
    if not Path(found).is_absolute():
        pytest.skip("gcc has no libasan here")
    library = tmp_path / "checked.so"
    assert compile_core("gcc", library, CHECKED) == ""
    environment = {
        **os.environ,
        "LD_PRELOAD": found,
        # the interpreter itself leaves memory behind
        "ASAN_OPTIONS": "detect_leaks=0:allocator_may_return_null=1",
        "PYTHONPATH": str(ROOT),
    }
    count = os.environ.get("SANITIZED_SCENES", "200")
    ended = subprocess.run(
        [sys.executable, str(ROOT / "tests/core/sanitized.py"), str(library), count],
        env=environment,
        capture_output=True,
        text=True,
    )
    assert ended.returncode == 0, ended.stderr[-4000:]
    assert "0 findings" in ended.stdout
