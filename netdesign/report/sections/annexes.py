"""Annexes: the model with its formulas; how to verify the report, its provenance."""

from __future__ import annotations

import re
from collections.abc import Callable

from netdesign.checks.check import Check
from netdesign.outcome import Outcome
from netdesign.report.blocks import (
    Column,
    Items,
    Pair,
    Pairs,
    Part,
    Table,
    given_cell,
    key_columns,
    section,
    text_cell,
)
from netdesign.report.sections.basis import (
    count_assumed,
    list_defaults,
    name_law,
    name_profile,
)
from netdesign.report.sections.decision import name_verification
from netdesign.report.words import (
    VERDICTS,
    Words,
    show_own,
    show_text,
    show_unit,
    show_verdict,
)
from netdesign.study.document import compute_digest, hash_results
from netdesign.study.notes import describe_evidence
from netdesign.study.records import Study
from netdesign.words.names import name

_MODEL = (
    "assumption.plane_strain",
    "assumption.steady_creep",
    "assumption.hinged_post",
    "assumption.coulomb",
)
# Formulas by which the forces come about that every calculation begins with.
FORMULAS = (
    ("pulls", "F_f = b · (f_x; f_y), P = b · (h_x; h_y)"),
    ("head", "C = (P × g) / (p × g), T = (P × p) / (p × g); a × c = a_x c_y − a_y c_x"),
    ("base", "V = −C p_y"),
    ("shared", "E_s = |F_f| + T_u"),
    ("pressure", "S'_N = ρ g H² K N / 2, K = (k_0 + k_1 ρ + k_2 ρ² + k_3 ρ³) sin 2ψ"),
    (
        "load_cases",
        "ρ_1 = ρ_0 (1 + r max(min(Z; Z_1) − Z_0; 0)), H_1 = d / cos ψ; H_2 = h_2 H_1",
    ),
    (
        "resultant",
        "S'_Q = f_s S'_N a_Q / (N tan ψ), G' = ρ g min(D_K; H cos ψ)² tan "
        "θ / 2, R = (f_s S'_N + G' sin ψ; −S'_Q − G' cos ψ)",
    ),
    (
        "chord",
        "λ = min(1; H cos ψ / D_K), Q = R_x cos θ − R_y sin θ, v_1 = 1 − "
        "λ/2, v_2 = λ/2; (Q² / (2 T²)) (λ (v_1² − v_1 v_2 + v_2²) / 3 + (1 "
        "− λ) v_2²) = s + (1 + s) T / ES",
    ),
    ("net", "f = v_1 R + T e, h = v_2 R − T e, e = (sin θ; cos θ)"),
    (
        "direction",
        "α_s = atan2(F_y; ±F_x), α = asin(cos β sin α_s), δ = max(|α_min − "
        "α_0|; |α_max − α_0|), cos δ' = cos δ / √(1 + k²); "
        "δ' > δ_max ⇒ R_k = R_H / sin δ'",
    ),
    (
        "bar",
        "N_Rk = π (D² − d²) f / 4, M_Rk = π (D⁴ − d⁴) f / (32 D), V_Rk = "
        "A_v f / √3, A_v = 3 A / 4 | 2 A / π",
    ),
    (
        "bending",
        "R_k = 1 / a, a = cos δ / N_Rk + e sin δ / M_Rk; c = 2 sin δ / "
        "V_Rk > a ⇒ R_k = (2 c − a) / c²",
    ),
    (
        "buckling",
        "Φ = (1 + α (λ − 0.2) + λ²) / 2, χ = min(1; 1 / (Φ + √(Φ² − λ²))), "
        "R_k = χ A f_y",
    ),
    ("end_moments", "M = S + (H + F) / 2 + (H − F)² / (16 S) | max(H; F)"),
    ("height", "D_K ≥ max(1; r_h) d"),
    ("spacing", "L ≤ f_L D_K / cos ψ, f_L = 2 tan ψ / (tan ψ − tan φ)"),
)


def show_model(study: Study, words: Words) -> Part:
    """Annex with model, formulas and evidence."""
    law = name_law(study)
    model = [words(key) for key in _MODEL]
    if law:
        model.append(words.show(describe_evidence(law)))
    return section(
        "annex-model",
        words("heading.annex_model"),
        Items(items=tuple(model)),
        _build_formulas(words).shown("formulas", symbols="cells"),
        _build_symbols(study, words).shown("formulas", symbols="cells"),
    )


