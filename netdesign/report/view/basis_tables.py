"""Basis of a study: scope, assumptions with their origin, reviewer's checklist."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from netdesign.outcome import Outcome
from netdesign.report.blocks.table import (
    Cell,
    Table,
    given_cell,
    name_columns,
    text_cell,
)
from netdesign.report.view.tables import ASSUMED, DEFAULT, list_settings
from netdesign.report.words import (
    MISSING,
    Words,
    name_heading,
    show_text,
    understand,
)
from netdesign.study.notes import tell_evidence
from netdesign.study.records import Study
from netdesign.words.message import say

_READING = (
    "caption.arrows",
    "reading.pressure",
    "caption.maps",
    "caption.lines",
    "caption.envelope_grid",
    "caption.on_paper",
    "reading.search",
    "reading.holds",
    "reading.directions",
    "caption.drivers",
    "reading.sobol",
)
_SCOPE = ("scope.treated", "scope.not_treated", "scope.decision")
_MODEL = (
    "assumption.plane_strain",
    "assumption.steady_creep",
    "assumption.hinged_post",
    "assumption.coulomb",
)


# Left empty, its factor is taken by the guideline's load.
_ALTITUDE = say("column.Nets.altitude")
# Net rows of which each is named; of more, those that are left out may be fewer.
_FEW_ROWS = 8


def list_scope(words: Words) -> tuple[str, ...]:
    """Scope: what is treated, what is not, and who decides."""
    return tuple(words(key) for key in _SCOPE)


def list_reading(study: Study, words: Words) -> tuple[str, ...]:
    """Sentences that hold of the drawings and tables of every row."""
    checks = words("caption.checks", legend=name_cases(study, words))
    return checks, *(words(key) for key in _READING)


def name_cases(study: Study, words: Words) -> str:
    """Legend of the numbers of a case, in their order."""
    points = [case.case for row in study.rows for case in row.cases[:1]]
    names = (
        [name_heading(words, key) for key in [*points[0].values][3:]] if points else []
    )
    legend = words("show.legend")
    if not names:
        return legend
    return words("show.legend_further", legend=legend, names=" / ".join(names))


def build_assumptions(study: Study, words: Words) -> Table:
    """Everything that was taken for granted, each with its status and origin."""
    keys = ("assumption", "value", "status", "origin")
    headings = [words(f"heading.{key}") for key in keys]
    defaults = _group_defaults(study, words)
    return Table(
        caption=words("caption.status"),
        columns=name_columns(headings, numbers=()),
        rows=(
            *(
                _list_cells(words(key), MISSING, words("status.model"), MISSING)
                for key in _MODEL
            ),
            *(
                _list_cells(label, text, words("status.setting"), MISSING)
                for label, text in list_settings(study, words)
            ),
            *(
                _list_cells(what, value, words("status.default"), who)
                for (what, value), who in defaults.items()
            ),
            *_count_assumed(study, words),
        ),
    )


def _count_assumed(study: Study, words: Words) -> tuple[tuple[Cell, ...], ...]:
    """Line that leads to the profile's values that nobody confirmed; none without."""
    count = sum(value.status == ASSUMED for value in study.profile.values)
    if not count:
        return ()
    told = words("show.assumed_counted", assumed=count, count=len(study.profile.values))
    place = words("show.see_profile")
    named = words("heading.limit_profile")
    return (_list_cells(named, told, words("status.assumed"), place),)


def _list_cells(*texts: str) -> tuple[Cell, ...]:
    return tuple(text_cell(text) for text in texts)


def _group_defaults(
    study: Study, words: Words, *, of_numbers: bool = False
) -> dict[tuple[str, str], str]:
    """Net rows, or the ranges, by the input that they left empty.

    A range without a number of samples is searched: that is no number.
    """
    found: dict[tuple[str, str], list[str]] = {}
    places = [(words("heading.ranges"), study.range_inputs)]
    places += [(row.id, row.inputs) for row in study.rows]
    for place, inputs in places:
        for echo in inputs:
            is_kind = isinstance(echo.value, float) or not of_numbers
            label = words.show(echo.label)
            if echo.cell == DEFAULT and echo.value != "" and is_kind:
                shown = words.show_quantity(understand(echo, words), echo.unit)
                found.setdefault((label, shown), []).append(place)
            elif echo.label == _ALTITUDE and echo.value == "":
                shown = words("show.largest_altitude_factor")
                found.setdefault((label, shown), []).append(place)
    return {
        key: show_text(name_rows(names, study, words)) for key, names in found.items()
    }


def name_rows(names: Sequence[str], study: Study, words: Words) -> str:
    """Names of net rows; of a large site all of them, or all but a few, in a phrase.

    What is named beside them, such as the ranges, stands before.
    """
    ids = [row.id for row in study.rows]
    beside = [name for name in names if name not in ids]
    others = [name for name in ids if name not in names]
    if len(ids) <= _FEW_ROWS or len(others) > _FEW_ROWS:
        return ", ".join(names)
    key = "show.all_rows_but" if others else "show.all_rows"
    told = words(key, count=len(ids), others=", ".join(others))
    return ", ".join([*beside, told])


