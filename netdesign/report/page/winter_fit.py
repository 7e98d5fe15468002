"""Section of the winter page on the fit of a row: bands, parameters, residuals."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from netdesign.report.blocks import (
    Block,
    Cell,
    Figure,
    Heading,
    Paragraph,
    Table,
    fixed_cell,
    force_cell,
    key_columns,
    name_columns,
    notes,
    text_cell,
)
from netdesign.report.drawing.measured_figure import draw_residuals
from netdesign.report.words import MISSING, Words, show_member, show_text, show_unit

_DECIMALS = {"slip_length": 1, "friction_angle": 1, "slack": 4}  # else 3


def show_fit(fit: Mapping[str, Any], density: float, words: Words) -> Iterator[Block]:
    """Tables, sentences and residuals of a fit.

    Parameters
    ----------
    fit : mapping
        Entry ``fit`` of the winter document.
    density : float
        Of the design case [kg/m3].
    words : Words
        Language.
    """
    is_fitted = fit["outcome"] == "fitted"
    heading = words("fit_page.heading", winter=fit["winter"] or MISSING)
    yield Heading(text=heading, level=3)
    yield notes(*_describe_fit(fit, words), look="notes" if is_fitted else "notes open")
    found = {"density": density, "share": fit["unconstrained_above"]}
    for part, table in (
        ("forces", _tabulate_forces(fit["forces"], words)),
        ("parameters", _tabulate_parameters(fit, words)),
    ):
        if table.rows:
            key = f"fit_page.{part}_{'note' if is_fitted else 'none'}"
            yield table.shown("study")
            yield Paragraph(text=words(key, **found), look="small")
    correlations = _tabulate_correlations(fit, words)
    if correlations.rows:
        yield correlations.shown("study")
    residuals = _tabulate_residuals(fit, words)
    if residuals.rows:
        svg = draw_residuals(fit["residuals"], words)
        yield Figure(svg=svg, caption=words("fit_page.figure"), look="plate")
        yield residuals.shown("study")


def _describe_fit(fit: Mapping[str, Any], words: Words) -> list[str]:
    """Outcome, readings and noise; days left out and known parameters if any."""
    noise = fit["noise"]
    told = [
        show_text(fit["why"]),
        words("fit_page.taken", readings=fit["readings"], days=fit["days"]),
        words(
            "fit_page.noise",
            reading=noise["reading"],
            cell=noise["cell"],
            rope=noise["rope_K"],
        ),
    ]
    if fit["days_left_out"]:
        told.append(words("fit_page.left_out", days=tuple(fit["days_left_out"])))
    if fit["known"]:
        names = tuple(words(f"fit_parameter.{one}") for one in fit["known"])
        told.append(words("fit_page.known", names=names))
    return told


def _tabulate_forces(forces: Sequence[Mapping[str, Any]], words: Words) -> Table:
    numbers = ("before", "deviation_before", "after", "deviation_after")
    return Table(
        caption=words("fit_page.forces_caption"),
        columns=key_columns(
            words, "fit_page.", ("case", "member", *numbers), numbers=numbers
        ),
        rows=tuple(
            (
                text_cell(words(f"fit_case.{one['case']}")),
                text_cell(show_member(words, one["member"])),
                _band_cell(one["before_kN"], words),
                _percent_cell(one["before_deviation"], words),
                _band_cell(one["after_kN"], words),
                _percent_cell(one["after_deviation"], words),
            )
            for one in forces
        ),
    )


def _tabulate_parameters(fit: Mapping[str, Any], words: Words) -> Table:
    keys = ("parameter", "unit", "prior", "posterior", "told")
    return Table(
        caption=words("fit_page.parameters_caption"),
        columns=key_columns(words, "fit_page.", keys, numbers=("prior", "posterior")),
        rows=tuple(
            (
                text_cell(words(f"fit_parameter.{one['name']}")),
                text_cell(show_unit(one["unit"])),
                _value_cell(one, "prior", words),
                _value_cell(one, "posterior", words),
                text_cell(_describe_worth(one, fit["outcome"], words)),
            )
            for one in fit["parameters"]
        ),
    )


def _value_cell(one: Mapping[str, Any], key: str, words: Words) -> Cell:
    value, deviation = one[key], one[f"{key}_deviation"]
    if value is None:
        return text_cell(MISSING)
    decimals = _DECIMALS.get(one["name"], 3)
    shown = words.show_fixed(value, decimals)
    if deviation is None:
        return Cell(text=shown, number=value)
    if one["deviation_of"] == "logarithm":
        around = f"{words.show_fixed(100.0 * deviation, 0)} %"
    else:
        around = words.show_fixed(deviation, decimals)
    return Cell(text=f"{shown} ± {around}", number=value)


def _describe_worth(one: Mapping[str, Any], outcome: str, words: Words) -> str:
    if outcome != "fitted":
        return MISSING
    if one["is_at_end"]:
        return words("fit_page.at_end")
    if one["is_constrained"]:
        return words("fit_page.constrained")
    return words("fit_page.unconstrained")


def _tabulate_correlations(fit: Mapping[str, Any], words: Words) -> Table:
    names = [words(f"fit_parameter.{one['name']}") for one in fit["parameters"]]
    headings = [words("fit_page.parameter"), *names]
    return Table(
        caption=words("fit_page.correlations_caption"),
        columns=name_columns(headings, numbers=names),
        rows=tuple(
            # none that is shown as 0 keeps its sign
            (text_cell(name), *(fixed_cell(words, round(x, 2) or 0.0, 2) for x in line))
            for name, line in zip(names, fit["correlations"], strict=False)
        ),
    )


def _tabulate_residuals(fit: Mapping[str, Any], words: Words) -> Table:
    computed = "computed" if fit["outcome"] == "fitted" else "computed_refused"
    numbers = ("measured", computed, "residual", "deviation")
    return Table(
        caption=words("fit_page.residuals_caption"),
        columns=key_columns(
            words, "fit_page.", ("date", "member", *numbers), numbers=numbers
        ),
        rows=tuple(
            (
                text_cell(one["date"].replace("-", "\u2011")),
                text_cell(show_member(words, one["member"])),
                force_cell(words, one["measured_kN"]),
                force_cell(words, one["computed_kN"]),
                fixed_cell(words, one["measured_kN"] / one["computed_kN"], 2),
                _percent_cell(one["deviation"], words),
            )
            for one in fit["residuals"]
        ),
    )


def _band_cell(band: Mapping[str, float] | None, words: Words) -> Cell:
    if band is None:
        return text_cell(MISSING)
    value = words.show_number("max_kN", band["value"])
    ends = words.show_band("max_kN", band["low"], band["high"])
    return Cell(text=f"{value} ({ends})", number=band["value"])


def _percent_cell(share: float | None, words: Words) -> Cell:
    if share is None:
        return text_cell(MISSING)
    return Cell(text=f"{words.show_fixed(100.0 * share, 1)} %", number=share)
