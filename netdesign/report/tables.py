"""Plain tables of a study: the same rows for the page and for the workbook."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from netdesign.outcome import Outcome
from netdesign.report.words import (
    VERDICTS,
    name_case,
    name_heading,
    name_member,
    show_band,
    show_given,
    show_number,
    show_text,
)
from netdesign.site.model import InputEcho
from netdesign.study import CasePoint, CaseRecord, RowStudy, Study

# Fields of a CaseRecord; the keys of its member forces without their unit.
MEMBERS = ("foot_anchor", "uphill_guy", "downhill_guy", "post")
_COUNTS = ("Cases", "Without result")
ASSUMED = "assumed"  # status of a profile value that nobody has confirmed


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """What a reader sees, and the number behind it if it is one."""

    text: str
    number: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """Heading of a column; ``quantity`` gives the decimals of its numbers."""

    heading: str
    quantity: str = ""
    is_number: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """Rows of cells under headings. Without rows, outputs print ``empty``."""

    caption: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Cell, ...], ...]
    empty: str = "none"


def _words(heading: str) -> Column:
    return Column(heading=heading)


def _numbers(key: str, heading: str = "") -> Column:
    return Column(heading=heading or name_heading(key), quantity=key, is_number=True)


def _name_columns(
    headings: Sequence[str], *, numbers: Sequence[str]
) -> tuple[Column, ...]:
    return tuple(Column(heading=h, is_number=h in numbers) for h in headings)


def _text(text: str) -> Cell:
    return Cell(text=show_text(text))


def _number(key: str, value: float | None) -> Cell:
    return Cell(text=show_number(key, value), number=value)


def _given(value: float | str) -> Cell:
    if isinstance(value, str):
        return _text(value)
    return Cell(text=show_given(value), number=value)


CASE_COLUMNS = tuple(
    _numbers(key) for key in ("density_kg_m3", "friction_deg", "inclination_deg")
)


def _case(case: CasePoint) -> tuple[Cell, ...]:
    return (
        _given(case.density_kg_m3),
        _given(case.friction_deg),
        _given(case.inclination_deg),
    )


def build_extremes(row: RowStudy) -> Table:
    """Largest force of each member, with what the others carry in that case."""
    return Table(
        caption="Largest characteristic force of each member, with the forces of the "
        "other members in the same case",
        columns=(
            _words("Member"),
            _numbers("max_kN"),
            _words("Band [kN]"),
            *CASE_COLUMNS,
            *(_numbers(f"{member}_kN") for member in MEMBERS),
        ),
        rows=tuple(
            (
                Cell(text=name_member(extreme.quantity)),
                _number("max_kN", extreme.max_kN),
                Cell(text=show_band("max_kN", extreme.low_kN, extreme.high_kN)),
                *_case(extreme.case),
                *(
                    _number(f"{member}_kN", extreme.coincident_kN.get(member))
                    if member != extreme.quantity
                    else _number("max_kN", extreme.max_kN)
                    for member in MEMBERS
                ),
            )
            for extreme in row.extremes
        ),
        empty="none: no case of this row converged",
    )


def list_failed(row: RowStudy) -> list[CaseRecord]:
    """Cases that gave no numbers."""
    return [case for case in row.cases if case.outcome is not Outcome.CONVERGED]


def build_failed(row: RowStudy) -> Table:
    """Cases without a result, by name."""
    return Table(
        caption="Cases that gave no numbers; no largest force includes them",
        columns=(_words("Case"), _words("Outcome"), _words("Reason")),
        rows=tuple(
            (Cell(text=name_case(case.case)), _text(case.outcome), _explain(case))
            for case in list_failed(row)
        ),
        empty="none: every case converged" if row.cases else "none: no case was run",
    )


def _explain(case: CaseRecord) -> Cell:
    if case.outcome is Outcome.CONVERGED:
        return _text(case.reason)
    return _text(f"{case.outcome.sentence} {case.reason}")


def build_cases(row: RowStudy) -> Table:
    """Every case of a row with its forces or the reason why there are none."""
    keys = [f"{member}_kN" for member in MEMBERS]
    keys += ["error_percent", "balance_residual"]
    return Table(
        caption="Cases, characteristic forces per anchor",
        columns=(
            *CASE_COLUMNS,
            *(_numbers(key) for key in keys),
            _words("Outcome"),
            _words("Reason"),
        ),
        rows=tuple(
            (
                *_case(case.case),
                *(_number(key, getattr(case, key)) for key in keys),
                _text(case.outcome),
                _explain(case),
            )
            for case in row.cases
        ),
    )


def build_inputs(inputs: Sequence[InputEcho], caption: str) -> Table:
    """List inputs as typed and as understood, each with its cell."""
    headings = ("Input", "Typed", "Understood as", "Unit", "Cell")
    return Table(
        caption=caption,
        columns=_name_columns(headings, numbers=("Understood as",)),
        rows=tuple(
            (
                _text(echo.label),
                _text(echo.text),
                _given(echo.value),
                _text(echo.unit),
                _text(echo.cell),
            )
            for echo in inputs
        ),
    )


def build_profile(study: Study, status: str = "") -> Table:
    """Values of the limit profile; only those of one ``status`` if it is given."""
    headings = ("Clause", "Value of", "Value", "Unit", "Status", "Source")
    return Table(
        caption=f"Values with the status {status!r}" if status else "Every value used",
        columns=_name_columns(headings, numbers=("Value",)),
        rows=tuple(
            (
                _text(value.clause),
                _text(value.text),
                _given(value.value),
                _text(value.unit),
                _text(value.status),
                _text(value.source),
            )
            for value in study.profile.values
            if status in ("", value.status)
        ),
    )


def build_quality(study: Study) -> Table:
    """Worst numerical quality of each row."""
    return Table(
        caption="Quality of the solutions, worst case of each net row",
        columns=(
            _words("Net row"),
            *_name_columns(_COUNTS, numbers=_COUNTS),
            _numbers("balance_residual", "Largest balance residual, of the weight"),
            _words("In case"),
            _numbers("error_percent", "Largest error estimate [%]"),
            _words("In case"),
        ),
        rows=tuple(_quality_row(row) for row in study.rows),
    )


def _quality_row(row: RowStudy) -> tuple[Cell, ...]:
    residual, residual_case = _worst(row, lambda case: case.balance_residual)
    error, error_case = _worst(row, lambda case: case.error_percent)
    return (
        _text(row.id),
        _given(len(row.cases)),
        _given(len(list_failed(row))),
        _number("balance_residual", residual),
        Cell(text=name_case(residual_case)),
        _number("error_percent", error),
        Cell(text=name_case(error_case)),
    )


def _worst(
    row: RowStudy, read: Callable[[CaseRecord], float | None]
) -> tuple[float | None, CasePoint | None]:
    known = [
        (number, case.case)
        for case in row.cases
        if case.outcome is Outcome.CONVERGED and (number := read(case)) is not None
    ]
    return max(known, key=lambda pair: pair[0], default=(None, None))


def build_outcomes(study: Study) -> Table:
    """Count cases by outcome; outcomes that did not occur are left out."""
    counts = Counter(case.outcome for row in study.rows for case in row.cases)
    return Table(
        caption="Cases by outcome",
        columns=_name_columns(("Outcome", "Cases", "Meaning"), numbers=("Cases",)),
        rows=tuple(
            (_text(outcome), _given(counts[outcome]), Cell(text=outcome.sentence))
            for outcome in Outcome
            if counts[outcome]
        ),
        empty="none: no case was run",
    )


def build_provenance(study: Study) -> Table:
    """All that is needed to repeat the study."""
    made = study.provenance
    verdict = VERDICTS[study.verdict]
    pairs = {
        "Command": made.command,
        "Exit code": f"{verdict.exit_code} ({verdict.word})",
        "Program": f"netdesign {made.version}",
        "Started": made.started,
        "Site file": made.site_file,
        "Site file, SHA-256": made.site_sha256,
        "Limit profile": f"{study.profile.id}, {study.profile.edition}",
        "Limit profile, SHA-256": study.profile.sha256,
        "Schema": study.schema,
    }
    pairs |= {f"Setting: {name}": text for name, text in made.settings.items()}
    pairs |= {f"Library: {name}": text for name, text in made.libraries.items()}
    return Table(
        caption="Origin of every number of this report",
        columns=(_words("Item"), _words("Value")),
        rows=tuple((_text(name), _text(text)) for name, text in pairs.items()),
    )


def stack_tables(caption: str, parts: Sequence[tuple[str, Table]]) -> Table:
    """One table out of several of one shape, told apart by their net row."""
    first = parts[0][1]
    return Table(
        caption=caption,
        columns=(_words("Net row"), *first.columns),
        rows=tuple((_text(name), *row) for name, part in parts for row in part.rows),
    )
