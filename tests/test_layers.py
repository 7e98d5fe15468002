"""Who may import whom. The tables here are the truth; the modules have to follow.

A module imports only from rows below its own number. Imports inside functions and
under ``TYPE_CHECKING`` count like all others.
"""

import ast
import sys
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

import pytest

import netdesign

PACKAGE = Path(netdesign.__file__).parent

# First part of the name below ``netdesign`` (a package or a single module), by row.
# The package itself stands for its version only.
ROWS = (
    {
        *("netdesign", "errors", "outcome", "units", "guards", "resources"),
        *("quantities", "output", "progress", "given_files", "json_text", "streams"),
        *("fault",),
    },
    {"numerics", "resistance", "search"},
    {"snow", "cable", "structure", "checks"},
    {"coupling", "guideline"},
    {"envelope"},
    {"site"},
    {
        *("study", "check_site", "monitoring", "rowcheck", "site_cases"),
        *("envelope_record", "envelope_file", "study_repeat", "study_values", "audit"),
        *("scene_file", "solution_file", "verification", "paper"),
    },
    {"benchmark"},
    {"report"},
    {"commands"},
    {"cli"},
    {"__main__"},
)

# Neighbours on one row do not see each other, but for these.
NEIGHBOURS = {
    ("errors", "outcome"),  # a SolveError carries its outcome
    ("guards", "errors"),  # guards raise
    ("fault", "errors"),  # tells what is raised on purpose from what is not
    ("resources", "errors"),
    ("output", "errors"),
    ("check_site", "study"),  # fills in what study.py declares
    ("check_site", "site_cases"),  # judges what site_cases.py solved
    ("check_site", "envelope_record"),
    ("envelope_record", "study"),
    ("envelope_file", "envelope_record"),
    ("envelope_file", "study"),
    ("site_cases", "monitoring"),
    ("site_cases", "rowcheck"),  # the scene of a row at a case
    ("site_cases", "study"),
    ("monitoring", "study"),  # fills in what study.py declares too
    ("cli", "commands"),  # registers what would make it too long
    ("rowcheck", "study"),  # so does this
    ("check_site", "rowcheck"),
    ("study_repeat", "check_site"),  # what a study says of its settings
    ("study_repeat", "site_cases"),
    ("study_repeat", "study"),
    ("audit", "study"),
    ("audit", "check_site"),  # how a study states a profile
    ("audit", "rowcheck"),  # judges checks again
    ("audit", "study_values"),
    ("study_repeat", "study_values"),
}

# Third-party packages, and the modules that may import them.
THIRD_PARTY = {
    "numpy": (
        *("numerics.*", "snow.*", "cable.*", "coupling.*"),
        *("envelope.*", "search.*", "solution_file", "verification.*", "benchmark.*"),
        *(
            "envelope_record",
            "monitoring",
            "paper.runs",
            "paper.findings",
            "report.net_figures",
        ),
        *("guideline.comparison", "commands.doctor"),
    ),
    "scipy": (
        *("numerics.newton", "snow.*", "envelope.store", "verification.*"),
        "benchmark.reference_path",
    ),
    "platformdirs": ("envelope.store",),
    "distributed": ("envelope.workers",),
    "skfem": ("snow.mesh", "snow.kernel", "snow.forms", "benchmark.reference_path"),
    "openpyxl": ("site.xlsx", "site.annotate"),
    "defusedxml": ("site.xlsx", "site.ods"),
    "xlsxwriter": ("site.template", "site.notes_sheet", "report.*"),
    "pydantic": ("checks.schema", "scene_file", "study", "json_text"),
    "pydantic_core": ("checks.schema", "json_text"),
    "jinja2": ("report.page",),
    "markupsafe": ("report.html", "report.page"),
    "weasyprint": ("report.pdf",),
    "matplotlib": ("report.*", "site.drawing"),
    "pandas": ("report.case_table",),
    "click": ("cli", "commands.*"),
    "rich": (
        *(
            "commands.verify",
            "progress",
            "report.terminal",
            "report.verification_table",
        ),
        *("commands.bench", "report.bench_table"),
    ),
}

# Slow to import: only inside functions, so that help is there at once.
ONLY_INSIDE_FUNCTIONS = {"openpyxl", "defusedxml", "xlsxwriter", "jinja2"} | {
    "weasyprint",
    "matplotlib",
    "pandas",
    "rich",
    "distributed",
}


