"""Writes ``LIST.map.toml`` beside an office's own list: what each heading may mean.

A guess stands where a name is known, whole or but for accents and signs, or is so like
one that no other comes near; else a question mark, with the likeliest behind it.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
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
    count, is_known = 0, False
    for sheet in workbook.sheets:
        known = given.tables.get(sheet.name) if given else None
        line = known.headings_in_line if known else find_heading_line(sheet)
        becomes = known.becomes if known else _find_kind(sheet, line)
        lines.append(f"[tables.{_quote(sheet.name)}]")
        if not becomes or not line:
            lines += [f'becomes = "{IGNORE}"', ""]
            continue
        table = known or ListTable(becomes=becomes, headings_in_line=line)
        more, missing = _write_table(sheet, table, language)
        lines += more
        count, is_known = count + missing, True
    if not is_known:
        names = (one.field.name for one in load_columns("rows")[:3])
        accepted = say("list_map.headings", names=tuple(names))
        raise refuse_file(path.name, say("list_map.no_list"), accepted)
    return "\n".join(lines) + "\n", count


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


@cache
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


def _write_table(
    sheet: Sheet, table: ListTable, language: Language
) -> tuple[list[str], int]:
    """Answers to a sheet that is read, and how many of them are missing."""
    guesses = [
        replace(one, answer=given, how=None, ranked="")
        if not is_unanswered(given := table.headings.get(one.name, ""))
        else one
        for one in guess_headings(sheet, table, language)
    ]
    becomes = load_plan(table.becomes).name_in(language)
    lines = [
        f"becomes = {_quote(becomes)}",
        f"headings_in_line = {table.headings_in_line}",
    ]
    missing = 0
    for part, asked in (
        ("headings", {x.name: (x.answer, _explain(x, language)) for x in guesses}),
        ("words", _ask_words(sheet, table, guesses, language)),
        ("always", _ask_always(table, guesses, language)),
    ):
        if not asked and part != "headings":
            continue
        about = f"  # {render(say('list_map.always'), language)}"
        title = f"[tables.{_quote(sheet.name)}.{part}]"
        lines += ["", title + about if part == "always" else title]
        for key, (answer, comment) in asked.items():
            shown = f"  # {comment}" if comment else ""
            lines.append(f"{_quote(key)} = {_quote(answer)}{shown}")
            missing += is_unanswered(answer)
    answered = [read_answer(one.answer, table.becomes).target for one in guesses]
    own = {one.place for one in answered if one is not None}
    for one in list_lacking(table.becomes, own):
        about = render(say("list_map.lacks", column=one.label(language)), language)
        lines.append(f"# {about}")
    return [*lines, ""], missing


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


_Asked = dict[str, tuple[str, str]]  # answers with a comment, by what they answer


def _ask_words(
    sheet: Sheet, table: ListTable, guesses: Sequence[HeadingGuess], language: Language
) -> _Asked:
    """Texts of cells that a column of words does not know, or that are answered."""
    asked = {text: (word, "") for text, word in table.words.items()}
    line = table.headings_in_line
    cells = dict(name_headings(sheet, line))
    for one in guesses:
        target = read_answer(one.answer, table.becomes).target
        if target is None or target.field.kind != "word":
            continue
        field, column = target.field, cells[one.name].column
        accepted = render(field.accepted, language)
        below = (sheet.cell(row, column) for row in sheet.rows if row > line)
        for text in (x.text.strip() for x in below if not x.is_blank):
            if text not in asked and not knows_word(field, text):
                asked[text] = UNANSWERED, f"{field.label_in(language)}: {accepted}"
    return asked


def _ask_always(
    table: ListTable, guesses: Sequence[HeadingGuess], language: Language
) -> _Asked:
    """What stands in every line though no heading says it: how a pull-out is proven."""
    keys = {one.target.key for one in guesses if one.target}
    if table.always or "pull_out" not in keys or "proven" in keys:
        return {column: (text, "") for column, text in table.always.items()}
    target = next(x for x in list_targets(table.becomes) if x.key == "proven")
    accepted = render(target.field.accepted, language)
    return {target.label(language): (UNANSWERED, accepted)}


def _explain(one: HeadingGuess, language: Language) -> str:
    """How an answer was found, what else the heading may mean, and its first cells."""
    how = render(one.how, language) if one.how else ""
    ranked = one.ranked if UNANSWERED in one.answer else ""
    cells = render(say("map.cells", cells=one.cells), language) if one.cells else ""
    return " ".join(" | ".join(filter(None, (how, ranked, cells))).split())


def _quote(text: str) -> str:
    return json.dumps(make_printable(text), ensure_ascii=False)
