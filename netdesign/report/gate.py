"""Refuses a report of a study that contradicts its own numbers."""

from __future__ import annotations

from collections.abc import Iterable

from netdesign.calculation.steps import SAME, Step, compare_steps, is_same
from netdesign.checks.schema import MODES_WITHOUT_FORCE
from netdesign.outcome import ContentError, NetDesignError, Verdict, merge_verdicts
from netdesign.structure.members import ROPE_OF
from netdesign.study.records import CheckRecord, Study, list_verdicts
from netdesign.study.values import show_value
from netdesign.words.message import Message, say

# Numbers of a check by the symbols that give them, and what no calculation alters.
_RESULTS = {"demand_kN": "E_d", "resistance_kN": "R_d", "utilisation": "μ"}
_RULES = {"E_d": "γ_E * E_k", "R_d": "R_k / γ_R", "μ": "E_d / R_d"}
_FORCES = ("E_k", "V_k", "E_d", "R_k", "R_d")
_KNOWN = "is_consistent"  # that it was looked at, kept with the study
_ABOVE_ZERO = ("γ_E", "γ_R", "R_d")


def require_consistent(study: Study) -> None:
    """Refuse a study whose verdicts or ratios do not follow from its numbers.

    Each output asks; one study is looked at once.

    Raises
    ------
    NetDesignError
        If a verdict is not that of its parts (a pass may be held back as not
        proven), a pass is not supported by its utilisation, or a design value
        or a utilisation is not what its parts give.
    """
    if _KNOWN in vars(study):
        return
    whole = say("audit.study")
    _require_earned(whole, study.verdict, (row.verdict for row in study.rows))
    for row in study.rows:
        place = say("audit.row", row=row.id)
        parts = list_verdicts(row.checks, row.independent)
        _require_earned(place, row.verdict, parts)
        for check in row.checks:
            where = say("audit.check", place=place, check=check.id)
            _require_sound(where, check)
            _require_floor(where, check, study.profile.floor)
    vars(study)[_KNOWN] = True


def _require_earned(place: Message, whole: Verdict, parts: Iterable[Verdict]) -> None:
    merged = merge_verdicts(parts)
    better = (Verdict.PASS, Verdict.DECLARED)
    is_held_back = whole is Verdict.NOT_PROVEN and merged in better
    if whole is not merged and not is_held_back:
        verdict, follows = say(f"verdict.{whole}"), say(f"verdict.{merged}")
        told = {"place": place, "verdict": verdict, "merged": follows}
        raise NetDesignError(say("audit.verdict", **told))


def _require_sound(place: Message, check: CheckRecord) -> None:
    """Refuse numbers that do not follow from the leaves of a check's calculation."""
    for step in check.steps:
        _require_step(place, step)
    try:
        fault = next(compare_steps(check.steps), None)
    except ContentError as error:
        fault = error.message
    if fault is not None:
        raise NetDesignError(say("audit.calculation", place=place, fault=fault))
    for key, symbol in _RESULTS.items():
        stored, follows = getattr(check, key), check.read(symbol)
        if not is_same(stored, follows):
            told = {"name": key, "stored": show_value(stored)}
            told |= {"follows": show_value(follows)}
            raise NetDesignError(say("audit.unequal", place=place, **told))
    if (check.verdict is Verdict.DECLARED) and check.declared is None:
        raise NetDesignError(say("audit.declared_by_nobody", place=place))
    if check.verdict is Verdict.PASS and not _is_without_force(check):
        _, high = check.utilisation_band
        if high is None or not high <= 1:
            raise NetDesignError(
                say(
                    "audit.pass_not_supported",
                    place=place,
                    verdict=say("verdict.pass"),
                    high=show_value(high),
                )
            )


def _require_step(place: Message, step: Step) -> None:
    """Refuse a force below zero, a divisor that is zero, and a rule of one's own."""
    known = [end for end in step.ends if end is not None]
    least = [0.0] if step.symbol in _FORCES else []
    if [*least, *known] != sorted([*least, *known]):
        raise NetDesignError(say("audit.size_or_band", place=place))
    if step.symbol in _ABOVE_ZERO and not all(end > 0.0 for end in known):
        raise NetDesignError(say("audit.not_above_zero", place=place))
    if _RULES.get(step.symbol, step.formula) != step.formula:
        told = {"symbol": step.symbol, "formula": step.formula}
        raise NetDesignError(say("audit.other_rule", place=place, **told))


def _require_floor(place: Message, check: CheckRecord, floor: str) -> None:
    """Refuse a demand below the guideline's load, and a pass that does not know it."""
    # the guideline knows no load of ropes along the row
    if floor == "none" or check.member in ROPE_OF:
        return
    action = check.known.get("V_k", check.known.get("E_k"))
    if action is None or action.value is None:
        return
    least = check.read(check.name_force("g"))
    if least is None:
        if check.verdict is Verdict.PASS:
            raise NetDesignError(say("audit.without_floor", place=place))
        return
    ends = [end for end in action.ends if end is not None]
    is_above = all(end >= least * (1.0 - SAME) for end in ends)
    if not is_above or check.governs != _find_governing(check, least):
        raise NetDesignError(say("audit.below_floor", place=place, least=least))


def _find_governing(check: CheckRecord, least: float) -> str:
    """Largest one of the loads, solved ones with their upper ends."""
    ends = (check.read_band(check.name_force(load))[1] for load in ("c", "p"))
    if least and least >= max(end or 0.0 for end in ends):
        return "guideline"
    return "panel" if check.is_by_panel else "coupled"


def _is_without_force(check: CheckRecord) -> bool:
    is_geometry = check.id.startswith("geometry.")
    return not check.is_of_force and (is_geometry or check.mode in MODES_WITHOUT_FORCE)
