"""Answer to a client's first question: why more than the guideline asks for."""

from __future__ import annotations

from netdesign.checks.check import Check
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
    name_columns,
    number_cell,
    section,
    text_cell,
)
from netdesign.report.drawing.chain_figure import draw_loads
from netdesign.report.words import (
    MISSING,
    Words,
    name_row,
    show_member,
)
from netdesign.structure.members import END_ANCHORS
from netdesign.study.case_records import GuidelineRecord
from netdesign.study.pulls import ANCHORS
from netdesign.study.records import RowStudy, Study, find_input
from netdesign.study.scopes import Scope, find_scopes

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
    tables = (_tabulate(compared, words), tabulate_used(study, words))
    blocks: list[Block] = [Paragraph(text=lead), *tables]
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


def tabulate_used(study: Study, words: Words) -> Table:
    """Utilisation of each anchor by the model and by the guideline, side by side.

    Each is the largest of the anchor's checks, wherever it stands in the row.
    """
    known = {one.member for row in study.rows for one in row.checks if _is_rated(one)}
    anchors = [one for one in (*ANCHORS, *END_ANCHORS) if one in known]
    names = [show_member(words, one) for one in anchors]
    return Table(
        caption=words("why_more.used"),
        columns=name_columns([words("heading.net_row"), *names], numbers=()),
        rows=tuple(
            (text_cell(row.id), *(_show_used(row, one, words) for one in anchors))
            for row in study.rows
        ),
        empty=words("show.none"),
    )


def _is_rated(check: Check) -> bool:
    return Scope.ANCHORS in find_scopes(check) and check.utilisation is not None


def _show_used(row: RowStudy, anchor: str, words: Words) -> Cell:
    """``0.84 / 0.54``; "-" for one that is not known."""
    checks = [one for one in row.checks if one.member == anchor and _is_rated(one)]
    pairs = [(one.utilisation_by_model, one.utilisation_by_guideline) for one in checks]
    most = (max(filter(None, one), default=None) for one in zip(*pairs, strict=True))
    shown = [words.show_number("utilisation", one) for one in most]
    return text_cell(" / ".join(shown) or MISSING)


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
