"""Basis of a report: scope, limit profile, inputs, notes, conditions, names of rows."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from netdesign.checks.check import Check
from netdesign.outcome import Outcome
from netdesign.report.blocks import (
    Block,
    Cell,
    Items,
    Pair,
    Pairs,
    Paragraph,
    Part,
    Table,
    given_cell,
    key_columns,
    name_columns,
    section,
    symbols,
    text_cell,
)
from netdesign.report.sections.schedule import show_tests
from netdesign.report.words import (
    MISSING,
    Words,
    name_heading,
    show_own,
    show_text,
    show_unit,
    understand,
)
from netdesign.site.model import InputEcho
from netdesign.study.records import ProfileRecord, RowStudy, Study
from netdesign.study.to_do import ToDo
from netdesign.words.catalogue import name
from netdesign.words.message import Message, say


def build_inputs(study: Study, words: Words) -> Table:
    """Inputs as understood: what all net rows share once, else a column for each row.

    A number that was typed in another way stands behind it: ``14 % → 0.05``, with the
    formula as a note.
    """
    shown: dict[tuple[str, str], dict[str, Cell]] = {}
    ids = [row.id for row in study.rows]
    places = [
        (ids, study.range_inputs),
        *(([row.id], row.inputs) for row in study.rows),
    ]
    for names, inputs in places:
        for echo in inputs:
            key = (_name_input(echo, words), show_unit(echo.unit))
            cell = _input_cell(echo, words)
            if echo.label != _NAME and cell.text != MISSING:
                shown.setdefault(key, {}).update(dict.fromkeys(names, cell))
    return Table(
        caption=words("heading.typed_and_understood"),
        columns=(
            *key_columns(words, "heading.", ("input", "unit", "in_all_rows")),
            *name_columns([show_text(row_id) for row_id in ids], numbers=()),
        ),
        rows=tuple(
            (text_cell(label), Cell(text=unit), *_share_cells(ids, cells))
            for (label, unit), cells in shown.items()
        ),
        empty=words("show.none"),
    )


def _name_input(echo: InputEcho, words: Words) -> str:
    """Name of an input; that of a row's end says so."""
    label = words.show(echo.label)
    is_of_end = isinstance(echo.label, Message) and echo.label.key.startswith(_ENDS)
    return words.join((label, words("heading.at_end"))) if is_of_end else label


def _share_cells(ids: Sequence[str], cells: Mapping[str, Cell]) -> list[Cell]:
    """A cell for all rows where their inputs are alike; else that of each row."""
    first, *others = (cells.get(row_id, Cell(text=MISSING)) for row_id in ids)
    if others and all(other == first for other in others):
        return [first, *(Cell() for _ in ids)]
    return [Cell(), first, *others]


def _input_cell(echo: InputEcho, words: Words) -> Cell:
    cell = given_cell(words, understand(echo, words))
    typed = words.write_formula(show_text(echo.text))
    note = words.show(echo.derivation) if echo.derivation else ""
    is_same = _PLAIN.fullmatch(typed) and float(typed.replace(",", ".")) == cell.number
    if cell.number is None or not echo.text or is_same or typed == cell.text:
        return replace(cell, note=note)
    return Cell(text=f"{typed} → {words.show_share(cell.number)}", note=note)


_PLAIN = re.compile(r"-?\d+([.,]\d+)?")  # number of a cell, whose text may be ours
_ASSUMED = "assumed"  # status of a value that is not confirmed


def show_profile(study: Study, words: Words) -> Part:
    """Annex with the values of the profile; sources that recur have numbers."""
    numbered, sources = _number_sources(build_profile(study, words))
    return section(
        "annex-profile",
        words("heading.annex_profile"),
        Paragraph(text=name_profile(study, words)),
        numbered.shown("profile"),
        *(Paragraph(text=source, look="small") for source in sources),
    )


def build_profile(study: Study, words: Words) -> Table:
    """Values of the limit profile."""
    keys = ("clause", "value_of", "value", "unit", "status", "source")
    return Table(
        caption=words("caption.every_value"),
        columns=key_columns(words, "heading.", keys, numbers=("value",)),
        rows=tuple(
            (
                text_cell(value.clause),
                text_cell(show_own(words, value.text)),
                given_cell(words, value.value),
                text_cell(show_unit(value.unit)),
                text_cell(words.show(name("status", value.status))),
                text_cell(show_own(words, value.source)),
            )
            for value in study.profile.values
        ),
        empty=words("show.none"),
    )


def _number_sources(table: Table) -> tuple[Table, tuple[str, ...]]:
    """The table with a number for each source, and the sources below it."""
    sources = dict.fromkeys(cells[-1].text for cells in table.rows)
    numbers = {source: f"[{k}]" for k, source in enumerate(sources, 1)}
    rows = tuple(
        (*cells[:-1], text_cell(numbers[cells[-1].text])) for cells in table.rows
    )
    texts = tuple(f"{number} {source}" for source, number in numbers.items())
    return replace(table, rows=rows), texts


def name_profile(study: Study, words: Words) -> str:
    """Title and edition of the limit profile."""
    return show_own(words, f"{study.profile.title}, {study.profile.edition}")


