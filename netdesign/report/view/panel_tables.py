"""The panel between two posts in words: both sets of forces, ropes, ends, limits."""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.report.blocks.table import (
    Cell,
    Table,
    given_cell,
    number_cell,
    number_column,
    share_cell,
    text_cell,
    text_column,
)
from netdesign.report.words import Words, show_member
from netdesign.structure.members import REPORTED_MEMBERS, name_in_panel
from netdesign.study.case_records import ExtremeRecord
from netdesign.study.records import CheckRecord, RowStudy
from netdesign.study.support_records import PanelRecord, RopeRecord

_ROPE_NAMES = {"lower": "panel_view.lower", "upper": "panel_view.upper"}


@dataclass(frozen=True, slots=True, kw_only=True)
class PanelView:
    """Panel of a row: two tables, and what the figures are worth."""

    forces: Table
    ropes: Table
    sentences: tuple[str, ...]


def view_panel(row: RowStudy, words: Words) -> PanelView | None:
    """Panel of a row in words; None of a row without one."""
    panel = row.panel
    if panel is None:
        return None
    return PanelView(
        forces=_build_forces(row, panel, words),
        ropes=_build_ropes(panel, words),
        sentences=(
            *_tell_assumed(panel, words),
            *_tell_guy(panel, words),
            *_tell_heights(panel, words),
            *_tell_end(row, panel, words),
            words("panel_view.ropes_worth"),
            words("panel_view.not_treated"),
        ),
    )


def _tell_assumed(panel: PanelRecord, words: Words) -> list[str]:
    """Sentence on what is assumed of the panel; none where all is given."""
    if not panel.assumed:
        return []
    return [words("panel.assumed", names=tuple(map(words.show, panel.assumed)))]


def _build_forces(row: RowStudy, panel: PanelRecord, words: Words) -> Table:
    """Largest forces of both sets, side by side."""
    by_section = {one.quantity: one for one in row.extremes}
    by_panel = {one.quantity: one for one in panel.extremes}
    return Table(
        caption=words("panel_view.forces"),
        columns=(
            text_column(words("heading.member")),
            number_column("max_kN", words("panel_view.by_section")),
            number_column("max_kN", words("panel_view.by_panel")),
            number_column("", words("panel_view.ratio")),
        ),
        rows=tuple(
            _list_forces(
                words,
                by_section.get(member),
                by_panel.get(name_in_panel(member)),
                member,
            )
            for member in REPORTED_MEMBERS
        ),
        empty=words("show.none"),
    )


def _list_forces(
    words: Words,
    section: ExtremeRecord | None,
    panel: ExtremeRecord | None,
    member: str,
) -> tuple[Cell, ...]:
    first, second = (one.max_kN if one else None for one in (section, panel))
    ratio = second / first if first and second is not None else None
    return (
        text_cell(show_member(words, member)),
        number_cell(words, "max_kN", first),
        number_cell(words, "max_kN", second),
        share_cell(words, ratio),
    )


def _build_ropes(panel: PanelRecord, words: Words) -> Table:
    """Both ropes: what each is, carries at most, and bears."""
    return Table(
        caption=words("panel_view.ropes"),
        columns=(
            text_column(words("panel_view.rope")),
            text_column(words("panel_view.type")),
            number_column("", words("panel_view.stiffness")),
            number_column("", words("panel_view.sag")),
            number_column("along_kN", words("panel_view.along")),
            number_column("tension_kN", words("panel_view.tension")),
            number_column("breaking_kN", words("panel_view.breaking")),
            number_column("", words("panel_view.share")),
        ),
        rows=tuple(_list_rope(one, words) for one in panel.ropes),
        empty=words("show.none"),
    )


def _list_rope(rope: RopeRecord, words: Words) -> tuple[Cell, ...]:
    share = None
    if rope.tension_kN is not None and rope.breaking_kN:
        share = rope.tension_kN / rope.breaking_kN
    return (
        text_cell(name_rope(rope, words)),
        text_cell(rope.type),
        given_cell(words, rope.stiffness_kN),
        given_cell(words, rope.sag),
        number_cell(words, "along_kN", rope.along_kN),
        number_cell(words, "tension_kN", rope.tension_kN),
        number_cell(words, "breaking_kN", rope.breaking_kN),
        share_cell(words, share),
    )


def name_rope(rope: RopeRecord, words: Words) -> str:
    """Name of a rope; what it is called in the record where that is no rope of ours."""
    key = _ROPE_NAMES.get(rope.rope)
    return words(key) if key else rope.rope


def _tell_guy(panel: PanelRecord, words: Words) -> list[str]:
    """Cause of the larger uphill guy, with what both sets have in the drawn case."""
    drawn = panel.drawing
    if drawn is None:
        return [words("panel_view.no_drawing")] if panel.failed else []
    foot, before = drawn.foot_kN[0], drawn.section_foot_kN[0]
    head, beside = drawn.head_kN[0], drawn.section_head_kN[0]
    return [
        words(
            "panel_view.why",
            foot=words.show_with_unit("force_x_kN", foot + drawn.mid_foot_kN[0]),
            section_foot=words.show_with_unit("force_x_kN", before),
            head=words.show_with_unit("force_x_kN", head),
            section_head=words.show_with_unit("force_x_kN", beside),
        )
    ]


def _tell_heights(panel: PanelRecord, words: Words) -> list[str]:
    if panel.effective_height_m is None or panel.lift_m is None:
        return []
    return [
        words(
            "panel_view.heights",
            height=words.show_with_unit("snow_thickness_m", panel.effective_height_m),
            lift=words.show_with_unit("snow_thickness_m", panel.lift_m),
        )
    ]


def _tell_end(row: RowStudy, panel: PanelRecord, words: Words) -> list[str]:
    """Pulls along the row at its end, with the end effect on top."""
    end = next((one for one in row.checks if one.member == "lateral_anchor"), None)
    if end is None or not end.is_of_force:
        return []
    drawn = panel.drawing
    pulls = {rope.rope: rope.along_kN for rope in panel.ropes}
    return [
        words(
            "panel_view.end",
            lower=words.show_with_unit("along_kN", pulls.get("lower")),
            upper=words.show_with_unit("along_kN", pulls.get("upper")),
            factor=words.show_fixed(_find_end_factor(end), 2),
            half=words.show_with_unit(
                "size_kN", _halve(drawn.foot_kN) if drawn is not None else None
            ),
        )
    ]


def _find_end_factor(end: CheckRecord) -> float:
    """Factor of the end effect on a rope's pull, (P8) [-]."""
    rope, pull = end.read("T_r"), end.read("H")
    return pull / rope if rope and pull is not None else 1.0


def _halve(force: tuple[float, float]) -> float:
    return float((force[0] ** 2 + force[1] ** 2) ** 0.5) / 2.0
