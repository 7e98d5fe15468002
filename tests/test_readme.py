"""The blocks of the pages for users are run, and what they print is compared."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from netdesign.edge.json_text import MAX_JSON_BYTES, MAX_OBJECTS, MAX_VALUES
from netdesign.site.cells.cells import MAX_NET_ROWS
from tests.each import each
from tests.make import write_rows

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
USAGE = (ROOT / "netdesign" / "USAGE.md").read_text(encoding="utf-8")
NETDESIGN = Path(sys.executable).with_name("netdesign")

# Pages for users, and those that they lead to.
PAGES = sorted([ROOT / "README.md", *ROOT.glob("netdesign/**/*.md")])

# Exit codes of the two commands as printed, run one after the other in one folder. The
# workbook that `init` writes has nothing filled in, so checking it is refused.
EXPECTED_EXIT_CODES = {"init": 0, "check": 3}


def blocks(language: str, text: str = README) -> list[str]:
    found = re.findall(
        rf"^( *)```{language}\n(.*?)^ *```", text, re.DOTALL | re.MULTILINE
    )
    return [
        re.sub(rf"^{indent}", "", block, flags=re.MULTILINE) for indent, block in found
    ]


(TABLE,) = blocks("text")
(PULLS,) = blocks("text", USAGE)


def run(command: str, folder: Path) -> subprocess.CompletedProcess[str]:
    environment = {
        **os.environ,
        "PATH": f"{NETDESIGN.parent}{os.pathsep}{os.environ['PATH']}",
        "COLUMNS": "100",
    }
    return subprocess.run(
        command,
        shell=True,
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )


def test_two_commands_run_as_printed(tmp_path):
    lines = blocks("console")[1].splitlines()
    assert len(lines) == len(EXPECTED_EXIT_CODES)
    for line in lines:
        result = run(line, tmp_path)
        assert result.returncode == EXPECTED_EXIT_CODES[line.split()[1]], result.stderr


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    """Folder in which the example is checked, and how that ended."""
    folder = tmp_path_factory.mktemp("example")
    return folder, run("netdesign check --example --quiet", folder)


def test_the_example_gives_what_is_shown(example):
    _, result = example
    assert result.returncode == 1, result.stderr
    printed = [line.rstrip() for line in result.stdout.splitlines()]
    shown = TABLE.splitlines()
    assert printed[: len(shown)] == shown


STUDY_KEYS = {"schema", "verdict", "rows", "provenance"}
ROW_KEYS = {"id", "verdict", "checks"}
CHECK_KEYS = {
    "id",
    "clause",
    "member",
    "demand_kN",
    "mode",
    "steps",
    "resistance_kN",
    "utilisation",
    "verdict",
    "case",
    "reason",
}


def test_the_example_fails_as_meant_with_the_keys_of_the_interface(example):
    folder, _ = example
    text = (folder / "netdesign-out" / "study.json").read_text(encoding="utf-8")
    document = json.loads(text)
    assert document["schema"] == "netdesign.study/4"
    assert document["verdict"] == "fail"
    assert set(document) >= STUDY_KEYS
    verdicts = {row["id"]: row["verdict"] for row in document["rows"]}
    assert verdicts["A1"] == "declared"
    assert verdicts["A2"] == "not_proven"
    assert verdicts["A4"] == verdicts["B4"] == "fail"
    for row in document["rows"]:
        assert set(row) >= ROW_KEYS
        assert {case["outcome"] for case in row["cases"]} == {"converged"}
        for check in row["checks"]:
            assert set(check) >= CHECK_KEYS
            assert check["verdict"] in ("pass", "fail", "not_proven", "declared")
            assert check["reason"]
    row = max((json.dumps(row, indent=1) for row in document["rows"]), key=len)
    case = max((json.dumps(c, indent=1) for c in document["rows"][0]["cases"]), key=len)
    case = case.replace("\n", "\n   ")
    # a site as large as it may be, whose searches take twice as many cases as most, can
    # be read again
    for most, sizes in (
        (MAX_JSON_BYTES, (len(row), len(case) + 1)),
        (MAX_VALUES, (row.count(","), case.count(",") + 1)),
        (MAX_OBJECTS, (row.count("{"), case.count("{"))),
    ):
        of_rows, of_cases = MAX_NET_ROWS * sizes[0], 100_000 * sizes[1]
        assert 1.1 * (of_rows + of_cases) < most


def test_scene_file_is_solved(tmp_path):
    (scene,) = [block for block in blocks("toml", USAGE) if "[slope]" in block]
    (tmp_path / "scene.toml").write_text(scene, encoding="utf-8")
    result = run("netdesign solve scene.toml", tmp_path)
    assert result.returncode == 0, result.stderr
    assert "balance residual" in result.stdout


def test_python_block_prints_what_is_shown(capsys):
    block, _ = blocks("python", USAGE)
    exec(compile(block, "USAGE.md", "exec"), {})
    assert capsys.readouterr().out == PULLS


def test_python_lines_check_a_site_as_printed(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    write_rows(tmp_path / "site.xlsx", ["R6"])
    (readme,) = blocks("python")
    exec(compile(readme, "README.md", "exec"), {})
    assert "foot_anchor" in capsys.readouterr().out
    assert (tmp_path / "reports" / "report.html").exists()
    _, usage = blocks("python", USAGE)
    names = {}
    exec(compile(usage, "USAGE.md", "exec"), names)
    assert names["again"].rows == names["study"].rows
    assert (tmp_path / "reports" / "report.docx").exists()


def test_profile_of_ones_own_is_used_as_printed(tmp_path):
    (block,) = blocks("console", USAGE)
    copy, validate, *checks = block.splitlines()
    assert run(copy, tmp_path).returncode == 0
    assert run(validate, tmp_path).returncode == 0
    assert len(checks) == 2
    for check in checks:
        line = check.partition("#")[0].replace(" --explain", "")
        read = run(f"{line} --dry-run", tmp_path)
        assert read.returncode == 0, read.stderr
        assert "8 net rows" in read.stdout


LINKS = [
    (page, link)
    for page in PAGES
    for link in re.findall(
        r'\]\(([^)h#][^)#]*)|<img src="([^"]+)"', page.read_text(encoding="utf-8")
    )
]


@each("page, link", [(page, a or b) for page, (a, b) in LINKS])
def test_links_lead_somewhere(page, link):
    assert (page.parent / link).exists()
