"""Annex of the model: what it assumes, its formulas, their symbols, its evidence."""

from __future__ import annotations

from netdesign.report.blocks.block import Items, Part, section
from netdesign.report.blocks.table import Table, text_cell, text_column
from netdesign.report.sections.basis import name_law
from netdesign.report.words import Words, show_unit
from netdesign.study.notes import describe_evidence
from netdesign.study.records import Study

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
        "α_0|; |α_max − α_0|), cos δ' = cos δ / √(1 + k²)",
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
        columns=tuple(
            text_column(words(f"heading.{key}")) for key in ("gives", "formula")
        ),
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
        f"{symbol}: {_name_symbol(symbol, unit, words)}"
        for symbol, unit in units.items()
    ]
    return Table(
        caption=words("caption.symbols"),
        columns=(text_column(words("heading.symbols")),),
        rows=((text_cell(words.join(told)),),) if told else (),
        empty=words("show.none"),
    )


def _name_symbol(symbol: str, unit: str, words: Words) -> str:
    name = words(f"symbol.{symbol}")
    return name if unit == "-" else f"{name} [{show_unit(unit)}]"
