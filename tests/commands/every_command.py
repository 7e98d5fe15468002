"""Every command of the program run once in a language, and all that a person reads."""

import contextlib
import html
import io
import re
import sys
import zipfile
from pathlib import Path

import openpyxl
import pytest

from netdesign import cli
from netdesign.evidence.verification import pack
from netdesign.evidence.verification.closed_forms import list_law
from netdesign.site.columns.all_tables import NETS
from netdesign.site.template import workbook as template
from tests.report.reading import read_workbook
from tests.small_scene import SMALL_SCENE

ROW = "R4"
HISTORY = SMALL_SCENE + '[solve]\nmethod = "transient"\nhorizon_days = 0.5\n'
HEIGHTS = [0, 30, 60, 55, 90, 130, 125, 150, 160, 150, 140, 120, 90, 60, 20, 0]
COMMANDS = {
    "init": "init site.xlsx --example",
    "dry run": "check site.xlsx --dry-run",
    "check": "check site.xlsx --out out --accuracy 0.1 --jobs 1 --docx",
    "what if": "check site.xlsx --out b --accuracy 0.1 --jobs 1 --no-excel "
    "--what-if {nets}.L2=9",
    "summary": "report out/study.json --out short --detail summary",
    "diff": "diff out/study.json b/what-if-study.json",
    "verify --study": "verify --study out/study.json --site site.xlsx --jobs 1",
    "plan": "tests site.xlsx --plan --study out/study.json --out form.xlsx",
    "tests": "tests form.xlsx",
    "map": "map site.xlsx",
    "refused": "check refused.xlsx --annotate marked.xlsx",
    "solve": "solve scene.toml --out solved",
    "solve again": "solve scene.toml --out solved",
    "history": "solve history.toml --out history",
    "envelope": "envelope scene.toml --density 270:330 --friction 20:30 --out wide "
    "--accuracy 0.05",
    "snowpack": "snowpack station.csv",
    "winter": "winter site.xlsx --heights station.csv --accuracy 0.1 --jobs 1 "
    "--every 8",
    "standards list": "standards list",
    "standards show": "standards show eurocode",
    "standards copy": "standards copy eurocode own",
    "standards validate": "standards validate own",
    "verify": "verify",
    "doctor": "doctor",
    "help": "--help",
    "completion": "completion bash",
    "no command": "chek",
}
_NO_LANGUAGE = ("completion",)  # a script for a shell
_ONCE = ("verify --study",)  # solves all again, two seconds: in the first language only
FIRST = "fr"


def write_inputs():
    """Scene files and a station's heights, in the present folder."""
    Path("scene.toml").write_text(SMALL_SCENE)
    Path("history.toml").write_text(HISTORY)
    lines = [f"2003-02-{k + 1:02d},{h},-3.5" for k, h in enumerate(HEIGHTS)]
    Path("station.csv").write_text(
        "\n".join(["date,HS [cm],air temperature [C]", *lines])
    )


def shorten_example():
    """The example with one of its rows, and narrow ranges that are soon searched."""
    lines = template.load_example()
    lines["Nets"] = [line for line in lines["Nets"] if line["id"] == ROW]
    for sheet in ("Ends", "Declared"):
        lines[sheet] = [line for line in lines[sheet] if line["row"] == ROW]
    for line in lines["Ranges"]:
        line["high"] = 1.05 * line["low"]
    return lines


def spoil_site(language):
    """The site with a word in the place of a slope."""
    book = openpyxl.load_workbook("site.xlsx")
    book[NETS.name_in(language)]["B2"] = "4O"
    book.save("refused.xlsx")


def fill_form():
    """Every test of the form held its proof load, but for the first."""
    book = openpyxl.load_workbook("form.xlsx")
    sheet = book.worksheets[0]
    rule = next(r for r in sheet.data_validations.dataValidation if "D2" in r.sqref)
    held, pulled = rule.formula1.strip('"').split(",")
    for row in range(2, sheet.max_row + 1):
        if sheet.cell(row, 5).value:
            sheet.cell(row, 3).value = 0.9 * sheet.cell(row, 5).value
            sheet.cell(row, 4).value = pulled if row == 2 else held
    book.save("form.xlsx")


def run_all(folder, language, patch):
    """What each command told, by its name; its files are in the folder."""
    patch.chdir(folder)
    lines = shorten_example()
    patch.setattr(template, "load_example", lambda: lines)
    patch.setattr(pack, "GROUPS", (list_law,))
    write_inputs()
    told = {}
    for name, line in COMMANDS.items():
        if name == "refused":
            spoil_site(language)
        if name == "tests":
            fill_form()
        if name in _ONCE and language != FIRST:
            continue
        words = line.format(nets=NETS.name_in(language)).split()
        if name not in _NO_LANGUAGE:
            words += ["--language", language]
        told[name] = run(words, patch)
    return told


def run(words, patch):
    """Standard output and error of one command."""
    stream = io.StringIO()
    patch.setattr(sys, "argv", ["netdesign", *words])
    with (
        contextlib.redirect_stdout(stream),
        contextlib.redirect_stderr(stream),
        pytest.raises(SystemExit) as ended,
    ):
        cli.main()
    assert ended.value.code != 5, stream.getvalue()
    return stream.getvalue()


def read_texts(path):
    """Text of a file that a person reads; "" of one that programs read."""
    if path.suffix in (".html", ".svg"):
        return read_page(path.read_text(encoding="utf-8"))
    if path.suffix == ".docx":
        with zipfile.ZipFile(path) as file:
            return read_page(file.read("word/document.xml").decode())
    if path.suffix == ".xlsx":
        return read_cells(path)
    if path.suffix == ".toml":
        lines = path.read_text(encoding="utf-8").splitlines()
        return "\n".join(line for line in lines if line.startswith("#"))
    return ""


def read_page(page):
    """Text of a page or a drawing, and what stands for its pictures."""
    page = re.sub(r"<(style|metadata)\b.*?</\1>", " ", page, flags=re.S)
    told = re.findall(r'(?:aria-label|alt|title|descr)="([^"]*)"', page)
    return html.unescape(re.sub(r"<[^>]*>", " ", page) + "\n" + "\n".join(told))


def read_cells(path):
    """Texts of all cells of a workbook, its sheets' names and its comments."""
    book = read_workbook(path.read_bytes(), formulas=True)
    texts = list(book.sheetnames)
    for sheet in book.worksheets:
        for row in sheet.iter_rows():
            for cell in row:
                is_text = isinstance(cell.value, str) and cell.data_type != "f"
                texts += [cell.value] if is_text else []
                texts += [cell.comment.text] if cell.comment else []
    return "\n".join(texts)
