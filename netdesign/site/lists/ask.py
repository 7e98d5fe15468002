"""Writes ``LIST.map.toml`` beside an office's own list: what each heading may mean.

A guess stands where a name is known, whole or but for accents and signs, or is so like
one that no other comes near; else a question mark, with the likeliest behind it.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

from netdesign.edge.input_files import make_printable
from netdesign.site.cells.cells import (
    UNDECLARED,
    Cell,
    Sheet,
    TextFormat,
)
from netdesign.site.cells.findings import refuse_file
from netdesign.site.columns.all_tables import (
    IGNORE,
    SHEETS,
    UNANSWERED,
    has_no_part,
    is_allowable,
    list_unclear,
)
from netdesign.site.columns.fields import KNOWN_UNITS, normalise, split_heading
from netdesign.site.columns.office import load_columns, load_plan
from netdesign.site.lists.guess import guess
from netdesign.site.lists.join import (
    find_list_unit,
    find_units,
    list_below,
    list_lacking,
    name_headings,
)
from netdesign.site.lists.list_map import (
    SCHEMA,
    ListMap,
    ListTable,
    declare_mark,
    read_list,
    read_list_map,
)
from netdesign.site.lists.targets import (
    GROUPS,
    Target,
    find_table,
    is_unanswered,
    list_targets,
    read_answer,
)
from netdesign.site.readings import knows_word
from netdesign.site.titles import find_own_unit
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

_FIRST_LINES = 20  # in which headings stand
_LEAST_TEXTS = 3  # in a line of headings
_LEAST_KNOWN = 2  # of them, in a sheet that is read
_EXAMPLES = 3
_IGNORED = f'becomes = "{IGNORE}"'
_OLD = {"anchor_types": "Anchors", "tests": "Tests"} | dict.fromkeys(
    ("rows", "net_types"), "Nets"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadingGuess:
    """First answer to a heading, how it was found, and what else it may mean.

    Attributes
    ----------
    name : str
        Heading as the file names it.
    answer : str
        With a question mark where only an engineer knows.
    target : Target or None
        Column that the answer names.
    how : Message or None
        How it was found.
    ranked : str
        Likeliest columns, with how alike they are, of 100.
    cells : str
        The first cells below it.
    """

    name: str = ""
    answer: str
    target: Target | None = None
    how: Message | None = None
    ranked: str = ""
    cells: str = ""


def write_list_map(
    path: Path, text_format: TextFormat = UNDECLARED, language: Language = "en"
) -> tuple[str, int]:
    """Text of the file of answers to a list, and how many of them are missing.

    Parameters
    ----------
    path : Path
        The list; answers that stand beside it already are kept.
    text_format : TextFormat
        As for reading.
    language : str
        Of columns and comments.

    Raises
    ------
    SiteDataError
        If the list cannot be read at all, or a file of answers beside it; if no sheet
        has headings that are known.
    """
    given = read_list_map(path)
    if given:
        text_format = declare_mark(text_format, given)
    workbook = read_list(path, text_format)
    lines = [*_begin(path, given, language)]
    count = 0
    is_known = False
    for sheet in workbook.sheets:
        more, missing = _write_sheet(sheet, given, language)
        is_known = is_known or _IGNORED not in more
        lines += more
        count += missing
    if not is_known:
        names = (one.field.name for one in load_columns("rows")[:3])
        accepted = say("list_map.headings", names=tuple(names))
        raise refuse_file(path.name, say("list_map.no_list"), accepted)
    return "\n".join(lines) + "\n", count


# A line of the file whose answer has a question mark, one that was left before too.
_OPEN = re.compile(r'^(?:"(?:[^"\\]|\\.)*"|\w+) = "(?:[^"\\]|\\.)*\?', re.MULTILINE)


def is_open(line: str) -> bool:
    """A line of a file of answers waits for an answer."""
    return _OPEN.match(line) is not None


def is_own_list(path: Path, text_format: TextFormat) -> bool:
    """A workbook is an office's own: it lacks sheets or most headings of a template."""
    sheets = read_list(path, text_format).sheets
    for plan in map(load_plan, ("rows", "net_types")):
        if not any(plan.matches(sheet.name) for sheet in sheets):
            return True
    cells = (cell for sheet in sheets for cell in sheet.row(find_heading_line(sheet)))
    names = [split_heading(str(cell.value))[0] for cell in cells]
    known = sum(name in _list_template_names() for name in names)
    return 2 * known < len(names)


def _list_template_names() -> frozenset[str]:
    return frozenset(
        normalise(names[0])
        for plan in (*SHEETS, *map(load_plan, GROUPS))
        for field in plan.fields
        for names in field.headings.values()
        if names
    )


