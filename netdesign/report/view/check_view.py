"""One check in words, and which check of several decides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from netdesign.outcome import Verdict
from netdesign.report.view.demand_steps import (
    describe_load,
    describe_widths,
    show_loads,
)
from netdesign.report.words import (
    MISSING,
    UNBOUNDED,
    VerdictWords,
    Words,
    show_check,
    show_text,
    show_verdict,
)
from netdesign.structure.members import BROUGHT_BY, REPORTED_MEMBERS
from netdesign.study.case_records import CasePoint
from netdesign.study.records import CheckRecord, RowStudy
from netdesign.words.names import name

# Worst first.
SEVERITY = (Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.DECLARED, Verdict.PASS)
_BAR_UNIT = 100.0  # length of a ratio bar at utilisation 1
_BAR_BEYOND = 50.0  # length that is left for all above 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Bar:
    """Ratio bar; lengths for an SVG in which 100 is utilisation 1."""

    low: str
    value: str
    high: str
    is_over: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckView:
    """One check in words."""

    title: str
    clause: str
    resistance_type: str
    resistance_basis: str
    resistance_cell: str
    demand: str
    resistance: str
    utilisation: str
    band: str
    bar: Bar | None
    verdict: VerdictWords
    case: str
    case_short: str
    reason: str
    load: str  # which load governs, and both values; "" without a floor
    loads: str  # both values by their symbols

    @property
    def resistance_from(self) -> str:
        """Type, basis and cell of a resistance: ``GEWI 28, tested, Anchors!E7``."""
        parts = (self.resistance_type, self.resistance_basis, self.resistance_cell)
        return show_text(", ".join(part for part in parts if part))

    @property
    def source(self) -> str:
        """Clause, and where the resistance comes from."""
        parts = (self.clause, self.resistance_from)
        return "; ".join(part for part in parts if part != MISSING) or MISSING


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """One line of a worked calculation: ``symbols = numbers = result``."""

    symbols: str
    numbers: str
    result: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Worked:
    """The calculation of one check with its numbers put in."""

    title: str
    steps: tuple[Step, ...]
    needed: str


def find_governing(checks: Sequence[CheckRecord]) -> CheckRecord | None:
    """Check that decides the verdict: the worst verdict, then the largest ratio."""
    return min(checks, key=rank_check, default=None)


def rank_check(check: CheckRecord) -> tuple[int, float]:
    """Sort key: worst verdict first, then the largest utilisation."""
    return SEVERITY.index(check.verdict), -_ratio(check)


def _ratio(check: CheckRecord) -> float:
    return -1.0 if check.used is None else check.used


def find_highest(checks: Sequence[CheckRecord]) -> CheckRecord | None:
    """Check with the largest utilisation, of those that have one."""
    known = [check for check in checks if check.used is not None]
    return max(known, key=_ratio, default=None)


def find_shown(row: RowStudy) -> CheckRecord | None:
    """Check of which the page shows most: the governing one, or the most used one."""
    governing = find_governing(row.checks)
    if governing and governing.used is not None:
        return governing
    return find_highest(row.checks)


def find_shown_member(row: RowStudy) -> str:
    """Member whose envelope the page shows first; "" without any."""
    shown = find_shown(row)
    if shown is None or shown.member in REPORTED_MEMBERS:
        return shown.member if shown else ""
    return BROUGHT_BY.get(shown.member, "")


def view_check(check: CheckRecord, words: Words) -> CheckView:
    """Put one check into words."""
    low, high = check.used_band
    return CheckView(
        title=show_check(words, check),
        clause=show_text(check.clause),
        resistance_type=check.resistance_type,
        resistance_basis=words.show(name("basis", check.resistance_basis))
        if check.resistance_basis
        else "",
        resistance_cell=check.resistance_cell,
        demand=words.show_number("demand_kN", check.demand_kN),
        resistance=words.show_number("resistance_kN", check.resistance_kN),
        utilisation=words.show_number("utilisation", check.used),
        band=words.show_band("utilisation", low, high),
        bar=_build_bar(low, check.used, high),
        verdict=show_verdict(check.verdict, words),
        case=_name_case(check, words),
        case_short=_name_case(check, words, is_short=True),
        reason=words.show(check.reason),
        load=describe_load(check, words),
        loads=show_loads(check, words),
    )


def pick_view(
    check: CheckRecord | None,
    checks: Sequence[CheckRecord],
    views: Sequence[CheckView],
) -> CheckView | None:
    """One of several checks in words, by these words in the same order."""
    return None if check is None else views[checks.index(check)]


def find_case(check: CheckRecord) -> CasePoint | None:
    """Case of the ranges that brings the demand; None where the guideline does."""
    return None if check.governs == "guideline" else check.case


def _name_case(check: CheckRecord, words: Words, *, is_short: bool = False) -> str:
    """Case that brings the demand: of the ranges, or the guideline's load case."""
    case = find_case(check)
    if check.governs != "guideline":
        return words.name_case_short(case) if is_short else words.name_case(case)
    named = show_text(words.show(name("load_case", check.load_case)))
    inclination = words.show_with_unit("inclination_deg", check.load_inclination_deg)
    return f"{named}, θ {inclination}"


