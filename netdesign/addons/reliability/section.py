"""Notional reliability of the rows' governing checks: an annex, lines of it, a sheet.

An index has one decimal, and never stands beside a verdict.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from netdesign.quantities import QUANTITIES
from netdesign.report.blocks import (
    Cell,
    Column,
    Items,
    Paragraph,
    Part,
    Table,
    key_columns,
    section,
    text_cell,
)
from netdesign.report.words import (
    MISSING,
    Words,
    append_unit,
    show_check,
    show_text,
)
from netdesign.study.records import ReliabilityRecord, RowStudy, Study, VariableRecord

# Annual indices of the JCSS Probabilistic Model Code where safety is expensive, for
# minor, moderate and large consequences.
_JCSS = {"minor": 3.1, "moderate": 3.3, "large": 3.7}
_ERRORS = 2.0  # of the sampling to each end of the band
_EDGE = 1e-9
_NONE = (text_cell(MISSING),) * 5  # beside a row without an index


def list_records(study: Study) -> list[tuple[RowStudy, ReliabilityRecord]]:
    """Rows with their reliability records; none without ``--reliability``."""
    return [(row, row.reliability) for row in study.rows if row.reliability]


def show_reliability(study: Study, words: Words) -> Iterator[Part]:
    """Annex of the notional reliability; none without ``--reliability``."""
    records, lacking = list_records(study), tuple(_list_lacking(study, words))
    if records:
        yield section(
            "annex-reliability",
            words("heading.annex_reliability"),
            Paragraph(text=words("reliability.is_not"), look="small"),
            Paragraph(text=words("reliability.reading"), look="small"),
            tabulate_indices(study, words),
            *([Items(items=lacking)] if lacking else []),
            *(
                block
                for row, record in records
                for block in _tell_shares(row, record, words)
            ),
            tabulate_variables(study, words),
        )


def list_reliability(study: Study, words: Words) -> Iterator[str]:
    """Lines for a terminal: indices of the rows, then why some have none."""
    records = list_records(study)
    indices = [
        words(
            "reliability.of_row",
            row=show_text(row.id),
            index=_show_index(record, words),
        )
        for row, record in records
        if record.beta is not None
    ]
    if indices:
        yield words("reliability.line", rows=tuple(indices))
    yield from _list_lacking(study, words)


def _list_lacking(study: Study, words: Words) -> Iterator[str]:
    """Reasons why rows have no index, each with its rows."""
    lacking: dict[str, list[str]] = {}
    for row, record in list_records(study):
        if record.beta is None:
            lacking.setdefault(words.show(record.reason), []).append(show_text(row.id))
    for reason, rows in lacking.items():
        yield words("reliability.lacking", rows=tuple(rows), reason=reason)


def _show_index(record: ReliabilityRecord, words: Words) -> str:
    """Index with its band, rounded outwards: ``3.4 (3.3 to 3.5)``."""
    if record.beta is None or record.standard_error is None:
        return MISSING
    spread = _ERRORS * record.standard_error
    low = math.floor(10.0 * (record.beta - spread) + _EDGE) / 10.0
    high = math.ceil(10.0 * (record.beta + spread) - _EDGE) / 10.0
    band = words(
        "show.band", low=words.show_fixed(low, 1), high=words.show_fixed(high, 1)
    )
    return words("show.with_band", value=words.show_fixed(record.beta, 1), band=band)


def tabulate_indices(study: Study, words: Words) -> Table:
    """Index of each row beside those of the model code, with its implied factors."""
    names = ("index", "by_form", "over_full", "action", "resistance", "solved")
    rows = [_list_row(row, record, words) for row, record in list_records(study)]
    rows += [
        (
            text_cell(MISSING),
            text_cell(f"JCSS, {words(f'consequences.{name}')}"),
            text_cell(words.show_fixed(index, 1)),
            *_NONE,
        )
        for name, index in _JCSS.items()
    ]
    return Table(
        caption=words("reliability.caption"),
        columns=(
            *key_columns(words, "heading.", ("net_row", "governing_check")),
            *key_columns(words, "reliability.", names, numbers=names),
        ),
        rows=tuple(rows),
        look="extremes",
        symbols="headings",
    )


def _list_row(
    row: RowStudy, record: ReliabilityRecord, words: Words
) -> tuple[Cell, ...]:
    check = next((check for check in row.checks if check.id == record.check), None)
    named = show_check(words, check) if check else MISSING
    if record.beta is None:
        refusal = text_cell(words("reliability.not_available"))
        return (text_cell(row.id), text_cell(named), refusal, *_NONE)
    over = None if record.beta_at_full is None else record.beta - record.beta_at_full
    return (
        text_cell(row.id),
        text_cell(named),
        text_cell(_show_index(record, words)),
        text_cell(words.show_fixed(record.beta_by_form, 1)),
        text_cell(MISSING if over is None else words.write(f"{over:+.1f}")),
        text_cell(_compare(record.action_factor, record.profile_action_factor, words)),
        text_cell(
            _compare(record.resistance_factor, record.profile_resistance_factor, words)
        ),
        text_cell(
            words(
                "reliability.solved_ratio",
                solved=words.show_fixed(record.force_ratio, 2),
                model=words.show_fixed(record.force_ratio_by_model, 2),
            )
        ),
    )


def _compare(implied: float | None, of_profile: float | None, words: Words) -> str:
    """Implied factor beside that of the profile."""
    if implied is None or of_profile is None:
        return MISSING
    return words(
        "reliability.beside",
        implied=words.show_fixed(implied, 2),
        profile=words.show_given(of_profile),
    )


def _tell_shares(
    row: RowStudy, record: ReliabilityRecord, words: Words
) -> Iterator[Paragraph]:
    """Alpha squared of a row's variables, the largest first; its design point."""
    shares = {
        _name(variable, words): variable.alpha_squared
        for variable in record.variables
        if variable.alpha_squared is not None
    }
    if not shares:
        return
    ranked = words.join(
        f"{name} {words('reliability.percent', share=words.show_fixed(100.0 * x, 0))}"
        for name, x in sorted(shares.items(), key=lambda pair: -pair[1])
    )
    title = words("reliability.shares", row=show_text(row.id))
    title = words("show.label", label=title, text=ranked)
    case = words.name_case(record.design_point)
    yield Paragraph(text=words("reliability.design_point", title=title, case=case))


