"""What a study rests on: scope, assumptions with their origin, reviewer's checklist."""

from __future__ import annotations

from collections.abc import Callable

from netdesign.outcome import Outcome
from netdesign.report.view.table import (
    Table,
    given_cell,
    name_columns,
    text_cell,
    word_cell,
)
from netdesign.report.view.tables import ASSUMED, DEFAULT
from netdesign.report.words import show_number, show_quantity, show_text
from netdesign.study.records import Study

SCOPE = (
    "Treated: the creeping snowpack and the net on which it slips, solved together in "
    "the plane section of a net row, over all ranges; post, guys and anchors from the "
    "net's pulls.",
    "Not treated: avalanche impact, snow above the net's head, effects out of the "
    "plane other than the row's ends, the ground's own stability, corrosion, fatigue.",
    "The numbers hold for the inputs of this document alone; the decision stays the "
    "engineer's.",
)
_MODEL = (
    ("Plane strain on a plane slope of even snow thickness", "model"),
    ("Steady creep; the clock is the fluidity and decides no force", "model"),
    ("Post hinged at both ends; guys carry tension only", "model"),
    ("Coulomb friction of snow on the net, the same along it", "model"),
)


def build_assumptions(study: Study) -> Table:
    """Everything that was taken for granted, each with its status and origin."""
    headings = ("Assumption", "Value", "Status", "Origin")
    laws = [(name, text) for name, text in study.provenance.settings.items()]
    return Table(
        caption="Status: model = built in, setting = chosen for the run, default = "
        "input left empty, assumed = value of the limit profile that nobody confirmed",
        columns=name_columns(headings, numbers=()),
        rows=(
            *(
                (word_cell(what), text_cell("-"), word_cell(status), text_cell("-"))
                for what, status in _MODEL
            ),
            *(
                (word_cell(n), text_cell(v), word_cell("setting"), text_cell("-"))
                for n, v in laws
            ),
            *(
                (word_cell(what), text_cell(value), word_cell(DEFAULT), text_cell(who))
                for (what, value), who in _group_defaults(study).items()
            ),
            *(
                (
                    word_cell(value.text),
                    text_cell(f"{value.id} = {show_quantity(value.value, value.unit)}"),
                    word_cell(value.status),
                    word_cell(value.source),
                )
                for value in study.profile.values
                if value.status == ASSUMED
            ),
        ),
    )


def _group_defaults(study: Study) -> dict[tuple[str, str], str]:
    """Net rows, or the ranges, by the input that they left empty."""
    found: dict[tuple[str, str], list[str]] = {}
    places = [("Ranges", study.range_inputs)]
    places += [(row.id, row.inputs) for row in study.rows]
    for place, inputs in places:
        for echo in inputs:
            if echo.cell == DEFAULT and echo.value != "":
                shown = show_quantity(echo.value, echo.unit)
                found.setdefault((echo.label, shown), []).append(place)
    return {key: show_text(", ".join(names)) for key, names in found.items()}


def build_checklist(study: Study) -> Table:
    """Questions of a reviewer, each with what this document says to it."""
    headings = ("No.", "Question", "What the study says", "See", "Done")
    return Table(
        caption="One line each for the reviewer's mark",
        columns=name_columns(headings, numbers=("No.",)),
        rows=tuple(
            (
                given_cell(float(number)),
                word_cell(question),
                word_cell(answer(study)),
                word_cell(section),
                text_cell("☐"),
            )
            for number, (question, answer, section) in enumerate(_QUESTIONS, 1)
        ),
    )


def _describe_site_file(study: Study) -> str:
    return f"SHA-256 begins {study.provenance.site_sha256[:12]}"


def _describe_inputs(study: Study) -> str:
    inputs = [*study.range_inputs, *(one for row in study.rows for one in row.inputs)]
    defaults = sum(one.cell == DEFAULT for one in inputs)
    return f"{len(inputs)} inputs, {defaults} left to their default"


def _describe_profile(study: Study) -> str:
    values = study.profile.values
    assumed = sum(value.status == ASSUMED for value in values)
    return f"{assumed} of {len(values)} values are assumed"


def _describe_independent(study: Study) -> str:
    laws = [one for row in study.rows for one in row.independent]
    return f"{sum(one.is_met for one in laws)} of {len(laws)} are met"


def _describe_cases(study: Study) -> str:
    cases = [case for row in study.rows for case in row.cases]
    failed = sum(case.outcome is not Outcome.CONVERGED for case in cases)
    return f"{len(cases) - failed} solved, {failed} without a result"


def _describe_quality(study: Study) -> str:
    cases = [case for row in study.rows for case in row.cases]
    residuals = [c.balance_residual for c in cases if c.balance_residual is not None]
    errors = [c.error_percent for c in cases if c.error_percent is not None]
    residual = show_number("balance_residual", max(residuals, default=None))
    error = show_number("error_percent", max(errors, default=None))
    return f"balance residual up to {residual} of the weight, error up to {error} %"


def _describe_laws(study: Study) -> str:
    above = [
        spread
        for row in study.rows
        for check in row.checks
        for spread in check.spreads
        if not spread.in_verdict and spread.high is not None and spread.high > 1
        and check.utilisation is not None and check.utilisation <= 1
    ]  # fmt: skip
    return f"{len(above)} checks at most 1 exceed 1 with another law"


# What is asked, what the study says to it, and the section that tells more.
_QUESTIONS: tuple[tuple[str, Callable[[Study], str], str], ...] = (
    (
        "Is the site file the one that was issued?",
        _describe_site_file,
        "Provenance",
    ),
    (
        "Does every input agree with drawings and survey?",
        _describe_inputs,
        "Inputs",
    ),
    (
        "Do the ranges hold all snow, friction and inclinations to expect?",
        lambda _: "see the table of ranges",
        "Ranges",
    ),
    (
        "Is the limit profile agreed, are its assumed values confirmed?",
        _describe_profile,
        "Limit profile",
    ),
    (
        "Does every case have a result, is a missing one explained?",
        _describe_cases,
        "Solver quality",
    ),
    (
        "Are balance and error estimate of the solutions small?",
        _describe_quality,
        "Solver quality",
    ),
    (
        "Are the independent checks met, is the guideline's difference explained?",
        _describe_independent,
        "Independent checks",
    ),
    (
        "Would another creep law change a verdict?",
        _describe_laws,
        "Uncertainty",
    ),
    (
        "Is what the calculation does not treat checked otherwise?",
        lambda _: "see the list under Scope",
        "Scope",
    ),
)
