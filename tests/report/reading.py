"""Readers for the tests: what a stranger's program finds in the outputs."""

import io
import re
import warnings
import zipfile
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path

import openpyxl
from openpyxl.worksheet.worksheet import Worksheet

from tests.programs import convert


class PageReader(HTMLParser):
    """Tags, tables by section and text of a page."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.ids: list[str] = []
        self.tables: dict[str, list[list[list[str]]]] = {}
        self.text: list[str] = []
        self._section = ""
        self._cell: list[str] | None = None
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        known = dict(attrs)
        if "id" in known:
            self.ids.append(known["id"])
        if tag == "section":
            self._section = known["id"]
        tables = self.tables.setdefault(self._section, [])
        if tag == "table":
            tables.append([])
        elif tag == "tr":
            tables[-1].append([])
        elif tag in ("td", "th"):
            self._cell = []

    def handle_endtag(self, tag):
        if tag in ("td", "th"):
            cell = " ".join(" ".join(self._cell).split())
            self.tables[self._section][-1][-1].append(cell)
            self._cell = None

    def handle_data(self, data):
        data = data.replace("\u00ad", "")  # where a word may be broken
        self.text.append(data)
        if self._cell is not None:
            self._cell.append(data)


def read_workbook(content: bytes, *, formulas: bool = False) -> openpyxl.Workbook:
    """Workbook with cached values, or with formulas."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # openpyxl does not know data bars of 2010
        return openpyxl.load_workbook(io.BytesIO(content), data_only=not formulas)


def read_rows(sheet: Worksheet, head: str) -> list[dict[str, object]]:
    """Rows below the line whose first cell is ``head``, by heading."""
    lines = [list(line) for line in sheet.iter_rows(values_only=True)]
    start = next(i for i, line in enumerate(lines) if line[0] == head)
    rows = []
    for line in lines[start + 1 :]:
        if line[0] is None:
            break
        named = zip(lines[start], line, strict=True)
        rows.append({name: value for name, value in named if name is not None})
    return rows


@dataclass(frozen=True)
class ShownCheck:
    """A check on its sheet: its texts, its utilisation, lines of its steps."""

    line: int
    row: str
    name: str
    verdict: str
    told: str  # reason, clause, case
    resistance: str
    used: tuple[object, object, object]  # low, value, high
    steps: dict[str, int]


def read_checks(content: bytes, name: str = "Checks") -> list[ShownCheck]:
    """Checks in their order, with the lines of the steps that they read."""
    sheet = read_workbook(content)[name]
    live = read_workbook(content, formulas=True)[name]
    checks: list[ShownCheck] = []
    for line, cells in enumerate(sheet.iter_rows(min_row=5, values_only=True), 5):
        row, check, verdict, first, *_ = cells
        if row:
            told = sheet[f"B{line + 1}"].value
            texts = (row, check, verdict, told or "", cells[10] or "")
            checks.append(ShownCheck(line, *texts, cells[6:9], {}))
        elif first:
            checks[-1].steps[first] = line
    for shown in checks:
        lines = [shown.line, *shown.steps.values()]
        for line in lines:  # it grows: cells that a formula reads stand above
            formulas = " ".join(x.value for x in live[line] if x.data_type == "f")
            read = {int(number) for number in re.findall(r"\b[GHI](\d+)\b", formulas)}
            lines += sorted(read - {*lines})
        shown.steps.update({sheet[f"D{line}"].value: line for line in lines[1:]})
    return checks


def recalculate(books: dict[str, bytes], folder: Path) -> dict[str, bytes]:
    """Workbooks by name after LibreOffice filled in every formula; skips without it.

    All in one run: most of its time goes into the start.
    """
    (folder / "in").mkdir()
    sources = [folder / "in" / f"{name}.xlsx" for name in books]
    for source, content in zip(sources, books.values(), strict=True):
        source.write_bytes(_strip_cached(content))
    convert("xlsx", folder / "out", *sources)
    return {path.stem: (folder / "out" / path.name).read_bytes() for path in sources}


def _strip_cached(content: bytes) -> bytes:
    """The same workbook without the stored results of its formulas."""
    buffer = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(content)) as source,
        zipfile.ZipFile(buffer, "w") as target,
    ):
        for name in source.namelist():
            text = source.read(name)
            if name.startswith("xl/worksheets/sheet"):
                text = re.sub(rb"</f><v>[^<]*</v>", b"</f>", text)
            target.writestr(name, text)
    return buffer.getvalue()
