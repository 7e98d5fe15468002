"""Tables of one net row beside its checks: support, guideline, what would flip."""

from __future__ import annotations

from netdesign.report.view.table import (
    Cell,
    Table,
    given_cell,
    name_columns,
    number_cell,
    number_column,
    share_cell,
    text_column,
    word_cell,
)
from netdesign.report.words import (
    MISSING,
    VERDICTS,
    name_case,
    name_check,
    name_member,
    show_band,
    show_quantity,
    show_with_unit,
)
from netdesign.study.records import (
    ChangeRecord,
    CheckRecord,
    GuidelineCase,
    RowStudy,
    SpreadRecord,
)

_LAWS = {
    "global_balance": "Force missing from the global balance, over the weight",
    "end_direction": "Sine of the angle between an end's pull and the net there",
    "friction_excess": "Shear on the net beyond the friction limit, over the weight",
    "capstan_ratio": "Largest over smallest tension of the net; the limit is what "
    "friction can hold around its curve",
    "tension_share": "Smallest over largest tension of the net, which does not push",
    "head_balance": "Sum of the forces on the post head, over the largest",
}
_FORCES = ("force_x_kN", "force_y_kN", "lateral_kN", "size_kN", "direction_deg")
_GUIDELINE = (
    "height_vertical_m",
    "creep_factor",
    "glide_factor",
    "rigid_kN_per_m",
    "load_kN_per_m",
    "foot_anchor_kN",
    "uphill_guy_kN",
    "post_kN",
    "load_difference_percent",
    "foot_difference_percent",
)


def build_anchors(row: RowStudy) -> Table:
    """Force on the ground at every anchor in the drawn case, with its direction."""
    return Table(
        caption="Characteristic force on the ground, each support inside the row, in "
        "the drawn case; direction from downslope (0°) over out of the ground (90°) to "
        "upslope (180°), negative into the ground",
        columns=(
            text_column("Anchor"),
            text_column("Member"),
            *(number_column(key) for key in _FORCES),
        ),
        rows=tuple(
            (
                word_cell(name_member(anchor.anchor)),
                word_cell(
                    name_member(anchor.member)
                    if anchor.size_kN
                    else f"{name_member(anchor.member)}, slack"
                ),
                *(number_cell(key, getattr(anchor, key)) for key in _FORCES),
            )
            for anchor in row.anchors
        ),
        empty="none: no case of this row converged",
    )


def build_head(row: RowStudy) -> Table:
    """Forces on the post head in the drawn case, which sum up to zero."""
    return Table(
        caption="Forces on the post head in the drawn case: they close",
        columns=(
            text_column("From"),
            number_column("force_x_kN"),
            number_column("force_y_kN"),
        ),
        rows=tuple(
            (
                word_cell(name_member(force.member)),
                number_cell("force_x_kN", force.x_kN),
                number_cell("force_y_kN", force.y_kN),
            )
            for force in row.head
        ),
        empty="none: no case of this row converged",
    )


def build_guideline(row: RowStudy) -> Table:
    """Guideline's load and forces beside those of the coupled solve."""
    record = row.guideline
    columns = (
        text_column("Load case"),
        number_column("density_kg_m3"),
        *(number_column(key) for key in _GUIDELINE),
    )
    caption = "Independent check by the guideline, characteristic, inside the row"
    empty = "none: no case of this row converged"
    if record is None:
        return Table(caption=caption, columns=columns, rows=(), empty=empty)
    solved = (
        word_cell(f"Coupled solve: {name_case(record.case)}"),
        given_cell(record.case.density_kg_m3),
        *(
            number_cell(
                key,
                {
                    "load_kN_per_m": record.solved_load_kN_per_m,
                    "foot_anchor_kN": record.solved_foot_anchor_kN,
                }.get(key),
            )
            for key in _GUIDELINE
        ),
    )
    cases = tuple(
        (
            word_cell(_name_load_case(case)),
            number_cell("density_kg_m3", case.density_kg_m3),
            *(number_cell(key, getattr(case, key)) for key in _GUIDELINE),
        )
        for case in record.cases
    )
    return Table(caption=caption, columns=columns, rows=(solved, *cases), empty=empty)


def _name_load_case(case: GuidelineCase) -> str:
    name = case.name.replace("_", " ")
    return f"{name}: {case.reason}" if case.reason else name


