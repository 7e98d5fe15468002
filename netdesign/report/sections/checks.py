"""Checks and scopes in words; what would make a check pass."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from netdesign.checks.check import Change, Check
from netdesign.outcome import Verdict
from netdesign.report.sections.basis import label_rows
from netdesign.report.words import (
    MISSING,
    Words,
    append_unit,
    show_check,
    show_text,
)
from netdesign.study.records import RowStudy, Study
from netdesign.study.scopes import (
    BY_APPROVAL,
    Scope,
    ScopeRecord,
    find_governing,
    is_far_from_limit,
)
from netdesign.study.to_do import shorten_reason
from netdesign.words.catalogue import name
from netdesign.words.message import Message, say


def describe_resistance(check: Check, words: Words) -> str:
    """Type, basis and cell of a resistance: ``GEWI 28, tested, Anchors!E7``."""
    basis = check.resistance_basis
    parts = (
        check.resistance_type,
        words.show(name("basis", basis)) if basis else "",
        check.resistance_cell,
    )
    return show_text(", ".join(part for part in parts if part))


def describe_eased(check: Check, words: Words) -> str:
    """Low end of a utilisation at the best ends of what is assumed; "" of none."""
    low = check.eased_low
    if low is None:
        return ""
    return words("show.eased", used=words.show_number("utilisation", low))


def name_case(check: Check, words: Words) -> str:
    """Case that brings the demand: of the ranges, or the guideline's load case."""
    if check.governs == "maker":
        return words("load_name.maker")
    if check.governs != "guideline":
        return words.name_case(check.case)
    named = show_text(words.show(name("load_case", check.load_case)))
    inclination = words.show_with_unit("inclination_deg", check.load_inclination_deg)
    return f"{named}, θ {inclination}"


def describe_loads(check: Check, words: Words) -> str:
    """Characteristic force by each load, the one that governs first; "" of one alone.

    Solved ones at most: with their error and what may hide between cases.
    """
    forces = {}
    letters = dict(zip(_LOADS, "cptgm", strict=True))
    for load, letter in letters.items():
        symbol = check.name_force(letter)
        _, force = check.read_band(symbol)
        if force is not None:
            shown = words.show_with_unit("max_kN", force)
            forces[load] = words(f"load_force.{load}", force=shown)
    if len(forces) < 2:
        return ""
    order = sorted(forces, key=lambda load: load != check.governs)
    return words.join(forces[load] for load in order)


def describe_briefly(row: RowStudy, words: Words) -> str:
    """Reason of a row's verdict in some ten words; "" of a pass."""
    check = find_governing(row.checks)
    if row.verdict is Verdict.PASS:
        return ""
    if check is None or check.verdict is not row.verdict:
        return words("todo.row_open")
    if check.verdict is Verdict.DECLARED and check.declared:
        return show_text(check.declared.document)
    reasons = [_leave_out_cell(reason) for reason in check.open_reasons]
    if reasons and check.verdict is not Verdict.FAIL:
        return words.join(map(words.show, reasons))
    return describe_cause(check, words)


def _leave_out_cell(message: Message) -> Message:
    """The same without the cells that it names."""
    if message.key == "check.of_cell" and isinstance(
        message.arguments["what"], Message
    ):
        return _leave_out_cell(message.arguments["what"])
    inner = {
        name: _leave_out_cell(argument) if isinstance(argument, Message) else argument
        for name, argument in message.arguments.items()
    }
    return say(message.key, **inner)


def describe_cause(check: Check, words: Words) -> str:
    """Cause that keeps a check from passing, without what its numbers say already."""
    has_numbers = check.is_of_force and not check.is_unbounded
    if check.verdict is Verdict.FAIL and has_numbers and check.demand_kN is not None:
        demand, resistance = _show_apart(check.demand_kN, check.resistance_kN, words)
        return words("show.exceeds", demand=demand, resistance=resistance)
    if check.open_reasons:
        return words.join(map(words.show, check.open_reasons))
    return words.show(shorten_reason(check.plain_reason))


def _show_apart(
    demand: float, resistance: float | None, words: Words
) -> tuple[str, str]:
    """Both forces in kN; with two more digits where they would read the same."""
    forces = {"demand_kN": demand, "resistance_kN": resistance}
    shown = [words.show_number(key, force) for key, force in forces.items()]
    if shown[0] == shown[1]:
        shown = [words.show_digits(force) for force in forces.values()]
    first, second = (append_unit(text, "kN") for text in shown)
    return first, second


def name_checks(checks: Sequence[Check], words: Words) -> str:
    """Names of checks, one after the other."""
    return (
        words.join(dict.fromkeys(show_check(words, check) for check in checks))
        or MISSING
    )