def _name(variable: VariableRecord, words: Words) -> str:
    """Name of a variable: that of its quantity, or of a ratio."""
    key = variable.key
    return words(f"label.{key}" if key else f"variable.{variable.name}")


def tabulate_variables(study: Study, words: Words) -> Table:
    """Distributions of all rows, with what each is from; equal lines are one."""
    names = ("distribution", "mean", "variation")
    lines: dict[tuple[str, ...], list[str]] = {}
    variables = [
        (variable, show_text(row.id))
        for row, record in list_records(study)
        for variable in record.variables
    ]
    places = list(dict.fromkeys(variable.name for variable, _ in variables))
    for variable, row_id in sorted(
        variables, key=lambda pair: places.index(pair[0].name)
    ):
        lines.setdefault(_list_texts(variable, words), []).append(row_id)
    return Table(
        caption=words("reliability.variables"),
        columns=(
            Column(heading=words("heading.quantity")),
            *key_columns(words, "reliability.", names, numbers=names[1:]),
            *key_columns(words, "heading.", ("source", "net_rows")),
        ),
        rows=tuple(
            (*map(text_cell, texts), text_cell(", ".join(rows)))
            for texts, rows in lines.items()
        ),
        look="extremes",
    )


def _list_texts(variable: VariableRecord, words: Words) -> tuple[str, ...]:
    return (
        _name(variable, words),
        words(f"distribution.{variable.distribution}"),
        _show_value(variable, variable.mean, words),
        words.show_fixed(variable.variation, 2),
        words.show(variable.source),
    )


def _show_value(variable: VariableRecord, value: float | None, words: Words) -> str:
    """Value of a variable to three digits, with its unit."""
    if value is None:
        return MISSING
    form = QUANTITIES.get(variable.key)
    shown = words.show_given(float(f"{value:.3g}"))
    return append_unit(shown, form.unit) if form and form.unit else shown
