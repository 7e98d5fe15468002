"""The core works without the folder of the add-ons, and says what is missing."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from netdesign.addon_table import COMMANDS
from tests.small_scene import ROUGH_SCENE
from tests.sources import PACKAGE


@pytest.fixture(scope="module")
def core(tmp_path_factory):
    """Folder with the package, without its add-ons."""
    folder = tmp_path_factory.mktemp("core")
    left_out = shutil.ignore_patterns("addons", "__pycache__")
    shutil.copytree(PACKAGE, folder / "netdesign", ignore=left_out)
    for name in ("standards", "templates"):
        shutil.copytree(PACKAGE.parent / name, folder / "netdesign" / "_data" / name)
    (folder / "scene.toml").write_text(ROUGH_SCENE, encoding="utf-8")
    return folder


def run(core: Path, *words: str, code: int = 0) -> subprocess.CompletedProcess[str]:
    """A run of Python in the folder, with the core that stands there."""
    ended = subprocess.run(
        [sys.executable, *words],
        cwd=core,
        env={**os.environ, "PYTHONPATH": str(core)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == code, ended.stderr + ended.stdout
    return ended


def call(core: Path, *words: str, code: int = 0) -> subprocess.CompletedProcess[str]:
    return run(core, "-m", "netdesign", *words, code=code)


def test_the_core_stands_alone(core):
    told = run(core, "-c", "import netdesign; print(netdesign.__file__)").stdout
    assert Path(told.strip()).parent == core / "netdesign"
    assert not (core / "netdesign" / "addons").exists()


def test_help_shows_the_commands_of_the_core_alone(core):
    shown = call(core, "--help").stdout
    assert "\n  check " in shown
    assert [name for name in COMMANDS if f"\n  {name} " in shown] == []


@pytest.mark.long
def test_a_site_is_checked_and_a_scene_solved(core):
    call(core, "init", "site.xlsx", "--example")
    some = ("--row", "A1", "--row", "B4")  # one that passes, one that fails
    call(core, "check", "--example", *some, "--out", "out", "--docx", code=1)
    made = {path.suffix for path in (core / "out").iterdir()}
    assert {".html", ".xlsx", ".docx", ".json"} <= made
    call(core, "report", "out/part-study.json", "--out", "again", code=1)
    assert "balance" in call(core, "solve", "scene.toml").stdout


IN_TURN = """
import json, sys
from netdesign.cli import main
for words in json.loads(sys.argv[1]):
    sys.argv = ["netdesign", *words.split()]
    try:
        main()
    except SystemExit as end:
        print(end.code, file=sys.stderr)
"""


def test_a_missing_add_on_is_one_sentence(core):
    commands = {
        "winter site.xlsx --out x": "winter",
        "verify": "evidence",
        "terrain --example": "terrain",
        "solve scene.toml --method transient": "history",
        "check --example --out r --reliability --no-cache": "reliability",
    }
    told = run(core, "-c", IN_TURN, json.dumps([*commands])).stderr.splitlines()
    assert told[1::2] == ["2"] * len(commands)
    for sentence, name in zip(told[::2], commands.values(), strict=True):
        assert f"needs the add-on {name}, which is not installed" in sentence


@pytest.mark.long
def test_tests_of_the_core_pass_alone(core):
    """Physics and checks: none of their tests needs an add-on."""
    shutil.copytree(PACKAGE.parent / "tests", core / "tests")
    shutil.copy(PACKAGE.parent / "pyproject.toml", core / "pyproject.toml")
    rooms = ("calculation", "checks", "resistance", "structure", "snow", "guideline")
    told = run(core, "-m", "pytest", "-q", "-x", *(f"tests/{room}" for room in rooms))
    assert "[100%]" in told.stdout
