"""The theory pages against each other and against the code that cites them.

A page has one letter for its formulas; they ascend. Whatever cites a formula, a section
or a constant finds it, and a constant has the value that the page prints.
"""

import ast
import dataclasses
import importlib
import io
import re
import tokenize
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import netdesign
from tests.each import each

PACKAGE = Path(netdesign.__file__).parent
ROOT = PACKAGE.parent
# In these rooms every word like a label is one.
NUMERICAL = (
    *("numerics", "snow", "cable", "structure", "coupling"),
    *("resistance", "guideline", "checks", "panel", "evidence/verification/planview"),
    *("snowpack", "winter"),
)
ELEMENTS = {"P1", "P2"}  # finite elements, not labels

LABEL = r"[A-Z]\d{1,2}[a-z]?"
# A formula has its label at its end, or in front.
DEFINED = re.compile(rf"^ {{4,}}(?=\S)(?:.*\(({LABEL})\)$|\(({LABEL})\) )", re.M)
WORD = re.compile(rf"(?<![\w.!›'\"])({LABEL})(?![\w.]*\w)")
IN_BRACKETS = re.compile(rf"\(({LABEL})\)|THEORY\.md,? \(?({LABEL})")
WITH_PAGE = re.compile(rf"(\w+)/THEORY\.md,?\s+(?:eqs?\.?\s+)?\(?({LABEL})")
SECTION = re.compile(r"(?:(\w+(?:/\w+)*)\.md,?\s+)?\b[Ss]ection\s+(\d+)")
FILE = re.compile(r"`(?:\w+/)*(\w+\.py)`")
NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"
CONSTANT = re.compile(
    rf"`((?:\w+\.)?_?[A-Z][A-Z\d_]+(?:\.[a-z_]+)?|[A-Z][a-z]\w+\.[a-z_]+)`"
    rf"(?:\s+=\s+({NUMBER}))?"
)

PAGES = {
    path.parent.name: path.read_text(encoding="utf-8")
    for path in sorted(PACKAGE.rglob("THEORY.md"))
}
SOURCES = {
    path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8")
    for folder in (PACKAGE, ROOT / "tests")
    for path in sorted(folder.rglob("*.py"))
    if path != Path(__file__)
}


def defined(page: str) -> list[str]:
    """Labels of a page's formulas, in their order."""
    return [end or front for end, front in DEFINED.findall(page)]


def rank(label: str) -> tuple[int, str]:
    number, suffix = re.fullmatch(r"[A-Z](\d+)([a-z]?)", label).groups()
    return int(number), suffix


def strays(labels: list[str]) -> list[tuple[str, str]]:
    """Neighbours that do not ascend by one, or by a letter."""
    return [
        (before, after)
        for before, after in pairwise(labels)
        if not (
            rank(after) == (rank(before)[0] + 1, "")
            or rank(after) == (rank(before)[0], chr(ord(rank(before)[1] or "`") + 1))
        )
    ]


FACTS = (ROOT / "tests" / "verification" / "FACTS.md").read_text(encoding="utf-8")
WITH_SECTIONS = {**PAGES, "FACTS": FACTS}

LABELS = {label for page in PAGES.values() for label in defined(page)}
LETTER = {room: defined(page)[0][0] for room, page in PAGES.items()}


def read_prose(source: str) -> Iterator[str]:
    """Comments and docstrings of a module."""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            yield token.string
    documented = ast.Module | ast.ClassDef | ast.FunctionDef
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, documented):
            yield ast.get_docstring(node) or ""


def list_cited(prose: str, *, every_word: bool) -> set[str]:
    """Labels that a text cites."""
    pattern = WORD if every_word else IN_BRACKETS
    groups = (match.groups() for match in pattern.finditer(prose))
    return {label for group in groups for label in group if label} - ELEMENTS


def list_misplaced(prose: str) -> list[tuple[str, str]]:
    """Labels that are cited from another page than theirs."""
    return [
        (room, label)
        for room, label in WITH_PAGE.findall(prose)
        if LETTER.get(room) != label[0]
    ]


def list_lost_sections(prose: str, own: str = "") -> list[tuple[str, str]]:
    """Sections that the page cited, or else the text's own, does not have."""
    cited = [
        (page.removesuffix("/THEORY").rpartition("/")[2] or own, number)
        for page, number in SECTION.findall(prose)
    ]
    return [
        (page, number)
        for page, number in cited
        if page and not re.search(rf"^## {number}\b", WITH_SECTIONS.get(page, ""), re.M)
    ]


def find_values(name: str, room: str) -> list[Any]:
    """What a constant is in the modules of a room that define it, else in all."""
    *owner, last = name.split(".")
    wanted, field = (last, "") if last.isupper() else (owner.pop(), last)
    values = []
    for place, source in SOURCES.items():
        folder, _, stem = place.removesuffix(".py").rpartition("/")
        rooms = folder.split("/")
        is_elsewhere = room and ("netdesign" not in rooms or room not in rooms)
        if is_elsewhere or (owner and owner != [stem]):
            continue
        if wanted not in top_names(source):
            continue
        module = importlib.import_module(f"{folder}/{stem}".replace("/", "."))
        values.append(read_field(getattr(module, wanted), field))
    return values or (find_values(name, "") if room else [])


