"""Plain tables of a study: the same rows for the page and for the workbook."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace

from netdesign.outcome import Outcome
from netdesign.report.blocks.table import (
    Cell,
    Column,
    Table,
    band_cell,
    given_cell,
    name_columns,
    number_cell,
    number_column,
    quantity_column,
    text_cell,
    text_column,
)
from netdesign.report.words import (
    MISSING,
    VERDICTS,
    Words,
    add_unit,
    show_member,
    show_own,
    show_text,
    show_unit,
    show_verdict,
    understand,
)
from netdesign.site.model import InputEcho
from netdesign.structure.members import REPORTED_MEMBERS
from netdesign.study.case_records import CasePoint, CaseRecord
from netdesign.study.document import hash_results
from netdesign.study.records import ProfileRecord, ProfileValue, RowStudy, Study
from netdesign.words.names import name

# Fields of a CaseRecord; the keys of its member forces without their unit.
DEFAULT = "default"  # cell of an input that nobody typed
_NUMBER = re.compile(r"[0-9]+(\.[0-9]+)?(e[+-]?[0-9]+)?")
ASSUMED = "assumed"  # status of a profile value that nobody has confirmed
CASE_QUANTITIES = ("density_kg_m3", "friction_deg", "inclination_deg")


def list_case_columns(words: Words, row: RowStudy) -> tuple[Column, ...]:
    """Columns of the quantities of a row's cases."""
    keys = row.cases[0].case.values if row.cases else CASE_QUANTITIES
    return tuple(quantity_column(words, key) for key in keys)


def _case(case: CasePoint, words: Words) -> tuple[Cell, ...]:
    return tuple(number_cell(words, *one) for one in case.values.items())


def build_extremes(row: RowStudy, words: Words) -> Table:
    """Largest force of each member, with what the others carry in that case."""
    return Table(
        caption=words("caption.extremes"),
        columns=(
            text_column(words("heading.member")),
            quantity_column(words, "max_kN"),
            text_column(add_unit(words("heading.band"), "kN")),
            *list_case_columns(words, row),
            *(quantity_column(words, f"{member}_kN") for member in REPORTED_MEMBERS),
        ),
        rows=tuple(
            (
                text_cell(show_member(words, extreme.quantity)),
                number_cell(words, "max_kN", extreme.max_kN),
                band_cell(words, "max_kN", extreme.low_kN, extreme.high_kN),
                *_case(extreme.case, words),
                *(
                    number_cell(
                        words, f"{member}_kN", extreme.coincident_kN.get(member)
                    )
                    if member != extreme.quantity
                    else number_cell(words, "max_kN", extreme.max_kN)
                    for member in REPORTED_MEMBERS
                ),
            )
            for extreme in row.extremes
        ),
        empty=words("heading.no_case_converged"),
    )


def list_failed(row: RowStudy) -> list[CaseRecord]:
    """Cases that gave no numbers."""
    return [case for case in row.cases if case.outcome is not Outcome.CONVERGED]


def list_loaded(row: RowStudy) -> list[str]:
    """Members that carry a force in at least one case."""
    return [
        member
        for member in REPORTED_MEMBERS
        if any(getattr(case, f"{member}_kN") for case in row.cases)
    ]


def build_failed(row: RowStudy, words: Words) -> Table:
    """Cases without a result, by name."""
    return Table(
        caption=words("caption.failed"),
        columns=name_columns(
            [words(f"heading.{one}") for one in ("case", "outcome", "reason")],
            numbers=(),
        ),
        rows=tuple(
            (
                Cell(text=words.name_case(case.case)),
                text_cell(words(f"ended.{case.outcome}")),
                _explain(case, words),
            )
            for case in list_failed(row)
        ),
        empty=words("heading.every_case_converged")
        if row.cases
        else words("heading.no_case_run"),
    )


