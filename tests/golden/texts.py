"""What the page, the workbook and the Word file of a study say, line by line."""

import re
from html.parser import HTMLParser

import docx
from docx.table import Table

from tests.report.reading import read_workbook

BLOCKS = {
    *("p", "tr", "li", "dt", "dd", "caption", "figcaption", "summary", "text"),
    *("h1", "h2", "h3", "h4", "div", "section", "title"),
}
CELLS = {"td", "th"}
UNSEEN = {"style", "script"}
# Of the run, not of the site.
OF_THE_RUN = re.compile(
    r"\b[0-9a-f]{64}\b|2\d{3}-\d\d-\d\d(T[0-9:+]+)?|(?<=Libraries).*|(?<=Command).*"
)


class PageLines(HTMLParser):
    """Lines of a page, cells of a table beside one another."""

    def __init__(self, page):
        super().__init__()
        self.lines, self._open, self._section, self._unseen = [], [], "page", 0
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self._unseen += tag in UNSEEN
        if tag in BLOCKS:
            self._end()
        if tag == "section":
            self._section = dict(attrs).get("id", "page")

    def handle_endtag(self, tag):
        self._unseen -= tag in UNSEEN
        if tag in CELLS:
            self._open.append("|")
        elif tag in BLOCKS:
            self._end()

    def handle_data(self, data):
        if not self._unseen:
            self._open.append(data.replace("\u00ad", ""))

    def _end(self):
        if text := " ".join("".join(self._open).split()):
            self.lines.append(f"{self._section}: {text}")
        self._open = []


def read_texts(folder):
    """Lines of the three reports in a folder, without what is of the run."""
    read = {
        "page": PageLines((folder / "report.html").read_text("utf-8")).lines,
        "workbook": read_book((folder / "report.xlsx").read_bytes()),
        "word": read_word(folder / "report.docx"),
    }
    return {
        name: [OF_THE_RUN.sub("…", " ".join(line.split())) for line in lines]
        for name, lines in read.items()
    }


def read_book(content):
    return [
        f"{sheet.title}: " + " | ".join(map(state_cell, line)).rstrip(" |")
        for sheet in read_workbook(content)
        for line in sheet.iter_rows(values_only=True)
        if any(value is not None for value in line)
    ]


def state_cell(value):
    if value is None:
        return ""
    return f"{value:.9g}" if isinstance(value, float) else str(value)


def read_word(path):
    lines, heading = [], ""
    for part in docx.Document(path).iter_inner_content():
        if isinstance(part, Table):
            rows = ([cell.text for cell in row.cells] for row in part.rows)
            lines += [f"{heading}: " + " | ".join(cells) for cells in rows]
        elif part.text:
            heading = part.text if "eading" in part.style.name else heading
            lines.append(f"{heading}: {part.text}")
    return lines
