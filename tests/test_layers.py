"""Who may import whom. The tables here are the truth; the modules have to follow.

A module imports only from rows below its own number. Imports inside functions and
under ``TYPE_CHECKING`` count like all others.
"""

import ast
import re
import sys
from dataclasses import dataclass
from fnmatch import fnmatch
from functools import cache
from pathlib import Path

import netdesign
from tests.each import each
from tests.sources import PACKAGE, walk_package

# Rooms, from the ground up. A room is a package, or the modules beside them. Each row
# sees what stands below it; rooms on one row do not see each other.
ROOT = "root"  # modules beside the rooms, for all of them
ROWS = (
    {"words"},
    {ROOT},
    {"edge"},
    {"numerics", "calculation"},
    {"resistance", "search", "core"},
    {"snow", "cable", "structure", "checks"},
    {"coupling", "guideline"},
    {"coupling.steady", "panel"},
    {"solving"},
    {"envelope"},
    {"site.columns"},
    {"site.cells"},
    {"site"},
    {"site.template"},
    {"study"},
    {"files"},
    {"report.words"},
    {"report.blocks"},
    {"report.what_if"},
    {"report.drawing"},
    {"report.sections"},
    {"report.page", "report.workbook", "report.document"},
    {"report"},
    {"api"},
    {"public", "examples"},  # examples see the public names only
    {"commands"},
    {"cli"},
    {"__main__"},
    # add-ons see all of the core, which sees none of them
    {"addons"},
    {
        "addons.history",
        "addons.reliability",
        "addons.terrain",
        "addons.winter",
    },
    {"addons.evidence"},
    {
        "addons.evidence.verification",
        "addons.evidence.paper",
        "addons.evidence.benchmark",
    },
    {"addons.evidence.validation"},
    {"addons.evidence.command"},
)
ROOMS = set().union(*ROWS)
ROOT_MODULES = {"addon_table", "outcome", "units", "quantities"}

# Third-party packages, and the modules that may import them.
THIRD_PARTY = {
    "numpy": (
        *(
            "numerics.*",
            "core.*",
            "snow.*",
            "cable.*",
            "coupling.*",
            "panel.*",
            "envelope.*",
            "guideline.*",
            "resistance.ground",
            "structure.row_position",
            "structure.splay",
            "search.*",
            "addons.reliability.*",
            "addons.winter.*",
            "solving.*",
            "addons.history.*",
            "addons.terrain.*",
        ),
        "addons.evidence.*",
        "commands.doctor",
    ),
    "scipy": (
        "numerics.optimise",
        "snow.*",
        "addons.reliability.*",
        "addons.winter.uniform_table",
        "addons.winter.statistics",
        "solving.store",
        "addons.evidence.*",
    ),
    "filelock": ("edge.input_files",),
    "platformdirs": ("solving.store",),
    "distributed": ("solving.workers",),
    "hatchling": ("core.build",),  # it runs before the package is installed
    "skfem": ("snow.forms",),
    "openpyxl": ("site.cells.*", "site.template.annotate"),
    "defusedxml": ("site.cells.xlsx", "site.cells.cells"),
    "xlsxwriter": ("site.template.*", "report.workbook.*"),
    "pydantic": (
        "addons.evidence.validation",
        *("checks.schema", "files.scene", "study.document"),
        *("edge.json_text", "site.lists.list_map"),
    ),
    "pydantic_core": ("checks.schema", "edge.json_text", "words.message"),
    "jinja2": ("report.page.render",),
    "markupsafe": ("report.page.*",),
    "weasyprint": ("report.files",),
    "docx": ("report.document.*",),
    "rasterio": ("addons.terrain.grid",),
    "pyogrio": ("addons.terrain.plan",),
    "shapely": ("addons.terrain.*",),
    "contourpy": ("addons.terrain.page",),
    "ezdxf": ("addons.terrain.verdict_map",),
    "PIL": ("report.drawing.raster",),
    "matplotlib": (
        *("report.drawing.*", "examples.*"),
        "coupling.solution",  # plots itself
    ),
    "pandas": ("study.records", "study.frames"),
    "rapidfuzz": ("site.lists.guess",),
    "click": ("cli", "commands.*", "addons.*command"),
    "rich": (
        *("edge.progress", "report.terminal", "report.console"),
        "report.anchor_table",
        "addons.evidence.*",
    ),
}

