"""The theory pages against each other and against the code that cites them."""

import ast
import dataclasses
import importlib
import re
from functools import cache
from pathlib import Path
from typing import Any

import netdesign
from tests.each import each

PACKAGE = Path(netdesign.__file__).parent
ROOT = PACKAGE.parent

NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"
CONSTANT = re.compile(
    rf"`((?:\w+\.)?_?[A-Z][A-Z\d_]+(?:\.[a-z_]+)?|[A-Z][a-z]\w+\.[a-z_]+)`"
    rf"(?:\s+=\s+({NUMBER}))?"
)

PAGES = {
    path.parent.name: path.read_text(encoding="utf-8")
    for path in sorted(PACKAGE.rglob("THEORY.md"))
}
SOURCES = {
    path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8")
    for folder in (PACKAGE, ROOT / "tests")
    for path in sorted(folder.rglob("*.py"))
    if path != Path(__file__)
}


def find_values(name: str, room: str) -> list[Any]:
    """What a constant is in the modules of a room that define it, else in all."""
    *owner, last = name.split(".")
    wanted, field = (last, "") if last.isupper() else (owner.pop(), last)
    values = []
    for place, source in SOURCES.items():
        folder, _, stem = place.removesuffix(".py").rpartition("/")
        rooms = folder.split("/")
        is_elsewhere = room and ("netdesign" not in rooms or room not in rooms)
        if is_elsewhere or (owner and owner != [stem]):
            continue
        if wanted not in top_names(source):
            continue
        module = importlib.import_module(f"{folder}/{stem}".replace("/", "."))
        values.append(read_field(getattr(module, wanted), field))
    return values or (find_values(name, "") if room else [])


def read_field(value: Any, field: str) -> Any:
    """The value, its attribute, or the default of a dataclass."""
    if not field:
        return value
    if isinstance(value, type):
        return {one.name: one.default for one in dataclasses.fields(value)}[field]
    return getattr(value, field)


@cache
def top_names(source: str) -> set[str]:
    """Names that a module defines."""
    names = set()
    for node in ast.parse(source).body:
        if isinstance(node, ast.ClassDef):
            names.add(node.name)
        targets = node.targets if isinstance(node, ast.Assign) else []
        targets += [node.target] if isinstance(node, ast.AnnAssign) else []
        for target in targets:
            names |= {one.id for one in ast.walk(target) if isinstance(one, ast.Name)}
    return names


@each("room", PAGES)
def test_constants_are_what_the_page_says(room):
    for name, printed in CONSTANT.findall(PAGES[room]):
        values = find_values(name, room)
        assert values, name
        if printed:
            assert values == [float(printed)], name
