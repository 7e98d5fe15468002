"""Checks worked out: the governing one of a row on its page, all of them in an annex.

A reader redoes the numbers from the page alone: what is solved or given stands with its
interval, each formula with its result.
"""

from __future__ import annotations

from collections.abc import Iterator

from netdesign.calculation.steps import PRINTED, Step, list_operands, translate
from netdesign.checks.check import Check
from netdesign.report.blocks import (
    Block,
    Cell,
    Content,
    Items,
    Paragraph,
    Part,
    Piece,
    Table,
    key_columns,
    section,
    strong,
    symbols,
    text_cell,
)
from netdesign.report.sections.checks import (
    describe_eased,
    describe_resistance,
    name_case,
    name_checks,
)
from netdesign.report.sections.rated import find_worked
from netdesign.report.words import (
    MISSING,
    UNBOUNDED,
    Words,
    append_unit,
    show_check,
    show_text,
    show_verdict,
)
from netdesign.study.records import RowStudy, Study

# Loads of which the largest is the characteristic force: of the others only the result.
_LOADS = ("E_c", "E_p", "E_t", "E_g", "E_m")
_OF_LOADS = {
    "panel": "E_p",
    "truss": "E_t",
    "guideline": "E_g",
    "coupled": "E_c",
    "maker": "E_m",
}


def work_out(check: Check, words: Words) -> Table:
    """The calculation of a check: name, formula, numbers, result, source, a line each.

    Of loads that do not govern the result stands alone.
    """
    lines = [_work_step(step, check, words) for step in _list_shown(check)]
    return Table(
        caption="",
        columns=key_columns(
            words, "worked.", ("name", "formula", "numbers", "result", "source")
        ),
        rows=(*lines, *_list_beside(check, words)),
        look="worked",
    )


def show_governing(study: Study, words: Words) -> Part:
    """Governing check of each row worked out."""
    parts: list[Block] = []
    for row in study.rows:
        check = find_worked(row)
        if check is not None:
            named = show_check(words, check), name_case(check, words)
            title = words.join((show_text(row.id), *named))
            name = f"worked-{len(parts) + 1}"
            worked = work_out(check, words)
            parts.append(section(name, title, worked, level=3))
    none = Paragraph(text=words("heading.no_utilisation"), look="none")
    return section("worked", words("heading.worked"), *(parts or [none]))


def _list_shown(check: Check) -> list[Step]:
    """Steps with a formula that lead from the governing load to the utilisation.

    Of the other loads the line of the largest has the numbers.
    """
    governing = _OF_LOADS.get(check.governs, "")
    wanted = {"E_d", *(("μ", "R_d", "R_k") if check.used is not None else ())}
    for step in reversed(check.steps):
        is_wanted = step.symbol in wanted
        if is_wanted and step.formula:
            operands = {symbol for symbol, _ in list_operands(step.formula, 0)}
            loads = operands & set(_LOADS) if step.symbol == "E_k" else set()
            others = loads - {governing} if governing in loads else set()
            wanted |= operands - others
    return [step for step in check.steps if step.symbol in wanted and step.formula]


def _work_step(step: Step, check: Check, words: Words) -> tuple[Cell, ...]:
    """Line of a step; what is left to resist nothing has no numbers."""
    known = {each.symbol: _show_digits(each.value, words) for each in check.steps}
    formula = words.write_formula(translate(step.formula, PRINTED))
    numbers = words.write_formula(
        translate(step.formula, PRINTED, lambda symbol, _: known[symbol])
    )
    result = append_unit(_show_digits(step.value, words), step.unit)
    if step.symbol == "μ":
        result = words.show_number("utilisation", step.value)
    if check.is_unbounded and step.symbol in ("R_d", "μ"):
        numbers = words.show(check.reason)
        result = UNBOUNDED if step.symbol == "μ" else MISSING
    return (
        text_cell(words(f"symbol.{step.symbol}")),
        Cell(content=symbols(f"{step.symbol} = {formula}")),
        text_cell(f"= {numbers}"),
        _show_result(result),
        text_cell(step.source or MISSING),
    )


def _show_result(shown: str) -> Cell:
    """Result that stands out, never broken before its unit."""
    return Cell(content=strong(shown.replace(" ", "\u00a0")))


