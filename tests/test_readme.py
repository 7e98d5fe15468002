"""The README's blocks are run, and what they print is compared."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
NETDESIGN = Path(sys.executable).with_name("netdesign")

# Exit codes of the commands as printed, run one after the other in one folder. The
# workbook that `init` writes has nothing filled in, so checking it is refused.
EXPECTED_EXIT_CODES = {"init": 0, "check": 3, "standards": 0}


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.DOTALL)


def run(command: str, folder: Path) -> subprocess.CompletedProcess[str]:
    environment = {
        **os.environ,
        "PATH": f"{NETDESIGN.parent}{os.pathsep}{os.environ['PATH']}",
        "COLUMNS": "110",
    }
    return subprocess.run(
        command,
        shell=True,
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )


def test_first_screen_holds_both_set_up_commands():
    first_screen = "\n".join(README.splitlines()[:40])
    commands = [line for line in first_screen.splitlines() if "venv" in line]
    assert len(commands) == 2
    assert commands[0].endswith("&& netdesign check --example")
    assert commands[1].endswith("&& python -m pytest -n 2")
    # CI runs these two lines as printed
    assert "grep '^python3 -m venv' README.md" in (ROOT / ".ci/run").read_text()


def test_example_prints_the_table_shown(tmp_path):
    shown = blocks("text")[0].splitlines()
    result = run("netdesign check --example --quiet", tmp_path)
    assert result.returncode == 1, result.stderr
    printed = [line.rstrip() for line in result.stdout.splitlines()]
    assert printed[: len(shown)] == shown
    outputs = {path.name for path in (tmp_path / "netdesign-out").iterdir()}
    assert outputs == {"study.json", "report.html", "report.xlsx"}


def test_commands_run_as_printed(tmp_path):
    lines = blocks("console")[1].splitlines()
    assert len(lines) == len(EXPECTED_EXIT_CODES)
    for line in lines:
        result = run(line, tmp_path)
        assert result.returncode == EXPECTED_EXIT_CODES[line.split()[1]], result.stderr


def test_scene_file_is_solved(tmp_path):
    (tmp_path / "scene.toml").write_text(blocks("toml")[0], encoding="utf-8")
    result = run("netdesign solve scene.toml", tmp_path)
    assert result.returncode == 0, result.stderr
    assert "balance residual" in result.stdout


def test_python_block_prints_what_is_shown(capsys):
    exec(compile(blocks("python")[0], "README.md", "exec"), {})
    assert capsys.readouterr().out == blocks("text")[1]


@pytest.mark.parametrize("link", re.findall(r"\]\(([^)h][^)]*)\)", README))
def test_links_lead_somewhere(link):
    assert (ROOT / link).exists()