def name_module(path: Path) -> str:
    """Dotted name below ``netdesign``; a package by its own name."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts).removesuffix(".__init__")


MODULES = {
    name_module(path): path
    for path in sorted(PACKAGE.rglob("*.py"))
    if path != PACKAGE / "__init__.py"
}


@dataclass(frozen=True)
class Import:
    """One import: what, from where, and whether it runs with the module."""

    target: str  # full name, as "netdesign.snow.mesh" or "numpy.typing"
    line: int
    is_immediate: bool


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


def own_part(target: str) -> str:
    """Unit of the tables that a name of the package belongs to."""
    parts = target.split(".")
    known = set().union(*ROWS)
    return parts[1] if len(parts) > 1 and parts[1] in known else "netdesign"


def row_of(part: str) -> int:
    return next(number for number, row in enumerate(ROWS) if part in row)


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
        return judge_own(module.split(".")[0], own_part(one.target))
    if top in sys.stdlib_module_names:
        return ""
    if not any(fnmatch(module, allowed) for allowed in THIRD_PARTY.get(top, ())):
        return "is not allowed here"
    if one.is_immediate and top in ONLY_INSIDE_FUNCTIONS:
        return "has to stand inside a function"
    return ""


def judge_own(part: str, target: str) -> str:
    if part == target or (part, target) in NEIGHBOURS:
        return ""
    if row_of(target) > row_of(part):
        return f"stands on row {row_of(target)}, above {row_of(part)}"
    if row_of(target) == row_of(part) and target != "netdesign":
        return "is a neighbour on the same row"
    return ""


@pytest.mark.parametrize("module", MODULES)
def test_module_keeps_to_its_row(module):
    assert faults(MODULES[module].read_text(encoding="utf-8"), module) == []


def test_the_package_itself_imports_next_to_nothing():
    source = (PACKAGE / "__init__.py").read_text(encoding="utf-8")
    assert [one.target for one in find_imports(source, "netdesign")] == [
        "os",
        "importlib.metadata.version",
    ]


def test_every_module_has_a_row():
    parts = {module.split(".")[0] for module in MODULES}
    assert parts <= set().union(*ROWS)
    assert sum(len(row) for row in ROWS) == len(set().union(*ROWS))


def test_no_entry_of_the_tables_is_idle():
    """An allowance that nothing uses is a door left open."""
    parts = {module.split(".")[0] for module in MODULES} | {"netdesign"}
    assert set().union(*ROWS) == parts
    used = {
        (module, one.target.split(".")[0], own_part(one.target))
        for module, path in MODULES.items()
        for one in find_imports(path.read_text(encoding="utf-8"), module)
    }
    neighbours = {
        (module.split(".")[0], part) for module, top, part in used if top == "netdesign"
    }
    assert neighbours >= NEIGHBOURS
    for package, allowed in THIRD_PARTY.items():
        users = [module for module, top, _ in used if top == package]
        for pattern in allowed:
            assert any(fnmatch(user, pattern) for user in users), (package, pattern)


def test_no_module_imports_by_name_at_run_time():
    for module, path in MODULES.items():
        text = path.read_text(encoding="utf-8")
        assert "import_module" not in text, module
        assert "__import__" not in text, module


@pytest.mark.parametrize(
    ("module", "source", "fault"),
    [
        ("snow.flow", "import netdesign.cli", "above"),
        ("snow.flow", "from netdesign import coupling", "above"),
        ("snow.flow", "from netdesign.cable.net import Net", "neighbour"),
        ("snow.flow", "def f():\n    from netdesign.cable import net", "neighbour"),
        ("snow.flow", "from ..cable import net", "neighbour"),
        ("snow.flow", "from .. import cable", "neighbour"),
        ("snow.flow", "if TYPE_CHECKING:\n    import netdesign.cli", "above"),
        ("snow.flow", "class A:\n    def f(self):\n        import click", "allowed"),
        ("study", "import netdesign.check_site", "neighbour"),
        ("units", "import netdesign.output", "neighbour"),
        ("checks.check", "import numpy as np", "allowed"),
        ("snow.flow", "import skfem", "allowed"),
        ("report.view", "import pandas", "allowed"),
        ("site.reader", "import openpyxl", "allowed"),
        ("site.xlsx", "import openpyxl", "inside a function"),
        ("site.xlsx", "class A:\n    import openpyxl", "inside a function"),
        (
            "commands.verify",
            "try:\n    import rich\nexcept ImportError:\n    pass",
            "inside",
        ),
        ("units", "import requests", "allowed"),
    ],
)
def test_the_walk_finds_what_is_forbidden(module, source, fault):
    (found,) = faults(source, module)
    assert fault in found


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("snow.flow", "from netdesign.snow import mesh\nfrom . import kernel"),
        ("snow.flow", "import math\nimport numpy.typing"),
        ("cli", "from netdesign import __version__"),
        ("check_site", "from netdesign.study import Study"),
        ("site.xlsx", "def f():\n    import openpyxl"),
        ("site.xlsx", "if TYPE_CHECKING:\n    import openpyxl"),
        ("report.html", "from netdesign.errors import NetDesignError"),
    ],
)
def test_the_walk_lets_the_rest_pass(module, source):
    assert faults(source, module) == []