def build_spreads(check: CheckRecord | None) -> Table:
    """Uncertainty budget of one check: its parts as utilisation, kN and per cent."""
    spreads = check.spreads if check else []
    title = f": {name_check(check)}" if check else ""
    return Table(
        caption=f"Where the interval of the utilisation comes from{title}",
        columns=(
            *name_columns(("Part", "Utilisation"), numbers=("Utilisation",)),
            number_column("demand_kN", "Demand, low [kN]"),
            number_column("demand_kN", "Demand, high [kN]"),
            number_column("change_percent", "Below [%]"),
            number_column("change_percent", "Above [%]"),
            *name_columns(("In the verdict", "Remark"), numbers=()),
        ),
        rows=tuple(_spread_row(check, spread) for spread in spreads) if check else (),
        empty="none: no check of this row has a utilisation",
    )


def _spread_row(check: CheckRecord, spread: SpreadRecord) -> tuple[Cell, ...]:
    ends = (spread.low, spread.high)
    used, resistance = check.utilisation, check.resistance_kN
    demands = [_scale(end, resistance) for end in ends]
    changes = [_compare(end, used) for end in ends]
    return (
        word_cell(str(spread.source)),
        word_cell(show_band("utilisation", *ends)),
        *(number_cell("demand_kN", demand) for demand in demands),
        *(number_cell("change_percent", change) for change in changes),
        word_cell("yes" if spread.in_verdict else "no, for comparison"),
        word_cell(str(spread.note or "")),
    )


def _scale(value: float | None, scale: float | None) -> float | None:
    return None if value is None or scale is None else value * scale


def _compare(value: float | None, base: float | None) -> float | None:
    return 100.0 * (value / base - 1.0) if value is not None and base else None


def build_independent(row: RowStudy) -> Table:
    """Laws that the drawn case must obey whatever the mesh."""
    headings = ("Check", "Value", "Limit", "Met")
    return Table(
        caption="Independent of the mesh, in the drawn case",
        columns=name_columns(headings, numbers=("Value", "Limit")),
        rows=tuple(
            (
                word_cell(_LAWS.get(one.name, one.name)),
                share_cell(one.value),
                share_cell(one.limit),
                word_cell("yes" if one.is_met else "NO"),
            )
            for one in row.independent
        ),
        empty="none: the study holds none for this row",
    )


def build_changes(row: RowStudy) -> Table:
    """What would make failing or unproven checks pass, and close ones fail."""
    headings = ("Check", "Verdict", "Passes with", "Now", "Solves", "Remark")
    return Table(
        caption="What would flip the checks: each change alone, all else as it is",
        columns=name_columns(headings, numbers=("Now", "Solves")),
        rows=tuple(
            (
                word_cell(name_check(check)),
                word_cell(VERDICTS[check.verdict].word),
                word_cell(describe_change(change)),
                Cell(text=_show(change.now, change.unit), number=None),
                given_cell(change.solves),
                word_cell(str(change.note or "")),
            )
            for check in row.checks
            for change in check.changes
        ),
        empty="none: no check of this row fails, is unproven or is close to its limit",
    )


def list_flips(check: CheckRecord | None) -> tuple[str, ...]:
    """Changes that flip one check, in short; none where no change alone does."""
    changes = check.changes if check else []
    return tuple(describe_flip(c) for c in changes if c.bound is not None)


def describe_flip(change: ChangeRecord) -> str:
    """One change and today's value: ``post spacing at most 1.42 m, now 4 m``."""
    text = describe_change(change)
    if change.now is None:
        return text
    return f"{text}, now {_show(change.now, change.unit)}"


def describe_change(change: ChangeRecord) -> str:
    """One change in words: ``snow density at most 219 kg/m3``."""
    if change.bound is None:
        return f"{change.quantity}: none"
    return f"{change.quantity} {change.sense} {_show(change.bound, change.unit)}"


def _show(value: float | None, unit: str) -> str:
    """Bounds are rounded to the side that passes when they are found."""
    return MISSING if value is None else show_quantity(value, unit)


def describe_widths(check: CheckRecord) -> tuple[tuple[str, str, str], ...]:
    """Steps from the solved force to the characteristic action of a support."""
    action = check.action
    if action is None:
        return ()
    steps = []
    if action.position == "edge":
        steps.append(
            (
                "b_e = b / 2 + f_R · Δl",
                f"{show_with_unit('post_spacing_m', action.post_spacing_m)} / 2 + "
                f"{show_with_unit('end_factor', action.end_factor)} · "
                f"{show_with_unit('end_length_m', action.end_length_m)}",
                show_with_unit("loaded_width_m", action.loaded_width_m),
            )
        )
    steps.append(
        (
            "E_k = E_s · b_e / b · k_q",
            f"{show_with_unit('solved_kN', action.solved_kN)} · "
            f"{show_with_unit('loaded_width_m', action.loaded_width_m)} / "
            f"{show_with_unit('post_spacing_m', action.post_spacing_m)} · "
            f"{show_with_unit('lateral_factor', action.lateral_factor)}",
            show_with_unit("action_kN", check.action_kN),
        )
    )
    return tuple(steps)
