"""Drawings of the page: errors of the pack, settling of snow, bands of structures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from netdesign.evidence.figure_style import use_style, write_svg
from netdesign.evidence.validation.band import MemberBand, Validation
from netdesign.evidence.verification.case import VerificationCase
from netdesign.evidence.verification.compaction import MODELS, STRESSES, Place
from netdesign.evidence.verification.pack import name_kind
from netdesign.report.drawing.style import (
    ACCENT,
    GREY,
    INK,
    PALE,
    WIDTH_IN,
)
from netdesign.report.words import ENGLISH, Words, show_member, show_own
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.words.catalogue import load_texts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_LEAST = 1e-16  # an error of none is shown there
_ROW_IN = 0.19  # height of a bar
# Told apart without colour.
_DASHES = ("-", (0, (5, 1.6)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)))


def draw_errors(cases: Sequence[VerificationCase], words: Words = ENGLISH) -> str:
    """Error of each case over its tolerance: right of the line none passes."""
    from matplotlib.figure import Figure

    name = "errors"
    kinds = list(dict.fromkeys(case.kind for case in cases))
    with use_style(name):
        figure = Figure(figsize=(WIDTH_IN, 0.32 * len(kinds) + 0.7))
        axes = figure.subplots()
        for place, kind in enumerate(reversed(kinds)):
            ratios = [
                max(case.error / case.tolerance, _LEAST)
                for case in cases
                if case.kind == kind
            ]
            axes.plot(ratios, [place] * len(ratios), "|", color=INK, markersize=8)
        axes.axvline(1.0, color=ACCENT, linewidth=1.0)
        axes.set_xscale("log")
        axes.set_xlim(_LEAST / 3.0, 10.0)
        named = [name_kind(kind, words) for kind in reversed(kinds)]
        axes.set_yticks(range(len(kinds)), named)
        axes.set_ylim(-0.6, len(kinds) - 0.4)
        axes.set_xlabel(words("validation.errors_axis"))
        _strip(axes)
        figure.tight_layout(pad=0.4)
    return write_svg(figure, name, words("validation.errors_title"))


def draw_compaction(places: Sequence[Place], words: Words = ENGLISH) -> str:
    """Apparent compaction viscosity over density, one panel a stress."""
    from matplotlib.figure import Figure

    name = "compaction"
    with use_style(name):
        figure = Figure(figsize=(WIDTH_IN, 4.6))
        grid = figure.subplots(2, 2, sharex=True, sharey=True)
        for stress, axes in zip(STRESSES, grid.flat, strict=True):
            here = [place for place in places if place.stress == stress]
            _draw_stress(axes, here)
            axes.set_title(
                words.write(f"{stress / 1e3:g}") + " kPa", loc="left", fontsize=8
            )
            _strip(axes)
        for axes in grid[-1]:
            axes.set_xlabel(words("validation.density_axis"))
        for axes in grid[:, 0]:
            axes.set_ylabel(words("validation.viscosity_axis"))
        handles, labels = grid[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="lower center", ncols=4, frameon=False)
        figure.tight_layout(pad=0.5, rect=(0.0, 0.09, 1.0, 1.0))
    return write_svg(figure, name, words("validation.compaction_title"))


def _draw_stress(axes: Axes, places: Sequence[Place]) -> None:
    densities = [place.density for place in places]
    for index, model in enumerate(MODELS):
        warm = [place.models[model.name][0] for place in places]
        cold = [place.models[model.name][1] for place in places]
        axes.fill_between(densities, warm, cold, color=PALE, linewidth=0.0, alpha=0.5)
        dashes = _DASHES[index]
        axes.plot(
            densities, warm, color=GREY, linestyle=dashes, label=model.name, linewidth=1
        )
    for index, law in enumerate(CREEP_LAWS):
        values = [place.laws[law] for place in places]
        color = ACCENT if index == 0 else INK
        dashes = _DASHES[index]
        axes.plot(densities, values, color=color, linestyle=dashes, label=law)
    axes.set_yscale("log")


def draw_bands(validations: Sequence[Validation], words: Words = ENGLISH) -> str:
    """Bands of the model and what was measured, one bar a member."""
    from matplotlib.figure import Figure

    name = "bands"
    bars = [
        (show_own(words, one.structure.title), comparison, band)
        for one in validations
        for comparison in one.comparisons
        for band in comparison.bands
    ]
    with use_style(name):
        height = _ROW_IN * (len(bars) + 1.3 * len(validations)) + 0.6
        figure = Figure(figsize=(WIDTH_IN, height))
        axes = figure.subplots()
        place, ticks, before = 0.0, [], ""
        for title, comparison, band in bars:
            if title != before:
                place -= 1.3
                axes.text(
                    0.0,
                    place + 0.75,
                    title,
                    transform=axes.get_yaxis_transform(),
                    va="center",
                    fontweight="bold",
                )
                before = title
            _draw_bar(axes, place, band, comparison.measured.value)
            label = words(
                "show.label",
                label=show_own(words, comparison.measured.name),
                text=name_validated(band.member, words),
            )
            ticks.append((place, label))
            place -= 1.0
        axes.set_yticks([tick for tick, _ in ticks], [label for _, label in ticks])
        axes.set_xscale("log")
        axes.set_ylim(place + 0.3, 0.0)
        axes.set_xlabel(words("validation.bands_axis"))
        _strip(axes)
        figure.tight_layout(pad=0.4)
    return write_svg(figure, name, words("validation.bands_title"))


def _draw_bar(axes: Axes, place: float, band: MemberBand, value: float) -> None:
    """Band of a member, its middle, and what was measured."""
    least = 1.0  # of the axis: a slack guy has no force
    for ends, color in (((band.low, band.high), PALE), (band.middle, GREY)):
        shown = [max(end, least) for end in ends]
        axes.plot(shown, [place] * 2, color=color, lw=7, solid_capstyle="butt")
    axes.plot([value], [place], "|", color=ACCENT, markersize=11, mew=2.2)


def name_validated(member: str, words: Words) -> str:
    """Member of the model that a measured value may be."""
    key = f"validation_member.{member}"
    return words(key) if key in load_texts("en") else show_member(words, member)


def _strip(axes: Axes) -> None:
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
