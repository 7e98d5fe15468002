"""Net rows on terrain -> page with maps, a table, and a profile of each row."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from netdesign.addons.terrain.coverage import Coverage
from netdesign.addons.terrain.drawing import (
    draw_map,
    draw_profile,
    draw_slopes,
    extract_ground,
    name_profile,
)
from netdesign.addons.terrain.measure import (
    MeasuredRow,
    describe_end,
    describe_kinks,
    describe_steep_above,
)
from netdesign.addons.terrain.plan import Plan
from netdesign.addons.terrain.surface import Surface
from netdesign.report.blocks import (
    Column,
    Figure,
    Paragraph,
    Part,
    Table,
    fixed_cell,
    masthead,
    notes,
    section,
    text_cell,
)
from netdesign.report.page.render import render_page
from netdesign.report.words import Words, show_text

_TITLE = "Net rows on the terrain"
_MAP = (
    "Relief with contours; rows thick, lines of fall up to the end of their snow thin, "
    "starting zones dashed. Crosses: steeper than 25° and held by no row."
)
_SLOPES = (
    "Slope angle in classes, the darker the steeper; a class begins at the number on "
    "its left."
)
_NUMBERS = (
    *("Slope of the steepest post [°]", "Its band [°]", "Mean of the posts [°]"),
    *("Aspect [°]", "Altitude [m]", "Length [m]", "Posts", "Upslope length [m]"),
)
_TEXTS = ("It ends", "Row below, distance [m]", "Kinks at posts")
# Names on the maps are read on paper and on a telephone.
_STYLE = """
p { overflow-wrap: anywhere; }
@media screen and (max-width: 620px) { .plate svg { width: 640px; } }
@media print { .plate svg { width: 100%; } }
"""


def render_terrain(
    surface: Surface,
    plan: Plan,
    rows: Sequence[MeasuredRow],
    coverage: Coverage,
    grid: tuple[str, str],
) -> bytes:
    """Page of rows on terrain.

    Parameters
    ----------
    surface, plan, rows, coverage
        What was measured.
    grid : tuple of str
        Name of the grid's file, and its SHA-256.
    """
    words = Words("en")
    extract = extract_ground(surface, plan)
    told = (
        find(row) for row in rows for find in (describe_kinks, describe_steep_above)
    )
    kinks = [one for one in told if one]
    maps = (
        (draw_map(extract, plan, rows, coverage), _MAP),
        (draw_slopes(extract, rows), _SLOPES),
    )
    profiles = ((draw_profile(row), name_profile(row)) for row in rows)
    first = _describe_grid(surface, coverage, grid)
    blocks = (
        masthead("netdesign terrain", _TITLE),
        Part(id="grid", blocks=(*(Paragraph(text=one) for one in first),)),
        section("map", "Map", *_show(maps)),
        section(
            "rows",
            "Rows",
            _tabulate(rows, words).shown("study"),
            *([notes(*kinks, look="notes open")] if kinks else []),
        ),
        section("profiles", "Profiles", *_show(profiles)),
    )
    return render_page(blocks, _TITLE, "en", style=_STYLE).encode()


def _show(drawings: Iterable[tuple[str, str]]) -> Iterator[Figure]:
    for svg, caption in drawings:
        yield Figure(svg=svg, caption=caption, look="plate")


def _describe_grid(
    surface: Surface, coverage: Coverage, grid: tuple[str, str]
) -> list[str]:
    """Sentences on the grid, its fit, and the coverage of the starting zones."""
    name, sha256 = grid
    cells = f"{surface.window} x {surface.window} cells of {surface.grid.cell:g} m"
    first = [
        f"Grid {show_text(name)}, SHA-256 {sha256}.",
        f"A quadratic is fitted to {cells} around each point. The heights leave it by "
        f"{surface.noise:.2g} m (standard deviation).",
    ]
    return [*first, coverage.sentence] if coverage.area else first


def _tabulate(rows: Sequence[MeasuredRow], words: Words) -> Table:
    lines = []
    for row in rows:
        slope, below = row.slope, row.below_length
        ends = (f"{math.degrees(one):.1f}" for one in (slope.low, slope.high))
        near = "-" if below is None else f"{row.below_row}, {below:.1f}"
        lines.append(
            (
                text_cell(row.line.id),
                fixed_cell(words, math.degrees(slope.value), 1),
                text_cell("–".join(ends)),
                fixed_cell(words, math.degrees(float(row.slopes.mean())), 1),
                fixed_cell(words, math.degrees(row.aspect), 0),
                fixed_cell(words, float(row.posts[:, 2].max()), 0),
                fixed_cell(words, row.length, 1),
                fixed_cell(words, len(row.posts), 0),
                fixed_cell(words, row.upslope.length.value, 1),
                text_cell(describe_end(row.upslope)),
                text_cell(near),
                text_cell(", ".join(map(str, row.kinks)) or "-"),
            )
        )
    columns = (
        Column(heading="Row"),
        *(Column(heading=one, is_number=True) for one in _NUMBERS),
        *(Column(heading=one) for one in _TEXTS),
    )
    caption = "What the grid says of each row"
    return Table(caption=caption, columns=columns, rows=tuple(lines))