def _build_bar(
    low: float | None, value: float | None, high: float | None
) -> Bar | None:
    if low is None or value is None or high is None:
        return None
    lengths = [f"{_measure_bar(ratio):.1f}" for ratio in (low, value, high)]
    return Bar(low=lengths[0], value=lengths[1], high=lengths[2], is_over=value > 1)


def _measure_bar(ratio: float) -> float:
    """Length of a bar: in proportion up to 1, then ever slower, so that 9 is no 1.5."""
    if ratio <= 1.0:
        return _BAR_UNIT * ratio
    return _BAR_UNIT + _BAR_BEYOND * (1.0 - 1.0 / ratio)


def work_out(check: CheckRecord, words: Words) -> Worked:
    """Worked calculation of a check with a demand and a resistance, or none left."""
    needed = words.show_with_unit("resistance_kN", check.read_band("E_d")[1])
    return Worked(
        title=words(
            "show.row_at_case",
            check=show_check(words, check),
            case=_name_case(check, words),
        ),
        steps=(
            *_derive_action(check, words),
            *_derive_resistance(check, words),
            _factor_action(check, words),
            *_list_comparison(check, words),
        ),
        needed=words(
            "show.needed", verdict=words(f"verdict.{check.verdict}"), force=needed
        ),
    )


def _derive_action(check: CheckRecord, words: Words) -> tuple[Step, ...]:
    """Characteristic action from the solved force and the widths that a support has."""
    return tuple(
        Step(symbols=symbols, numbers=numbers, result=result)
        for symbols, numbers, result in describe_widths(check, words)
    )


def _derive_resistance(check: CheckRecord, words: Words) -> tuple[Step, ...]:
    """Characteristic resistance from dimensions or tests."""
    if not check.resistance_derivation:
        return ()
    given = check.read("R_k")
    return (
        Step(
            symbols="R_k",
            numbers=words.show(check.resistance_derivation),
            result=words.show_with_unit("resistance_characteristic_kN", given),
        ),
    )


def _factor_action(check: CheckRecord, words: Words) -> Step:
    factor = words.show_number("action_factor", check.read("γ_E"))
    return Step(
        symbols="E_d = γ_E · E_k",
        numbers=f"{factor} · {words.show_with_unit('action_kN', check.read('E_k'))}",
        result=words.show_with_unit("demand_kN", check.demand_kN),
    )


def _reduce_resistance(check: CheckRecord, words: Words) -> Step:
    given = check.read("R_k")
    return Step(
        symbols="R_d = R_k / γ_R",
        numbers=_divide(
            words.show_with_unit("resistance_characteristic_kN", given),
            words.show_number("resistance_factor", check.read("γ_R")),
        ),
        result=words.show_with_unit("resistance_kN", check.resistance_kN),
    )


def _list_comparison(check: CheckRecord, words: Words) -> tuple[Step, ...]:
    """Resistance and utilisation; where nothing is left to resist, why that is so."""
    if not check.is_unbounded:
        return _reduce_resistance(check, words), _compare_both(check, words)
    return (
        Step(symbols="R_d", numbers=words.show(check.reason), result=MISSING),
        Step(symbols="μ", numbers=words("show.nothing_resists"), result=UNBOUNDED),
    )


def _compare_both(check: CheckRecord, words: Words) -> Step:
    low, high = check.utilisation_band
    return Step(
        symbols="μ = E_d / R_d",
        numbers=_divide(
            words.show_with_unit("demand_kN", check.demand_kN),
            words.show_with_unit("resistance_kN", check.resistance_kN),
        ),
        result=words(
            "show.with_band",
            value=words.show_number("utilisation", check.used),
            band=words.show_band("utilisation", low, high),
        ),
    )


def _divide(above: str, below: str) -> str:
    return f"{above} / {below}"
