"""One check in words, and which check of several decides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from netdesign.outcome import Verdict
from netdesign.report.words import (
    MISSING,
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
        case=name_case(check, words),
        case_short=name_case(check, words, is_short=True),
        reason=words.show(check.reason),
        load=_tell_load(check, words),
        loads=_show_loads(check, words),
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


def name_case(check: CheckRecord, words: Words, *, is_short: bool = False) -> str:
    """Case that brings the demand: of the ranges, or the guideline's load case."""
    if check.governs != "guideline":
        return (
            words.name_case_short(check.case)
            if is_short
            else words.name_case(check.case)
        )
    named = show_text(words.show(name("load_case", check.load_case)))
    inclination = words.show_with_unit("inclination_deg", check.load_inclination_deg)
    return f"{named}, θ {inclination}"


def _list_loads(check: CheckRecord) -> dict[str, tuple[str, float]]:
    """Characteristic force by each load, with its symbol; solved ones at most [kN].

    None where there is one load alone, or no force by any.
    """
    loads = {"coupled": "c", "panel": "p", "guideline": "g"}
    found = {}
    for load, letter in loads.items():
        symbol = check.name_force(letter)
        _, force = check.read_band(symbol)
        if force is not None:
            found[load] = symbol, force
    is_loaded = any(force for _, force in found.values())
    return found if len(found) > 1 and is_loaded else {}


def _tell_load(check: CheckRecord, words: Words) -> str:
    """Governing load of a demand, with all values; "" where there is one alone."""
    loads = _list_loads(check)
    if not loads:
        return ""
    shown = {
        load: words.show_symbol(symbol, "kN", force)
        for load, (symbol, force) in loads.items()
    }
    told = []
    if "panel" in shown:
        panel, coupled = shown["panel"], shown["coupled"]
        told.append(words("show.load_panel", panel=panel, coupled=coupled))
    if "guideline" in shown:
        first = "guideline" if check.governs == "guideline" else "coupled"
        pair = words(
            f"show.load_{first}",
            coupled=shown["coupled"],
            guideline=shown["guideline"],
            case=show_text(words.show(name("load_case", check.load_case))),
        )
        told.insert(len(told) if check.governs == "panel" else 0, pair)
    is_across = "V_k" in check.known  # the demand is along the slope
    both = words.join(told)
    return words("show.load_across", loads=both) if is_across else both


def _show_loads(check: CheckRecord, words: Words) -> str:
    """The same by their symbols, the one that governs first."""
    loads = _list_loads(check)
    order = sorted(loads, key=lambda load: load != check.governs)
    return words.join(
        f"{symbol} {words.show_number('demand_kN', force)}"
        for symbol, force in (loads[load] for load in order)
    )


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
