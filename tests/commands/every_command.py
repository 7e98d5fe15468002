"""Commands that speak three languages run once, and all that a person reads."""

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
from netdesign.site.columns.office import load_plan
from netdesign.site.template.office_workbook import load_input_example, render_input
from tests.report.reading import read_workbook

ROW = "A4"
COMMANDS = {
    "init": "init new.xlsx --example",
    "check": "check site.xlsx --out out --accuracy 0.1 --jobs 1 --docx --quiet",
    "what if": "check site.xlsx --out b --accuracy 0.1 --jobs 1 --quiet --no-excel "
    "--what-if {rows}!I6=9",
    "summary": "report out/study.json --out c --annexes",
    "table": "table site.xlsx --study out/study.json",
    "diff": "diff out/study.json b/what-if-study.json",
    "refused": "check refused.xlsx --annotate marked.xlsx",
}


def shorten_example():
    """The example with one of its rows, and narrow ranges that are soon searched."""
    tables = load_input_example()
    (row,) = (line for line in tables["rows"] if line["id"] == ROW)
    tables["rows"] = [{**row, "post_spacing": 4}]
    tables["declared"] = [{**tables["declared"][0], "row": ROW, "document": "EX-G7"}]
    narrow = {"density": 330, "friction_angle": 30, "inclination": 15}
    tables["project"] = [{**tables["project"][0], **narrow}]
    return tables


def spoil_site(language):
    """The site with a word in the place of a slope."""
    book = openpyxl.load_workbook("site.xlsx")
    book[load_plan("rows").name_in(language)]["B6"] = "4O"
    book.save("refused.xlsx")


def run_all(folder, language, patch):
    """What each command told, by its name; its files are in the folder."""
    patch.chdir(folder)
    Path("site.xlsx").write_bytes(render_input(shorten_example(), language))
    told = {}
    for name, line in COMMANDS.items():
        if name == "refused":
            spoil_site(language)
        words = line.format(rows=load_plan("rows").name_in(language)).split()
        told[name] = run([*words, "--language", language], patch)
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
