"""Every public name says what it is; numbers of the physics say their unit."""

import ast
import doctest
import inspect
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

import netdesign

PACKAGE = Path(netdesign.__file__).parent
ROOT = PACKAGE.parent
PHYSICS = (
    *("numerics", "snow", "cable", "structure", "coupling", "checks"),
    *("resistance", "guideline"),
)

# A number says its unit in brackets, its shape if it is an array, or that it has
# the unit of, or is taken relative to, something that it names.
STATED = re.compile(r"\[[^\]]+\]|\bshape\b|\bunit\b|\bover\b|dimensionless", re.I)
# Entries about a quantity of any kind.
ANY_QUANTITY = {("judge", "low, high")}

Documented = ast.Module | ast.ClassDef | ast.FunctionDef


def read(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


MODULES = {
    path.relative_to(PACKAGE).as_posix(): read(path)
    for path in sorted(PACKAGE.rglob("*.py"))
}


def public(node: Documented, name: str = "") -> Iterator[tuple[str, Documented]]:
    """Module, its public functions and classes, and their public methods."""
    yield name or "module", node
    for child in node.body if not isinstance(node, ast.FunctionDef) else ():
        is_named = isinstance(child, ast.ClassDef | ast.FunctionDef)
        if is_named and not child.name.startswith("_"):
            yield from public(child, f"{name}.{child.name}".lstrip("."))


def sections(docstring: str) -> dict[str, list[str]]:
    """Lines below each underlined heading."""
    found: dict[str, list[str]] = {}
    lines = inspect.cleandoc(docstring).splitlines()
    heading = ""
    for line, following in zip(lines, [*lines[1:], ""], strict=True):
        if line and re.fullmatch("-{3,}", following):
            heading = line
            found[heading] = []
        elif heading and not re.fullmatch("-{3,}", line):
            found[heading].append(line)
    return found


def entries(lines: list[str]) -> list[tuple[str, str, str]]:
    """Name, kind and description of each entry of a section."""
    found: list[list[str]] = []
    for line in lines:
        if line and not line.startswith(" "):
            name, _, kind = line.partition(" : ")
            found.append([name, kind, ""])
        elif found:
            found[-1][2] += f" {line.strip()}"
    return [(name, kind, text) for name, kind, text in found]


def unstated(function: str, docstring: str) -> list[str]:
    """Numbers among the parameters that say neither unit nor shape."""
    return [
        f"{function}({name})"
        for name, kind, text in entries(sections(docstring).get("Parameters", []))
        if re.search(r"\b(float|ndarray)\b", kind)
        and not STATED.search(f"{kind} {text}")
        and (function.split(".")[-1], name) not in ANY_QUANTITY
    ]


@pytest.mark.parametrize("module", MODULES)
def test_every_public_name_has_a_docstring(module):
    missing = [
        name for name, node in public(MODULES[module]) if not ast.get_docstring(node)
    ]
    assert missing == []


@pytest.mark.parametrize(
    "module", [name for name in MODULES if name.startswith(PHYSICS)]
)
def test_parameters_of_the_physics_state_their_unit(module):
    found = [
        fault
        for name, node in public(MODULES[module])
        if isinstance(node, ast.FunctionDef)
        for fault in unstated(name, ast.get_docstring(node) or "")
    ]
    assert found == []


@pytest.mark.parametrize(
    "module", [name for name in MODULES if name.startswith(PHYSICS)]
)
def test_documented_parameters_are_those_of_the_function(module):
    for name, node in public(MODULES[module]):
        documented = sections(ast.get_docstring(node) or "").get("Parameters")
        if documented and isinstance(node, ast.FunctionDef):
            names = [one for entry in entries(documented) for one in split(entry[0])]
            arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
            assert sorted(names) == sorted(
                argument.arg
                for argument in arguments
                if argument.arg not in ("self", "cls")
            ), name


def test_tests_named_in_docstrings_exist():
    named = {
        (module, line.removeprefix("tests/"))
        for module, tree in MODULES.items()
        for _, node in public(tree)
        for line in re.findall(
            r"[\w/]+\.py",
            " ".join(sections(ast.get_docstring(node) or "").get("Verified by", [])),
        )
    }
    missing = {one for one in named if not (ROOT / "tests" / one[1]).is_file()}
    assert named
    assert missing == set()


def split(names: str) -> list[str]:
    return [name.strip() for name in names.split(",")]


def test_the_physics_documents_its_parameters():
    """Otherwise the tests above would pass on nothing."""
    documented = [
        name
        for module, tree in MODULES.items()
        if module.startswith(PHYSICS)
        for name, node in public(tree)
        if "Parameters" in sections(ast.get_docstring(node) or "")
    ]
    assert len(documented) >= 10


EXAMPLE = """Find something.

Parameters
----------
angle : float
    Of the slope [rad].
bare : float
    Of the slope, which
    is steep.
places : ndarray, shape (2, n)
    Where.
tolerance : float
    Gap over the length.
kind : str
    Its name.

Returns
-------
float
    Nothing here counts.
"""


def test_a_missing_unit_is_found():
    assert unstated("find", EXAMPLE) == ["find(bare)"]
    assert unstated("judge", "x\n\nParameters\n-----\nlow, high : float\n    x") == []


def test_a_missing_docstring_is_found():
    source = '"""M."""\ndef f():\n    pass\nclass A:\n    "A."\n    def g(self): pass\n'
    found = {name: ast.get_docstring(node) for name, node in public(ast.parse(source))}
    assert found == {"module": "M.", "f": None, "A": "A.", "A.g": None}


def test_examples_of_the_package_are_collected_as_tests():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    options = project["tool"]["pytest"]["ini_options"]
    assert "--doctest-modules" in options["addopts"].split()
    assert "netdesign" in options["testpaths"]
    parser = doctest.DocTestParser()
    examples = [
        example
        for tree in MODULES.values()
        for _, node in public(tree)
        for example in parser.get_examples(ast.get_docstring(node) or "")
    ]
    assert any(example.want for example in examples)
