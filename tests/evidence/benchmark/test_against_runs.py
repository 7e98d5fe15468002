"""What is timed of a version, run with this one: a scene, a row, a refused command."""

import sys
import zipfile
from pathlib import Path

import pytest

from netdesign import __version__
from netdesign.evidence.benchmark.against import (
    Figure,
    Size,
    list_figures,
    open_version,
    read_version,
    time_figure,
)
from netdesign.evidence.benchmark.scenes import (
    NAMED,
    NAMES,
    load_scenes,
    write_site,
)
from netdesign.files.scene import read_scene
from netdesign.outcome import ModelError
from netdesign.site.reader import read_site

THIS = Path(sys.executable)
SMALL = Size(repeats=1, scenes=("flat-light",), samples=2, rows=9)


@pytest.mark.parametrize("name", ["scenes", "grid"])
def test_a_figure_is_timed_in_a_process_of_the_version(tmp_path, name):
    figure = list_figures(SMALL, tmp_path)[name]
    found = time_figure(THIS, figure, tmp_path)
    assert 0.0 < found["cpu_s"] < 60.0
    assert found["wall_s"] > 0.0
    if name == "scenes":  # warm: the same commands with the program's start take longer
        cold = time_figure(THIS, Figure(figure.timed), tmp_path)
        assert found["cpu_s"] < cold["cpu_s"]


def test_what_a_version_cannot_do_is_told_with_its_exit_code(tmp_path):
    spoilt = tmp_path / "spoilt.toml"
    spoilt.write_text("[slope]\n")
    told = time_figure(THIS, Figure([["solve", str(spoilt)]]), tmp_path)
    assert "spoilt.toml" in told
    assert told.endswith("(3)")
    script = tmp_path / "python"
    script.write_text("#!/bin/sh\necho its own words >&2\nexit 7\n")
    script.chmod(0o755)
    assert time_figure(script, Figure([[]]), tmp_path) == "its own words (7)"


def test_every_named_scene_is_a_scene_file():
    for name, scene in load_scenes().items():
        assert read_scene(NAMED / f"{name}.toml")[0] == scene
    assert len(NAMES) == 16


def test_the_site_is_read(tmp_path):
    write_site(tmp_path / "site", 9)
    site = read_site(tmp_path / "site")
    assert [row.id for row in site.rows][-3:] == ["R7.1", "R1.2", "R2.2"]
    first, again = (row for row in site.rows if row.id in ("R1.1", "R1.2"))
    assert again.snow_thickness == pytest.approx(0.97 * first.snow_thickness)


def test_rows_of_the_site_are_all_different(tmp_path):
    write_site(tmp_path / "site", 20)
    rows = read_site(tmp_path / "site").rows
    assert len({(row.snow_thickness, row.upslope_length) for row in rows}) == 20


def test_python_of_a_venv():
    with open_version(THIS) as python:
        assert read_version(python) == __version__
    with open_version(THIS.parent.parent) as python:
        assert python == THIS


@pytest.mark.parametrize("name", ["no-such", "empty"])
def test_what_is_no_version_is_refused(tmp_path, name):
    (tmp_path / "empty").mkdir()
    with pytest.raises(ModelError, match="accepted is"), open_version(tmp_path / name):
        pass


def test_a_python_without_the_program_is_refused(tmp_path):
    script = tmp_path / "python"
    script.write_text("#!/bin/sh\nexit 1\n")
    script.chmod(0o755)
    with pytest.raises(ModelError, match="runs no netdesign"):
        read_version(script)


@pytest.mark.slow
def test_a_wheel_is_installed_beside_the_libraries_of_this_version(tmp_path):
    """``pytest -m slow -k wheel_is_installed``: makes a venv, 5 s."""
    wheel = tmp_path / "netdesign-9.9-py3-none-any.whl"
    folder = "netdesign-9.9.dist-info"
    texts = {
        "netdesign/__init__.py": "import numpy\n",
        f"{folder}/METADATA": "Metadata-Version: 2.1\nName: netdesign\nVersion: 9.9\n",
        f"{folder}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\n"
        "Tag: py3-none-any\n",
        f"{folder}/RECORD": "",
    }
    with zipfile.ZipFile(wheel, "w") as file:
        for name, text in texts.items():
            file.writestr(name, text)
    with open_version(wheel) as python:
        assert read_version(python) == "9.9"
