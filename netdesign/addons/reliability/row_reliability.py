"""Notional annual reliability of the governing check of a net row.

It decides nothing: verdicts, exit code and all other records are the same without it.
Theory: addons/reliability/THEORY.md.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from netdesign.addons.reliability.check_by_case import CheckByCase, find_check_by_case
from netdesign.addons.reliability.reliability import (
    DesignPoint,
    Reliability,
    find_reliability,
    follow_design_point,
)
from netdesign.addons.reliability.response import (
    Rater,
    Response,
    build_response,
    move,
)
from netdesign.addons.reliability.variables import (
    HEIGHT,
    MODEL,
    RESISTANCE,
    LimitState,
    Variable,
    list_lines,
    list_variables,
)
from netdesign.checks.check import Check
from netdesign.envelope.ranges import PARAMETERS, Case
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Fault, ModelError, Verdict, catch_fault
from netdesign.site.model import Site
from netdesign.snow.snowpack import compare_densities
from netdesign.study.case_records import record_point
from netdesign.study.member_force import RowForces
from netdesign.study.records import ReliabilityRecord, VariableRecord
from netdesign.study.row_checks import RowChecks
from netdesign.study.row_to_check import CaseSolver, RowToCheck
from netdesign.study.scopes import find_worst
from netdesign.words.catalogue import name_check
from netdesign.words.message import Message, say

MOST_ROUNDS = 3  # in which the design point is solved again
LARGEST_MISS = 0.1  # of ln mu at the last one
_CLOSE = 0.02  # a miss at which the rounds end
_LEAST_HEIGHT = 1e-6  # [m]
_HEIGHTS = ("thickness", "snow_height")


def record_reliability(
    task: RowToCheck, forces: RowForces, row_checks: RowChecks, solver: CaseSolver
) -> ReliabilityRecord:
    """Reliability of a row's governing check, or the reason why there is none.

    There is none of a row with a check that has no numbers: it may be the weakest.

    Parameters
    ----------
    task, forces, row_checks : RowToCheck, RowForces, RowChecks
        The row, its forces and its checks.
    solver : CaseSolver
        One of its own: what fails here is no fault of the checks.
    """
    check, by_case = find_worst(row_checks.checks), None
    judged = row_checks.judged.get(check.id) if check else None
    if judged is not None:
        by_case = find_check_by_case(task, forces, judged, row_checks.judged.values())
    return rate_reliability(task.site, row_checks.checks, check, by_case, solver)


def rate_reliability(
    site: Site,
    checks: Sequence[Check],
    check: Check | None,
    by_case: CheckByCase | None,
    solver: CaseSolver,
) -> ReliabilityRecord:
    """Reliability of the governing ``check`` as a function of a solved case."""
    reason = _find_open(checks) or _find_lack(check, by_case)
    if check is None or by_case is None or reason is not None:
        return ReliabilityRecord(check=check.id if check else "", reason=reason)
    analysis = partial(_analyse, site, check, by_case, solver)
    try:
        record = catch_fault(analysis, check.id)
    except ModelError as refusal:
        record = ReliabilityRecord(check=check.id, reason=refusal.message)
    if isinstance(record, Fault):
        reason_of_fault = say("reliability.fault", kind=record.kind)
        record = ReliabilityRecord(check=check.id, reason=reason_of_fault)
    return replace(record, solves=solver.count)


def _find_open(checks: Sequence[Check]) -> Message | None:
    """First check that is not proven by its numbers, nor fails by them."""
    for check in checks:
        is_met = check.verdict is Verdict.PASS
        if not is_met and (
            check.verdict is not Verdict.FAIL or check.utilisation is None
        ):
            named = name_check(check.member, check.mode, check.position)
            return say("reliability.open_check", check=named)
    return None


def _find_lack(check: Check | None, by_case: CheckByCase | None) -> Message | None:
    """Reason why a check has no limit state of its solved force."""
    if check is None:
        return say("reliability.no_check")
    if check.governs in ("guideline", "maker"):
        return say("reliability.by_guideline")
    numbers = [check.utilisation, check.read("γ_E"), check.read("γ_R")]
    if by_case is None or not all(numbers):
        return say("reliability.not_followed")
    if any(name in by_case.ranges.axes for name in _HEIGHTS):
        return say("reliability.height_ranges")
    return None


def _analyse(
    site: Site, check: Check, by_case: CheckByCase, solver: CaseSolver
) -> ReliabilityRecord:
    variables = list_variables(site, by_case, check)
    used = check.utilisation or math.nan
    governing = next(
        result
        for result in by_case.results
        if result.case == by_case.governing and by_case.has_result(result)
    )
    scale = used / (by_case.utilisation(governing) or math.nan)
    rater = Rater(check=by_case, solver=solver, scale=scale)
    response = build_response(rater, list_lines(by_case, variables))
    factors = (check.read("γ_E") or math.nan, check.read("γ_R") or math.nan)
    state = _State(
        variables=variables,
        response=response,
        factor=math.log(factors[0] * factors[1]),
        slope_cosine=math.cos(by_case.row.slope_angle),
        height=by_case.row.snow_thickness / math.cos(by_case.row.slope_angle),
    )
    state, by_model, solved = _meet_design_point(state, rater)
    log_used = math.log(used)
    reliability = find_reliability(state.build(), log_used)
    state.require_within(reliability.design_point)
    record = _record(check, state, reliability, by_case.governing)
    return replace(
        record,
        force_ratio=math.exp(solved - log_used),
        force_ratio_by_model=math.exp(by_model - log_used),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _State:
    """Limit state of a check in physical terms: (U6).

    ``factor`` is the logarithm of the product of both partial factors, ``height`` the
    row's vertical snow height [m], to which the density refers.
    """

    variables: tuple[Variable, ...]
    response: Response
    factor: float
    slope_cosine: float
    height: float

    @property
    def names(self) -> list[str]:
        return [variable.name for variable in self.variables]

    def build(self) -> LimitState:
        return LimitState(variables=self.variables, margin=self._find_margin)

    def _find_margin(self, values: Floats) -> Floats:
        columns = dict(zip(self.names, values.T, strict=True))
        strong, model = columns.pop(RESISTANCE), columns.pop(MODEL)
        result: Floats = (
            np.log(np.maximum(strong, 1e-12))
            - np.log(np.maximum(model, 1e-12))
            - self.response.find(self._name_solved(columns))
            + self.factor
        )
        return result

    def _name_solved(self, columns: Mapping[str, Floats]) -> dict[str, Floats]:
        """Quantities as they are solved: thickness of a height, density by (U5a)."""
        solved = dict(columns)
        heights = np.maximum(solved.pop(HEIGHT), _LEAST_HEIGHT)
        solved["thickness"] = heights * self.slope_cosine
        solved["density"] = solved["density"] * compare_densities(heights, self.height)
        return solved

    def read_point(self, values: Sequence[float]) -> dict[str, float]:
        """Quantities of a design point as they are solved [SI]."""
        named = {
            variable.name: np.array([min(value, variable.cap)])
            for variable, value in zip(self.variables, values, strict=True)
        }
        del named[MODEL], named[RESISTANCE]
        return {k: float(v[0]) for k, v in self._name_solved(named).items()}

    def require_within(self, values: Sequence[float]) -> None:
        """Refuse a design point beyond what was solved."""
        beyond = self.response.find_beyond(self.read_point(values))
        if beyond is not None:
            name = say(f"label.{PARAMETERS[beyond].key}")
            raise ModelError(say("reliability.beyond", name=name))

    def with_error(self, error: float) -> _State:
        """State whose model factor has another error beside its own, (U8)."""
        variables = tuple(
            replace(entry, deviation=math.hypot(entry.deviation, error * entry.mean))
            if entry.name == MODEL
            else entry
            for entry in self.variables
        )
        return replace(self, variables=variables)


def _meet_design_point(state: _State, rater: Rater) -> tuple[_State, float, float]:
    """State that agrees with the full model at its design point.

    And ln mu at the last one: by the model before it was solved, and solved.
    """
    point: DesignPoint | None = None
    error = by_model = solved = miss = 0.0
    for _ in range(MOST_ROUNDS):
        limit = state.with_error(error).build()
        point = follow_design_point(limit, point)
        at = limit.place(point.place[None])[0].tolist()
        state.require_within(at)
        values = state.read_point(at)
        by_model = state.response.find_at(values)
        (rate,) = rater.solve(rater.check.governing, [values])
        if rate is None:
            raise ModelError(say("reliability.no_solve"))
        solved, miss = rate, abs(rate - by_model)
        error = math.hypot(state.response.find_error(values), miss)
        shift = state.response.shift + solved - by_model
        state = replace(state, response=replace(state.response, shift=shift))
        if miss < _CLOSE:
            break
    if miss > LARGEST_MISS:
        raise ModelError(say("reliability.missed", share=miss))
    return state.with_error(error), by_model, solved


def _record(
    check: Check,
    state: _State,
    reliability: Reliability,
    governing: Case,
) -> ReliabilityRecord:
    values = dict(zip(state.names, reliability.design_point, strict=True))
    used = math.log(check.utilisation or math.nan)
    point = state.read_point(reliability.design_point)
    ratio = math.exp(state.response.find_at(point) - used)
    return ReliabilityRecord(
        check=check.id,
        reason=None,
        variables=_record_variables(state, reliability, point),
        beta=reliability.beta,
        standard_error=reliability.standard_error,
        beta_by_form=reliability.beta_by_form,
        beta_at_full=reliability.beta_shifted,
        action_factor=ratio * values[MODEL],
        resistance_factor=1.0 / values[RESISTANCE],
        profile_action_factor=check.read("γ_E"),
        profile_resistance_factor=check.read("γ_R"),
        design_point=record_point(move(governing, point)),
        samples=reliability.samples,
    )


def _record_variables(
    state: _State, reliability: Reliability, point: Mapping[str, float]
) -> list[VariableRecord]:
    """Variables, with the values that were solved at the design point."""
    records = []
    for variable, share, value in zip(
        state.variables,
        reliability.alpha_squared,
        reliability.design_point,
        strict=True,
    ):
        parameter = PARAMETERS.get(variable.name)
        show = parameter.show if parameter else float
        at_design_point = point.get(variable.name, min(value, variable.cap))
        records.append(
            VariableRecord(
                name=variable.name,
                key=parameter.key if parameter else "",
                distribution=variable.kind,
                mean=show(variable.mean),
                variation=variable.deviation / variable.mean,
                source=variable.source,
                is_assumed=variable.is_assumed,
                alpha_squared=share,
                at_design_point=show(at_design_point),
            )
        )
    return records
