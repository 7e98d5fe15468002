"""Annexes of other models and of all cases, which the workbook has as sheets."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from netdesign.checks.check import CasePoint
from netdesign.outcome import Outcome
from netdesign.report.blocks import (
    Block,
    Cell,
    Column,
    Items,
    Part,
    Table,
    key_columns,
    name_columns,
    number_cell,
    quantity_column,
    section,
    text_cell,
)
from netdesign.report.sections.basis import label_rows
from netdesign.report.words import (
    MISSING,
    Words,
    add_unit,
    show_member,
)
from netdesign.structure.members import REPORTED_MEMBERS
from netdesign.study.case_records import CaseRecord
from netdesign.study.records import ModelFormRecord, RowStudy, Study

_QUANTITIES = ("density_kg_m3", "friction_deg", "inclination_deg")


def show_quality(study: Study, words: Words) -> Part:
    """Annex with the forces by other models."""
    return section(
        "annex-quality",
        words("heading.annex_quality"),
        build_opinions(study, words).shown("extremes"),
        *_list_refused(study, words),
    )


def explain_case(case: CaseRecord, words: Words) -> Cell:
    """End of a case with its reason."""
    if case.outcome is Outcome.CONVERGED:
        return text_cell(words.show(case.reason))
    sentence = words.show(case.outcome.message)
    if case.reason is None:
        return text_cell(sentence)
    reason = words.show(case.reason)
    return text_cell(
        words("show.sentence_and_reason", sentence=sentence, reason=reason)
    )


def build_cases(row: RowStudy, words: Words) -> Table:
    """Every case of a row with its forces or the reason why there are none."""
    keys = [f"{member}_kN" for member in REPORTED_MEMBERS]
    keys += ["error_percent", "balance_residual"]
    return Table(
        caption=words("caption.cases"),
        columns=(
            *list_case_columns(words, row),
            *(quantity_column(words, key) for key in keys),
            *key_columns(words, "heading.", ("outcome", "reason")),
        ),
        rows=tuple(
            (
                *_show_case(case.case, words),
                *(number_cell(words, key, getattr(case, key)) for key in keys),
                text_cell(words(f"ended.{case.outcome}")),
                explain_case(case, words),
            )
            for case in row.cases
        ),
        empty=words("show.none"),
    )


def list_case_columns(words: Words, row: RowStudy) -> tuple[Column, ...]:
    """Columns of the quantities of a row's cases."""
    keys = row.cases[0].case.values if row.cases else _QUANTITIES
    return tuple(quantity_column(words, key) for key in keys)


def _show_case(case: CasePoint, words: Words) -> tuple[Cell, ...]:
    return tuple(number_cell(words, *one) for one in case.values.items())


def _list_refused(study: Study, words: Words) -> Iterator[Block]:
    """Other creep laws that give no force, each reason once, with its net rows."""
    rows: dict[str, list[str]] = {}
    for row in study.rows:
        for one in row.model_form.variants if row.model_form else ():
            if one.ratio is None:
                reason = words.show(one.reason)
                named = words("spread.creep_law", law=one.creep_law)
                told = reason if named in reason else f"{named}, {reason}"
                rows.setdefault(told, []).append(row.id)
    yield from _list_by_rows(rows, study, words)


def _list_by_rows(
    rows: dict[str, list[str]], study: Study, words: Words
) -> Iterator[Block]:
    if rows:
        yield Items(items=tuple(label_rows(rows, study, words)), look="small")


def build_opinions(study: Study, words: Words) -> Table:
    """Forces by other models beside the coupled one, a line a row."""
    headings = [
        add_unit(words(f"opinion.{key}"), "kN")
        for key in ("coupled", "load_case_1", "load_case_2")
    ]
    others = words("opinion.other_snow")
    return Table(
        caption=words("opinion.caption"),
        columns=(
            Column(heading=words("heading.net_row")),
            *name_columns(headings, numbers=headings),
            Column(heading=others),
        ),
        rows=tuple(_opinion_row(row, words) for row in study.rows),
        empty=words("show.none"),
    )


def _opinion_row(row: RowStudy, words: Words) -> tuple[Cell, ...]:
    guideline = row.guideline
    coupled = guideline.solved_foot_anchor_kN if guideline else None
    cases = guideline.cases if guideline else []
    by_case = {one.name: one.foot_anchor_kN for one in cases}
    return (
        text_cell(row.id),
        number_cell(words, "foot_anchor_kN", coupled),
        number_cell(words, "foot_anchor_kN", by_case.get("load_case_1")),
        number_cell(words, "foot_anchor_kN", by_case.get("load_case_2")),
        text_cell(_describe_model_form(row.model_form, words)),
    )


def _describe_model_form(record: ModelFormRecord | None, words: Words) -> str:
    """Spread of the governing force over other models of the snow; "-" without."""
    if record is None:
        return MISSING
    ends = [record.force_kN * ratio for ratio in record.ratios]
    return words(
        "opinion.spread",
        member=show_member(words, record.member),
        band=words.show_band("solved_kN", *ends),
        count=sum(one.ratio is not None for one in record.variants),
    )


def stack_rows(
    caption: str,
    study: Study,
    build: Callable[[RowStudy, Words], Table],
    words: Words,
) -> Table:
    """One table out of those of the net rows."""
    return stack_tables(caption, [(x.id, build(x, words)) for x in study.rows], words)


def stack_tables(
    caption: str, parts: Sequence[tuple[str, Table]], words: Words
) -> Table:
    """One table out of several, told apart by their net row.

    A column that only some of them have is empty for the others.
    """
    columns = _join_columns([table for _, table in parts])
    return Table(
        caption=caption,
        columns=(Column(heading=words("heading.net_row")), *columns),
        rows=tuple(
            (text_cell(name), *_place_cells(part, row, columns))
            for name, part in parts
            for row in part.rows
        ),
        empty=parts[0][1].empty if parts else words("show.none"),
    )


def _join_columns(tables: Sequence[Table]) -> list[Column]:
    """Columns of all tables, each once, every one behind those that stand before it."""
    joined: list[Column] = []
    for table in tables:
        place = 0
        for column in table.columns:
            if column in joined:
                place = joined.index(column) + 1
            else:
                joined.insert(place, column)
                place += 1
    return joined


def _place_cells(
    table: Table, row: Sequence[Cell], columns: Sequence[Column]
) -> list[Cell]:
    found = dict(zip(table.columns, row, strict=True))
    return [found.get(column, text_cell("")) for column in columns]