# Slow to import: only inside functions, so that help is there at once.
ONLY_INSIDE_FUNCTIONS = {"openpyxl", "defusedxml", "xlsxwriter", "jinja2"} | {
    "weasyprint",
    "docx",
    "PIL",
    "matplotlib",
    "pandas",
    "rich",
    "distributed",
    "rasterio",
    "pyogrio",
    "ezdxf",
}


def name_module(path: Path) -> str:
    """Dotted name below ``netdesign``; a package by its own name."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts).removesuffix(".__init__")


# A script that other versions run by its path; no module imports it.
PROBE = PACKAGE / "addons" / "evidence" / "benchmark" / "probe.py"
MODULES = {
    name_module(path): path
    for path in sorted(PACKAGE.rglob("*.py"))
    if path not in (PACKAGE / "__init__.py", PROBE)
}


@dataclass(frozen=True)
class Import:
    """One import: what, from where, and whether it runs with the module."""

    target: str  # full name, as "netdesign.snow.mesh" or "numpy.typing"
    line: int
    is_immediate: bool


@cache
def find_imports(source: str, module: str) -> list[Import]:
    """All imports of a module's text."""
    found: list[Import] = []
    collect(ast.parse(source), module, True, found)
    return found


def collect(
    node: ast.AST, module: str, is_immediate: bool, found: list[Import]
) -> None:
    for child in ast.iter_child_nodes(node):
        runs_later = isinstance(
            child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda
        ) or (isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test))
        found.extend(
            Import(target, child.lineno, is_immediate)
            for target in name_targets(child, module)
        )
        collect(child, module, is_immediate and not runs_later, found)


def name_targets(node: ast.AST, module: str) -> list[str]:
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if not isinstance(node, ast.ImportFrom):
        return []
    base = node.module or ""
    if node.level:
        above = f"netdesign.{module}".split(".")[: -node.level]
        base = ".".join([*above, *([node.module] if node.module else [])])
    # ``from netdesign.report import tables`` may name a module or a value in it
    return [f"{base}.{alias.name}" for alias in node.names]


def name_room(target: str) -> str:
    """Room of a module, or of a name in one, given below ``netdesign``."""
    parts = target.split(".")
    if parts[0] in ROOT_MODULES:
        return ROOT
    names = [".".join(parts[:count]) for count in range(len(parts), 0, -1)]
    # what is not a room is the package's own: its version and its public names
    return next((name for name in names if name in ROOMS), ROOT)


def row_of(room: str) -> int:
    return next(number for number, row in enumerate(ROWS) if room in row)


def faults(source: str, module: str) -> list[str]:
    """What the tables forbid in a module's text."""
    found = []
    for one in find_imports(source, module):
        fault = judge(one, module)
        if fault:
            found.append(f"{module}, line {one.line}: {one.target}: {fault}")
    return found


def judge(one: Import, module: str) -> str:
    top = one.target.split(".")[0]
    if top == "netdesign":
        return judge_own(name_room(module), name_room(below_package(one.target)))
    if top in sys.stdlib_module_names:
        return ""
    if not any(fnmatch(module, allowed) for allowed in THIRD_PARTY.get(top, ())):
        return "is not allowed here"
    if one.is_immediate and top in ONLY_INSIDE_FUNCTIONS:
        return "has to stand inside a function"
    return ""


def below_package(target: str) -> str:
    return target.partition(".")[2]


def judge_own(room: str, target: str) -> str:
    if room == target:
        return ""
    if row_of(target) > row_of(room):
        return f"stands on row {row_of(target)}, above {row_of(room)}"
    if row_of(target) == row_of(room):
        return "is a neighbour on the same row"
    return ""


@each("module", MODULES)
def test_module_keeps_to_its_row(module):
    assert faults(MODULES[module].read_text(encoding="utf-8"), module) == []


@each("module", [m for m in MODULES if m.startswith("examples.")])
def test_an_example_uses_public_names_only(module):
    imports = find_imports(MODULES[module].read_text(encoding="utf-8"), module)
    own = {one.target for one in imports if one.target.startswith("netdesign")}
    assert own
    assert own <= {f"netdesign.{name}" for name in netdesign.__all__}


def test_every_module_has_a_room():
    loose = {module for module in MODULES if name_room(module) == ROOT}
    assert loose == ROOT_MODULES
    assert sum(len(row) for row in ROWS) == len(ROOMS)
    assert {name_room(module) for module in MODULES} == ROOMS


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