def _list_beside(check: Check, words: Words) -> Iterator[tuple[Cell, ...]]:
    """Least resistance with which a check without one passes."""
    needed = check.needed_kN
    if needed is not None and check.resistance_kN is None:
        upper = _show_digits(check.read_band("E_d")[1], words)
        yield (
            text_cell(words("worked.needed")),
            Cell(content=symbols("R_k ≥ γ_R · E_d")),
            Cell(content=symbols(words("worked.upper_end", force=upper))),
            _show_result(append_unit(words.show_minimum(needed), "kN")),
            text_cell(words("worked.least")),
        )


def _show_digits(value: float | None, words: Words) -> str:
    """Number to four digits: enough to redo what follows from it."""
    if value is None or not 1e-3 < abs(value) < 1e4:
        return words.show_digits(value)
    return words.write(f"{value:.4g}")


def show_all(study: Study, words: Words, legend: Paragraph) -> Part:
    """Annex with every check of every row, step by step, below a legend of symbols."""
    reading = Paragraph(text=symbols(words("reading.annex_checks")), look="small")
    named = "annex-checks", words("heading.annex_checks")
    if not study.rows:
        none = Paragraph(text=words("heading.no_rows"), look="none")
        return section(*named, reading, none)
    parts = [part for row in study.rows for part in _show_row(row, words)]
    return section(*named, reading, *parts, legend)


def _show_row(row: RowStudy, words: Words) -> Iterator[Table | Items]:
    """Checks of forces step by step, then those that compare none."""
    forces = [check for check in row.checks if check.is_of_force]
    yield Table(
        caption=show_text(row.id),
        columns=key_columns(words, "heading.", ("calculation",)),
        rows=tuple((Cell(content=_describe_check(x, words)),) for x in forces),
        empty=words("heading.no_utilisation"),
        look="worked-out",
    )
    further = _list_further(row, words)
    if further:
        yield Items(items=further, look="small")


def _describe_check(check: Check, words: Words) -> Content:
    """Every step of a check with its interval; its resistance, verdict and case."""
    mark = show_verdict(check.verdict, words).symbol
    label = words("show.label", label=f"{mark} {show_check(words, check)}", text="")
    known = (step for step in check.steps if step.value is not None)
    texts = [_describe_step(each, check, words) for each in known]
    beside = [describe_resistance(check, words), name_case(check, words)]
    beside += [text for text in [describe_eased(check, words)] if text]
    if check.is_unbounded:
        beside.append(words.show(check.reason))
    return (
        Piece(label, "name"),
        Piece(words.join(texts), has_symbols=True),
        Piece("\n" + words.join(x for x in beside if x != MISSING)),
    )


def _describe_step(step: Step, check: Check, words: Words) -> str:
    """Symbol, formula, value with its interval and unit."""
    shown = append_unit(_show_interval(step, words), step.unit.replace("-", ""))
    if step.formula:
        formula = words.write_formula(translate(step.formula, PRINTED))
        return f"{step.symbol} = {formula} = {shown}"
    if step.symbol == "R_k" and check.resistance_derivation:
        return f"R_k = {words.show(check.resistance_derivation)} = {shown}"
    return f"{step.symbol} = {shown}"


def _show_interval(step: Step, words: Words) -> str:
    low, value, high = (_show_digits(end, words) for end in step.ends)
    return value if low == value == high else f"{value} ({low}–{high})"


def _list_further(row: RowStudy, words: Words) -> tuple[str, ...]:
    """Checks that compare no force; those with one reason in one line.

    Each line has verdict, names, clause and reason.
    """
    alike: dict[tuple[str, str, str], list[Check]] = {}
    for check in row.checks:
        if check.is_of_force:
            continue
        mark = show_verdict(check.verdict, words).symbol
        clause = f" ({check.clause})" if check.clause not in ("", MISSING) else ""
        texts = (mark, clause, words.show(check.reason))
        alike.setdefault(texts, []).append(check)
    return tuple(
        words(
            "show.label",
            label=f"{mark} {show_text(row.id)}, {name_checks(every, words)}{clause}",
            text=reason,
        )
        for (mark, clause, reason), every in alike.items()
    )
