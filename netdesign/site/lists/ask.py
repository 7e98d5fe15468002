"""Writes ``LIST.map.toml`` beside an office's own list: what each heading may mean.

A guess stands where a heading is a known name, apart from accents and signs, or where
a single name is alike. Else a question mark stands there, with the likeliest names.
"""

from __future__ import annotations

import json
import re
import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import islice
from pathlib import Path

from rapidfuzz.fuzz import token_sort_ratio

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
    UNANSWERED,
    has_no_part,
    is_allowable,
    list_unclear,
)
from netdesign.site.columns.fields import KNOWN_UNITS, normalise, split_heading
from netdesign.site.columns.office import load_columns, load_plan
from netdesign.site.headings import find_heading_unit, find_own_unit
from netdesign.site.lists.join import (
    find_list_unit,
    find_units,
    list_below,
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
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

_FIRST_LINES = 20  # in which headings stand
_LEAST_TEXTS = 3  # in a line of headings
_LEAST_KNOWN = 2  # headings that a sheet needs, to be read
_EXAMPLES = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadingGuess:
    """First answer to a heading, with its reason and other possible columns.

    Attributes
    ----------
    name : str
        Heading as the file names it.
    answer : str
        With a question mark where only an engineer knows.
    target : Target or None
        Column that the answer names.
    how : Message or None
        Reason for the answer.
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
        has known headings.
    """
    answers = read_list_map(path)
    if answers:
        text_format = declare_mark(text_format, answers)
    workbook = read_list(path, text_format)
    lines = [*_begin(path, answers, language)]
    count, is_known = 0, False
    for sheet in workbook.sheets:
        answered = answers.tables.get(sheet.name) if answers else None
        line = answered.headings_in_line if answered else find_heading_line(sheet)
        becomes = answered.becomes if answered else _find_kind(sheet, line)
        lines.append(f"[tables.{_quote(sheet.name)}]")
        if not becomes or not line:
            lines += [f'becomes = "{IGNORE}"', ""]
            continue
        table = answered or ListTable(becomes=becomes, headings_in_line=line)
        more, missing = _write_table(sheet, table, language)
        lines += more
        count, is_known = count + missing, True
    if not is_known:
        names = (column.field.name for column in load_columns("rows")[:3])
        accepted = say("list_map.headings", names=tuple(names))
        raise refuse_file(path.name, say("list_map.no_list"), accepted)
    return "\n".join(lines) + "\n", count


def is_own_list(path: Path, text_format: TextFormat) -> bool:
    """A workbook is an office's own: it lacks sheet Rows or Net types."""
    sheets = read_list(path, text_format).sheets
    plans = map(load_plan, ("rows", "net_types"))
    return not all(any(plan.matches(sheet.name) for sheet in sheets) for plan in plans)


def find_heading_line(sheet: Sheet) -> int:
    """Line of the headings: the one with the most known names, else the most texts."""
    lines = list(islice((n for n in sorted(sheet.rows) if sheet.row(n)), _FIRST_LINES))

    def rank(number: int) -> tuple[int, int]:
        texts = [
            cell.value for cell in sheet.row(number) if isinstance(cell.value, str)
        ]
        return sum(map(_is_name, texts)), len(texts)

    best = max(lines, key=rank, default=0)
    return best if best and rank(best)[1] >= _LEAST_TEXTS else 0


def _is_name(text: str) -> bool:
    return has_no_part(text) or split_heading(text)[0] in _list_names()


@cache
def _list_names() -> frozenset[str]:
    targets = (target for table in GROUPS for target in list_targets(table))
    return frozenset[str]().union(*(target.field.names for target in targets))


def _begin(path: Path, answers: ListMap | None, language: Language) -> Iterator[str]:
    for line in render(say("list_map.head", file=path.name), language).splitlines():
        yield f"# {line}".rstrip()
    yield f'schema = "{SCHEMA}"'
    yield f"list = {_quote(path.name)}"
    if answers and answers.decimal_mark:
        yield f'decimal_mark = "{answers.decimal_mark}"'
    yield ""


def _write_table(
    sheet: Sheet, table: ListTable, language: Language
) -> tuple[list[str], int]:
    """Answers to a sheet that is read, and how many of them are missing."""
    guesses = [
        replace(heading, answer=answer, how=None, ranked="")
        if not is_unanswered(answer := table.headings.get(heading.name, ""))
        else heading
        for heading in guess_headings(sheet, table, language)
    ]
    becomes = load_plan(table.becomes).name_in(language)
    lines = [
        f"becomes = {_quote(becomes)}",
        f"headings_in_line = {table.headings_in_line}",
    ]
    missing = 0
    for part, questions in (
        ("headings", _ask_headings(guesses, language)),
        ("words", _ask_words(sheet, table, guesses, language)),
        ("always", _ask_always(table, guesses, language)),
    ):
        if not questions and part != "headings":
            continue
        about = f"  # {render(say('list_map.always'), language)}"
        title = f"[tables.{_quote(sheet.name)}.{part}]"
        lines += ["", title + about if part == "always" else title]
        for key, (answer, comment) in questions.items():
            shown = f"  # {comment}" if comment else ""
            lines.append(f"{_quote(key)} = {_quote(answer)}{shown}")
            missing += is_unanswered(answer)
    return [*lines, ""], missing


def _find_kind(sheet: Sheet, line: int) -> str:
    """Table that a sheet becomes, by its name or by most of its headings."""
    own = find_table(sheet.name)
    if own:
        return own
    counts = {}
    for table in GROUPS:
        list_table = ListTable(becomes=table, headings_in_line=line)
        counts[table] = sum(
            heading.target is not None
            for heading in guess_headings(sheet, list_table, "en")
        )
    best = max(counts, key=lambda table: counts[table])
    return best if line and counts[best] >= _LEAST_KNOWN else ""


def guess_headings(
    sheet: Sheet, table: ListTable, language: Language
) -> Iterator[HeadingGuess]:
    """Guesses at all headings of a sheet; two that mean the same column are asked.

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
        below = list(islice((cell for cell in cells if not cell.is_blank), _EXAMPLES))
        unit, measure = find_list_unit(cell, units), find_heading_unit(cell)[1]
        targets = [
            target
            for target in list_targets(table.becomes)
            if target.has_unit(unit) and measure in ("", target.measure)
        ]
        heading = _guess(str(cell.value), unit, table.becomes, targets, below, language)
        shown = "; ".join(make_printable(cell.text) for cell in below)
        guesses.append(replace(heading, name=name, cells=shown))
    counts = Counter(
        heading.target.column.like for heading in guesses if heading.target is not None
    )
    for heading in guesses:
        count = counts[heading.target.column.like] if heading.target else 0
        if count > 1:
            how = say("list_map.twice", count=count, column=heading.answer)
            yield replace(heading, answer=UNANSWERED, target=None, how=how)
        else:
            yield heading


def _guess(
    text: str,
    unit: str,
    becomes: str,
    targets: Sequence[Target],
    below: Sequence[Cell],
    language: Language,
) -> HeadingGuess:
    """First answer to a heading, which may mean some columns by its unit."""
    if has_no_part(text):
        return HeadingGuess(answer=IGNORE, how=say("list_map.no_part"))
    ranked, alike = rank_targets(text, unit, targets)
    shown = (f"{target.title(language, unit)} {score:.0f}" for target, score in ranked)
    question = HeadingGuess(
        answer=UNANSWERED, how=say("list_map.unknown"), ranked=" · ".join(shown)
    )
    names = {split_heading(text)[0], normalise(text)}
    possible = [
        target for target in targets if not names.isdisjoint(target.field.names)
    ]
    if is_allowable(text) and not possible:  # "Zulassung" is a column's own name
        return replace(question, how=say("list_map.allowable"))
    how = say("list_map.known")
    if not possible and alike is not None:
        possible = [alike]
        how = say("list_map.alike", score=ranked[0][1])
    if len(possible) != 1 or _is_unclear(text, becomes):
        return question
    answer = _complete(possible[0], unit, below, language)
    return replace(question, answer=answer, target=possible[0], how=how)


# "N°" numbers the lines of a list, and is no glide factor N.
_NUMBER = re.compile(r"\w\s*[°º]")


def _is_unclear(text: str, becomes: str) -> bool:
    """Whether a heading may mean several columns."""
    if _NUMBER.fullmatch(text.strip()):
        return True
    own, bracket = split_heading(text)
    if not list_unclear(GROUPS[becomes][-1]).isdisjoint((normalise(text), own)):
        return True
    # behind a number a bracket is a unit, behind a word part of the name
    fields = [
        target.field for target in list_targets(becomes) if own in target.field.names
    ]
    is_word = bool(fields) and not any(field.units for field in fields)
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


def _ask_headings(guesses: Sequence[HeadingGuess], language: Language) -> _Asked:
    return {
        heading.name: (heading.answer, _explain(heading, language))
        for heading in guesses
    }


def _ask_words(
    sheet: Sheet, table: ListTable, guesses: Sequence[HeadingGuess], language: Language
) -> _Asked:
    """Texts of cells with their answers, or where a column of words lacks them."""
    asked = {text: (word, "") for text, word in table.words.items()}
    line = table.headings_in_line
    cells = dict(name_headings(sheet, line))
    for heading in guesses:
        target = read_answer(heading.answer, table.becomes).target
        if target is None or target.field.kind != "word":
            continue
        field, column = target.field, cells[heading.name].column
        accepted = render(field.accepted, language)
        below = (sheet.cell(row, column) for row in sheet.rows if row > line)
        for text in (cell.text.strip() for cell in below if not cell.is_blank):
            if text not in asked and not knows_word(field, text):
                asked[text] = UNANSWERED, f"{field.label_in(language)}: {accepted}"
    return asked


def _ask_always(
    table: ListTable, guesses: Sequence[HeadingGuess], language: Language
) -> _Asked:
    """Answers for columns that a list lacks: how pull-out resistances are proven."""
    keys = {heading.target.name for heading in guesses if heading.target}
    if table.always or "pull_out" not in keys or "proven" in keys:
        return {column: (text, "") for column, text in table.always.items()}
    target = next(
        target for target in list_targets(table.becomes) if target.name == "proven"
    )
    accepted = render(target.field.accepted, language)
    return {target.label(language): (UNANSWERED, accepted)}


def _explain(heading: HeadingGuess, language: Language) -> str:
    """Comment on an answer: its reason, other possible columns, its first cells."""
    how = render(heading.how, language) if heading.how else ""
    ranked = heading.ranked if UNANSWERED in heading.answer else ""
    cells = (
        render(say("map.cells", cells=heading.cells), language) if heading.cells else ""
    )
    return " ".join(" | ".join(filter(None, (how, ranked, cells))).split())


def _quote(text: str) -> str:
    return json.dumps(make_printable(text), ensure_ascii=False)


# Measured on 220 headings of eight lists: a wrong one reaches 83, a meaningless one 87,
# and two columns of ours are 90 alike.
_SURE, _APART = 92.0, 5.0
_LEAST, _MOST_LISTED = 40.0, 3
_WORD = re.compile(r"[^\W_]+")
_BRACKET = re.compile(r"[\[(][^\[\]()]*[\])]\s*$")


def rank_targets(
    text: str, unit: str, targets: Iterable[Target]
) -> tuple[list[tuple[Target, float]], Target | None]:
    """Rank columns by the likeness of a heading's words to their names.

    Parameters
    ----------
    text : str
        The heading as typed.
    unit : str
        Its unit; empty where it has none, which then excludes no column.
    targets : iterable of Target
        What it may mean.

    Returns
    -------
    list of Target and float, Target or None
        The likeliest columns with how alike they are, of 100; the column that may be
        taken, None where an engineer must decide.
    """
    plain = _list_words(_BRACKET.sub("", text) or text)
    scores = [
        (target, max(token_sort_ratio(plain, _list_words(name)) for name in names))
        for target in targets
        if target.has_unit(unit) and (names := target.field.raw_names)
    ]
    scores.sort(key=lambda scored: -scored[1])
    best, second = [*(score for _, score in scores), 0.0, 0.0][:2]
    is_sure = best >= _SURE and best - second >= _APART and not is_allowable(text)
    listed = [scored for scored in scores if scored[1] >= _LEAST]
    return listed[:_MOST_LISTED], scores[0][0] if is_sure else None


def _list_words(text: str) -> str:
    """Words without case and accents."""
    decomposed = unicodedata.normalize("NFKD", text.casefold())
    letters = "".join(sign for sign in decomposed if not unicodedata.combining(sign))
    return " ".join(_WORD.findall(letters))
