"""The name of the solver: another one for other code, the same for other comments."""

import ast
import io
import shutil
import tokenize
from pathlib import Path

import pytest

from netdesign.solving import store
from netdesign.solving.store import identify_solver, take_code
from tests.each import each

PACKAGE = Path(store.__file__).parents[1]
FILES = list(store._list_files(store._SOLVER_PARTS, PACKAGE))
MODULES = [path for path in FILES if path.suffix == ".py"]
KEPT = (tokenize.NAME, tokenize.NUMBER, tokenize.STRING, tokenize.OP)


# Of the package outside: they word, carry or keep what was found, and decide no number.
DECIDE_NOTHING = ("edge", "errors", "fault", "words", "report")


@pytest.fixture
def package(tmp_path):
    """A copy of the solver's text; names of it are found anew."""
    for path in FILES:
        place = tmp_path / path.relative_to(PACKAGE)
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, place)
    return tmp_path


def rename(package, place, old, new):
    """Name of the solver with another text at one place."""
    path = package / place
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    store._identify.cache_clear()
    return identify_solver(package)


def list_tokens(text):
    """Tokens that compute, with their places."""
    lines = io.StringIO(text).readline
    return [one for one in tokenize.generate_tokens(lines) if one.type in KEPT]


def find_docstrings(text):
    """Places of the docstrings, as Python sees them."""
    owners = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, owners) and ast.get_docstring(node) is not None:
            yield node.body[0].lineno, node.body[0].col_offset


@each("path", MODULES)
def test_of_every_module_all_stays_but_docstrings_and_comments(path):
    text = path.read_text(encoding="utf-8")
    documented = set(find_docstrings(text))
    before = [one.string for one in list_tokens(text) if one.start not in documented]
    code = take_code(text)
    assert [one.string for one in list_tokens(code)] == before
    kinds = {one.type for one in tokenize.generate_tokens(io.StringIO(code).readline)}
    assert tokenize.COMMENT not in kinds
    assert "\n\n" not in code


REMARKS = [
    ("numerics/optimise.py", '"""', '"""Another word. '),
    ("numerics/optimise.py", '    """', '    """Another word. '),
    ("numerics/optimise.py", "\n", "\n\n# a remark, with 3.7 and \"signs'\n"),
    ("numerics/optimise.py", ":\n", ":  # a remark\n"),
    ("snow/glide_factors.toml", "\n", "\n# a remark\n\n"),
]
CHANGES = [
    ("snow/compiled.py", "LEAF = 6", "LEAF = 7"),
    ("snow/glide_factors.toml", "[", "[ 0.1,"),
    ("numerics/optimise.py", "return ", "return -"),
    ("units.py", "1e3", "1e4"),
]


@pytest.mark.parametrize("change", [*REMARKS, *CHANGES])
def test_a_change_is_another_solver_but_of_docstrings_and_comments(package, change):
    assert (rename(package, *change) == identify_solver()) is (change in REMARKS)


def test_another_core_is_another_solver(monkeypatch):
    before = identify_solver()
    monkeypatch.setattr(store, "name_core", lambda: "C of another text")
    assert identify_solver() != before


def test_whatever_the_solver_imports_is_in_its_name_or_decides_nothing():
    named = {path.relative_to(PACKAGE).with_suffix("").as_posix() for path in FILES}
    outside = set()
    for path in MODULES:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        froms = [one for one in ast.walk(tree) if isinstance(one, ast.ImportFrom)]
        modules = {one.module for one in froms if one.module.startswith("netdesign.")}
        outside |= {one.removeprefix("netdesign.") for one in modules}
    outside = {one for one in outside if not one.startswith(DECIDE_NOTHING)}
    assert len(outside) > 40
    files = {one.replace(".", "/") for one in outside}
    assert {one for one in files if not {one, f"{one}/__init__"} & named} == set()