def read_field(value: Any, field: str) -> Any:
    """The value, its attribute, or the default of a dataclass."""
    if not field:
        return value
    if isinstance(value, type):
        return {one.name: one.default for one in dataclasses.fields(value)}[field]
    return getattr(value, field)


def top_names(source: str) -> set[str]:
    """Names that a module defines."""
    names = set()
    for node in ast.parse(source).body:
        if isinstance(node, ast.ClassDef):
            names.add(node.name)
        targets = node.targets if isinstance(node, ast.Assign) else []
        targets += [node.target] if isinstance(node, ast.AnnAssign) else []
        for target in targets:
            names |= {one.id for one in ast.walk(target) if isinstance(one, ast.Name)}
    return names


@each("room", PAGES)
def test_a_page_has_a_letter_of_its_own(room):
    (letter,) = {label[0] for label in defined(PAGES[room])}
    assert [other for other in PAGES if LETTER[other] == letter] == [room]


@each("room", PAGES)
def test_labels_ascend(room):
    labels = defined(PAGES[room])
    assert len(labels) >= 2
    assert rank(labels[0]) in ((0, ""), (1, ""))
    assert strays(labels) == []


@each("room", PAGES)
def test_a_page_cites_what_there_is(room):
    page = PAGES[room]
    assert list_cited(page, every_word=True) - LABELS == set()
    assert list_misplaced(page) == []
    assert list_lost_sections(page, room) == []
    names = {Path(place).name for place in SOURCES}
    assert set(FILE.findall(page)) - names == set()


@each("place", SOURCES)
def test_code_and_tests_cite_what_there_is(place):
    is_numerical = place.startswith(tuple(f"netdesign/{room}/" for room in NUMERICAL))
    for prose in read_prose(SOURCES[place]):
        cited = list_cited(prose, every_word=is_numerical)
        assert cited - LABELS == set(), prose
        assert list_misplaced(prose) == [], prose
        assert list_lost_sections(prose) == [], prose


def test_tables_of_the_verification_cite_what_there_is():
    page = (ROOT / "tests" / "verification" / "README.md").read_text(encoding="utf-8")
    assert list_cited(page, every_word=False) - LABELS == set()


def test_every_file_of_the_verification_has_its_table():
    folder = ROOT / "tests" / "verification"
    page = (folder / "README.md").read_text(encoding="utf-8")
    named = re.findall(r"^\| \*\*(test_\w+\.py)\*\* \|", page, re.M)
    assert sorted(named) == sorted(path.name for path in folder.glob("test_*.py"))


@each("room", PAGES)
def test_constants_are_what_the_page_says(room):
    for name, printed in CONSTANT.findall(PAGES[room]):
        values = find_values(name, room)
        assert values, name
        if printed:
            assert values == [float(printed)], name


def test_the_pages_do_name_constants():
    """Otherwise the test above would pass on nothing."""
    printed = {
        room: [value for _, value in CONSTANT.findall(page) if value]
        for room, page in PAGES.items()
    }
    assert len(printed["snow"]) >= 10
    assert len(printed["coupling"]) >= 20
    assert len(printed["cable"]) >= 3


def test_a_wrong_label_is_found():
    page = (
        "\n    a = b      (N1)\n    c = d, e = f   (N2)\n\n    (N2b)  g = h\n    (N4)\n"
    )
    assert defined(page) == ["N1", "N2", "N2b", "N4"]
    assert strays(["N1", "N2", "N2a", "N2b", "N3"]) == []
    assert strays(["N1", "N1"]) == [("N1", "N1")]
    assert strays(["N2", "N2b"]) == [("N2", "N2b")]
    assert strays(["N2", "N4"]) == [("N2", "N4")]


def test_a_citation_that_leads_nowhere_is_found():
    text = "snow/THEORY.md, eqs (N1) to (N95) and cable/THEORY.md, N96. See F9, P1."
    assert list_cited(text, every_word=True) - LABELS == {"N95", "N96", "F9"}
    assert list_cited(text, every_word=False) - LABELS == {"N95", "N96"}
    assert list_misplaced(text) == [("cable", "N96")]
    assert list_lost_sections("coupling/THEORY.md, section 6; section 9") == []
    assert list_lost_sections("snow/THEORY.md, section 9") == [("snow", "9")]
    assert list_lost_sections("section 9", own="snow") == [("snow", "9")]
    assert list_lost_sections("tests/FACTS.md, section 9", own="snow") == []
    assert list_lost_sections("FACTS.md, " + "section 99") == [("FACTS", "99")]


def test_a_constant_that_is_none_is_found():
    assert find_values("PATIENCE", "snow") == [12]
    assert find_values("interface._ROUNDING", "snow") == [1e-9]
    assert find_values("SolverSettings.balance_tolerance", "coupling") == [1e-8]
    assert find_values("_NO_SUCH_THING", "snow") == []
    assert len(find_values("_ROUNDING", "cable")) > 1  # needs its module's name
