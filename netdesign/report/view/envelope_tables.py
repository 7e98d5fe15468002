"""Tables of a searched envelope: bounds with confirmation, drivers, flips."""

from __future__ import annotations

from collections.abc import Mapping

from netdesign.report.blocks.table import (
    Cell,
    Table,
    fixed_cell,
    name_columns,
    number_cell,
    number_column,
    quantity_column,
    text_cell,
    text_column,
)
from netdesign.report.words import (
    MISSING,
    Words,
    add_unit,
    name_heading,
    show_check,
    show_member,
)
from netdesign.study.envelope_records import BoundRecord, EnvelopeRecord
from netdesign.study.records import RowStudy
from netdesign.words.names import name


def describe_search(row: RowStudy, words: Words) -> str:
    """Way to the largest forces, and basis of their bound; "" of a grid."""
    record = row.envelope
    if record is None:
        return ""
    closed = words("show.closed") if record.is_closed else words("show.not_closed")
    numbers = {
        "cases": record.cases,
        "gap": record.gap_asked_percent,
        "certainty": record.certainty,
        "share": record.resolved_share,
    }
    if not record.skipped:
        return words("show.searched", closed=closed, **numbers)
    skipped, tests = record.skipped, record.skips_tested
    return words(
        "show.searched_skipped", closed=closed, skipped=skipped, tests=tests, **numbers
    )


def build_bounds(row: RowStudy, words: Words) -> Table:
    """Largest force, what may hide above it, and its confirmation."""
    gap = add_unit(words("heading.gap"), "%")
    difference = add_unit(words("heading.difference"), "%")
    above = add_unit(words("heading.nowhere_above"), "kN")
    again = add_unit(words("heading.solved_again"), "kN")
    return Table(
        caption=words("caption.bounds"),
        columns=(
            text_column(words("heading.member")),
            quantity_column(words, "max_kN"),
            number_column("max_kN", above),
            *name_columns((gap,), numbers=(gap,)),
            number_column("max_kN", again),
            *name_columns((difference,), numbers=(difference,)),
            text_column(words("heading.solved_again_by")),
            text_column(words("heading.case")),
        ),
        rows=tuple(_bound_row(bound, words) for bound in _list_bounds(row.envelope)),
        empty=_name_empty(row, words),
    )


def _name_empty(row: RowStudy, words: Words) -> str:
    if row.envelope is None:
        return words("heading.grid_without_bound")
    return words("heading.no_case_converged")


def _bound_row(bound: BoundRecord, words: Words) -> tuple[Cell, ...]:
    again = bound.confirmation
    gap = bound.upper_bound_kN / bound.max_kN - 1.0 if bound.max_kN > 0.0 else 0.0
    by = MISSING
    if again is not None:
        by = words.show(again.reason)
        if again.reason is None:
            method = words.show(name("method", again.method))
            count = again.elements or 0
            by = words("show.solved_again_by", method=method, count=count)
    difference = again.difference_percent if again else None
    return (
        text_cell(show_member(words, bound.quantity)),
        number_cell(words, "max_kN", bound.max_kN),
        number_cell(words, "max_kN", bound.upper_bound_kN),
        fixed_cell(words, 100.0 * gap, 2),
        number_cell(words, "max_kN", again.confirmed_kN if again else None),
        Cell(
            text=MISSING if difference is None else words.write(f"{difference:+.2f}"),
            number=difference,
        ),
        text_cell(by),
        text_cell(_name_case(bound.case, words)),
    )


def build_drivers(row: RowStudy, words: Words) -> Table:
    """Drivers of each force: tornado about the governing case, Sobol indices."""
    keys = ("first_order", "total", "unexplained")
    numbers = [words(f"heading.{key}") for key in keys]
    low, high = words("heading.at_low_end"), words("heading.at_high_end")
    names = {check.id: show_check(words, check) for check in row.checks}
    return Table(
        caption=words("caption.driver_table"),
        columns=(
            text_column(words("heading.member")),
            text_column(words("heading.quantity")),
            number_column("max_kN", add_unit(low, "kN")),
            number_column("max_kN", add_unit(high, "kN")),
            *name_columns(numbers, numbers=numbers),
            text_column(words("heading.check_flips_at")),
        ),
        rows=tuple(
            (
                text_cell(show_member(words, bound.quantity)),
                text_cell(name_heading(words, one.key)),
                number_cell(words, "max_kN", one.at_low_kN),
                number_cell(words, "max_kN", one.at_high_kN),
                fixed_cell(words, one.first_order, 3),
                fixed_cell(words, one.total, 3),
                fixed_cell(words, bound.unexplained or 0.0, 3),
                text_cell(words.join(_list_flips(bound, one.key, names, words))),
            )
            for bound in _list_bounds(row.envelope)
            if bound.max_kN > 0.0
            for one in bound.drivers
        ),
        empty=_name_empty(row, words),
    )


def _list_bounds(record: EnvelopeRecord | None) -> list[BoundRecord]:
    return [] if record is None else record.bounds


def _name_case(case: dict[str, float], words: Words) -> str:
    return words.join(words.show_number(*one) for one in case.items())


def _list_flips(
    bound: BoundRecord, key: str, names: Mapping[str, str], words: Words
) -> list[str]:
    """Critical values of a quantity: ``312.4 (Foot anchor, tendon)``."""
    told = [
        (
            words.show_number(key, flip.value),
            names.get(flip.check, flip.check),
        )
        for flip in bound.flips
        if flip.key == key
    ]
    return [f"{value} ({check})" for value, check in told]
