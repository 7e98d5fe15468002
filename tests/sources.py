"""Modules of the package as syntax trees, parsed once for all tests that read them."""

import ast
from functools import cache
from pathlib import Path

import netdesign

PACKAGE = Path(netdesign.__file__).parent


@cache
def parse_package() -> dict[str, ast.Module]:
    """Trees by the path of their module inside the package."""
    return {
        path.relative_to(PACKAGE).as_posix(): ast.parse(path.read_text("utf-8"))
        for path in sorted(PACKAGE.rglob("*.py"))
    }


def walk_package():
    """Every node of every module, with the path of its module."""
    for name, tree in parse_package().items():
        for node in ast.walk(tree):
            yield name, node


@cache
def list_calls():
    """Every call of the package, with the path of its module and its name."""
    return [
        (module, node, getattr(node.func, "id", getattr(node.func, "attr", "")))
        for module, node in walk_package()
        if isinstance(node, ast.Call)
    ]
