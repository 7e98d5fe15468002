"""Answer to a client's first question: why more than the guideline asks for."""

from __future__ import annotations

from netdesign.report.blocks import (
    Block,
    Cell,
    Column,
    Figure,
    Paragraph,
    Part,
    Table,
    fixed_cell,
    key_columns,
    number_cell,
    section,
    text_cell,
)
from netdesign.report.drawing.chain_figure import draw_loads
from netdesign.report.words import (
    Words,
    name_row,
)
from netdesign.study.case_records import GuidelineRecord
from netdesign.study.records import RowStudy, Study, find_input

_LOAD_CASES = ("load_case_1", "load_case_2")


def show_difference(study: Study, words: Words) -> Part | None:
    """Half a page on the coupled forces beside those of the guideline's load.

    None where no net row has both.
    """
    compared = [row for row in study.rows if _compare(row)]
    if not compared:
        return None
    worst = max(compared, key=lambda row: _compare(row) or 0.0)
    record = worst.guideline
    ratios = [one for row in compared if (one := _compare(row))]
    ends = [words.show_fixed(end(ratios), 2) for end in (min, max)]
    ratio = words("show.from_to", low=ends[0], high=ends[1])
    lead = words("why_more.lead", ratio=ratio if ends[0] != ends[1] else ends[0])
    blocks: list[Block] = [Paragraph(text=lead), _tabulate(compared, words)]
    height = find_input(worst, "net_height")
    svg = draw_loads(record, height, words) if record and height else ""
    if record and svg:
        caption = words("why_more.caption", row=name_row(worst.id, words))
        blocks.append(Figure(svg=svg, caption=caption))
    if record:
        label, text = worst.id, words.show(record.sentence)
        blocks.append(Paragraph(text=words("show.label", label=label, text=text)))
    return section("why-more", words("why_more.heading"), *blocks)


def _compare(row: RowStudy) -> float | None:
    """Coupled force of the foot anchor over the largest of the guideline's cases."""
    least = _find_largest(row.guideline) if row.guideline else None
    if row.guideline is None or not least:
        return None
    return row.guideline.solved_foot_anchor_kN / least


def _find_largest(record: GuidelineRecord) -> float | None:
    forces = [one.foot_anchor_kN for one in record.cases if one.name in _LOAD_CASES]
    return max((one for one in forces if one is not None), default=None)


def _tabulate(rows: list[RowStudy], words: Words) -> Table:
    """Foot anchor of each row: coupled, by the guideline, by its law in equal snow."""
    keys = ("coupled", "guideline", "ratio", "same_snow", "model")
    return Table(
        caption=words("why_more.table"),
        columns=(
            Column(heading=words("heading.net_row")),
            *key_columns(words, "why_more.", keys, numbers=keys),
        ),
        rows=tuple(_show(row, words) for row in rows),
    )


def _show(row: RowStudy, words: Words) -> tuple[Cell, ...]:
    record = row.guideline
    coupled = record.solved_foot_anchor_kN if record else None
    least = _find_largest(record) if record else None
    cases = record.cases if record else []
    same = next((one.foot_anchor_kN for one in cases if one.name == "same_snow"), None)
    return (
        text_cell(row.id),
        number_cell(words, "foot_anchor_kN", coupled),
        number_cell(words, "foot_anchor_kN", least),
        fixed_cell(words, _compare(row), 2),
        number_cell(words, "foot_anchor_kN", same),
        fixed_cell(words, coupled / same if coupled and same else None, 2),
    )