def _build_formulas(words: Words) -> Table:
    """Formulas of statics and guideline, once for all rows."""
    return Table(
        caption=words("caption.formulas"),
        columns=key_columns(words, "heading.", ("gives", "formula")),
        rows=tuple(
            (
                text_cell(words(f"formula.{key}")),
                text_cell(words.write_formula(formula)),
            )
            for key, formula in FORMULAS
        ),
    )


def _build_symbols(study: Study, words: Words) -> Table:
    """Symbols of the calculations of the study."""
    steps = (step for row in study.rows for one in row.checks for step in one.steps)
    units = {step.symbol: step.unit for step in steps}
    told = [
        words("show.label", label=symbol, text=_name_symbol(symbol, unit, words))
        for symbol, unit in units.items()
    ]
    return Table(
        caption=words("caption.symbols"),
        columns=(Column(heading=words("heading.symbols")),),
        rows=((text_cell(words.join(told)),),) if told else (),
        empty=words("show.none"),
    )


def _name_symbol(symbol: str, unit: str, words: Words) -> str:
    name = words(f"symbol.{symbol}")
    return name if unit == "-" else f"{name} [{show_unit(unit)}]"


_NUMBER = re.compile(r"[0-9]+(\.[0-9]+)?(e[+-]?[0-9]+)?")


def show_verification(study: Study, words: Words) -> Part:
    """Annex with command and digest, checklist, provenance."""
    pairs = {
        "verify_report": name_verification(study),
        "what_that_does": words("heading.verify_explained"),
        "study_hash": compute_digest(study),
    }
    return section(
        "annex-verify",
        words("heading.annex_verify"),
        Pairs(
            look="keys",
            pairs=tuple(
                Pair(name=words(f"heading.{k}"), text=x) for k, x in pairs.items()
            ),
        ),
        _build_checklist(study, words).shown("checklist"),
        build_provenance(study, words).shown("provenance"),
    )


def _write_command(words: Words) -> str:
    """Command that makes the document again, in its language."""
    language = "" if words.language == "en" else f" --language {words.language}"
    return f"netdesign report study.json{language}"


def build_provenance(study: Study, words: Words) -> Table:
    """All that is needed to repeat the study."""
    made = study.provenance
    pairs = {
        "command_again": _write_command(words),
        "results_hash": hash_results(study),
        "program": f"netdesign {made.version}",
        "started": made.started,
        "site_file": made.site_file,
        "site_hash": made.site_sha256,
        "limit_profile": words(
            "show.label", label=study.profile.id, text=name_profile(study, words)
        ),
        "profile_version": study.profile.version,
        "profile_choice": study.profile.choice,
        "profile_hash": study.profile.sha256,
        "schema": study.schema,
    }
    named = {words(f"heading.{key}"): text for key, text in pairs.items()}
    for key, text in made.settings.items():
        setting = words.show(name("setting", key))
        shown = _show_setting(key, text, words)
        named[words("show.setting", setting=setting)] = shown
    libraries = ", ".join(f"{k} {v}" for k, v in made.libraries.items())
    named[words("heading.libraries")] = libraries
    verdict = show_verdict(study.verdict, words)
    code = VERDICTS[study.verdict].exit_code
    named[words("heading.exit_code")] = words(
        "show.exit_code", code=code, verdict=verdict.word
    )
    return Table(
        caption=words("caption.provenance"),
        columns=key_columns(words, "heading.", ("item", "value")),
        rows=tuple(
            (text_cell(one), text_cell(text)) for one, text in named.items() if text
        ),
    )


def _show_setting(key: str, text: str, words: Words) -> str:
    """Setting as stored; a number, and only that, with the language's mark."""
    if key == "method":
        return words.show(name("method_used", text))
    return words.write(text) if _NUMBER.fullmatch(text) else show_own(words, text)


