"""The library of the compiled core: built, known by its text, switched off, refused."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from netdesign.core import library, sources
from netdesign.snow.compiled import build_plan

ROOT = Path(library.__file__).resolve().parents[2]

needs_compiler = pytest.mark.skipif(
    not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler"
)
needs_core = pytest.mark.skipif(library.find_core() is None, reason="no compiled core")


@pytest.mark.parametrize("word", ["numpy", "NumPy", " NUMPY "])
def test_switched_off(word, monkeypatch):
    monkeypatch.setenv(sources.SWITCH, word)
    assert library.find_core() is None
    assert library.name_core() == "numpy"


def test_the_digest_has_the_flags(monkeypatch):
    """A library that may fuse multiplications is another one."""
    before = sources.digest_sources()
    sources.digest_sources.cache_clear()
    flags = tuple(flag for flag in sources.FLAGS if "contract" not in flag)
    assert len(flags) < len(sources.FLAGS)
    monkeypatch.setattr(sources, "FLAGS", flags)
    assert sources.digest_sources() != before
    sources.digest_sources.cache_clear()


def test_a_comment_makes_no_other_digest_and_a_constant_does(tmp_path, monkeypatch):
    for path in sources.ROOM.glob("*.[ch]"):
        shutil.copy(path, tmp_path)
    before = sources.digest_sources()
    monkeypatch.setattr(sources, "ROOM", tmp_path)
    path, made = tmp_path / "step.c", []
    text = path.read_text(encoding="utf-8")
    for added in ("/* a remark */\n", "static const int SEVEN = 7;\n"):
        path.write_text(text + added, encoding="utf-8")
        sources.digest_sources.cache_clear()
        made.append(sources.digest_sources())
    sources.digest_sources.cache_clear()
    assert made[0] == before
    assert made[1] != before


@pytest.mark.parametrize("content", [None, b"", b"not a library"])
def test_a_file_that_is_no_library_is_not_taken(tmp_path, content):
    path = tmp_path / "_core.so"
    if content is not None:
        path.write_bytes(content)
    assert library._load(path) is None


@needs_compiler
def test_every_c_file_is_compiled():
    names = {path.name for path in sources.ROOM.glob("*.[ch]")}
    assert names == {*sources.SOURCES, *sources.HEADERS}


@needs_compiler
def test_no_compiler_where_it_is_switched_off_or_missing(monkeypatch):
    monkeypatch.delenv(sources.SWITCH, raising=False)
    assert sources.find_compiler()
    monkeypatch.setenv(sources.SWITCH, sources.SWITCHED_OFF)
    assert sources.find_compiler() is None
    monkeypatch.delenv(sources.SWITCH)
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("CC", raising=False)
    assert sources.find_compiler() is None


TRIANGLES = np.array([[0, 1, 2, 3, 4, 5]], dtype=np.int32)
NODES = np.array([[0.0, 1.0, 0.0, 0.5, 0.5, 0.0], [0.0, 0.0, 1.0, 0.0, 0.5, 0.5]])
NET = np.array([0, 5, 2], dtype=np.int32)


@needs_core
@pytest.mark.parametrize(
    ("triangles", "net"),
    [
        (TRIANGLES + 1, NET),  # a node that there is not
        (TRIANGLES - 1, NET),
        (TRIANGLES, NET + 4),
        (np.array([[0, 1, 2, 3, 4, 4]], dtype=np.int32), NET[:1]),  # 5 in no triangle
        (TRIANGLES, NET[:0]),
    ],
)
def test_numbers_out_of_range_are_refused(triangles, net):
    with pytest.raises(ValueError, match="compiled core refuses"):
        build_plan(library.find_core(), triangles, NODES, net)