def list_defaults(study: Study, words: Words) -> str:
    """Numbers that nobody typed, what they were taken as, and where; "" for none."""
    found = _group_defaults(study, words, of_numbers=True)
    return words.join(
        words("show.default_taken", what=what, value=value, who=who)
        for (what, value), who in found.items()
    )


def build_checklist(study: Study, words: Words) -> Table:
    """Questions of a reviewer, each with what this document says to it."""
    keys = ("no", "question", "what_study_says", "see", "done")
    headings = [words(f"heading.{key}") for key in keys]
    return Table(
        caption=words("caption.checklist"),
        columns=name_columns(headings, numbers=headings[:1]),
        rows=tuple(
            (
                given_cell(words, float(number)),
                text_cell(words(question)),
                text_cell(answer(study, words)),
                text_cell(words(section)),
                text_cell("☐"),
            )
            for number, (question, answer, section) in enumerate(_QUESTIONS, 1)
        ),
    )


def _describe_site_file(study: Study, words: Words) -> str:
    return words("show.hash_begins", hash=study.provenance.site_sha256[:12])


def _describe_inputs(study: Study, words: Words) -> str:
    inputs = [*study.range_inputs, *(one for row in study.rows for one in row.inputs)]
    defaults = sum(one.cell == DEFAULT for one in inputs)
    return words("show.inputs_counted", count=len(inputs), defaults=defaults)


def _describe_profile(study: Study, words: Words) -> str:
    values = study.profile.values
    assumed = sum(value.status == ASSUMED for value in values)
    return words("show.assumed_counted", assumed=assumed, count=len(values))


def _describe_independent(study: Study, words: Words) -> str:
    laws = [one for row in study.rows for one in row.independent]
    met = sum(one.is_met for one in laws)
    return words("show.laws_counted", met=met, count=len(laws))


def _describe_cases(study: Study, words: Words) -> str:
    cases = [case for row in study.rows for case in row.cases]
    failed = sum(case.outcome is not Outcome.CONVERGED for case in cases)
    solved = len(cases) - failed
    return words("show.cases_solved", solved=solved, failed=failed)


def _describe_quality(study: Study, words: Words) -> str:
    cases = [case for row in study.rows for case in row.cases]
    residuals = [c.balance_residual for c in cases if c.balance_residual is not None]
    errors = [c.error_percent for c in cases if c.error_percent is not None]
    residual = words.show_number("balance_residual", max(residuals, default=None))
    error = words.show_number("error_percent", max(errors, default=None))
    return words("show.quality", residual=residual, error=error)


def _describe_laws(study: Study, words: Words) -> str:
    above = [
        spread
        for row in study.rows
        for check in row.checks
        for spread in check.spreads
        if not spread.in_verdict and spread.high is not None and spread.high > 1
        and check.utilisation is not None and check.utilisation <= 1
    ]  # fmt: skip
    return words("show.other_laws_counted", count=len(above))


def _name_law(study: Study) -> str:
    """Creep law of a study; "" of one that does not say."""
    return study.provenance.settings.get("creep_law", "").partition(" ")[0]


def tell_accepted_law(study: Study, words: Words) -> str:
    """Creep law whose extrapolation is accepted, and whether it is the study's."""
    given, own = study.project.accepted_law, _name_law(study)
    if given in ("", own):
        return show_text(given) if given else ""
    return words("show.accepted_of_another", given=show_text(given), own=show_text(own))


def _describe_snow(study: Study, words: Words) -> str:
    """Governing snow against the densities of its law, and what is known there."""
    law = _name_law(study)
    inside = [
        case.is_calibrated
        for row in study.rows
        for check in row.checks
        for case in row.cases
        if check.case == case.case
    ]
    is_accepted = bool(law) and study.project.accepted_law == law
    return words(
        "show.snow_of_law",
        inside=sum(inside),
        count=len(inside),
        consent=words("show.law_accepted" if is_accepted else "show.law_not_accepted"),
        evidence=words.show(tell_evidence(law)),
    )


# What is asked, what the study says to it, and the section that tells more.
_QUESTIONS: tuple[tuple[str, Callable[[Study, Words], str], str], ...] = (
    (
        "question.site_file",
        _describe_site_file,
        "heading.provenance",
    ),
    (
        "question.inputs",
        _describe_inputs,
        "heading.inputs",
    ),
    (
        "question.ranges",
        lambda _, words: words("show.see_ranges"),
        "heading.ranges",
    ),
    (
        "question.profile",
        _describe_profile,
        "heading.limit_profile",
    ),
    (
        "question.cases",
        _describe_cases,
        "heading.solver_quality",
    ),
    (
        "question.snow_of_law",
        _describe_snow,
        "heading.notes",
    ),
    (
        "question.quality",
        _describe_quality,
        "heading.solver_quality",
    ),
    (
        "question.independent",
        _describe_independent,
        "heading.independent_checks",
    ),
    (
        "question.laws",
        _describe_laws,
        "heading.uncertainty",
    ),
    (
        "question.otherwise",
        lambda _, words: words("show.see_scope"),
        "heading.scope",
    ),
)
