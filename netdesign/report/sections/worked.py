"""Checks worked out: the governing one of a row line by line, and kinds in an annex.

The annex has one check of each kind. A reader redoes its numbers from the page alone:
what is solved or given stands with its interval, and below it each formula with its
result. All others stand in the tables of their rows, and live in the workbook.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from netdesign.calculation.steps import PRINTED, Step, translate
from netdesign.checks.check import Check
from netdesign.report.blocks import (
    Cell,
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
from netdesign.report.sections.checks import describe_resistance, name_case, name_checks
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
from netdesign.study.records import Study
from netdesign.words.names import name_mode

_LAST = "E_d"  # of the steps that checks of one member share
# Formulas of every check, which stand once above all of them.
_BY_HEADING = ("E_d", "R_d", "μ")
_OfRow = tuple[str, Check]  # id of the net row, and a check of it


def work_out(check: Check, words: Words) -> Table:
    """The calculation of a check: formula, numbers, result, a line each."""
    title = {"check": show_check(words, check), "case": name_case(check, words)}
    return Table(
        caption=words("show.row_at_case", **title),
        columns=key_columns(words, "heading.", ("symbols", "numbers", "result")),
        rows=tuple(_list_steps(check, words)),
        look="worked",
    )


def _list_steps(check: Check, words: Words) -> Iterator[tuple[Cell, ...]]:
    """Every quantity that is worked out, from the solved force to the utilisation."""
    known = {one.symbol: _show(one, words) for one in check.steps}
    for one in check.steps:
        told = _describe_given(one, check, words)
        if told:
            yield Cell(content=symbols(one.symbol)), *map(text_cell, told)
        elif one.formula:
            formula = _print(one, words)
            numbers = words.write_formula(
                translate(one.formula, PRINTED, lambda symbol, _: known[symbol])
            )
            shown = known[one.symbol]
            if one.symbol == "μ":
                shown = _show_used(check, one.value, words)
            yield (
                Cell(content=symbols(f"{one.symbol} = {formula}")),
                text_cell(f"= {numbers}"),
                Cell(content=(Piece("= "), *strong(shown))),
            )


def _describe_given(one: Step, check: Check, words: Words) -> tuple[str, str] | None:
    """Text in the place of numbers and result of a quantity without a formula."""
    if check.is_unbounded and one.symbol in ("R_d", "μ"):  # nothing is left to resist
        if one.symbol == "R_d":
            return words.show(check.reason), MISSING
        return words("show.nothing_resists"), UNBOUNDED
    if one.formula or one.symbol != "R_k" or not check.resistance_derivation:
        return None
    shown = append_unit(_show_interval(one, words), one.unit)
    return f"= {words.show(check.resistance_derivation)}", f"= {shown}"


def _show(step: Step, words: Words) -> str:
    return append_unit(_show_digits(step.value, words), step.unit)


def _print(step: Step, words: Words) -> str:
    """Formula of a step in symbols."""
    return words.write_formula(translate(step.formula, PRINTED))


def _show_used(check: Check, used: float | None, words: Words) -> str:
    """Utilisation with its interval, where that is known."""
    shown = words.show_number("utilisation", used)
    band = words.show_band("utilisation", *check.used_band)
    return shown if band == MISSING else words("show.with_band", value=shown, band=band)


def show_all(study: Study, words: Words) -> Part:
    """Annex with the check that decides of each kind, and its net row."""
    reading = Paragraph(text=symbols(words("reading.annex_checks")), look="small")
    named = "annex-checks", words("heading.annex_checks")
    if not study.rows:
        none = Paragraph(text=words("heading.no_rows"), look="none")
        return section(*named, reading, none)
    groups = _group(_choose(study, is_of_force=True))
    shared = _find_shared(groups)
    table = Table(
        caption=words.join(_describe_step(one, words) for one in shared),
        columns=key_columns(words, "heading.", ("calculation",)),
        rows=tuple(_list_groups(groups, shared, words)),
        empty=words("heading.no_utilisation"),
        look="worked-out",
        symbols="headings",
    )
    further = _list_further(_choose(study, is_of_force=False), words)
    return section(*named, reading, table, Items(items=further, look="small"))


def _choose(study: Study, *, is_of_force: bool) -> list[_OfRow]:
    """Check that decides, of each kind; those with a ratio come first."""
    kinds: dict[tuple[str, ...], list[_OfRow]] = {}
    for row in study.rows:
        for check in row.checks:
            if check.is_of_force is is_of_force:
                kinds.setdefault(_name_kind(check), []).append((row.id, check))
    return [
        min(every, key=lambda one: (one[1].used is None, *one[1].rank))
        for every in kinds.values()
    ]


def _name_kind(check: Check) -> tuple[str, ...]:
    """Member, mode and place, and the way in which the resistance was found."""
    told = check.resistance_derivation
    return (check.member, check.mode, check.position, told.key if told else "")


def _list_further(checks: Sequence[_OfRow], words: Words) -> tuple[str, ...]:
    """Checks that compare no force; those of a row with one reason in one line.

    Each line has verdict, names, clause and reason.
    """
    alike: dict[tuple[str, str, str, str], list[Check]] = {}
    for row, check in checks:
        sign = show_verdict(check.verdict, words).symbol
        clause = f" ({check.clause})" if check.clause not in ("", MISSING) else ""
        told = (sign, show_text(row), clause, words.show(check.reason))
        alike.setdefault(told, []).append(check)
    return tuple(
        words(
            "show.label",
            label=f"{sign} {row}, {name_checks(every, words)}{clause}",
            text=reason,
        )
        for (sign, row, clause, reason), every in alike.items()
    )


def _group(checks: Sequence[_OfRow]) -> list[list[_OfRow]]:
    """Checks of forces by the steps of their net row that lead to the design force."""
    groups: dict[tuple[object, ...], list[_OfRow]] = {}
    for row, check in checks:
        told = tuple(_identify(one) for one in _take_action(check))
        groups.setdefault((row, *told), []).append((row, check))
    return list(groups.values())


def _identify(step: Step) -> tuple[object, ...]:
    """Content of a step; a guy and its anchor have theirs from other places."""
    return step.symbol, step.formula, step.ends


def _take_action(check: Check) -> Iterator[Step]:
    for step in check.steps:
        yield step
        if step.symbol == _LAST:
            return


def _find_shared(groups: Sequence[Sequence[_OfRow]]) -> list[Step]:
    """Given and solved values that have one value in all checks, in their order."""
    found: dict[str, dict[object, Step]] = {}
    for group in groups:
        for step in _take_action(group[0][1]):
            found.setdefault(step.symbol, {})[_identify(step)] = step
    alone = [steps for steps in found.values() if len(steps) == 1]
    return [step for steps in alone for step in steps.values() if not step.formula]


def _list_groups(
    groups: Sequence[Sequence[_OfRow]], shared: Sequence[Step], words: Words
) -> Iterator[tuple[Cell, ...]]:
    told: set[object] = set()  # resistances whose dimensions stand above already
    above = {step.symbol for step in shared}
    for group in groups:
        checks = [check for _, check in group]
        whole = list(_take_action(checks[0]))
        action = [one for one in whole if one.symbol not in above]
        steps = [_describe_step(one, words) for one in _set_leaves_first(action)]
        name = f"{show_text(group[0][0])}, {_name_group(checks, words)}"
        parts = [
            Piece(words("show.label", label=name, text=""), "name"),
            Piece(f"{words.join(steps)}.", has_symbols=True),
        ]
        for check in checks:
            own = [one for one in check.steps[len(whole) :] if one.symbol not in above]
            resistance = (check.resistance_cell, check.mode, check.read("R_k"))
            parts += _describe_check(check, own, words, is_told=resistance in told)
            told.add(resistance)
        yield (Cell(content=tuple(parts)),)


def _name_group(group: Sequence[Check], words: Words) -> str:
    """Members that a design force acts on, and their place."""
    members = dict.fromkeys(show_member(words, one.member) for one in group)
    named = words.join(members)
    key = {"edge": "check.of_end", "second": "check.of_second"}.get(group[0].position)
    return words(key, check=named) if key else named


def _set_leaves_first(steps: Sequence[Step]) -> list[Step]:
    return sorted(steps, key=lambda one: bool(one.formula))


def _describe_step(step: Step, words: Words) -> str:
    """Symbol, formula, value; what the heading says of all checks is left out."""
    if not step.formula or step.symbol in _BY_HEADING:
        return f"{step.symbol} = {_show_step(step, words)}"
    shown = _show_digits(step.value, words)
    return f"{step.symbol} = {_print(step, words)} = {shown}"


def _show_step(step: Step, words: Words) -> str:
    """Value and its interval; its unit where that is no force."""
    shown = _show_interval(step, words)
    return shown if step.unit in ("kN", "-") else append_unit(shown, step.unit)


def _show_interval(step: Step, words: Words) -> str:
    low, value, high = (_show_digits(one, words) for one in step.ends)
    return value if low == value == high else f"{value} ({low}–{high})"


def _show_digits(value: float | None, words: Words) -> str:
    """Number to four digits: enough to redo what follows from it."""
    if value is None or not 1e-3 < abs(value) < 1e4:
        return words.show_digits(value)
    return words.write(f"{value:.4g}")


def _describe_check(
    check: Check,
    steps: Sequence[Step],
    words: Words,
    *,
    is_told: bool,
) -> tuple[Piece, Piece]:
    """Line of one check: where its resistance comes from, and what follows."""
    told = []
    for step in steps:
        given = _describe_given(step, check, words)
        if given and is_told and step.symbol == "R_k":
            told.append(f"R_k = {_show_step(step, words)}")
        elif given:
            told.append(f"{step.symbol} {' '.join(given)}")
        else:
            told.append(_describe_step(step, words))
    source = describe_resistance(check, words)
    mode = words.show(name_mode(check.mode))
    label = mode if source == MISSING else f"{mode} ({source})"
    case = name_case(check, words, is_short=True)
    sign = show_verdict(check.verdict, words).symbol
    return (
        Piece("\n" + words("show.label", label=f"{sign} {label}", text="")),
        Piece(words.join([*told, case]), has_symbols=True),
    )
