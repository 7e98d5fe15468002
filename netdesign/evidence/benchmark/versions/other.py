"""The Python of another version: that of a venv, or of one made for a wheel."""

from __future__ import annotations

import subprocess
import sysconfig
import venv
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from netdesign.errors import ModelError
from netdesign.words.message import say

_PYTHONS = ("bin/python", "Scripts/python.exe")
_ASK = "from importlib.metadata import version; print(version('netdesign'))"
_LONGEST_S = 300.0


@contextmanager
def open_version(path: Path) -> Iterator[Path]:
    """Python that runs the version of a wheel, a venv, or a venv's Python.

    A wheel is installed in a venv of its own, without its dependencies: they are those
    of this version, so that the programs are compared and not their libraries.

    Raises
    ------
    ModelError
        If the path is none of these, or the wheel cannot be installed.
    """
    if path.suffix == ".whl" and path.is_file():
        with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            yield _install(path, Path(folder))
        return
    found = [path, *(path / name for name in _PYTHONS)]
    python = next((one for one in found if one.is_file()), None)
    if python is None:
        raise ModelError(say("against.no_version", path=str(path)))
    yield python.absolute()  # not resolved: a venv is known by its link


def read_version(python: Path) -> str:
    """Version of the program that a Python runs.

    Raises
    ------
    ModelError
        If it runs none.
    """
    try:
        told = subprocess.run(
            [python, "-I", "-c", _ASK],
            capture_output=True,
            text=True,
            check=True,
            timeout=_LONGEST_S,
        )
    except (OSError, subprocess.SubprocessError):
        raise ModelError(say("against.no_program", path=str(python))) from None
    return told.stdout.strip()


def _install(wheel: Path, folder: Path) -> Path:
    venv.create(folder, with_pip=True)
    python = next(folder / name for name in _PYTHONS if (folder / name).is_file())
    places = dict.fromkeys(sysconfig.get_path(name) for name in ("purelib", "platlib"))
    site = subprocess.run(
        [python, "-I", "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.strip()
    (Path(site) / "libraries.pth").write_text("\n".join(places), encoding="utf-8")
    install = ["-I", "-m", "pip", "install", "--no-deps", "--no-index", "--quiet"]
    words = [str(python), *install, str(wheel.resolve())]
    if subprocess.run(words, capture_output=True, check=False).returncode:
        raise ModelError(say("against.not_installed", path=str(wheel)))
    return python
