"""Envelope of a net row: member forces over the ranges, small multiples."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from netdesign.outcome import Outcome
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
from netdesign.report.tables import list_loaded
from netdesign.report.words import show_given, show_number
from netdesign.study import CaseRecord, ExtremeRecord, RowStudy

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MOST_PANELS, _MOST_LINES = 4, 5  # across; more are thinned out
_PANEL_IN, _HEAD_IN, _FOOT_IN = 1.14, 0.5, 0.42
# Told apart without colour: shade, dashes and marker all differ.
_LINES: tuple[tuple[str, Any, str], ...] = (
    (INK, "-", "o"),
    ("#555b63", "--", "s"),
    (GREY, "-.", "^"),
    ("#555b63", ":", "D"),
    (INK, (0, (6, 2, 1, 2, 1, 2)), "v"),
)


def draw_envelope(row: RowStudy, name: str) -> str:
    """SVG of all forces of a row; "" if no case of it gives a force."""
    from matplotlib.figure import Figure

    members = list_loaded(row)
    if not members:
        return ""
    governing = [extreme.case for extreme in row.extremes]
    panels = _thin(
        (case.case.inclination_deg for case in row.cases),
        [case.inclination_deg for case in governing],
        _MOST_PANELS,
    )
    frictions = _thin(
        (case.case.friction_deg for case in row.cases),
        [case.friction_deg for case in governing],
        _MOST_LINES,
    )
    height = _PANEL_IN * len(members) + _HEAD_IN + _FOOT_IN
    with use_style(name):
        figure = Figure(figsize=(WIDTH_IN, height))
        grid = figure.subplots(
            len(members), len(panels), sharex=True, sharey="row", squeeze=False
        )
        for member, line in zip(members, grid, strict=True):
            for inclination, axes in zip(panels, line, strict=True):
                _draw_panel(axes, row, member, inclination, frictions)
        _dress(figure, grid, members, panels)
        _draw_legend(figure, frictions, has_failed=_has_failed(row.cases))
        return write_svg(figure, name, "Member forces over the ranges")


def _thin(values: Iterable[float], keep: Sequence[float], most: int) -> list[float]:
    """At most ``most`` of the values, evenly chosen; those to keep come first."""
    known = sorted(set(values))
    if len(known) <= most:
        return known
    chosen = dict.fromkeys(value for value in keep if value in known)
    last = len(known) - 1
    for step in range(most):
        chosen.setdefault(known[round(step * last / (most - 1))])
    return sorted(list(chosen)[:most])


def _force(case: CaseRecord, member: str) -> float | None:
    force: float | None = getattr(case, f"{member}_kN")
    return force


def _height(case: CaseRecord, member: str) -> float:
    """Force, or a gap in the line."""
    force = _force(case, member)
    return math.nan if force is None else force


def _has_failed(cases: Iterable[CaseRecord]) -> bool:
    return any(case.outcome is not Outcome.CONVERGED for case in cases)


def _draw_panel(
    axes: Axes,
    row: RowStudy,
    member: str,
    inclination: float,
    frictions: Sequence[float],
) -> None:
    here = [case for case in row.cases if case.case.inclination_deg == inclination]
    for friction, (shade, dashes, marker) in zip(frictions, _LINES, strict=False):
        points = sorted(
            (case.case.density_kg_m3, _height(case, member))
            for case in here
            if case.case.friction_deg == friction
        )
        axes.plot(
            [x for x, _ in points],
            [y for _, y in points],
            color=shade,
            linestyle=dashes,
            marker=marker,
            markersize=2.8,
            markerfacecolor="white",
            markeredgewidth=0.7,
            linewidth=0.9,
        )
    failed = [case.case.density_kg_m3 for case in here if _has_failed([case])]
    axes.plot(
        failed,
        [0.04] * len(failed),
        "x",
        color=ACCENT,
        markersize=5,
        transform=axes.get_xaxis_transform(),
        clip_on=False,
    )
    for extreme in row.extremes:
        if extreme.quantity == member and extreme.case.inclination_deg == inclination:
            _mark(axes, extreme)


def _mark(axes: Axes, extreme: ExtremeRecord) -> None:
    """Ring around the governing case, with its value."""
    at = (extreme.case.density_kg_m3, extreme.max_kN)
    ring: dict[str, Any] = {
        "mfc": "none",
        "mec": ACCENT,
        "mew": 1.1,
        "ms": 7.5,
        "zorder": 5,
    }
    axes.plot(*at, "o", clip_on=False, **ring)
    is_left = at[0] == axes.dataLim.x0
    axes.annotate(
        show_number("max_kN", extreme.max_kN),
        at,
        xytext=(7 if is_left else -7, 1),
        textcoords="offset points",
        ha="left" if is_left else "right",
        va="bottom",
        color=ACCENT,
    )


def _dress(
    figure: Figure,
    grid: Any,
    members: Sequence[str],
    panels: Sequence[float],
) -> None:
    """Headings, few ticks, faint lines."""
    height = figure.get_size_inches()[1]
    figure.subplots_adjust(
        left=0.085,
        right=0.985,
        top=1 - _HEAD_IN / height,
        bottom=_FOOT_IN / height,
        wspace=0.1,
        hspace=0.32,
    )
    for line, member in zip(grid, members, strict=True):
        quantity = QUANTITIES[f"{member}_kN"]
        line[0].set_title(
            f"{quantity.label} [{quantity.unit}]",
            loc="left",
            fontsize=TEXT_PT,
            fontweight="bold",
            pad=4,
        )
        for axes in line:
            axes.margins(x=0.08, y=0.18)
            axes.locator_params(axis="y", nbins=4)
            axes.locator_params(axis="x", nbins=5)
            axes.grid(axis="y", color=PALE, linewidth=0.4)
            axes.spines[["top", "right"]].set_visible(False)
    for axes, inclination in zip(grid[0], panels, strict=True):
        axes.set_title(f"θ = {show_given(inclination)}°", loc="right", fontsize=TEXT_PT)
    density = QUANTITIES["density_kg_m3"]
    for axes in grid[-1]:
        axes.set_xlabel(f"{density.label} [{density.unit}]")


def _draw_legend(
    figure: Figure, frictions: Sequence[float], *, has_failed: bool
) -> None:
    from matplotlib.lines import Line2D

    handles = [
        Line2D(
            [],
            [],
            color=shade,
            linestyle=dashes,
            marker=marker,
            ms=2.8,
            mfc="white",
            mew=0.7,
            lw=0.9,
            label=f"φ = {show_given(friction)}°",
        )
        for friction, (shade, dashes, marker) in zip(frictions, _LINES, strict=False)
    ]
    ring = Line2D([], [], ls="", marker="o", mfc="none", mec=ACCENT, ms=6)
    ring.set_label("governing case")
    handles.append(ring)
    if has_failed:
        handles.append(Line2D([], [], ls="", marker="x", color=ACCENT, ms=5))
        handles[-1].set_label("no result")
    figure.legend(
        handles=handles,
        loc="upper left",
        ncols=len(handles),
        frameon=False,
        fontsize=TEXT_PT,
        handlelength=2.6,
        handletextpad=0.5,
        columnspacing=1.2,
        bbox_to_anchor=(0.06, 1.0),
        borderaxespad=0.1,
    )
