"""The command line: exit codes, streams, files; each command once in a process."""

import json
import shutil
import signal
import subprocess
import sys

import pytest

from netdesign.edge.input_files import find_resource
from netdesign.words.message import say
from tests.make import find_cell, write_rows, write_tiny
from tests.program import QUICK, call_program, spoilt_program, start_program
from tests.report.reading import read_workbook
from tests.small_scene import ROUGH_SCENE

PROFILE = "nf-p-95-304-style"


def listing(folder):
    files = (p for p in folder.rglob("[!.]*") if p.is_file())
    return {str(p.relative_to(folder)) for p in files}


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """Folder with the tiny site, checked once into ``out``."""
    folder = tmp_path_factory.mktemp("home")
    write_tiny(folder / "site.xlsx")
    return folder


@pytest.fixture(scope="module")
def checked(home):
    return start_program(
        *("check", "site.xlsx", "--out", "out", "--no-cache", *QUICK),
        cwd=home,
        SOURCE_DATE_EPOCH="86400",
    )


@pytest.fixture(scope="module")
def study(home, checked):
    return json.loads((home / "out" / "study.json").read_text(encoding="utf-8"))


# --- check: verdicts ---------------------------------------------------------------


def test_a_pass_ends_with_0(checked, study):
    assert checked.code == 0, checked.err
    assert study["verdict"] == "pass"
    assert "PASS" in checked.out.upper()


@pytest.mark.parametrize(
    ("typed", "code", "verdict"),
    [
        ({"tendon": 2, "pull_out": 2}, 1, "fail"),
        (dict.fromkeys(("pull_out", "proven", "test_count")), 4, "not_proven"),
    ],
)
def test_what_does_not_pass_ends_with_its_code(tmp_path, typed, code, verdict):
    write_tiny(tmp_path / "site.xlsx", lambda x: x["anchor_types"][0].update(typed))
    result = call_program("check", "site.xlsx", "--json", *QUICK, cwd=tmp_path)
    assert result.code == code, result.err
    assert json.loads(result.out)["verdict"] == verdict


def test_an_unknown_profile_of_a_site_is_refused_at_its_cell(call, tmp_path):
    def misspell(tables):
        tables["project"][0]["standard"] = "eurocod"

    write_tiny(tmp_path / "site.xlsx", misspell)
    ended = call("check", "site.xlsx", "--dry-run")
    assert ended.code == 3
    place = find_cell("project", "standard").replace("!", " › ")
    assert f"site.xlsx › {place}: limit profile 'eurocod'" in ended.err
    assert "Did you mean eurocode?" in ended.err


def test_a_declared_check_ends_with_6_and_is_named_on_every_output(tmp_path):
    def declare(tables):
        del tables["posts"][0]["bearing"]
        tables["declared"] = [
            {
                "row": "all",
                "check": "Post base, bearing",
                "document": "Report G-17",
                "author": "B. Rüegg",
                "date": "2026-03-09",
            }
        ]

    write_tiny(tmp_path / "site.xlsx", declare)
    result = call_program("check", "site.xlsx", "--out", "out", *QUICK, cwd=tmp_path)
    assert result.code == 6, result.err
    proof = f"Report G-17, B. Rüegg, 2026-03-09, cell {find_cell('declared', 'check')}"
    (row,) = [one for one in result.out.splitlines() if one.startswith("R1 ")]
    assert "†" in row
    assert "Report G-17" in " ".join(result.out.split())  # it is folded
    assert proof in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    book = read_workbook((tmp_path / "out" / "report.xlsx").read_bytes())
    for sheet, part in (("Decision", "Report G-17"), ("Checks", proof)):
        cells = [cell.value for line in book[sheet].iter_rows() for cell in line]
        assert any(part in str(cell) for cell in cells), sheet
    again = call_program("report", "out/study.json", "--out", "again", cwd=tmp_path)
    assert again.code == 6, again.err


# --- check: outputs ----------------------------------------------------------------


def test_outputs_are_in_their_folder_and_nothing_else_is(home, checked):
    outputs = {path.name for path in (home / "out").glob("[!.]*")}
    assert outputs == {"study.json", "report.html", "report.xlsx"}
    (wrote,) = [one for one in checked.err.splitlines() if one.startswith("wrote ")]
    assert wrote.endswith(" in out")
    assert all(name in wrote for name in outputs)


def test_json_prints_one_document_and_nothing_else(home, study, tmp_path):
    write_tiny(tmp_path / "site.xlsx")
    options = ("--json", "--no-cache", *QUICK)
    result = call_program("check", "site.xlsx", *options, cwd=tmp_path)
    assert result.code == 0, result.err
    document = json.loads(result.out)
    assert listing(tmp_path) == {"site.xlsx"}
    assert "net rows: largest forces and checks: 1 solved, about " in result.err
    for part in ("verdict", "rows", "profile", "range_inputs", "notes"):
        assert document[part] == study[part]


def test_several_profiles_get_a_folder_each(home, checked, tmp_path):
    own = tmp_path / "mine"
    shutil.copytree(find_resource("standards") / PROFILE, own)
    document = own / "document.toml"
    document.write_text(document.read_text().replace(PROFILE, "mine", 1))
    result = call_program(
        *("check", home / "site.xlsx", "--standard", PROFILE, "--standard", "mine"),
        *("--out", "out", "--no-html", "--no-excel", "--json", *QUICK),
        cwd=tmp_path,
    )
    assert result.code == 0, result.err
    document = json.loads(result.out)
    assert document["schema"] == "netdesign.studies/1"
    ids = [one["profile"]["id"] for one in document["studies"]]
    assert ids == [PROFILE, "mine"]
    for name in ids:
        assert (tmp_path / "out" / name / "study.json").is_file()