def count_assumed(study: Study) -> tuple[int, int]:
    """Number of unconfirmed values of the profile, and of all its values."""
    values = study.profile.values
    return sum(value.status == _ASSUMED for value in values), len(values)


def list_odd_values(profile: ProfileRecord, words: Words) -> tuple[str, ...]:
    """Values below 1 or beyond what any document has, each with its reason."""
    return tuple(
        words(
            "show.label",
            label=f"{show_own(words, value.text)} = "
            f"{words.show_quantity(value.value, value.unit)}",
            text=words("note.beyond", reason=show_text(value.reason_beyond)),
        )
        for value in profile.values
        if value.reason_beyond
    )


_SCOPE = ("avalanche", "structure", "ground", "product")
_NAME, _ENDS = say("column.rows.id"), "column.Ends."
# Net rows of which each is named; of more, those that are left out may be fewer.
_FEW_ROWS, _TWO = 8, 2


def show_basis(study: Study, words: Words) -> Part:
    """Statements that hold for all rows: limits of the report, profile, tests."""
    others = (note for note in study.notes if not note.key.startswith(_LIMIT))
    notes = (
        *(words.show(note) for note in others),
        *label_rows(share_notes(study, words), study, words),
    )
    blocks: tuple[Block, ...] = (
        Paragraph(text=words("scope.decision"), look="small"),
        Pairs(
            pairs=(
                *_list_scope(study, words),
                *_list_documents(study, words),
                *_list_profile(study, words),
            ),
            look="keys",
        ),
        *show_tests(study, words),
        Items(items=tuple(map(symbols, notes))),
    )
    return section("basis", words("heading.basis"), *blocks, level=3, look="basis")


def _list_scope(study: Study, words: Words) -> Iterator[Pair]:
    """Who must check what the study does not treat; what its profile leaves out first.

    What one of them has to check stands together.
    """
    topics_of: dict[str, list[str]] = {}
    for key in (*study.profile.not_checked, *_SCOPE):
        topics_of.setdefault(words(f"scope.{key}_by"), []).append(words(f"scope.{key}"))
    for who, topics in topics_of.items():
        yield Pair(name=who, text=words.join(topics))


def _list_profile(study: Study, words: Words) -> Iterator[Pair]:
    """The limit profile in some lines, and the least load."""
    profile = study.profile
    texts = {
        "limit_profile": name_profile(study, words),
        "profile_choice": _name_choice(profile, words),
        "floor": describe_floor(study, words),
        "odd_values": words.join(list_odd_values(profile, words)),
    }
    for key, text in texts.items():
        if text:
            named = words(f"heading.{key}")
            yield Pair(name=named, text=symbols(show_text(text)))


_DOCUMENTS = ("snow_document", "glide_document", "ground_document")


def _list_documents(study: Study, words: Words) -> Iterator[Pair]:
    """Where snow heights, glide factors and the ground come from."""
    project = study.project
    texts = (project.snow_document, project.glide_document, project.ground_document)
    lacking = []
    for key, text in zip(_DOCUMENTS, texts, strict=True):
        name = words(f"documents.{key}")
        if text:
            yield Pair(name=name, text=show_text(text))
        else:
            lacking.append(name)
    if lacking:
        asked = words("documents.to_confirm", what=words.join(lacking))
        yield Pair(name=words("documents.lacking"), text=asked)


def _name_choice(profile: ProfileRecord, words: Words) -> str:
    """Set of factors in force; "" of a profile that has one alone."""
    named = profile.choice_text or profile.choice
    return show_own(words, named) if named else ""


def has_other_floor(study: Study) -> bool:
    """No minimum load is taken, another one than the profile has, or it decides."""
    is_other = study.profile.floor == "none" or study.profile.is_floor_overruled
    return is_other or study.profile.is_by_guideline


def describe_floor(study: Study, words: Words) -> str:
    """Least load of the design forces, and how often it governs."""
    text = _count_by_floor(study, words)
    if study.profile.is_by_guideline:
        text = words.join([words("floor.decides"), text])
    if not study.profile.has_maker_floor:
        text = words.join([text, words("floor.no_maker")])
    if not study.profile.is_floor_overruled:
        return text
    return words.join([words("floor.overruled", profile=study.profile.id), text])


def _count_by_floor(study: Study, words: Words) -> str:
    if study.profile.floor == "none":
        is_own = not study.profile.is_floor_overruled
        return words("floor.none" if is_own else "floor.none_chosen")
    checks = [check for row in study.rows for check in row.checks if check.is_of_force]
    governed = sum(map(_is_by_guideline, checks))
    profiles = {row.floor.profile for row in study.rows if row.floor}
    named = show_text(", ".join(sorted(profiles)))
    return words("floor.told", profile=named, count=governed, all=len(checks))


def _is_by_guideline(check: Check) -> bool:
    """The guideline's load governs; of a rope it may have raised the pull."""
    is_raised = "φ_g" in check.step_of and "E_c" not in check.step_of
    return check.governs == "guideline" or is_raised