def _build_checklist(study: Study, words: Words) -> Table:
    """Questions of a reviewer, each with what this document says to it."""
    keys = ("no", "question", "what_study_says", "see", "done")
    return Table(
        caption=words("caption.checklist"),
        columns=key_columns(words, "heading.", keys, numbers=("no",)),
        rows=tuple(
            (
                given_cell(words, float(number)),
                text_cell(words(question)),
                text_cell(answer(study, words)),
                text_cell(words(place)),
                text_cell("☐"),
            )
            for number, (question, answer, place) in enumerate(_QUESTIONS, 1)
        ),
    )


def _describe_site_file(study: Study, words: Words) -> str:
    return words("show.hash_begins", hash=study.provenance.site_sha256[:12])


def _describe_inputs(study: Study, words: Words) -> str:
    inputs = [*study.range_inputs, *(one for row in study.rows for one in row.inputs)]
    defaults = len(list_defaults(study, words))
    return words("show.inputs_counted", count=len(inputs), defaults=defaults)


def _describe_profile(study: Study, words: Words) -> str:
    assumed, count = count_assumed(study)
    return words("show.assumed_counted", assumed=assumed, count=count)


def _describe_independent(study: Study, words: Words) -> str:
    laws = [one for row in study.rows for one in row.independent]
    met = sum(one.is_met for one in laws)
    return words("show.laws_counted", met=met, count=len(laws))


def describe_cases(study: Study, words: Words) -> str:
    """Cases with and without a result."""
    cases = [case for row in study.rows for case in row.cases]
    failed = sum(case.outcome is not Outcome.CONVERGED for case in cases)
    return words("show.cases_solved", solved=len(cases) - failed, failed=failed)


def _describe_quality(study: Study, words: Words) -> str:
    cases = [case for row in study.rows for case in row.cases]
    residuals = [c.balance_residual for c in cases if c.balance_residual is not None]
    errors = [c.error_percent for c in cases if c.error_percent is not None]
    residual = words.show_number("balance_residual", max(residuals, default=None))
    error = words.show_number("error_percent", max(errors, default=None))
    return words("show.quality", residual=residual, error=error)


def _describe_laws(study: Study, words: Words) -> str:
    """Rows whose governing check another creep law would turn, and those not known."""
    above, open_ = [], []
    for row in study.rows:
        form = row.model_form
        if form is None or form.utilisation is None or form.utilisation_high is None:
            open_.append(row.id)
        elif form.utilisation <= 1.0 < form.utilisation_high:
            above.append(row.id)
    rows, left = (", ".join(map(show_text, one)) for one in (above, open_))
    none = words("show.none")
    return words("show.other_laws", rows=rows or none, left=left or none)


def _describe_snow(study: Study, words: Words) -> str:
    """Snow of the solved forces that govern, against the densities of its law."""
    inside = [
        case.is_calibrated
        for row in study.rows
        for check in row.checks
        for case in row.cases
        if check.case == case.case and _is_by_snow(check)
    ]
    return words("show.snow_of_law", inside=sum(inside), count=len(inside))


_OF_SNOW = ("E_s", "E_p0", "V_s", "V_p0", "T_r", "T_b")  # forces of solved snow


def _is_by_snow(check: Check) -> bool:
    """Solved snow governs, by a force that is not that of the load along the row."""
    solved = (check.read_band(symbol)[1] for symbol in _OF_SNOW)
    return check.governs not in ("guideline", "maker") and any(solved)


# What is asked, what the study says to it, and the section that tells more.
_QUESTIONS: tuple[tuple[str, Callable[[Study, Words], str], str], ...] = (
    ("question.site_file", _describe_site_file, "heading.provenance"),
    ("question.inputs", _describe_inputs, "heading.inputs_of_rows"),
    (
        "question.ranges",
        lambda _, words: words("show.see_ranges"),
        "heading.ranges",
    ),
    ("question.profile", _describe_profile, "heading.annex_profile"),
    ("question.cases", describe_cases, "heading.annex_quality"),
    ("question.snow_of_law", _describe_snow, "heading.annex_model"),
    ("question.quality", _describe_quality, "heading.annex_quality"),
    ("question.independent", _describe_independent, "heading.annex_quality"),
    ("question.laws", _describe_laws, "heading.annex_quality"),
    (
        "question.otherwise",
        lambda _, words: words("show.see_scope"),
        "heading.scope",
    ),
)
