"""Support of one solved scene in words: both sets of forces, ropes, the row's end.

All numbers come from part ``support`` of the solution document.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from netdesign.report.blocks import (
    Block,
    Cell,
    Column,
    Part,
    Table,
    notes,
    number_cell,
    number_column,
    section,
    text_cell,
)
from netdesign.report.words import Words, show_member
from netdesign.structure.members import SOLVED_MEMBERS, Member

_PARTS: Mapping[str, str] = {
    "x": "support_view.x",
    "y": "support_view.y",
    "z": "support_view.z",
    "size": "support_view.size",
}
_PULLS: Mapping[tuple[str, str], str] = {
    ("plain", "foot_kN"): "support_view.foot_by_section",
    ("plain", "head_kN"): "support_view.head_by_section",
    ("panel", "foot_kN"): "support_view.foot_by_panel",
    ("panel", "mid_foot_kN"): "support_view.mid_foot_by_panel",
    ("panel", "head_kN"): "support_view.head_by_panel",
    ("row_end", "foot_kN"): "support_view.end_foot",
}


def show_support(support: Mapping[str, Any], words: Words) -> Part:
    """Section with the support of a solution document, and what it is worth."""
    tables = [_build_forces, _build_vectors] if support["plain"] else []
    blocks: list[Block] = [build(support, words).shown("study") for build in tables]
    if support["plain"] and support["panel"]:
        blocks.append(_build_ropes(support["panel"], words).shown("study"))
    sentences = (
        *_describe_lack(support, words),
        *_describe_panel(support, words),
        *_describe_end(support["row_end"], words),
    )
    if sentences:
        blocks.append(notes(*sentences))
    return section("support", words("support_view.title"), *blocks)


def list_shown(support: Mapping[str, Any]) -> list[str]:
    """Members whose forces are shown: a post's foot only where the post pulls."""
    sets = (support["plain"], support["panel"])
    is_lifted = any(find_force(one, Member.POST_FOOT) for one in sets)
    return [one for one in SOLVED_MEMBERS if is_lifted or one != Member.POST_FOOT]


def find_force(forces: Mapping[str, Any] | None, member: str) -> float | None:
    """Force of a member within one of the two sets [kN]; None without it."""
    value: float | None = forces.get(f"{member}_kN") if forces else None
    return value


def _build_forces(support: Mapping[str, Any], words: Words) -> Table:
    """Both sets side by side, each with its numerical error."""
    sets = (support["plain"], support["panel"])
    return Table(
        caption=words("support_view.forces"),
        columns=(
            Column(heading=words("heading.member")),
            number_column("max_kN", words("panel_view.by_section")),
            number_column("max_kN", words("support_view.error")),
            number_column("max_kN", words("panel_view.by_panel")),
            number_column("max_kN", words("support_view.error")),
            number_column("", words("panel_view.ratio")),
        ),
        rows=tuple(_list_forces(sets, one, words) for one in list_shown(support)),
    )


def _list_forces(
    sets: tuple[Mapping[str, Any] | None, ...], member: str, words: Words
) -> tuple[Cell, ...]:
    section, panel = (find_force(one, member) for one in sets)
    errors = [one["error_kN"][member] if one else None for one in sets]
    ratio = panel / section if section and panel is not None else None
    return (
        text_cell(show_member(words, member)),
        number_cell(words, "max_kN", section),
        number_cell(words, "max_kN", errors[0]),
        number_cell(words, "max_kN", panel),
        number_cell(words, "max_kN", errors[1]),
        Cell(text=words.show_share(ratio), number=ratio),
    )


def _build_vectors(support: Mapping[str, Any], words: Words) -> Table:
    """Pulls on foot and head of a support, and on the foot at the row's end."""
    named = [
        (key, support[part][name])
        for (part, name), key in _PULLS.items()
        if support[part] and name in support[part]
    ]
    return Table(
        caption=words("support_view.vectors"),
        columns=(
            Column(heading=words("support_view.pull")),
            *(number_column("max_kN", words(key)) for key in _PARTS.values()),
        ),
        rows=tuple(
            (
                text_cell(words(key)),
                *(number_cell(words, "max_kN", force.get(part)) for part in _PARTS),
            )
            for key, force in named
        ),
        empty=words("show.none"),
    )


def _build_ropes(panel: Mapping[str, Any], words: Words) -> Table:
    return Table(
        caption=words("support_view.ropes"),
        columns=(
            Column(heading=words("panel_view.rope")),
            number_column("along_kN", words("panel_view.along")),
            number_column("tension_kN", words("panel_view.tension")),
        ),
        rows=tuple(
            (
                text_cell(words(f"panel_view.{name}")),
                number_cell(words, "along_kN", panel[f"{name}_rope"]["H_kN"]),
                number_cell(words, "tension_kN", panel[f"{name}_rope"]["T_kN"]),
            )
            for name in ("lower", "upper")
        ),
    )


def _describe_lack(support: Mapping[str, Any], words: Words) -> list[str]:
    if "reason" not in support:
        return []
    return [words("support_view.lack", reason=support["reason"])]


def _describe_panel(support: Mapping[str, Any], words: Words) -> list[str]:
    """Reason of the larger guy, heights in mid-panel, worth of the ropes."""
    plain, panel = support["plain"], support["panel"]
    if not plain or not panel:
        return []
    foot = panel["foot_kN"]["x"] + panel.get("mid_foot_kN", {"x": 0.0})["x"]
    return [
        words(
            "panel_view.why",
            foot=words.show_with_unit("force_x_kN", foot),
            section_foot=words.show_with_unit("force_x_kN", plain["foot_kN"]["x"]),
            head=words.show_with_unit("force_x_kN", panel["head_kN"]["x"]),
            section_head=words.show_with_unit("force_x_kN", plain["head_kN"]["x"]),
        ),
        words(
            "support_view.heights",
            drop=words.show_with_unit("sag_m", panel["mid_head_drop_m"]),
            lift=words.show_with_unit("sag_m", panel["foot_lift_m"]),
        ),
        words("panel_view.ropes_worth"),
        words("panel_view.not_treated"),
    ]


def _describe_end(end: Mapping[str, Any] | None, words: Words) -> list[str]:
    if not end:
        return []
    told = words(
        "support_view.end",
        foot=words.show_with_unit("size_kN", end["foot_kN"]["size"]),
        along=words.show_with_unit("along_kN", end["foot_kN"]["z"]),
        head=words.show_with_unit("along_kN", end["head_along_kN"]),
    )
    if end["end_guy_kN"] is None:
        return [told, words("support_view.no_guy")]
    guy = words(
        "support_view.guy",
        guy=words.show_with_unit("size_kN", end["end_guy_kN"]),
        post=words.show_with_unit("size_kN", end["post_kN"]),
    )
    return [told, guy]
