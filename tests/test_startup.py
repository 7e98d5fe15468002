"""Help is there at once: nothing heavy is imported for it."""

import json
import subprocess
import sys

import netdesign
from netdesign.checks import list_standards, load_standard
from netdesign.core.library import name_core
from tests.make import write_tiny
from tests.small_scene import ROUGH_SCENE

HEAVY = (
    *("numpy", "scipy", "skfem", "pandas", "matplotlib", "openpyxl", "xlsxwriter"),
    *("jinja2", "pydantic", "rich", "rasterio", "pyogrio", "ezdxf"),
)

# Of a plain steady scene: 96 today, of more than 500.
MOST_OWN_MODULES = 105

PROBE = """
import json, sys
from netdesign.cli import main
try:
    for words in json.loads(sys.argv[1]):
        code = None
        sys.argv = ["netdesign", *words]
        try:
            main()
        except SystemExit as end:
            code = end.code
        if code:
            sys.exit(code)
finally:
    print(json.dumps(sorted(sys.modules)), file=sys.stderr)
"""


def imported(*commands, cwd, whole=False, code=0):
    """Top-level packages that are loaded when commands have ended; or whole names."""
    result = subprocess.run(
        [sys.executable, "-c", PROBE, json.dumps(commands)],
        cwd=cwd,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == code, result.stderr
    names = json.loads(result.stderr.splitlines()[-1])
    return set(names) if whole else {name.split(".")[0] for name in names}


HELP = (
    *(["--help"], ["--version"]),
    *([name, "--help"] for name in (
        *("check", "init", "solve", "report", "standards", "table", "terrain"),
        *("diff", "doctor"),
    )),
)  # fmt: skip


def test_help_imports_nothing_heavy(tmp_path):
    """One after the other in one process: what any of them imports is there at last."""
    modules = imported(*HELP, cwd=tmp_path)
    assert "click" in modules
    assert not modules & set(HEAVY)


def test_a_plain_steady_scene_needs_little_beside_its_solver(tmp_path):
    """Each of these takes longer to import than the scene to solve."""
    scene = tmp_path / "scene.toml"
    scene.write_text(ROUGH_SCENE, encoding="utf-8")
    modules = imported(["solve", str(scene)], cwd=tmp_path, whole=True)
    unused = {"skfem", "rich", "jinja2", "openpyxl", "sqlite3", "multiprocessing"}
    rooms = ("commands.check", "checks", "envelope", "report", "search", "site")
    unused |= {
        f"netdesign.{room}" for room in (*rooms, "study", "coupling.history.run")
    }
    assert "netdesign.coupling.steady.solve" in modules
    assert not modules & unused
    own = [name for name in modules if name.startswith("netdesign")]
    assert len(own) <= MOST_OWN_MODULES


def test_a_table_needs_no_solver(tmp_path):
    """A second of processor time for eight rows: no more than reading and a table."""
    write_tiny(tmp_path / "site.xlsx")
    modules = imported(["table", "site.xlsx"], cwd=tmp_path)
    assert "rich" in modules
    assert not modules & {"scipy", "skfem", "pandas", "jinja2", "xlsxwriter"}


def test_a_faulty_site_is_refused_without_a_solver(tmp_path):
    site = tmp_path / "site.csv"
    site.write_text("id,slope angle [deg]\nR1,steep\n", encoding="utf-8")
    modules = imported(["check", "site.csv"], cwd=tmp_path, whole=True, code=3)
    assert "netdesign.site.reader" in modules
    assert not modules & {"scipy", "netdesign.study.cases", "netdesign.snow.flow_step"}


def test_the_module_is_the_program(tmp_path):
    result = subprocess.run(
        [sys.executable, "-m", "netdesign", "--version"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0
    program, core, *profiles = result.stdout.splitlines()
    assert program == f"netdesign {netdesign.__version__}"
    assert core.split(maxsplit=1) == ["core", name_core()]
    assert len(profiles) == len(list_standards())
    for line, name in zip(profiles, list_standards(), strict=True):
        standard = load_standard(name)
        assert f" {name}: version {standard.version}, " in line
        assert line.endswith(standard.edition)
