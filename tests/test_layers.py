"""Who may import whom. The tables of ``layers.toml`` are the truth.

A module imports only from rows below its own. Imports inside functions and under
``TYPE_CHECKING`` count like all others.
"""

import ast
import re
import sys
import tomllib
from fnmatch import fnmatch
from pathlib import Path

import netdesign
from tests.each import each
from tests.sources import PACKAGE, parse_package, walk_package

TABLES = tomllib.loads(
    Path(__file__).with_name("layers.toml").read_text(encoding="utf-8")
)
ROW_OF = {room: row for row, rooms in enumerate(TABLES["rows"]) for room in rooms}
# A script that other versions run by its path; no module imports it.
PROBE = "addons.evidence.benchmark.probe"


def name_module(path: str) -> str:
    """Dotted name below ``netdesign``; a package by its own name."""
    return path.removesuffix(".py").replace("/", ".").removesuffix(".__init__")


MODULES = {name_module(path): tree for path, tree in parse_package().items()}
del MODULES["__init__"], MODULES[PROBE]


def list_targets(module: str) -> list[str]:
    """Full names of all that a module imports."""
    found = []
    for node in ast.walk(MODULES[module]):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        if isinstance(node, ast.ImportFrom):
            assert not node.level, "an import is of a whole name"
            # ``from netdesign.report import tables`` may name a module or a value
            found += [f"{node.module}.{alias.name}" for alias in node.names]
    return found


def name_room(target: str) -> str:
    """Room of a module, or of a name in one, given below ``netdesign``."""
    parts = target.split(".")
    names = [".".join(parts[:count]) for count in range(len(parts), 0, -1)]
    # what is not a room is the package's own: its version and its public names
    return next((name for name in names if name in ROW_OF), "root")


def is_allowed(target: str, module: str) -> bool:
    top, _, below = target.partition(".")
    if top == "netdesign":
        room, seen = name_room(module), name_room(below)
        return room == seen or ROW_OF[seen] < ROW_OF[room]
    allowed = TABLES["third_party"].get(top, ())
    return top in sys.stdlib_module_names or any(
        fnmatch(module, one) for one in allowed
    )


@each("module", MODULES)
def test_module_keeps_to_its_row(module):
    assert [x for x in list_targets(module) if not is_allowed(x, module)] == []


@each("module", [m for m in MODULES if m.startswith("examples.")])
def test_an_example_uses_public_names_only(module):
    own = {one for one in list_targets(module) if one.startswith("netdesign")}
    assert own
    assert own <= {f"netdesign.{name}" for name in netdesign.__all__}


def test_every_module_has_a_room():
    loose = {module for module in MODULES if name_room(module) == "root"}
    assert loose == set(TABLES["root_modules"])
    assert sum(map(len, TABLES["rows"])) == len(ROW_OF)
    assert {name_room(module) for module in MODULES} == set(ROW_OF)


def test_the_page_of_the_architecture_names_what_exists():
    page = (PACKAGE / "ARCHITECTURE.md").read_text(encoding="utf-8")
    classes = {
        node.name for _, node in walk_package() if isinstance(node, ast.ClassDef)
    }
    values = set(re.findall(r"`([A-Z][a-z]\w+)`", page))
    files = set(re.findall(r"`(\w+(?:/\w+)+(?:\.py)?)`", page))
    assert {"Case", "Extreme", "Check"} <= values <= classes
    rooms = [path for path in PACKAGE.iterdir() if path.is_dir()]
    roots = (PACKAGE.parent, PACKAGE, *rooms)
    assert "study/records.py" in files
    assert {f for f in files if not any((r / f).exists() for r in roots)} == set()
