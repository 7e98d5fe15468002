"""Help is there at once: nothing heavy is imported for it."""

import json
import subprocess
import sys

import pytest

HEAVY = (
    *("numpy", "scipy", "skfem", "pandas", "matplotlib", "openpyxl", "xlsxwriter"),
    *("jinja2", "pydantic", "rich"),
)

PROBE = """
import json, sys
from netdesign.cli import main
try:
    main()
finally:
    tops = sorted({name.split(".")[0] for name in sys.modules})
    print(json.dumps(tops), file=sys.stderr)
"""


def imported(*arguments, cwd):
    """Top-level packages that are loaded when the program ends."""
    result = subprocess.run(
        [sys.executable, "-c", PROBE, *arguments],
        cwd=cwd,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stderr
    return set(json.loads(result.stderr.splitlines()[-1]))


@pytest.mark.parametrize(
    "arguments",
    [
        ["--help"],
        ["--version"],
        ["check", "--help"],
        ["init", "--help"],
        ["solve", "--help"],
        ["report", "--help"],
        ["standards", "--help"],
        ["diff", "--help"],
        ["doctor", "--help"],
        ["completion", "bash"],
    ],
)
def test_help_imports_nothing_heavy(tmp_path, arguments):
    modules = imported(*arguments, cwd=tmp_path)
    assert "click" in modules
    assert not modules & set(HEAVY)


def test_the_probe_sees_what_is_imported(tmp_path):
    assert "pydantic" in imported("standards", "list", cwd=tmp_path)


def test_profiles_are_listed_without_a_solver(tmp_path):
    modules = imported("standards", "list", cwd=tmp_path)
    assert not modules & {"numpy", "scipy", "skfem", "pandas", "matplotlib"}


def test_the_module_is_the_program(tmp_path):
    result = subprocess.run(
        [sys.executable, "-m", "netdesign", "--version"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0
    assert result.stdout.startswith("netdesign")
