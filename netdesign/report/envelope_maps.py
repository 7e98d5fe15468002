"""Drawings of a searched envelope: maps by inclination, lines with bound, drivers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from netdesign.quantities import QUANTITIES
from netdesign.report.figures import (
    ACCENT,
    GREY,
    INK,
    PALE,
    TEXT_PT,
    WIDTH_IN,
    use_style,
    write_svg,
)
from netdesign.report.words import show_given
from netdesign.study import BoundRecord, EnvelopeRecord, MapRecord

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.figure import Figure

_PANEL_IN, _HEAD_IN, _FOOT_IN = 1.5, 0.35, 0.45
_SMALLEST = 1e-9  # of the largest force: below it a member counts as unloaded
_STEPS = 10  # shades of a map
_SHADES = "Greys"  # prints without colour; the accent marks what governs


def draw_maps(record: EnvelopeRecord, name: str) -> str:
    """SVG of force over density and friction, a column for each inclination.

    Returns "" where density or friction does not range. The ring marks the governing
    case, in the map of the inclination nearest to it.
    """
    bounds = [bound for bound in _list_loaded(record) if bound.maps]
    if not bounds:
        return ""
    columns = max(len(bound.maps) for bound in bounds)
    with use_style(name):
        figure, grid = _open_figure(len(bounds), columns)
        for bound, line in zip(bounds, grid, strict=True):
            nearest = min(
                bound.maps,
                key=lambda one, bound=bound: abs(  # type: ignore[misc]
                    one.inclination_deg - bound.case["inclination_deg"]
                ),
            )
            least = min(min(min(row) for row in one.force_kN) for one in bound.maps)
            for one, axes in zip(bound.maps, line, strict=False):
                shades = _draw_map(axes, one, least, bound.upper_bound_kN)
                if one is nearest:
                    _ring(axes, bound.case["density_kg_m3"], bound.case["friction_deg"])
            if shades is not None:
                figure.colorbar(shades, ax=list(line), pad=0.01)
            line[0].set_ylabel(
                f"{_name(bound, record)}\n{_label('friction_deg')}", fontsize=TEXT_PT
            )
        for axes in grid[-1]:
            axes.set_xlabel(_label("density_kg_m3"))
        return write_svg(figure, name, "Forces over density and friction")


def draw_lines(record: EnvelopeRecord, name: str) -> str:
    """SVG of force along each quantity through the governing case, with its bound."""
    bounds = [bound for bound in _list_loaded(record) if bound.lines]
    if not bounds:
        return ""
    columns = max(len(bound.lines) for bound in bounds)
    with use_style(name):
        figure, grid = _open_figure(len(bounds), columns)
        for bound, line in zip(bounds, grid, strict=True):
            for one, axes in zip(bound.lines, line, strict=False):
                axes.fill_between(
                    one.values, one.force_kN, one.bound_kN, color=PALE, linewidth=0
                )
                axes.plot(one.values, one.force_kN, color=INK, linewidth=0.9)
                axes.plot(
                    one.values, one.bound_kN, color=GREY, linewidth=0.6, linestyle="--"
                )
                axes.axhline(bound.upper_bound_kN, color=ACCENT, linewidth=0.5)
                _ring(axes, bound.case[one.key], bound.max_kN)
                axes.margins(x=0.04, y=0.15)
                axes.spines[["top", "right"]].set_visible(False)
            line[0].set_ylabel(_name(bound, record), fontsize=TEXT_PT)
        for one, axes in zip(bounds[-1].lines, grid[-1], strict=False):
            axes.set_xlabel(_label(one.key))
        return write_svg(figure, name, "Forces along each quantity, with the bound")


def draw_drivers(record: EnvelopeRecord, name: str) -> str:
    """SVG of what drives each force: tornado about the governing case."""
    bounds = [bound for bound in _list_loaded(record) if bound.drivers]
    if not bounds:
        return ""
    with use_style(name):
        figure, grid = _open_figure(len(bounds), 1)
        for bound, (axes,) in zip(bounds, grid, strict=True):
            _draw_tornado(axes, bound)
            axes.set_xlabel(_name(bound, record), fontsize=TEXT_PT)
        return write_svg(figure, name, "What drives each force")


def _draw_map(axes: Any, one: MapRecord, least: float, most: float) -> Any:
    """Shades of one map; None where the force does not vary."""
    axes.set_title(
        f"θ = {show_given(round(one.inclination_deg, 3))}°",
        loc="right",
        fontsize=TEXT_PT,
    )
    if not most > least:
        return None
    levels = [least + (most - least) * k / _STEPS for k in range(_STEPS + 1)]
    return axes.contourf(
        one.density_kg_m3, one.friction_deg, one.force_kN, levels, cmap=_SHADES
    )


def _draw_tornado(axes: Any, bound: BoundRecord) -> None:
    drivers = sorted(bound.drivers, key=lambda one: one.most_kN - one.least_kN)
    for place, one in enumerate(drivers):
        axes.barh(
            place, one.most_kN - one.least_kN, left=one.least_kN, color=PALE, height=0.6
        )
        axes.text(
            one.most_kN,
            place,
            f"  S {one.first_order:.2f}, total {one.total:.2f}",
            va="center",
            fontsize=TEXT_PT,
        )
    axes.axvline(bound.max_kN, color=ACCENT, linewidth=0.8)
    axes.set_yticks(range(len(drivers)), [_label(one.key) for one in drivers])
    axes.margins(x=0.35)
    axes.spines[["top", "right"]].set_visible(False)


def _ring(axes: Any, x: float, y: float) -> None:
    """Mark of the worst case."""
    axes.plot(
        [x], [y], "o", mfc="none", mec=ACCENT, mew=1.1, ms=7, zorder=5, clip_on=False
    )


def _open_figure(rows: int, columns: int) -> tuple[Figure, Any]:
    from matplotlib.figure import Figure

    height = _PANEL_IN * rows + _HEAD_IN + _FOOT_IN
    figure = Figure(figsize=(WIDTH_IN, height), layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False)


def _list_loaded(record: EnvelopeRecord) -> Sequence[BoundRecord]:
    largest = max((bound.max_kN for bound in record.bounds), default=0.0)
    return [bound for bound in record.bounds if bound.max_kN > _SMALLEST * largest]


def _name(bound: BoundRecord, record: EnvelopeRecord) -> str:
    if record.is_per_metre:
        return f"Net, {bound.quantity} [kN/m]"
    return f"{QUANTITIES[f'{bound.quantity}_kN'].label} [kN]"


def _label(key: str) -> str:
    quantity = QUANTITIES[key]
    return f"{quantity.label} [{quantity.unit}]" if quantity.unit else quantity.label
