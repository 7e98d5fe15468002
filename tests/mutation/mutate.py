"""Mutation testing: spoils one sign at a time and looks whether a test notices.

``python tests/mutation/mutate.py`` spoils every module of `TARGETS`, each in a copy
of the package and of the tests; ``--only units`` one of them. Mutated are comparisons,
``and`` and ``or``, ``not``, the signs of arithmetic, ``min`` and ``max``, truth values
and numbers. Survivors are printed with their line; those of `EXPLAINED` change
nothing that a caller could see, and are counted apart.
"""

from __future__ import annotations

import argparse
import ast
import copy
import os
import shutil
import signal
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy  # noqa: F401  (imported before the forks)
import pydantic  # noqa: F401
import pytest
import scipy.sparse.linalg
import scipy.spatial  # noqa: F401
import skfem  # noqa: F401

ROOT = Path(__file__).resolve().parents[2]
SECONDS = 60

# Module and the tests that have to notice; all of them run without a solver.
TARGETS = {
    "outcome": ("tests/test_outcome.py",),
    "units": ("tests/test_units.py",),
    "structure/head": (
        "tests/structure/test_head.py",
        "tests/structure/test_force_polygon.py",
    ),
    "envelope/extremes": ("tests/envelope/test_extremes.py",),
    "checks/check": ("tests/checks/test_check.py", "tests/checks/test_verdicts.py"),
    "checks/result": ("tests/checks/test_check.py", "tests/checks/test_verdicts.py"),
    "checks/geometry": ("tests/checks/test_check.py", "tests/checks/test_geometry.py"),
    "checks/loader": ("tests/checks/test_loader.py", "tests/checks/test_profiles.py"),
    "checks/schema": ("tests/checks/test_schema.py", "tests/checks/test_profiles.py"),
}

# Equivalent to the original: module, text of the mutant's line, why.
EXPLAINED: dict[tuple[str, str], str] = {}

_COMPARISONS = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}
_ARITHMETIC = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Pow: ast.Mult,
}
_NAMES = {"min": "max", "max": "min", "any": "all", "all": "any"}


def list_mutants(tree: ast.Module) -> Iterator[tuple[int, ast.Module]]:
    """Line and tree of every mutant; each differs from the tree in one place."""
    for index, node in enumerate(ast.walk(tree)):
        for variant in range(_count_variants(node)):
            mutant = copy.deepcopy(tree)
            place = next(n for k, n in enumerate(ast.walk(mutant)) if k == index)
            _spoil(place, variant)
            yield getattr(node, "lineno", 0), mutant


def _count_variants(node: ast.AST) -> int:
    if isinstance(node, ast.Compare):
        return sum(len(_COMPARISONS[type(sign)]) for sign in node.ops)
    if isinstance(node, ast.BinOp):
        return int(type(node.op) in _ARITHMETIC)
    if isinstance(node, ast.BoolOp):
        return 1
    if isinstance(node, ast.UnaryOp):
        return int(isinstance(node.op, ast.USub | ast.Not))
    if isinstance(node, ast.Call):
        return int(isinstance(node.func, ast.Name) and node.func.id in _NAMES)
    return int(isinstance(node, ast.Constant) and _is_number(node.value))


def _is_number(value: object) -> bool:
    return isinstance(value, bool | int | float)


def _spoil(node: ast.AST, variant: int) -> None:
    if isinstance(node, ast.Compare):
        pairs = [
            (place, other)
            for place, sign in enumerate(node.ops)
            for other in _COMPARISONS[type(sign)]
        ]
        place, other = pairs[variant]
        node.ops[place] = other()
    elif isinstance(node, ast.BinOp):
        node.op = _ARITHMETIC[type(node.op)]()
    elif isinstance(node, ast.BoolOp):
        node.op = ast.Or() if isinstance(node.op, ast.And) else ast.And()
    elif isinstance(node, ast.UnaryOp):
        node.op = ast.UAdd() if isinstance(node.op, ast.USub) else ast.Not()
        if isinstance(node.op, ast.Not):
            node.operand = ast.UnaryOp(ast.Not(), node.operand)
    elif isinstance(node, ast.Call):
        assert isinstance(node.func, ast.Name)
        node.func.id = _NAMES[node.func.id]
    elif isinstance(node, ast.Constant):
        node.value = not node.value if isinstance(node.value, bool) else node.value + 1


def survives(folder: Path, module: str, source: str, tests: tuple[str, ...]) -> bool:
    """Whether the tests pass with that source in the place of the module's.

    In a fork, so that the slow imports of other packages are done once.
    """
    (folder / "netdesign" / f"{module}.py").write_text(source, encoding="utf-8")
    child = os.fork()
    if child == 0:
        signal.alarm(SECONDS)  # a mutant that hangs is killed too
        silence = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silence, 1)
        os.dup2(silence, 2)
        os.chdir(folder)
        sys.path.insert(0, str(folder))
        os._exit(int(pytest.main(["-q", "-x", "-p", "no:cacheprovider", *tests])))
    _, status = os.waitpid(child, 0)
    return status == 0


def try_module(folder: Path, module: str) -> tuple[int, int, list[str]]:
    """Counts of killed and of explained mutants, and what survived otherwise."""
    path = folder / "netdesign" / f"{module}.py"
    original = path.read_text(encoding="utf-8")
    tests = tuple(name for name in TARGETS[module] if (folder / name).exists())
    if not survives(folder, module, original, tests):
        raise SystemExit(f"{module}: its tests fail without any mutant")
    killed, explained, survivors = 0, 0, []
    for line, mutant in list_mutants(ast.parse(original)):
        if not survives(folder, module, ast.unparse(mutant), tests):
            killed += 1
            continue
        text = original.splitlines()[line - 1].strip()
        if (module, text) in EXPLAINED:
            explained += 1
        else:
            survivors.append(f"{module}.py:{line}: {text}")
    path.write_text(original, encoding="utf-8")
    return killed, explained, survivors


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", help="one module, such as units")
    only = parser.parse_args().only
    total = killed_in_all = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for part in ("netdesign", "tests", "standards", "templates"):
            shutil.copytree(ROOT / part, folder / part)
        shutil.copy(ROOT / "pyproject.toml", folder)
        for module in TARGETS:
            if only and only not in module:
                continue
            killed, explained, survivors = try_module(folder, module)
            count = killed + len(survivors)
            total, killed_in_all = total + count, killed_in_all + killed
            share = killed / max(count, 1)
            print(
                f"{module}: {killed} of {count} killed ({share:.0%}), "
                f"{explained} explained",
                flush=True,
            )
            for survivor in survivors:
                print(f"    survived: {survivor}", flush=True)
    print(
        f"all: {killed_in_all} of {total} killed ({killed_in_all / max(total, 1):.1%})"
    )


if __name__ == "__main__":
    main()