def _explain(case: CaseRecord, words: Words) -> Cell:
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
            text_column(words("heading.outcome")),
            text_column(words("heading.reason")),
        ),
        rows=tuple(
            (
                *_case(case.case, words),
                *(number_cell(words, key, getattr(case, key)) for key in keys),
                text_cell(words(f"ended.{case.outcome}")),
                _explain(case, words),
            )
            for case in row.cases
        ),
        empty=words("show.none"),
    )


def build_inputs(inputs: Sequence[InputEcho], caption: str, words: Words) -> Table:
    """List inputs as typed and as understood, each with its cell."""
    keys = ("input", "typed", "understood_as", "unit", "cell")
    headings = [words(f"heading.{key}") for key in keys]
    return Table(
        caption=caption,
        columns=name_columns(headings, numbers=(words("heading.understood_as"),)),
        rows=tuple(
            (
                text_cell(words.show(echo.label)),
                text_cell(
                    words.show(echo.derivation) if echo.derivation else echo.text
                ),
                given_cell(words, understand(echo, words)),
                text_cell(show_unit(echo.unit)),
                text_cell(
                    words("status.default") if echo.cell == DEFAULT else echo.cell
                ),
            )
            for echo in inputs
        ),
        empty=words("show.none"),
    )


def build_profile(study: Study, words: Words, status: str = "") -> Table:
    """Values of the limit profile; only those of one ``status`` if it is given."""
    keys = ("clause_and_key", "value_of", "value", "unit", "status", "source")
    headings = [words(f"heading.{key}") for key in keys]
    caption = words("caption.every_value")
    if status:
        named = words.show(name("status", status))
        caption = words("caption.values_of_status", status=named)
    return Table(
        caption=caption,
        columns=name_columns(headings, numbers=(words("heading.value"),)),
        rows=tuple(
            (
                text_cell(_name_place(value)),
                text_cell(show_own(words, value.text)),
                given_cell(words, value.value),
                text_cell(show_unit(value.unit)),
                text_cell(words.show(name("status", value.status))),
                text_cell(show_own(words, value.source)),
            )
            for value in study.profile.values
            if status in ("", value.status)
        ),
        empty=words("show.none"),
    )


def _name_place(value: ProfileValue) -> str:
    """Clause and key of a value: what the first page and a reviewer ask for."""
    return ", ".join(
        one for one in (value.clause, value.id) if one not in ("", MISSING)
    )


def number_sources(table: Table) -> tuple[Table, tuple[str, ...]]:
    """The table with a number for each source that several values have, and those."""
    counts = Counter(cells[-1].text for cells in table.rows)
    shared = [source for source, count in counts.items() if count > 1]
    numbers = {source: f"[{k}]" for k, source in enumerate(shared, 1)}
    rows = tuple(
        (*cells[:-1], Cell(text=numbers.get(cells[-1].text, cells[-1].text)))
        for cells in table.rows
    )
    told = tuple(f"{number} {source}" for source, number in numbers.items())
    return replace(table, rows=rows), told


def list_below_one(profile: ProfileRecord, words: Words) -> tuple[str, ...]:
    """Factors below 1, each with the reason that the profile gives."""
    return tuple(
        words(
            "show.label",
            label=f"{value.id} = {words.show_quantity(value.value, value.unit)}",
            text=words("note.below_one", reason=show_text(value.reason_below_one)),
        )
        for value in profile.values
        if value.reason_below_one
    )


def build_quality(study: Study, words: Words) -> Table:
    """Worst numerical quality of each row."""
    counts = (words("heading.cases"), words("heading.without_result"))
    error = add_unit(words("heading.largest_error"), "%")
    return Table(
        caption=words("caption.quality"),
        columns=(
            text_column(words("heading.net_row")),
            *name_columns(counts, numbers=counts),
            number_column("balance_residual", words("heading.largest_residual")),
            text_column(words("heading.in_case")),
            number_column("error_percent", error),
            text_column(words("heading.in_case")),
        ),
        rows=tuple(_quality_row(row, words) for row in study.rows),
        empty=words("show.none"),
    )


