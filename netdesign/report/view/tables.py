"""Plain tables of a study: the same rows for the page and for the workbook."""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Callable, Sequence

from netdesign.edge.json_text import list_fields
from netdesign.outcome import Outcome
from netdesign.report.view.table import (
    Cell,
    Table,
    given_cell,
    name_columns,
    number_cell,
    number_column,
    text_cell,
    text_column,
    word_cell,
)
from netdesign.report.words import (
    VERDICTS,
    name_case,
    name_member,
    show_band,
    show_unit,
)
from netdesign.site.model import InputEcho
from netdesign.study.records import CasePoint, CaseRecord, RowStudy, Study

# Fields of a CaseRecord; the keys of its member forces without their unit.
MEMBERS = ("foot_anchor", "uphill_guy", "downhill_guy", "post")
_COUNTS = ("Cases", "Without result")
DEFAULT = "default"  # cell of an input that nobody typed
ASSUMED = "assumed"  # status of a profile value that nobody has confirmed


CASE_COLUMNS = tuple(
    number_column(key) for key in ("density_kg_m3", "friction_deg", "inclination_deg")
)


def _case(case: CasePoint) -> tuple[Cell, ...]:
    return (
        given_cell(case.density_kg_m3),
        given_cell(case.friction_deg),
        given_cell(case.inclination_deg),
    )


def build_extremes(row: RowStudy) -> Table:
    """Largest force of each member, with what the others carry in that case."""
    return Table(
        caption="Largest characteristic force of each member, with the forces of the "
        "other members in the same case",
        columns=(
            text_column("Member"),
            number_column("max_kN"),
            text_column("Band [kN]"),
            *CASE_COLUMNS,
            *(number_column(f"{member}_kN") for member in MEMBERS),
        ),
        rows=tuple(
            (
                word_cell(name_member(extreme.quantity)),
                number_cell("max_kN", extreme.max_kN),
                word_cell(show_band("max_kN", extreme.low_kN, extreme.high_kN)),
                *_case(extreme.case),
                *(
                    number_cell(f"{member}_kN", extreme.coincident_kN.get(member))
                    if member != extreme.quantity
                    else number_cell("max_kN", extreme.max_kN)
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


def list_loaded(row: RowStudy) -> list[str]:
    """Members that carry a force in at least one case."""
    return [
        member
        for member in MEMBERS
        if any(getattr(case, f"{member}_kN") for case in row.cases)
    ]


def build_failed(row: RowStudy) -> Table:
    """Cases without a result, by name."""
    return Table(
        caption="Cases that gave no numbers; no largest force includes them",
        columns=(text_column("Case"), text_column("Outcome"), text_column("Reason")),
        rows=tuple(
            (Cell(text=name_case(case.case)), word_cell(case.outcome), _explain(case))
            for case in list_failed(row)
        ),
        empty="none: every case converged" if row.cases else "none: no case was run",
    )


def _explain(case: CaseRecord) -> Cell:
    if case.outcome is Outcome.CONVERGED:
        return word_cell(str(case.reason or ""))
    return word_cell(f"{case.outcome.sentence} {case.reason or ''}")


def build_cases(row: RowStudy) -> Table:
    """Every case of a row with its forces or the reason why there are none."""
    keys = [f"{member}_kN" for member in MEMBERS]
    keys += ["error_percent", "balance_residual"]
    return Table(
        caption="Cases, characteristic forces per anchor",
        columns=(
            *CASE_COLUMNS,
            *(number_column(key) for key in keys),
            text_column("Outcome"),
            text_column("Reason"),
        ),
        rows=tuple(
            (
                *_case(case.case),
                *(number_cell(key, getattr(case, key)) for key in keys),
                word_cell(case.outcome),
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
        columns=name_columns(headings, numbers=("Understood as",)),
        rows=tuple(
            (
                word_cell(echo.label),
                text_cell(echo.text),
                given_cell(echo.value),
                text_cell(show_unit(echo.unit)),
                word_cell(echo.cell) if echo.cell == DEFAULT else text_cell(echo.cell),
            )
            for echo in inputs
        ),
    )


def build_profile(study: Study, status: str = "") -> Table:
    """Values of the limit profile; only those of one ``status`` if it is given."""
    headings = ("Clause", "Value of", "Value", "Unit", "Status", "Source")
    return Table(
        caption=f"Values with the status {status!r}" if status else "Every value used",
        columns=name_columns(headings, numbers=("Value",)),
        rows=tuple(
            (
                text_cell(value.clause),
                word_cell(value.text),
                given_cell(value.value),
                text_cell(show_unit(value.unit)),
                word_cell(value.status),
                word_cell(value.source),
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
            text_column("Net row"),
            *name_columns(_COUNTS, numbers=_COUNTS),
            number_column(
                "balance_residual", "Largest balance residual, of the weight"
            ),
            text_column("In case"),
            number_column("error_percent", "Largest error estimate [%]"),
            text_column("In case"),
        ),
        rows=tuple(_quality_row(row) for row in study.rows),
    )


def _quality_row(row: RowStudy) -> tuple[Cell, ...]:
    residual, residual_case = _worst(row, lambda case: case.balance_residual)
    error, error_case = _worst(row, lambda case: case.error_percent)
    return (
        text_cell(row.id),
        given_cell(len(row.cases)),
        given_cell(len(list_failed(row))),
        number_cell("balance_residual", residual),
        Cell(text=name_case(residual_case)),
        number_cell("error_percent", error),
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
        columns=name_columns(("Outcome", "Cases", "Meaning"), numbers=("Cases",)),
        rows=tuple(
            (
                word_cell(outcome),
                given_cell(counts[outcome]),
                word_cell(outcome.sentence),
            )
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
        "Command for this document again": "netdesign report study.json",
        "Results, SHA-256": hash_results(study),
        "Program": f"netdesign {made.version}",
        "Started": made.started,
        "Site file": made.site_file,
        "Site file, SHA-256": made.site_sha256,
        "Limit profile": f"{study.profile.id}, {study.profile.edition}",
        "Limit profile, version": study.profile.version,
        "Limit profile, choice": study.profile.choice,
        "Limit profile, SHA-256": study.profile.sha256,
        "Schema": study.schema,
    }
    pairs |= {f"Setting: {name}": text for name, text in made.settings.items()}
    pairs["Libraries"] = ", ".join(f"{k} {v}" for k, v in made.libraries.items())
    code = word_cell(f"{verdict.exit_code} ({verdict.word})")
    return Table(
        caption="Origin of every number of this report",
        columns=(text_column("Item"), text_column("Value")),
        rows=(
            *((word_cell(name), text_cell(text)) for name, text in pairs.items()),
            (word_cell("Exit code"), code),
        ),
    )


def hash_results(study: Study) -> str:
    """SHA-256 of verdict and net rows: equal for equal results, whenever made."""
    content = {
        "verdict": study.verdict,
        "profile": study.profile.sha256,
        "rows": study.rows,
    }
    text = json.dumps(content, default=list_fields, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def stack_tables(caption: str, parts: Sequence[tuple[str, Table]]) -> Table:
    """One table out of several of one shape, told apart by their net row."""
    first = parts[0][1]
    return Table(
        caption=caption,
        columns=(text_column("Net row"), *first.columns),
        rows=tuple(
            (text_cell(name), *row) for name, part in parts for row in part.rows
        ),
    )
