"""Answer to a client's first question: why more than the guideline asks for."""

from __future__ import annotations

from netdesign.report.blocks import (
    Block,
    Cell,
    Figure,
    Paragraph,
    Part,
    Table,
    fixed_cell,
    key_columns,
    number_cell,
    section,
    text_cell,
    text_column,
)
from netdesign.report.drawing.chain_figure import draw_loads
from netdesign.report.words import Words
from netdesign.study.case_records import GuidelineRecord
from netdesign.study.records import RowStudy, Study, find_input

_LOAD_CASES = ("load_case_1", "load_case_2")
_Compared = tuple[RowStudy, GuidelineRecord, float]  # and the ratio of both forces


def show_difference(study: Study, words: Words) -> Part | None:
    """Half a page on the coupled forces beside those of the guideline's load.

    None where no net row has both.
    """
    compared = [
        (row, row.guideline, ratio)
        for row in study.rows
        if row.guideline and (ratio := _compare(row.guideline))
    ]
    if not compared:
        return None
    worst, record, _ = max(compared, key=lambda one: one[2])
    ratios = [ratio for _, _, ratio in compared]
    lead = words(
        "why_more.lead",
        low=words.show_fixed(min(ratios), 2),
        high=words.show_fixed(max(ratios), 2),
    )
    blocks: list[Block] = [Paragraph(text=lead), _tabulate(compared, words)]
    height = find_input(worst, "net_height")
    svg = draw_loads(record, height, words) if height else ""
    if svg:
        caption = words("why_more.caption", row=worst.id)
        blocks.append(Figure(svg=svg, caption=caption))
    text = words("show.label", label=worst.id, text=words.show(record.sentence))
    blocks.append(Paragraph(text=text))
    return section("why-more", words("why_more.heading"), *blocks)


def _compare(record: GuidelineRecord) -> float | None:
    """Coupled force of the foot anchor over the largest of the guideline's cases."""
    least = _find_largest(record)
    return record.solved_foot_anchor_kN / least if least else None


def _find_largest(record: GuidelineRecord) -> float | None:
    forces = [one.foot_anchor_kN for one in record.cases if one.name in _LOAD_CASES]
    return max((one for one in forces if one is not None), default=None)


def _tabulate(compared: list[_Compared], words: Words) -> Table:
    """Foot anchor of each row: coupled, by the guideline, by its law in equal snow."""
    keys = ("coupled", "guideline", "ratio", "same_snow", "model")
    return Table(
        caption=words("why_more.table"),
        columns=(
            text_column(words("heading.net_row")),
            *key_columns(words, "why_more.", keys, numbers=keys),
        ),
        rows=tuple(_show(*one, words) for one in compared),
    )


def _show(
    row: RowStudy, record: GuidelineRecord, ratio: float, words: Words
) -> tuple[Cell, ...]:
    coupled = record.solved_foot_anchor_kN
    forces = {one.name: one.foot_anchor_kN for one in record.cases}
    same = forces.get("same_snow")
    return (
        text_cell(row.id),
        number_cell(words, "foot_anchor_kN", coupled),
        number_cell(words, "foot_anchor_kN", _find_largest(record)),
        fixed_cell(words, ratio, 2),
        number_cell(words, "foot_anchor_kN", same),
        fixed_cell(words, coupled / same if same else None, 2),
    )
