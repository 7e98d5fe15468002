"""Checks worked out: the governing one of a row line by line, and all in an annex.

A reader redoes every number of the annex from the page alone: what is solved or given
stands with its interval, and below it each formula with its result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from netdesign.calculation.formula import PRINTED, write_formula
from netdesign.calculation.quantity import Quantity
from netdesign.calculation.steps import Step, evaluate
from netdesign.report.blocks.block import Block, Paragraph, Part, section
from netdesign.report.blocks.table import (
    Cell,
    Table,
    name_columns,
    rich_cell,
    text_cell,
)
from netdesign.report.blocks.text import Piece, strong, symbols
from netdesign.report.sections.checks import describe_resistance, name_case
from netdesign.report.words import (
    MISSING,
    UNBOUNDED,
    Words,
    append_unit,
    show_check,
    show_member,
    show_text,
    show_verdict,
)
from netdesign.study.records import CheckRecord, RowStudy, Study
from netdesign.words.names import name_mode

_LAST = "E_d"  # of the steps that checks of one member share
# Formulas of every check, which stand once above all of them.
_BY_HEADING = ("E_d", "R_d", "μ")


def work_out(check: CheckRecord, words: Words) -> Table:
    """The calculation of a check: formula, numbers, result, a line each."""
    headings = [words(f"heading.{one}") for one in ("symbols", "numbers", "result")]
    title = {"check": show_check(words, check), "case": name_case(check, words)}
    return Table(
        caption=words("show.row_at_case", **title),
        columns=name_columns(headings, numbers=()),
        rows=tuple(_list_steps(check, words)),
        look="worked",
    )


def _list_steps(check: CheckRecord, words: Words) -> Iterator[tuple[Cell, ...]]:
    """Every quantity that is worked out, from the solved force to the utilisation."""
    for one in evaluate(check.steps).values():
        told = _describe_given(one, check, words)
        if told:
            yield rich_cell(symbols(one.symbol)), text_cell(told[0]), text_cell(told[1])
        elif one.operation:
            formula = _write(one, lambda leaf: leaf.symbol, words)
            numbers = _write(one, lambda leaf: _show(leaf, words), words)
            shown = _show(one, words)
            if one.symbol == "μ":
                shown = _add_band(words, *check.used_band, one.value, "utilisation")
            yield (
                rich_cell(symbols(f"{one.symbol} = {formula}")),
                text_cell(f"= {numbers}"),
                rich_cell((Piece("= "), *strong(shown))),
            )


def _describe_given(
    one: Quantity, check: CheckRecord, words: Words
) -> tuple[str, str] | None:
    """Text in the place of numbers and result of a quantity without a formula."""
    if check.is_unbounded and one.symbol in ("R_d", "μ"):  # nothing is left to resist
        if one.symbol == "R_d":
            return words.show(check.reason), MISSING
        return words("show.nothing_resists"), UNBOUNDED
    if one.operation or one.symbol != "R_k" or not check.resistance_derivation:
        return None
    return f"= {words.show(check.resistance_derivation)}", f"= {_show(one, words)}"


def _show(quantity: Quantity, words: Words) -> str:
    return words.show_symbol(quantity.symbol, quantity.unit, quantity.value)


def _write(quantity: Quantity, show: Callable[[Quantity], str], words: Words) -> str:
    """Formula of a quantity with what is shown of each one that it is made of."""
    notation = replace(PRINTED, number=words.show_given)
    return write_formula(quantity, lambda one, _: show(one), notation)


def _add_band(
    words: Words, low: float | None, high: float | None, value: float | None, key: str
) -> str:
    band = words.show_band(key, low, high)
    shown = words.show_number(key, value)
    return shown if band == MISSING else words("show.with_band", value=shown, band=band)


def show_all(study: Study, words: Words) -> Part:
    """Annex with every check of every row."""
    rows = (
        block
        for number, row in enumerate(study.rows, 1)
        for block in _show_row(row, number, words)
    )
    reading = Paragraph(text=symbols(words("reading.annex_checks")), look="small")
    none = Paragraph(text=words("heading.no_rows"), look="none")
    shown = tuple(rows) or (none,)
    return section("annex-checks", words("heading.annex_checks"), reading, *shown)


def _show_row(row: RowStudy, number: int, words: Words) -> Iterator[Block]:
    groups = _group(row.checks)
    shared = _find_shared(groups)
    name = words("show.label", label=words("heading.net_row"), text=show_text(row.id))
    told = words.join(_describe_leaf(one, words) for one in shared)
    table = Table(
        caption=f"{name}. {told}",
        columns=name_columns([words("heading.calculation")], numbers=()),
        rows=tuple(_list_groups(groups, shared, words)),
        empty=words("heading.no_utilisation"),
        look="worked-out",
        symbols="headings",
    )
    further = [one for one in row.checks if not one.is_of_force]
    shown: tuple[Block, ...] = (table,)
    if further:
        text = words.join(_describe_further(further, words))
        shown += (Paragraph(text=text, look="small"),)
    yield Part(kind="section", id=f"row-{number}-calculation", blocks=shown)


def _describe_further(checks: Sequence[CheckRecord], words: Words) -> Iterator[str]:
    """Checks that compare no force, each with its verdict, clause and reason."""
    for check in checks:
        sign = show_verdict(check.verdict, words).symbol
        clause = f" ({check.clause})" if check.clause not in ("", MISSING) else ""
        label = f"{sign} {show_check(words, check)}{clause}"
        reason = words.show(check.reason).rstrip(".")
        yield words("show.label", label=label, text=reason)


def _group(checks: Sequence[CheckRecord]) -> list[list[CheckRecord]]:
    """Checks of forces by the steps that lead to their design force."""
    groups: dict[tuple[object, ...], list[CheckRecord]] = {}
    for check in checks:
        if check.is_of_force:
            told = tuple(_identify(one) for one in _take_action(check))
            groups.setdefault(told, []).append(check)
    return list(groups.values())


def _identify(step: Step) -> tuple[object, ...]:
    """Content of a step; a guy and its anchor have theirs from other places."""
    return step.symbol, step.formula, step.ends


def _take_action(check: CheckRecord) -> Iterator[Step]:
    for step in check.steps:
        yield step
        if step.symbol == _LAST:
            return


def _find_shared(groups: Sequence[Sequence[CheckRecord]]) -> list[Step]:
    """Given and solved values that have one value in the whole row, in their order."""
    found: dict[str, dict[object, Step]] = {}
    for group in groups:
        for step in _take_action(group[0]):
            found.setdefault(step.symbol, {})[_identify(step)] = step
    alone = [steps for steps in found.values() if len(steps) == 1]
    return [step for steps in alone for step in steps.values() if not step.formula]


def _list_groups(
    groups: Sequence[Sequence[CheckRecord]], shared: Sequence[Step], words: Words
) -> Iterator[tuple[Cell, ...]]:
    told: set[object] = set()  # resistances whose dimensions stand above already
    above = {step.symbol for step in shared}
    for group in groups:
        whole = list(_take_action(group[0]))
        action = [one for one in whole if one.symbol not in above]
        known = {one.id: evaluate(one.steps) for one in group}
        first = known[group[0].id]
        steps = [_describe_step(one, first, words) for one in _set_leaves_first(action)]
        name = words("show.label", label=_name_group(group, words), text="")
        parts = [
            Piece(name, "name"),
            Piece(f"{words.join(steps)}.", has_symbols=True),
        ]
        for check in group:
            own = [one for one in check.steps[len(whole) :] if one.symbol not in above]
            resistance = (check.resistance_cell, check.mode, check.read("R_k"))
            is_told = resistance in told
            parts += _describe_check(
                check, own, known[check.id], words, is_told=is_told
            )
            told.add(resistance)
        yield (rich_cell(tuple(parts)),)


def _name_group(group: Sequence[CheckRecord], words: Words) -> str:
    """Members that a design force acts on, and their place."""
    members = dict.fromkeys(show_member(words, one.member) for one in group)
    named = words.join(members)
    is_end = group[0].position == "edge"
    return words("check.of_end", check=named) if is_end else named


def _set_leaves_first(steps: Sequence[Step]) -> list[Step]:
    return sorted(steps, key=lambda one: bool(one.formula))


def _describe_step(step: Step, known: dict[str, Quantity], words: Words) -> str:
    """Symbol, formula, value; what the heading says of all checks is left out."""
    if not step.formula:
        return _describe_leaf(step, words)
    if step.symbol in _BY_HEADING:
        return f"{step.symbol} = {_show_step(step, words)}"
    formula = _write(known[step.symbol], lambda leaf: leaf.symbol, words)
    return f"{step.symbol} = {formula} = {_show_digits(step.value, words)}"


def _describe_leaf(step: Step, words: Words) -> str:
    return f"{step.symbol} = {_show_step(step, words)}"


def _show_step(step: Step, words: Words) -> str:
    """Value and its interval; its unit where that is no force."""
    low, value, high = (_show_digits(one, words) for one in step.ends)
    shown = value if low == value == high else f"{value} ({low}–{high})"
    return shown if step.unit in ("kN", "-") else append_unit(shown, step.unit)


def _show_digits(value: float | None, words: Words) -> str:
    """Number to four digits: enough to redo what follows from it."""
    if value is None or not 1e-3 < abs(value) < 1e4:
        return words.show_digits(value)
    return words.write(f"{value:.4g}")


def _describe_check(
    check: CheckRecord,
    steps: Sequence[Step],
    known: dict[str, Quantity],
    words: Words,
    *,
    is_told: bool,
) -> tuple[Piece, Piece]:
    """Line of one check: where its resistance comes from, and what follows."""
    told = []
    for step in steps:
        given = _describe_given(known[step.symbol], check, words)
        if given and is_told and step.symbol == "R_k":
            told.append(_describe_leaf(step, words))
        elif given:
            told.append(f"{step.symbol} {' '.join(given)}")
        else:
            told.append(_describe_step(step, known, words))
    source = describe_resistance(check, words)
    mode = words.show(name_mode(check.mode))
    label = mode if source == MISSING else f"{mode} ({source})"
    case = name_case(check, words, is_short=True)
    sign = show_verdict(check.verdict, words).symbol
    return (
        Piece("\n" + words("show.label", label=f"{sign} {label}", text="")),
        Piece(words.join([*told, case]), has_symbols=True),
    )
