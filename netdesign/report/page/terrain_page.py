"""Net rows on terrain -> page with maps, a table, and a profile of each row."""

from __future__ import annotations

import math
from collections.abc import Sequence

from netdesign.report.blocks import (
    Figure,
    Paragraph,
    Part,
    Table,
    fixed_cell,
    key_columns,
    masthead,
    notes,
    section,
    text_cell,
)
from netdesign.report.drawing.terrain_map import (
    draw_map,
    draw_profile,
    draw_slopes,
    extract_ground,
)
from netdesign.report.page.render import render_page
from netdesign.report.words import Words, show_text
from netdesign.terrain.coverage import Coverage
from netdesign.terrain.measure import MeasuredRow, describe_kinks, describe_steep_above
from netdesign.terrain.plan import Plan
from netdesign.terrain.surface import Surface
from netdesign.words.catalogue import Language
from netdesign.words.message import say

PAGE_FILE = "terrain.html"
_COLUMNS = (
    *("row", "slope", "band", "mean", "aspect", "altitude", "length", "posts"),
    *("upslope", "upslope_end", "below", "kinks"),
)

_TEXTS = ("row", "upslope_end", "below", "kinks")
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
    language: Language,
) -> bytes:
    """Page of rows on terrain.

    Parameters
    ----------
    surface, plan, rows, coverage
        What was measured.
    grid : tuple of str
        Name of the grid's file, and its SHA-256.
    language : str
        Of the page.
    """
    words = Words(language)
    extract = extract_ground(surface, plan)
    first = _describe_grid(surface, coverage, grid, words)
    told = (
        find(row) for row in rows for find in (describe_kinks, describe_steep_above)
    )
    kinks = [words.show(one) for one in told if one]
    maps = (
        Figure(
            svg=draw_map(extract, plan, rows, coverage, words),
            caption=words("terrain_page.map_caption"),
            look="plate",
        ),
        Figure(
            svg=draw_slopes(extract, rows, words),
            caption=words("terrain_page.slopes_caption"),
            look="plate",
        ),
    )
    blocks = (
        masthead("netdesign terrain", words("terrain_page.title")),
        Part(id="grid", blocks=(*(Paragraph(text=one) for one in first),)),
        section("map", words("terrain_page.map"), *maps),
        section(
            "rows",
            words("terrain_page.rows"),
            _tabulate(rows, words).shown("study"),
            *([notes(*kinks, look="notes open")] if kinks else []),
        ),
        section(
            "profiles",
            words("terrain_page.profiles"),
            *(
                Figure(
                    svg=draw_profile(row, words),
                    caption=words("terrain_page.profile", row=row.line.id),
                    look="plate",
                )
                for row in rows
            ),
        ),
    )
    title = words("terrain_page.title")
    return render_page(blocks, title, language, style=_STYLE).encode()


def _describe_grid(
    surface: Surface, coverage: Coverage, grid: tuple[str, str], words: Words
) -> list[str]:
    """Sentences on the grid, its fit, and the coverage of the starting zones."""
    name, sha256 = grid
    first = [
        words("terrain_page.grid", file=show_text(name), sha256=sha256),
        words(
            "terrain_page.fit",
            noise=surface.noise,
            window=surface.window,
            cell=surface.grid.cell,
        ),
    ]
    if coverage.area:
        told = say(
            "terrain.coverage",
            area=coverage.area,
            uncovered=coverage.uncovered,
            share=100.0 * coverage.share,
        )
        first.append(words.show(told))
    return first


def _tabulate(rows: Sequence[MeasuredRow], words: Words) -> Table:
    lines = []
    for row in rows:
        slope = row.slope
        below = row.below_length
        ends = (f"{math.degrees(one):.1f}" for one in (slope.low, slope.high))
        lines.append(
            (
                text_cell(row.line.id),
                fixed_cell(words, math.degrees(slope.value), 1),
                text_cell(words.write("–".join(ends))),
                fixed_cell(words, math.degrees(float(row.slopes.mean())), 1),
                fixed_cell(words, math.degrees(row.aspect), 0),
                fixed_cell(words, float(row.posts[:, 2].max()), 0),
                fixed_cell(words, row.length, 1),
                fixed_cell(words, len(row.posts), 0),
                fixed_cell(words, row.upslope.length.value, 1),
                text_cell(words(f"terrain.end_{row.upslope.end}", row=row.upslope.row)),
                text_cell(
                    f"{row.below_row}, {words.write(f'{below:.1f}')}"
                    if below is not None
                    else "-"
                ),
                text_cell(", ".join(map(str, row.kinks)) or "-"),
            )
        )
    numbers = [one for one in _COLUMNS if one not in _TEXTS]
    return Table(
        caption=words("terrain_page.rows_caption"),
        columns=key_columns(words, "terrain_page.column_", _COLUMNS, numbers=numbers),
        rows=tuple(lines),
    )
