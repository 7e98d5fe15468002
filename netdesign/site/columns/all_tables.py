"""The site workbook as one table: sheets, headings, units, bounds, defaults.

What a column is: ``columns.toml``. Names of sheets and columns stand in
``netdesign/words``; notes and other headings in ``words/*.toml`` and ``synonyms``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from netdesign.site.columns.columns_file import load_data, read_plan
from netdesign.site.columns.fields import Field, SheetPlan
from netdesign.words.catalogue import LANGUAGES, Language, render
from netdesign.words.message import say

PROJECT = read_plan(load_data(), "Project")
NETS = read_plan(load_data(), "Nets")
# As offices type it, also with both ends in one cell; the template does not offer that.
RANGES_AS_TYPED = read_plan(load_data(), "Ranges")
RANGES = replace(
    RANGES_AS_TYPED,
    fields=tuple(one for one in RANGES_AS_TYPED.fields if one.is_offered),
)
# Layers by net row, one a line; a row without lines here is of uniform snow.
SNOW = read_plan(load_data(), "Snow")
# The keys of the resistances are the modes of `model.MEMBER_MODES`.
ANCHORS = read_plan(load_data(), "Anchors")
ROPES = read_plan(load_data(), "Ropes")
POSTS = read_plan(load_data(), "Posts")
# Types of the first and last support of a row, where they are not those of the others.
ENDS = read_plan(load_data(), "Ends")
# Measurements, one a line, to stand beside a history; nothing is checked with them.
MONITORING = read_plan(load_data(), "Monitoring")
# Checks that somebody has proven elsewhere, one a line.
DECLARED = read_plan(load_data(), "Declared")
# A station's snow heights, one day a line.
WINTER = read_plan(load_data(), "Winter")

SHEETS: tuple[SheetPlan, ...] = (
    *(PROJECT, NETS, RANGES, SNOW, ANCHORS, ROPES, POSTS, ENDS),
    *(MONITORING, DECLARED, WINTER),
)
PROJECT_ITEMS = PROJECT.items
RANGE_QUANTITIES = RANGES.items
# What else may range: then no line of sheet Nets gives it. Keys are those of
# `envelope.parameters.PARAMETERS`.
FURTHER_QUANTITIES: tuple[Field, ...] = tuple(
    one for one in RANGE_QUANTITIES if one.column
)
USUAL_QUANTITIES: tuple[Field, ...] = tuple(
    one for one in RANGE_QUANTITIES if not one.column
)
# The sheet that an annotated copy lists its findings on, by language.
FINDINGS_SHEETS: Mapping[Language, str] = {
    language: render(say("annotated.findings_sheet"), language)
    for language in LANGUAGES
}
# Sheets of the program's own that hold nothing to read.
QUIET_SHEETS: tuple[str, ...] = (
    *("Notes", "Notice", "Hinweise"),
    *FINDINGS_SHEETS.values(),
)