def find_heading_line(sheet: Sheet) -> int:
    """Line of the headings: that with the most known, else with the most texts."""
    lines = list(islice((n for n in sorted(sheet.rows) if sheet.row(n)), _FIRST_LINES))

    def rank(number: int) -> tuple[int, int]:
        texts = [one.value for one in sheet.row(number) if isinstance(one.value, str)]
        return sum(map(_is_name, texts)), len(texts)

    best = max(lines, key=rank, default=0)
    return best if best and rank(best)[1] >= _LEAST_TEXTS else 0


def _is_name(text: str) -> bool:
    return has_no_part(text) or split_heading(text)[0] in _list_names()


def _list_names() -> frozenset[str]:
    targets = (one for table in GROUPS for one in list_targets(table))
    return frozenset[str]().union(*(one.field.names for one in targets))


def _begin(path: Path, given: ListMap | None, language: Language) -> Iterator[str]:
    for line in render(say("list_map.head", file=path.name), language).splitlines():
        yield f"# {line}".rstrip()
    yield f'schema = "{SCHEMA}"'
    yield f"list = {_quote(path.name)}"
    if given and given.decimal_mark:
        yield f'decimal_mark = "{given.decimal_mark}"'
    yield ""


def _write_sheet(
    sheet: Sheet, given: ListMap | None, language: Language
) -> tuple[list[str], int]:
    """Table of a sheet, and how many answers are missing."""
    known = given.tables.get(sheet.name) if given else None
    line = known.headings_in_line if known else find_heading_line(sheet)
    becomes = known.becomes if known else _find_kind(sheet, line)
    place = f"tables.{_quote(sheet.name)}"
    lines = [f"[{place}]"]
    if not becomes or not line:
        return [*lines, _IGNORED, ""], 0
    table = ListTable(becomes=becomes, headings_in_line=line)
    guesses = list(guess_headings(sheet, table, language))
    old = known.headings if known else {}
    guesses = [_keep(one, old) for one in guesses]
    lines.append(f"becomes = {_quote(load_plan(becomes).name_in(language))}")
    lines.append(f"headings_in_line = {line}")
    lines += ["", f"[{place}.headings]", *(_show(one, language) for one in guesses)]
    if words := list(_ask_words(sheet, table, guesses, known, language)):
        lines += ["", f"[{place}.words]", *words]
    always = _ask_always(guesses, known, becomes, language)
    if always:
        about = render(say("list_map.always"), language)
        lines += ["", f"[{place}.always]  # {about}", *always]
    answered = [read_answer(one.answer, becomes).target for one in guesses]
    own = {one.place for one in answered if one is not None}
    for one in list_lacking(becomes, own):
        about = render(say("list_map.lacks", column=one.label(language)), language)
        lines.append(f"# {about}")
    return [*lines, ""], sum(map(is_open, lines))


def _find_kind(sheet: Sheet, line: int) -> str:
    """Table that a sheet becomes, by its name or by most of its headings."""
    own = find_table(sheet.name)
    if own:
        return own
    counts = {}
    for table in GROUPS:
        of = ListTable(becomes=table, headings_in_line=line)
        counts[table] = sum(
            x.target is not None for x in guess_headings(sheet, of, "en")
        )
    best = max(counts, key=lambda one: counts[one])
    return best if line and counts[best] >= _LEAST_KNOWN else ""


def guess_headings(
    sheet: Sheet, table: ListTable, language: Language
) -> Iterator[HeadingGuess]:
    """Guesses at all headings of a sheet; two of one column are questions.

    Parameters
    ----------
    sheet, table : Sheet, ListTable
        The sheet, and what becomes of it.
    language : str
        Of the answers.
    """
    line = table.headings_in_line
    units = find_units(sheet, line)
    rows = list_below(sheet, line)[1 if units else 0 :]
    guesses = []
    for name, cell in name_headings(sheet, line):
        cells = (sheet.cell(row, cell.column) for row in rows)
        below = list(islice((x for x in cells if not x.is_blank), _EXAMPLES))
        unit = find_list_unit(cell, units)
        guessed = _guess(str(cell.value), unit, table.becomes, below, language)
        shown = "; ".join(make_printable(x.text) for x in below)
        guesses.append(replace(guessed, name=name, cells=shown))
    counts = Counter(x.target.place for x in guesses if x.target is not None)
    for guessed in guesses:
        count = counts[guessed.target.place] if guessed.target else 0
        if count > 1:
            how = say("list_map.twice", count=count, column=guessed.answer)
            yield replace(guessed, answer=UNANSWERED, target=None, how=how)
        else:
            yield guessed