def _quality_row(row: RowStudy, words: Words) -> tuple[Cell, ...]:
    residual, residual_case = _worst(row, lambda case: case.balance_residual)
    error, error_case = _worst(row, lambda case: case.error_percent)
    return (
        text_cell(row.id),
        given_cell(words, len(row.cases)),
        given_cell(words, len(list_failed(row))),
        number_cell(words, "balance_residual", residual),
        Cell(text=words.name_case(residual_case)),
        number_cell(words, "error_percent", error),
        Cell(text=words.name_case(error_case)),
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


def build_outcomes(study: Study, words: Words) -> Table:
    """Count cases by outcome; outcomes that did not occur are left out."""
    headings = [words(f"heading.{key}") for key in ("outcome", "cases", "meaning")]
    counts = Counter(case.outcome for row in study.rows for case in row.cases)
    return Table(
        caption=words("caption.outcomes"),
        columns=name_columns(headings, numbers=headings[1:2]),
        rows=tuple(
            (
                text_cell(words(f"ended.{outcome}")),
                given_cell(words, counts[outcome]),
                text_cell(words.show(outcome.message)),
            )
            for outcome in Outcome
            if counts[outcome]
        ),
        empty=words("heading.no_case_run"),
    )


def build_provenance(study: Study, words: Words) -> Table:
    """All that is needed to repeat the study."""
    made = study.provenance
    pairs = {
        "command": made.command,
        "command_again": "netdesign report study.json",
        "results_hash": hash_results(study),
        "program": f"netdesign {made.version}",
        "started": made.started,
        "site_file": made.site_file,
        "site_hash": made.site_sha256,
        "limit_profile": words(
            "show.label", label=study.profile.id, text=name_profile(study, words)
        ),
        "profile_version": study.profile.version,
        "profile_choice": study.profile.choice,
        "profile_hash": study.profile.sha256,
        "schema": study.schema,
    }
    named = {words(f"heading.{key}"): text for key, text in pairs.items()}
    for label, text in list_settings(study, words):
        named[words("show.setting", setting=label)] = text
    libraries = ", ".join(f"{k} {v}" for k, v in made.libraries.items())
    named[words("heading.libraries")] = libraries
    verdict = show_verdict(study.verdict, words)
    code = VERDICTS[study.verdict].exit_code
    named[words("heading.exit_code")] = words(
        "show.exit_code", code=code, verdict=verdict.word
    )
    return Table(
        caption=words("caption.provenance"),
        columns=(
            text_column(words("heading.item")),
            text_column(words("heading.value")),
        ),
        rows=tuple((text_cell(one), text_cell(text)) for one, text in named.items()),
    )


def name_profile(study: Study, words: Words) -> str:
    """Title and edition of the limit profile."""
    return show_own(words, f"{study.profile.title}, {study.profile.edition}")


def list_settings(study: Study, words: Words) -> list[tuple[str, str]]:
    """Settings of a run by their names; the method in words."""
    return [
        (
            words.show(name("setting", key)),
            words.show(name("method_used", text))
            if key == "method"
            else _show_setting(text, words),
        )
        for key, text in study.provenance.settings.items()
    ]


def _show_setting(text: str, words: Words) -> str:
    """Setting as stored; a number, and only that, with the language's mark."""
    return words.write(text) if _NUMBER.fullmatch(text) else show_own(words, text)


def stack_tables(
    caption: str, parts: Sequence[tuple[str, Table]], words: Words
) -> Table:
    """One table out of several, told apart by their net row.

    A column that only some of them have is empty for the others.
    """
    columns = _join_columns([table for _, table in parts])
    return Table(
        caption=caption,
        columns=(text_column(words("heading.net_row")), *columns),
        rows=tuple(
            (text_cell(name), *_place_cells(part, row, columns))
            for name, part in parts
            for row in part.rows
        ),
        empty=parts[0][1].empty,
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
