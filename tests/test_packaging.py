"""A wheel of this checkout, installed in a new environment, works elsewhere."""

import importlib.util
import os
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import venv
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
VERSION_LINE = "version = "

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("hatchling") is None, reason="hatchling is not installed"
)


def call(*command, cwd):
    """Standard output of a command that has to succeed."""
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    result = subprocess.run(
        [str(part) for part in command],
        cwd=cwd,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def pip(*arguments, cwd):
    quiet = ("--disable-pip-version-check", "--quiet")
    return call(sys.executable, "-m", "pip", *quiet, *arguments, cwd=cwd)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    offline = ("--no-deps", "--no-build-isolation", "--no-index")
    pip("wheel", *offline, "--wheel-dir", folder, ROOT, cwd=folder)
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def names(wheel):
    with zipfile.ZipFile(wheel) as archive:
        return set(archive.namelist())


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    """Folder of the programs of a new environment that has the wheel."""
    home = tmp_path_factory.mktemp("environment") / "venv"
    venv.create(home, system_site_packages=True, with_pip=False)
    programs = home / ("Scripts" if sys.platform == "win32" else "bin")
    python = programs / Path(sys.executable).name
    # Of the environment that runs the tests, the new one shall see what the wheel
    # needs. A path file does not start the path files there: an editable install of
    # this project stays out of sight.
    own = Path(call(python, "-c", WHERE, cwd=home).strip())
    theirs = sysconfig.get_path("purelib")
    (own / "dependencies.pth").write_text(f"{theirs}\n", encoding="utf-8")
    pip("--python", python, "install", "--no-deps", "--no-index", wheel, cwd=home)
    return programs


WHERE = "import sysconfig; print(sysconfig.get_path('purelib'))"


def files_below(folder):
    return {
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def test_wheel_holds_every_module(names):
    modules = {
        f"netdesign/{name}"
        for name in files_below(ROOT / "netdesign")
        if name.endswith(".py")
    }
    assert len(modules) > 50
    assert modules <= names


def test_wheel_says_that_it_has_types(names):
    assert "netdesign/py.typed" in names


def test_wheel_holds_the_licence(wheel):
    with zipfile.ZipFile(wheel) as archive:
        (licence,) = (n for n in archive.namelist() if n.endswith("/LICENSE"))
        assert archive.read(licence) == (ROOT / "LICENSE").read_bytes()
        (metadata,) = (n for n in archive.namelist() if n.endswith("/METADATA"))
        stated = archive.read(metadata).decode("utf-8").splitlines()
    assert {"License-Expression: MIT", "License-File: LICENSE"} <= set(stated)


@pytest.mark.parametrize("folder", ["standards", "templates"])
def test_wheel_holds_the_files_that_the_program_reads(names, folder):
    files = {f"netdesign/_data/{folder}/{f}" for f in files_below(ROOT / folder)}
    assert files
    assert files == {n for n in names if n.startswith(f"netdesign/_data/{folder}/")}


def test_wheel_holds_nothing_else(names):
    tops = {name.split("/")[0] for name in names}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"netdesign"}
    files = [Path(one).name for one in names]
    assert not [one for one in files if one.startswith(("test_", "conftest"))]


def test_wheel_holds_the_compiled_core_where_there_is_a_compiler(wheel, names):
    has_compiler = any(map(shutil.which, ("cc", "gcc", "clang")))
    is_built = has_compiler and os.environ.get("NETDESIGN_CORE") != "numpy"
    assert ("netdesign/core/_core.so" in names) == is_built
    assert wheel.name.endswith("py3-none-any.whl") == (not is_built)


def test_source_archive_holds_what_a_wheel_is_built_from(tmp_path):
    build = ("-m", "hatchling", "build", "--target", "sdist", "--directory", tmp_path)
    call(sys.executable, *build, cwd=ROOT)
    (archive,) = tmp_path.glob("*.tar.gz")
    with tarfile.open(archive) as source:
        paths = {name.partition("/")[2] for name in source.getnames()}
    assert {"LICENSE", "README.md", "pyproject.toml", "netdesign/py.typed"} <= paths
    core = {"build.py", "sources.py", "step.c", "core.h"}
    assert {f"netdesign/core/{name}" for name in core} <= paths
    assert not [path for path in paths if path.endswith(".so")]
    assert {f"standards/{name}" for name in files_below(ROOT / "standards")} <= paths


@pytest.mark.long
def test_installed_program_runs_from_anywhere(installed, tmp_path):
    place = call(
        *(installed / "python", "-c", "import netdesign; print(netdesign.__file__)"),
        cwd=tmp_path,
    )
    assert Path(place.strip()).is_relative_to(installed.parent)
    profiles = call(installed / "netdesign", "standards", "list", cwd=tmp_path)
    assert [line.split()[0] for line in profiles.splitlines()] == [
        "eurocode",
        "nf-p-95-304-style",
        "onr-24805-style",
        "swiss-guideline-2007",
    ]
    version = call(installed / "netdesign", "--version", cwd=tmp_path)
    (stated,) = (
        line.removeprefix(VERSION_LINE).strip('"')
        for line in (ROOT / "pyproject.toml").read_text(encoding="utf-8").splitlines()
        if line.startswith(VERSION_LINE)
    )
    assert stated in version
