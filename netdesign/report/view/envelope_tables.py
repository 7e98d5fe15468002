"""Tables of a searched envelope: bounds with confirmation, drivers, flips."""

from __future__ import annotations

from netdesign.report.view.table import (
    Cell,
    Table,
    name_columns,
    number_cell,
    number_column,
    text_cell,
    text_column,
    word_cell,
)
from netdesign.report.words import MISSING, name_heading, name_member, show_number
from netdesign.study.records import BoundRecord, EnvelopeRecord, RowStudy

_GRID = "none: the cases are a grid, which says nothing about what lies between them"


def describe_search(row: RowStudy) -> str:
    """How the largest forces were found, what their bound rests on; "" of a grid."""
    record = row.envelope
    if record is None:
        return ""
    closed = "closed" if record.is_closed else "NOT closed"
    skipped = (
        f"; {record.skipped} of them known without a solve, since the snow stuck on "
        f"the net with less friction already (tested {record.skips_tested} times)"
        if record.skipped
        else ""
    )
    return (
        f"Searched with {record.cases} cases{skipped}. The gap asked for, "
        f"{record.gap_asked_percent:g} % of each force, is {closed}. The bounds rest "
        f"on a model of the forces between the cases, widened to {record.certainty:g} "
        "of its held-out standard errors; a feature narrower than "
        f"{record.resolved_share:g} of a range may hide."
    )


def build_bounds(row: RowStudy) -> Table:
    """Largest force, what may hide above it, and its confirmation."""
    return Table(
        caption="Largest characteristic forces, with what may hide between the cases "
        "and the governing case solved again",
        columns=(
            text_column("Member"),
            number_column("max_kN"),
            number_column("max_kN", "Nowhere above [kN]"),
            *name_columns(("Gap [%]",), numbers=("Gap [%]",)),
            number_column("max_kN", "Solved again [kN]"),
            *name_columns(("Difference [%]",), numbers=("Difference [%]",)),
            text_column("Solved again by"),
            text_column("Case"),
        ),
        rows=tuple(_bound_row(bound) for bound in _list_bounds(row.envelope)),
        empty=_GRID if row.envelope is None else "none: no case of this row converged",
    )


def _bound_row(bound: BoundRecord) -> tuple[Cell, ...]:
    again = bound.confirmation
    gap = bound.upper_bound_kN / bound.max_kN - 1.0 if bound.max_kN > 0.0 else 0.0
    by = MISSING
    if again is not None:
        by = str(again.reason or "") or f"{again.method}, {again.elements} triangles"
    difference = again.difference_percent if again else None
    return (
        word_cell(name_member(bound.quantity)),
        number_cell("max_kN", bound.max_kN),
        number_cell("max_kN", bound.upper_bound_kN),
        Cell(text=f"{100.0 * gap:.2f}", number=100.0 * gap),
        number_cell("max_kN", again.confirmed_kN if again else None),
        Cell(
            text=MISSING if difference is None else f"{difference:+.2f}",
            number=difference,
        ),
        word_cell(by),
        text_cell(_name_case(bound.case)),
    )


def build_drivers(row: RowStudy) -> Table:
    """What drives each force: tornado about the governing case, Sobol indices."""
    numbers = ("First order", "Total", "Unexplained")
    return Table(
        caption="What drives each force: values at the ends of each range with the "
        "others as in the governing case; Sobol indices for independent quantities, "
        "uniform in their ranges (assumed), with the share that the model misses",
        columns=(
            text_column("Member"),
            text_column("Quantity"),
            number_column("max_kN", "At low end [kN]"),
            number_column("max_kN", "At high end [kN]"),
            *name_columns(numbers, numbers=numbers),
            text_column("A check flips at"),
        ),
        rows=tuple(
            (
                word_cell(name_member(bound.quantity)),
                word_cell(name_heading(one.key)),
                number_cell("max_kN", one.at_low_kN),
                number_cell("max_kN", one.at_high_kN),
                Cell(text=f"{one.first_order:.3f}", number=one.first_order),
                Cell(text=f"{one.total:.3f}", number=one.total),
                Cell(text=f"{bound.unexplained or 0.0:.3f}", number=bound.unexplained),
                text_cell(_name_flips(bound, one.key)),
            )
            for bound in _list_bounds(row.envelope)
            if bound.max_kN > 0.0
            for one in bound.drivers
        ),
        empty=_GRID if row.envelope is None else "none: no case of this row converged",
    )


def _list_bounds(record: EnvelopeRecord | None) -> list[BoundRecord]:
    return [] if record is None else record.bounds


def _name_case(case: dict[str, float]) -> str:
    return ", ".join(f"{value:.5g}" for value in case.values())


def _name_flips(bound: BoundRecord, key: str) -> str:
    """Critical values of a quantity: ``312.4 (foot_anchor.tendon)``."""
    return "; ".join(
        f"{show_number(key, float(f'{flip.value:.4g}'))} ({flip.check})"
        for flip in bound.flips
        if flip.key == key
    )
