"""Reports of the built-in example as texts; its workbook calculated by LibreOffice."""

import difflib
import lzma
import math
import shutil
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path

from tests.golden.drawn import HERE
from tests.golden.texts import read_texts
from tests.report.reading import read_workbook, recalculate

CHECK = ("check", "--example", "--docx", "--no-cache", "--quiet", "--out")
LIMIT = 1e-9
SHOWN = 6  # lines of a place that are printed


@cache
def check_example():
    """Texts of the example's reports, and its workbook."""
    with tempfile.TemporaryDirectory() as folder:
        command = (sys.executable, "-m", "netdesign", *CHECK, folder)
        subprocess.run(command, check=False, capture_output=True, timeout=300)
        return read_texts(Path(folder)), (Path(folder) / "report.xlsx").read_bytes()


def compare_texts():
    """G2: page, workbook and Word file of the example; accept changes by --write."""
    told = []
    for name, lines in check_example()[0].items():
        changes = difflib.unified_diff(load_text(name), lines, n=0, lineterm="")
        by_place = {}
        for line in changes:
            if not line.startswith(("---", "+++", "@@")):
                by_place.setdefault(line[1:].partition(":")[0], []).append(line)
        for place, found in by_place.items():
            told.append(f"{name}, {place}: {len(found)} lines differ")
            told += [f"  {line}" for line in found[:SHOWN]]
    return told


def load_text(name):
    packed = (HERE / f"{name}.txt.xz").read_bytes()
    return lzma.decompress(packed).decode("utf-8").split("\n")


def store_texts():
    for name, lines in check_example()[0].items():
        packed = lzma.compress("\n".join(lines).encode(), preset=9)
        (HERE / f"{name}.txt.xz").write_bytes(packed)


def compare_recalculated():
    """G4: LibreOffice calculates every number of the example's workbook again."""
    if shutil.which("soffice") is None:
        sys.stdout.write("   not compared: LibreOffice is not installed\n")
        return []
    book = check_example()[1]
    with tempfile.TemporaryDirectory() as folder:
        fresh = recalculate({"report": book}, Path(folder))["report"]
    then, now = read_workbook(book), read_workbook(fresh)
    return [
        f"{sheet.title}!{cell.coordinate}: {was!r} -> {found!r}"
        for sheet in read_workbook(book, formulas=True)
        for line in sheet.iter_rows()
        for cell in line
        if cell.data_type == "f"
        for was in [then[sheet.title][cell.coordinate].value]
        for found in [now[sheet.title][cell.coordinate].value]
        if not is_near(was, found)
    ]


def is_near(one, other):
    if isinstance(one, (int, float)) and isinstance(other, (int, float)):
        return math.isclose(one, other, rel_tol=LIMIT, abs_tol=LIMIT)
    return (one or "") == (other or "")
