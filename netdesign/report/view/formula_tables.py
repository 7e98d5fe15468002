"""Formulas of all figures, and what the tables of figures hold: once for all rows."""

from __future__ import annotations

from netdesign.report.blocks.table import Table, text_cell, text_column
from netdesign.report.words import Words

# Names of the formulas, each with its symbols; what it gives is in the words.
FORMULAS = (
    ("pulls", "F_f = b · (f_x; f_y), P = b · (h_x; h_y)"),
    ("head", "C = (P × g) / (p × g), T = (P × p) / (p × g); a × c = a_x c_y − a_y c_x"),
    ("base", "V = −C p_y"),
    ("shared", "E_s = |F_f| + T_u"),
    (
        "guys",
        "g = 1 / (2 cos β), A = c k P / sin β; c_u = max(1/2; κ), "
        "c_d = max(1/2; 1 − κ), κ = |d × p| / (|u × p| + |d × p|)",
    ),
    (
        "post",
        "A = w · max(k P / tan β − T_min; 0), w = κ u·p + (1 − κ) d·p, "
        "T_min = min(max(T_s − ΔT; 0); T_g)",
    ),
    ("sliding", "E_k = t V_k, t = max |x_H − x_B| / y_H, R_k = μ_b γ_E V_k"),
    ("lateral", "k_q = √(1 + k²)"),
    (
        "width",
        "b_e = b / 2 + f_R Δl, f_R = min((e_0 + e_1 N) a / 2; c_0 + c_1 N), "
        "Δl = min(l a / 2; s_l D_K)",
    ),
    ("coupled", "E_c = (g E_s + A) k_q b_e / b"),
    ("guideline", "E_g = (g E_g0 + A) k_q b_e / b"),
    ("panel", "E_p = (g E_p0 + A) k_q b_e / b + Z"),
    ("rope_end", "H = T_r (1 + f_R Δl / b), Z = H tan γ, E_k = H / cos γ"),
    ("action", "E_k = max(E_c; E_p; E_g)"),
    ("design", "E_d = γ_E E_k, R_d = R_k / γ_R, μ = E_d / R_d"),
    ("pressure", "S'_N = ρ g H² K N / 2, K = (k_0 + k_1 ρ + k_2 ρ² + k_3 ρ³) sin 2ψ"),
    (
        "load_cases",
        "ρ_1 = ρ_0 (1 + r max(min(Z; Z_1) − Z_0; 0)), H_1 = d / cos ψ; H_2 = h_2 H_1",
    ),
    (
        "resultant",
        "S'_Q = f_s S'_N a_Q / (N tan ψ), G' = ρ g min(D_K; H cos ψ)² tan θ / 2, "
        "R = (f_s S'_N + G' sin ψ; −S'_Q − G' cos ψ)",
    ),
    (
        "chord",
        "λ = min(1; H cos ψ / D_K), Q = R_x cos θ − R_y sin θ, v_1 = 1 − λ/2, "
        "v_2 = λ/2; (Q² / (2 T²)) (λ (v_1² − v_1 v_2 + v_2²) / 3 + (1 − λ) v_2²) "
        "= s + (1 + s) T / ES",
    ),
    ("net", "f = v_1 R + T e, h = v_2 R − T e, e = (sin θ; cos θ)"),
    (
        "direction",
        "α_s = atan2(F_y; ±F_x), α = asin(cos β sin α_s), "
        "δ = max(|α_min − α_0|; |α_max − α_0|), cos δ' = cos δ / √(1 + k²)",
    ),
    (
        "bar",
        "N_Rk = π (D² − d²) f / 4, M_Rk = π (D⁴ − d⁴) f / (32 D), "
        "V_Rk = A_v f / √3, A_v = 3 A / 4 | 2 A / π",
    ),
    (
        "bending",
        "R_k = 1 / a, a = cos δ / N_Rk + e sin δ / M_Rk; c = 2 sin δ / V_Rk > a ⇒ "
        "R_k = (2 c − a) / c²",
    ),
    (
        "buckling",
        "Φ = (1 + α (λ − 0.2) + λ²) / 2, χ = min(1; 1 / (Φ + √(Φ² − λ²))), "
        "R_k = χ A f_y",
    ),
    ("height", "D_K ≥ max(1; r_h) d"),
    ("spacing", "L ≤ f_L D_K / cos ψ, f_L = 2 tan ψ / (tan ψ − tan φ)"),
)
_HOLDING = (
    *("statics", "floor_statics", "held_sideways", "actions", "panel_actions"),
    *("check_figures", "turns"),
)


def build_holding(words: Words) -> Table:
    """Contents of the tables of a row, once for all rows."""
    return Table(
        caption=words("caption.figure_tables"),
        columns=tuple(
            text_column(words(f"heading.{key}")) for key in ("table", "table_holds")
        ),
        rows=tuple(
            (text_cell(words(f"caption.{key}")), text_cell(words(f"holding.{key}")))
            for key in _HOLDING
        ),
    )


def build_formulas(words: Words) -> Table:
    """Formulas of all figures, once for all rows."""
    keys = ("gives", "formula")
    return Table(
        caption=words("caption.formulas"),
        columns=tuple(text_column(words(f"heading.{key}")) for key in keys),
        rows=tuple(
            (
                text_cell(words(f"formula.{key}")),
                text_cell(words.write_formula(formula)),
            )
            for key, formula in FORMULAS
        ),
    )
