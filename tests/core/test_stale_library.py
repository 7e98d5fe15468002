"""A library that does not match the C text beside it, in a checkout."""

import os
import shutil
import subprocess
import sys

import pytest

from netdesign.core import sources
from tests.core.test_library import ROOT, needs_compiler

NAME = "from netdesign.core.library import name_core; print(name_core())"
DIGEST = "from netdesign.core.sources import digest_sources; print(digest_sources())"


@pytest.fixture
def checkout(tmp_path):
    """A copy of the package whose library is that of another text."""
    skip = shutil.ignore_patterns("__pycache__", "_core.*")
    shutil.copytree(ROOT / "netdesign", tmp_path / "netdesign", ignore=skip)
    for folder in ("standards", "templates"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    (tmp_path / "pyproject.toml").touch()
    library = tmp_path / "netdesign" / "core" / "_core.so"
    library.write_bytes(b"of another text")
    return tmp_path


def start(checkout, *arguments, **environment):
    names = {sources.SWITCH: "", "PYTHONPATH": str(checkout), **environment}
    return subprocess.Popen(
        [sys.executable, *arguments],
        cwd=checkout,
        env=os.environ | names,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        encoding="utf-8",
    )


def run(checkout, *arguments, **environment):
    """Standard output and standard error."""
    return start(checkout, *arguments, **environment).communicate()


def list_core(checkout):
    return {path.name for path in (checkout / "netdesign/core").glob("_core.*")}


@needs_compiler
def test_it_is_compiled_again_by_two_processes_at_once(checkout, monkeypatch):
    monkeypatch.setenv(sources.SWITCH, "")  # or no compiler is looked for
    quick = checkout / "cc"
    quick.write_text(f'#!/bin/sh\nexec "{sources.find_compiler()}" "$@" -O0\n')
    quick.chmod(0o755)
    both = [start(checkout, "-c", NAME, CC=str(quick)) for _ in range(2)]
    digest = run(checkout, "-c", DIGEST)[0]
    assert [one.communicate() for one in both] == [(f"C {digest}", "")] * 2
    assert list_core(checkout) == {"_core.so"}
    made = (checkout / "netdesign/core/_core.so").stat().st_mtime_ns
    assert run(checkout, "-c", NAME) == (f"C {digest}", "")
    assert (checkout / "netdesign/core/_core.so").stat().st_mtime_ns == made


def test_without_a_compiler_every_run_says_so_in_one_line(checkout):
    for _ in range(2):
        out, error = run(checkout, "-c", NAME, PATH="", CC="")
        assert out == "numpy\n"
        assert error.startswith("netdesign computes in NumPy")
        assert error.endswith(" (no C compiler found)\n")
        assert error.count("\n") == 1


@needs_compiler
def test_text_that_does_not_compile_is_told_and_nothing_is_left(checkout):
    (checkout / "netdesign/core/core.h").write_text("#error no such thing\n")
    out, error = run(checkout, "-c", NAME)
    assert out == "numpy\n"
    assert "no such thing" in error
    assert error.count("\n") == 1
    assert list_core(checkout) == {"_core.so"}


@pytest.mark.parametrize("is_switched_off", [True, False])
def test_nothing_is_said_or_made_where_it_is_not_asked_for(checkout, is_switched_off):
    if not is_switched_off:
        (checkout / "pyproject.toml").unlink()  # as installed
    switch = {sources.SWITCH: sources.SWITCHED_OFF if is_switched_off else ""}
    assert run(checkout, "-c", NAME, **switch) == ("numpy\n", "")
    library = checkout / "netdesign/core/_core.so"
    assert library.read_bytes() == b"of another text"
