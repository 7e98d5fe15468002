"""Fills in a file of answers to an office's list by what its headings mean."""

import json
import re
import tomllib

from netdesign.site.cells.cells import UNDECLARED
from netdesign.site.lists.ask import write_list_map
from netdesign.site.lists.list_map import name_map
from netdesign.site.lists.targets import find_table, list_targets

ALWAYS = {"de": "kleinster Versuch", "fr": "minimum d'essais", "en": "least of tests"}
WORDS = {"câble": "ancrage à câble"}  # as the input workbook says it
_OPEN = re.compile(r'("(?:[^"\\]|\\.)*") = "[^"]*\?[^"]*"')
_ANSWERED = {}  # by list
_UNIT = re.compile(r"\[(cm)\]")


def name_target(target):
    """Column as `offices` names it."""
    return f"{target.field.table}.{target.name}"


def find_target(becomes, meaning):
    """Column of a meaning."""
    return next(x for x in list_targets(becomes) if name_target(x) == meaning)


def answer_list(office, path):
    """Write the file of answers beside a list, with every question answered.

    Words of cells are asked about once it is known what their column is.
    """
    known = repr(office)
    for _ in range(1 if known in _ANSWERED else 2):
        text = _ANSWERED.get(known) or _answer_once(office, path)
        name_map(path).write_text(text, encoding="utf-8")
    _ANSWERED[known] = text
    return name_map(path)


def _answer_once(office, path):
    text, _ = write_list_map(path, UNDECLARED, office.language)
    tables = tomllib.loads(text)["tables"]
    sheets = {one.name: one for one in office.sheets}
    lines, name = [], ""
    for line in text.splitlines():
        found = re.match(r'\[tables\.("(?:[^"\\]|\\.)*")', line)
        name = json.loads(found[1]) if found else name
        asked = _OPEN.match(line)
        if asked:
            heading = json.loads(asked[1])
            becomes = find_table(tables[name]["becomes"])
            given = find_answer(sheets[name], heading, becomes, office.language)
            line = f"{asked[1]} = {json.dumps(given, ensure_ascii=False)}"
        lines.append(line)
    return "\n".join(lines) + "\n"


def find_answer(sheet, heading, becomes, language):
    """Answer to a heading, or to what stands in every line."""
    meaning = sheet.headings.get(heading)
    if meaning is None:
        return WORDS.get(heading, ALWAYS[language])
    if meaning in ("ask", "ignore"):
        return "ignore"
    unit = _UNIT.search(heading)
    target = find_target(becomes, meaning)
    return target.title(language, unit[1] if unit else "")