def _guess(
    text: str, unit: str, becomes: str, below: Sequence[Cell], language: Language
) -> HeadingGuess:
    """First answer to one heading."""
    if has_no_part(text):
        return HeadingGuess(answer=IGNORE, how=say("list_map.no_part"))
    targets = [one for one in list_targets(becomes) if one.has_unit(unit)]
    ranked, alike = guess(text, unit, targets)
    shown = (f"{one.title(language, unit)} {score:.0f}" for one, score in ranked)
    question = HeadingGuess(
        answer=UNANSWERED, how=say("list_map.unknown"), ranked=" · ".join(shown)
    )
    if is_allowable(text):
        return replace(question, how=say("list_map.allowable"))
    names = {split_heading(text)[0], normalise(text)}
    known = [one for one in targets if not names.isdisjoint(one.field.names)]
    how = say("list_map.known")
    if not known and alike is not None:
        known = [alike]
        how = say("list_map.alike", score=ranked[0][1])
    if len(known) != 1 or _is_unclear(text, becomes):
        return question
    answer = _complete(known[0], unit, below, language)
    return replace(question, answer=answer, target=known[0], how=how)


# "N°" numbers the lines of a list, and is no glide factor N.
_NUMBER = re.compile(r"\w\s*[°º]")


def _is_unclear(text: str, becomes: str) -> bool:
    """A heading is known to mean several things."""
    if _NUMBER.fullmatch(text.strip()):
        return True
    own, bracket = split_heading(text)
    if not list_unclear(_OLD[becomes]).isdisjoint((normalise(text), own)):
        return True
    # behind a number a bracket is a unit, behind a word part of the name
    named = [x.field for x in list_targets(becomes) if own in x.field.names]
    is_word = bool(named) and not any(one.units for one in named)
    return is_word and bracket not in ("", *KNOWN_UNITS)


def _complete(
    target: Target, unit: str, below: Sequence[Cell], language: Language
) -> str:
    """Answer with the unit, where the list does not say it."""
    field = target.field
    label = target.label(language)
    unit = unit or find_own_unit(list(below), field)
    has_none = field.unit in ("", "-") or unit
    if target.measure:
        return f"{label} [{target.measure_in(language, unit or UNANSWERED)}]"
    return label if has_none else f"{label} [{UNANSWERED}]"


def _keep(one: HeadingGuess, given: Mapping[str, str]) -> HeadingGuess:
    """Guess whose answer was given before."""
    answer = given.get(one.name, "")
    if is_unanswered(answer):
        return one
    return replace(one, answer=answer, how=None, ranked="")


def _ask_words(
    sheet: Sheet,
    table: ListTable,
    guesses: Sequence[HeadingGuess],
    known: ListTable | None,
    language: Language,
) -> Iterator[str]:
    """Texts of cells that a column of words does not know, or that are answered."""
    given = known.words if known else {}
    yield from (f"{_quote(one)} = {_quote(text)}" for one, text in given.items())
    line = table.headings_in_line
    cells = dict(name_headings(sheet, line))
    asked = set(given)
    for one in guesses:
        target = read_answer(one.answer, table.becomes).target
        if target is None or target.field.kind != "word":
            continue
        field, column = target.field, cells[one.name].column
        accepted = render(field.accepted, language)
        below = (
            sheet.cell(row, column)
            for row in sheet.rows
            if row > table.headings_in_line
        )
        for text in dict.fromkeys(x.text.strip() for x in below if not x.is_blank):
            if text not in asked and not knows_word(field, text):
                asked.add(text)
                about = f"{field.label_in(language)}: {accepted}"
                yield f"{_quote(text)} = {_quote(UNANSWERED)}  # {about}"


def _ask_always(
    guesses: Sequence[HeadingGuess],
    known: ListTable | None,
    becomes: str,
    language: Language,
) -> list[str]:
    """What stands in every line though no heading says it: how a pull-out is proven."""
    given, about = dict(known.always) if known else {}, ""
    keys = {one.target.key for one in guesses if one.target}
    if "pull_out" in keys and "proven" not in keys and not given:
        target = next(x for x in list_targets(becomes) if x.key == "proven")
        given[target.label(language)] = UNANSWERED
        words = tuple(map(target.field.name_word, target.field.words))
        about = f"  # {render(say('accepted.words', words=words), language)}"
    return [f"{_quote(one)} = {_quote(text)}{about}" for one, text in given.items()]


def _show(one: HeadingGuess, language: Language) -> str:
    """Line of the file: heading, answer, and how it was found."""
    how = render(one.how, language) if one.how else ""
    ranked = one.ranked if UNANSWERED in one.answer else ""
    cells = render(say("map.cells", cells=one.cells), language) if one.cells else ""
    about = " | ".join(filter(None, (how, ranked, cells)))
    line = f"{_quote(one.name)} = {_quote(one.answer)}"
    return f"{line}  # {' '.join(about.split())}" if about else line


def _quote(text: str) -> str:
    return json.dumps(make_printable(text), ensure_ascii=False)