# --- check: refusals ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["check"], "give a site workbook, or --example"),
        (["check", "site.xlsx", "--example"], "give a site workbook, or --example"),
        (["check", "site.xlsx", "--colour"], "No such option"),
        (["check", "site.xlsx", "--accuracy", "0.5"], "is not in the range"),
        (["check", "site.xlsx", "--jobs", "0"], "is not in the range"),
        (["check", "site.xlsx", "--method", "steady"], "No such option"),
        (["check", "a.xlsx", "b.xlsx"], "unexpected extra argument"),
        (
            [*("check", "--example", "--dry-run"), *("--standard", PROFILE) * 2],
            "two of the profiles have the same id",
        ),
        (["chek"], "No such command"),
        ([], "Usage:"),
        (["solve"], "Missing argument"),
    ],
)
def test_wrong_usage_ends_with_2(home, tmp_path, arguments, message):
    result = call_program(*arguments, cwd=tmp_path)
    assert result.code == 2, result.err
    assert message in result.err
    assert result.out == ""
    assert listing(tmp_path) == set()


def test_a_refused_workbook_ends_with_3_and_every_finding(tmp_path):
    def spoil(tables):
        tables["rows"][0] |= {"slope_angle": 95, "foot_anchor": "A9"}
        tables["project"][0]["density"] = "270 to 4OO"

    write_tiny(tmp_path / "site.xlsx", spoil)
    result = call_program("check", "site.xlsx", "--json", *QUICK, cwd=tmp_path)
    assert result.code == 3
    for table, key, text in (
        ("rows", "slope_angle", "95"),
        ("rows", "foot_anchor", "A9"),
        ("project", "density", "270 to 4OO"),
    ):
        place = find_cell(table, key).replace("!", " › ")
        assert f'site.xlsx › {place}: "{text}"' in result.err
    assert "3 findings; nothing was checked" in result.err
    assert result.out == ""
    assert listing(tmp_path) == {"site.xlsx"}


# --- bugs, interrupts, closed pipes ------------------------------------------------


@pytest.mark.skipif(sys.platform == "win32", reason="sends a POSIX signal")
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_an_interrupt_ends_with_130_and_no_outputs(tmp_path, jobs):
    write_rows(tmp_path / "site.xlsx", leans=True)
    # A shell that runs tests in the background lets its children ignore SIGINT.
    heed = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
    with subprocess.Popen(
        [*spoilt_program(heed), "check", "site.xlsx", "--jobs", jobs],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert "net rows: largest forces" in process.stderr.readline()
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate()
    assert process.returncode == 130, stderr
    assert "interrupted; to continue: netdesign check site.xlsx" in stderr
    assert "reports: " not in stderr
    assert "Traceback" not in stderr
    assert stdout == ""
    assert listing(tmp_path) == {"site.xlsx"}


# --- init --------------------------------------------------------------------------


# --- report ------------------------------------------------------------------------


def test_report_renders_the_same_page_without_a_solver_and_says_so(
    home, checked, tmp_path
):
    without = "import netdesign.coupling.steady.solve as s\ns.solve_steady = None"
    result = start_program(
        *("report", home / "out" / "study.json", "--out", "again"),
        cwd=tmp_path,
        program=spoilt_program(without),
    )
    assert result.code == 0, result.err
    page, again = (
        (folder / "report.html").read_text(encoding="utf-8")
        for folder in (home / "out", tmp_path / "again")
    )
    mark = f"{say('standing.not_verified')} · "
    assert mark in again
    assert again.replace(mark, "", 1) == page
    assert {path.name for path in (tmp_path / "again").glob("[!.]*")} == {
        "report.html",
        "report.xlsx",
    }


# --- standards ---------------------------------------------------------------------


def test_standards_shows_every_value_with_its_status(tmp_path, study):
    result = call_program("standards", "show", PROFILE, cwd=tmp_path)
    assert result.code == 0
    assert study["profile"]["sha256"] in result.out
    own = [v for v in study["profile"]["values"] if not v["id"].startswith("floor.")]
    assert len(own) < len(study["profile"]["values"])
    for value in own:
        line = f"{value['id']} = {round(value['value'], 5):g} {value['unit']}"
        assert f"{line}  [{value['status']}]" in result.out


def test_standards_copy_starts_a_profile_of_ones_own(tmp_path):
    result = call_program("standards", "copy", "eurocode", "my-annex", cwd=tmp_path)
    assert result.code == 0, result.err
    assert result.out.startswith("my-annex: version 2, ")
    source = find_resource("standards") / "eurocode"
    assert listing(tmp_path / "my-annex") == listing(source)
    again = call_program("standards", "copy", "eurocode", "my-annex", cwd=tmp_path)
    assert again.code == 2
    assert "exists already" in again.err
    wrong = call_program("standards", "copy", "eurocode", "my annex", cwd=tmp_path)
    assert wrong.code == 2
    assert "becomes the profile's id" in wrong.err
    assert not (tmp_path / "my annex").exists()


# --- solve -------------------------------------------------------------------------


def test_solve_without_a_solution_ends_with_4(tmp_path):
    """A net with half its length to spare lets the snow bulge too far."""
    scene = ROUGH_SCENE.replace("slack = 0.05", "slack = 0.5\ninclination_deg = 20")
    (tmp_path / "scene.toml").write_text(scene)
    result = call_program("solve", "scene.toml", "--json", cwd=tmp_path)
    assert result.code == 4
    document = json.loads(result.out)
    assert document["outcome"] == "out_of_validity"
    assert "touch the ground" in document["reason"]
    assert "anchor_forces" not in document
