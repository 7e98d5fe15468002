"""Standard streams: readers who stop, disks that are full, code pages without signs."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from netdesign.words.catalogue import load_texts
from tests.make import write_tiny
from tests.program import QUICK, start_program

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="POSIX pipes and devices")
FULL = Path("/dev/full")


def weaken(tables):
    tables["anchor_types"][0] |= {"tendon": 2, "pull_out": 2}


def forget(tables):
    for key in ("pull_out", "proven", "test_count"):
        del tables["anchor_types"][0][key]


VERDICTS = {0: None, 1: weaken, 4: forget}


@pytest.fixture(scope="module")
def sites(tmp_path_factory):
    """Folder with a site of each verdict: ``0.xlsx`` passes."""
    folder = tmp_path_factory.mktemp("sites")
    for code, edit in VERDICTS.items():
        write_tiny(folder / f"{code}.xlsx", edit)
    return folder


def close_reader():
    """Writing end of a pipe that nobody reads."""
    reading, writing = os.pipe()
    os.close(reading)
    return writing


@pytest.mark.long
@POSIX
@pytest.mark.parametrize(("code", "json_option"), [(0, ()), (1, ("--json",)), (4, ())])
def test_a_reader_who_stops_leaves_the_verdict(sites, tmp_path, code, json_option):
    writing = close_reader()
    try:
        result = start_program(
            *("check", sites / f"{code}.xlsx", *QUICK, "--out", "o", *json_option),
            cwd=tmp_path,
            stdout=writing,
        )
    finally:
        os.close(writing)
    assert result.code == code, result.err
    assert "Traceback" not in result.err
    assert "BrokenPipe" not in result.err
    assert (tmp_path / "o" / "report.html").stat().st_size > 0


@pytest.mark.skipif(not FULL.exists(), reason="no device that is always full")
@pytest.mark.parametrize(
    "arguments",
    [["standards", "list"], ["--help"], ["--version"]],
)
def test_a_full_disk_behind_standard_output_is_the_user_s(tmp_path, arguments):
    with FULL.open("w") as full:
        result = start_program(*arguments, cwd=tmp_path, stdout=full)
    assert result.code == 2
    assert result.err == (
        "error: standard output cannot be written to: No space left on device\n"
    )


@pytest.mark.parametrize(
    ("language", "encoding"),
    [
        ("fr", "ascii"),
        pytest.param("en", "cp850", marks=pytest.mark.long),
        pytest.param("de", "cp437", marks=pytest.mark.long),
    ],
)
def test_no_code_page_ends_a_check(sites, tmp_path, encoding, language):
    result = subprocess.run(
        [Path(sys.executable).with_name("netdesign"), "check", sites / "4.xlsx",
         *QUICK, "--language", language, "--out", "o", "--no-html", "--no-excel"],
        cwd=tmp_path, capture_output=True, check=False,
        env={**os.environ, "PYTHONIOENCODING": encoding},
    )  # fmt: skip
    assert result.returncode == 4, result.stderr
    shown = result.stdout.decode(encoding)
    assert load_texts(language)["verdict.not_proven"].replace("É", "")[:4] in shown
    assert (tmp_path / "o" / "study.json").exists()


@pytest.mark.skipif(not FULL.exists(), reason="no device that is always full")
def test_a_document_is_utf_8_whatever_the_code_page_and_standard_error(tmp_path):
    """Nobody can write to standard error, and the signs are in no code page."""

    def edit(tables):
        forget(tables)
        tables["rows"][0]["id"] = "Rangée φ 1"

    write_tiny(tmp_path / "site.xlsx", edit)
    with FULL.open("w") as full:
        ended = subprocess.run(
            [Path(sys.executable).with_name("netdesign"), "check", "site.xlsx",
             "--json", *QUICK],
            cwd=tmp_path, stdout=subprocess.PIPE, stderr=full, check=False,
            env={**os.environ, "PYTHONIOENCODING": "cp437"},
        )  # fmt: skip
    assert ended.returncode == 4
    document = json.loads(ended.stdout.decode())
    assert document["verdict"] == "not_proven"
    assert document["rows"][0]["id"] == "Rangée φ 1"