_LOADS = ("coupled", "panel", "truss", "guideline", "maker")
_SENSES = {
    "at least": "show.change_at_least",
    "has": "show.change_has",
}


def list_flips(check: Check, words: Words) -> tuple[str, ...]:
    """Changes that turn one check, in short; none where no change alone does.

    ``characteristic resistance ≥ 142 kN, now 120 kN (as far as the calculated cases
    show)``
    """
    return tuple(_describe_flip(change, words) for change in check.changes)


def _describe_flip(change: Change, words: Words) -> str:
    quantity = words.show(change.quantity)
    bound = words.show_quantity(change.bound, "kN")  # rounded by the search
    if change.sense == "at least":
        bound = append_unit(words.show_minimum(change.bound), "kN")
    text = words(_SENSES[change.sense], quantity=quantity, bound=bound)
    if change.now is not None:
        shown = words.show_quantity(change.now, "kN")
        text = words("show.change_now", change=text, now=shown)
    if change.note is not None:
        text = words("show.with_note", text=text, note=words.show(change.note))
    return text


def list_changes(rows: Sequence[tuple[str, Check]], words: Words) -> list[str]:
    """Lines of what turns each check, by net row; else why there is nothing."""
    lines = [
        show_text(
            words(
                "show.label",
                label=words(
                    "show.row_and_check",
                    row=row,
                    check=show_check(words, check),
                    verdict=words(f"verdict.{check.verdict}"),
                ),
                text=words("show.passes_with", change=flip),
            )
        )
        for row, check in rows
        for flip in list_flips(check, words)
    ]
    if lines:
        return lines
    is_far = all(is_far_from_limit(check) for _, check in rows)
    return [words("show.no_change" if is_far else "show.no_change_alone")]


_BETWEEN = " · "


def describe_study_scopes(study: Study, words: Words) -> str:
    """``anchors FAIL 1.48 (6 assumed), A4 · structure by approval X · siting PASS``.

    Each scope stands with the row that decides it, where there are several.
    """
    rows = {row.id: row for row in study.rows}
    texts = []
    for scope, record in study.scopes.items():
        row = rows.get(record.row or "")
        text = _describe(scope, record, _find_check(row, record), words)
        is_open = record.verdict is not Verdict.PASS and len(rows) > 1 and row
        texts.append(f"{text}, {show_text(row.id)}" if row and is_open else text)
    return _BETWEEN.join(texts)


def _find_check(row: RowStudy | None, record: ScopeRecord) -> Check | None:
    """Check that decides a scope."""
    checks = row.checks if row else []
    return next((check for check in checks if check.id == record.governing), None)


def _describe(
    scope: Scope, record: ScopeRecord, check: Check | None, words: Words
) -> str:
    name = words(f"of_scope.{scope}")
    if document := _find_approval(record, check):
        return words("scopes.by_approval", scope=name, document=show_text(document))
    verdict = words(f"verdict.{record.verdict}")
    used = show_extent(record, check, words)
    parts = [name, verdict, *([used] if used else [])]
    if record.assumed:
        parts.append(words("scopes.assumed", count=record.assumed))
    return " ".join(parts)


def _find_approval(record: ScopeRecord, check: Check | None) -> str:
    """Document of the type approval that proves a scope; "" without one."""
    is_by_approval = record.governing == BY_APPROVAL
    is_proven = check is not None and check.declared and is_by_approval
    return check.declared.document if is_proven and check and check.declared else ""


def show_extent(record: ScopeRecord, check: Check | None, words: Words) -> str:
    """Utilisation of the check that decides, else its force; "" of one without."""
    if check is not None and check.used is not None:
        return words.show_number("utilisation", check.used)
    demand = check.read_band("E_d")[1] if check else None
    is_met = record.verdict in (Verdict.PASS, Verdict.DECLARED)
    if demand is None or is_met:
        return ""
    return append_unit(words.show_number("demand_kN", demand), "kN")


def list_exceeding(study: Study, words: Words) -> Iterator[str]:
    """Checks whose coupled force exceeds the resistance, though it does not decide."""
    rows: dict[str, list[str]] = {}
    for row in study.rows:
        beyond = [check for check in row.checks if check.exceeds_by_model]
        if not beyond:
            continue
        worst = max(beyond, key=lambda check: check.utilisation_by_model or 0.0)
        text = words(
            "scopes.exceeds",
            check=show_check(words, worst),
            times=words.show_number("utilisation", worst.utilisation_by_model),
            count=len(beyond),
        )
        rows.setdefault(text, []).append(row.id)
    yield from label_rows(rows, study, words)