def name_law(study: Study) -> str:
    """Creep law of a study; "" of one that does not say."""
    return study.provenance.settings.get("creep_law", "").partition(" ")[0]


_LIMIT = "note."  # of notes on the model; others say what was read, or supports a law


def list_limits(study: Study, words: Words) -> list[str]:
    """Notes on the whole study for the first page: where its creep law was used."""
    return [words.show(note) for note in study.notes if note.key.startswith(_LIMIT)]


def list_notes(study: Study, words: Words) -> list[str]:
    """Notes on the whole study, and those that several rows share."""
    return [
        *(words.show(note) for note in study.notes),
        *label_rows(share_notes(study, words), study, words),
    ]


# Notes that ask nothing of anyone: no number of them decides.
_BESIDE = ("row.guys_in_snow",)


# Notes of which the largest number is said for all rows.
_LARGEST = {"row.one_anchor": "both"}


def is_of_row(note: Message) -> bool:
    """A note for the page of its row, which is more than information."""
    return note.key not in _BESIDE


def list_row_notes(row: RowStudy, study: Study, words: Words) -> Iterator[str]:
    """Notes of a row; one with a number has that of the worst row of the study."""
    for note in row.notes:
        if note.key in _LARGEST:
            key, name = note.key, _LARGEST[note.key]
            same = (x for each in study.rows for x in each.notes if x.key == key)
            yield words.show(max(same, key=lambda x: float(str(x.arguments[name]))))
        elif is_of_row(note):
            yield words.show(note)


def share_notes(study: Study, words: Words) -> dict[str, list[str]]:
    """Notes that several rows have, word by word, with the rows: told once."""
    rows: dict[str, list[str]] = {}
    for row in study.rows:
        notes = list_row_notes(row, study, words)
        for note in dict.fromkeys(notes):
            rows.setdefault(note, []).append(show_text(row.id))
    return {note: ids for note, ids in rows.items() if len(ids) > 1}


def name_cases(study: Study, words: Words) -> str:
    """Legend of the numbers of a case, in their order."""
    points = [case.case for row in study.rows for case in row.cases[:1]]
    names = (
        [name_heading(words, key) for key in [*points[0].values][3:]] if points else []
    )
    legend = words("show.legend")
    if not names:
        return legend
    return words("show.legend_further", legend=legend, names=" / ".join(names))


def anchor_rows(study: Study) -> dict[str, str]:
    """Place of each net row in the page; rows alike but for their names share one."""
    anchors: dict[str, str] = {}
    known: list[tuple[RowStudy, str]] = []
    for number, row in enumerate(study.rows, 1):
        plain = _leave_out_name(row)
        same = (anchor for other, anchor in known if other == plain)
        anchors[row.id] = next(same, f"row-{number}")
        known.append((plain, anchors[row.id]))
    return anchors


def _leave_out_name(row: RowStudy) -> RowStudy:
    """The row as if it stood in no line of a workbook."""
    inputs = [replace(echo, cell="") for echo in row.inputs if echo.label != _NAME]
    return replace(row, id="", inputs=inputs)


def label_rows(
    rows: Mapping[str, Sequence[str]], study: Study, words: Words
) -> list[str]:
    """Sentences, each behind the net rows of which it holds."""
    return [
        words(
            "show.label", label=show_text(name_rows(ids, study, words)), text=sentence
        )
        for sentence, ids in rows.items()
    ]


def name_rows(names: Sequence[str], study: Study, words: Words) -> str:
    """Names of net rows; all of them, or of a large site all but a few, in a phrase.

    What is named beside them, such as the ranges, stands before.
    """
    ids = [row.id for row in study.rows]
    beside = [name for name in names if name not in ids]
    others = [name for name in ids if name not in names]
    is_short = len(names) <= len(others)
    most = _FEW_ROWS if others else _TWO
    if len(ids) <= most or len(others) > _FEW_ROWS or is_short:
        return ", ".join(names)
    key = "show.all_rows_but" if others else "show.all_rows"
    text = words(key, count=len(ids), others=", ".join(others))
    return ", ".join([*beside, text])


def describe_cases(study: Study, words: Words) -> str:
    """Cases with and without a result."""
    cases = [case for row in study.rows for case in row.cases]
    failed = sum(case.outcome is not Outcome.CONVERGED for case in cases)
    return words("show.cases_solved", solved=len(cases) - failed, failed=failed)


def show_line(line: ToDo, study: Study, words: Words) -> str:
    """What is to be done, after the net rows that need it."""
    rows = show_text(name_rows(list(line.rows), study, words))
    return words("to_do.line", rows=rows, text=words.show(line.text))


def list_conditions(study: Study, words: Words) -> list[str]:
    """What has to hold beside the checks, by who sees to it and for which rows."""
    shared: dict[tuple[str, tuple[str, ...]], list[str]] = {}
    for condition in study.conditions:
        key = (condition.who, tuple(condition.rows))
        shared.setdefault(key, []).append(words.show(condition.message))
    return [
        words(
            "condition.line",
            who=words.show(name("who", who)),
            rows=show_text(name_rows(rows, study, words)),
            text=words.join(texts),
        )
        for (who, rows), texts in shared.items()
    ]
