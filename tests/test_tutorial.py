"""The tutorial in three languages: each command is run, and prints what is printed."""

import re
import shlex
from pathlib import Path

import openpyxl
import pytest

from tests.each import each
from tests.program import call_program

FOLDER = Path(__file__).resolve().parent.parent / "netdesign"
WIDTH = "100"  # columns of the terminal of which the pages show the output
BLANKS = {0xA0: " ", 0x202F: " "}  # before French signs; pages have plain ones
# A block with its kind, a cell to be written, or the answer to a heading.
PART = re.compile(
    r"^```(?P<kind>\w+)(?: (?P<file>\S+))?\n(?P<text>.*?)^```$"
    r"|^\| `(?P<sheet>[^`!|]+)!(?P<cell>[A-Z]+\d+)` \| `(?P<value>[^`]+)` \|"
    r"|^\| `(?P<heading>[^`|]+)` \| `(?P<answer>[^`|]+)` \|$",
    re.DOTALL | re.MULTILINE,
)


def run(line, folder):
    """Output of a command; the number in its comment is its exit code."""
    command, _, comment = line.partition("#")
    program, *words = shlex.split(command)
    assert program == "netdesign"
    result = call_program(*words, cwd=folder, COLUMNS=WIDTH)
    code = re.search(r"\d+", comment)
    assert result.code == int(code[0] if code else 0), result.err
    lines = result.out.translate(BLANKS).splitlines()
    return [line.rstrip() for line in lines]


def find_missing(shown, printed):
    """Pieces of an excerpt that no output has.

    A line ``...`` stands for lines that are left out, ``…`` for a part of a line.
    """
    text = "\n".join(["", *printed, ""])
    pieces = re.split(r"^\.\.\.\n", shown, flags=re.MULTILINE)
    patterns = [re.escape(piece).replace("…", ".*") for piece in pieces]
    return [one for one in patterns if not re.search(f"\n{one}", text)]


def write_cell(path, part):
    """What the page says to write, as a number where it is one."""
    workbook = openpyxl.load_workbook(path)
    value = part["value"]
    is_number = re.fullmatch(r"\d+[.,]?\d*", value)
    typed = float(value.replace(",", ".")) if is_number else value
    workbook[part["sheet"]][part["cell"]] = typed
    workbook.save(path)


def answer(path, part):
    """Replace the question mark of a heading."""
    text = path.read_text(encoding="utf-8")
    asked = f'"{part["heading"]}" = "?"'
    assert asked in text
    told = asked.replace('"?"', f'"{part["answer"]}"')
    path.write_text(text.replace(asked, told), encoding="utf-8")


def follow(page, folder, left_out):
    """Do what a page says, in its order; the number of commands that were run."""
    text = (FOLDER / page).read_text(encoding="utf-8")
    printed, ran = [], 0
    for part in PART.finditer(text):
        if part["kind"] == "sh":
            lines = part["text"].splitlines()
            lines = [line for line in lines if not line.startswith(("#", *left_out))]
            printed = [one for line in lines for one in run(line, folder)]
            ran += len(lines)
        elif part["kind"] == "text":
            assert find_missing(part["text"], printed) == []
        elif part["file"]:
            (folder / part["file"]).write_text(part["text"], encoding="utf-8")
        elif part["sheet"]:
            (workbook,) = folder.glob("*.xlsx")
            write_cell(workbook, part)
        elif part["heading"]:
            (answers,) = folder.glob("*.map.toml")
            answer(answers, part)
    return ran


PAGES = ("TUTORIAL.md", "TUTORIAL.fr.md", "TUTORIAL.de.md")
COMMANDS = 9


@pytest.mark.long
@each("page", PAGES)
def test_a_tutorial_does_what_it_prints(page, tmp_path):
    """The new solve of the stored study, as long as all else, in English alone."""
    folder = tmp_path / page
    folder.mkdir()
    left_out = () if page == PAGES[0] else ("netdesign verify",)
    assert follow(page, folder, left_out) == COMMANDS - len(left_out)


def test_the_tutorials_say_the_same():
    english, *others = (list_parts(page) for page in PAGES)
    assert others == [english, english]


def list_parts(page):
    """Kinds of a page's blocks, headings, and places of its cells, in their order."""
    text = (FOLDER / page).read_text(encoding="utf-8")
    return [part["kind"] or part["cell"] or "answer" for part in PART.finditer(text)]
