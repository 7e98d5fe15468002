"""Tables of one net row beside its checks: support, guideline, what would flip."""

from __future__ import annotations

from netdesign.outcome import Verdict
from netdesign.report.blocks.table import (
    Cell,
    Table,
    given_cell,
    name_columns,
    number_cell,
    number_column,
    quantity_column,
    share_cell,
    text_cell,
    text_column,
)
from netdesign.report.words import (
    MISSING,
    Words,
    add_unit,
    name_choice,
    show_check,
    show_member,
    show_text,
)
from netdesign.study.flips import CLOSE
from netdesign.study.guideline_records import GuidelineCase
from netdesign.study.records import ChangeRecord, CheckRecord, RowStudy, SpreadRecord
from netdesign.study.support_records import AnchorRecord, PullRecord
from netdesign.words.names import name

_FORCES = ("force_x_kN", "force_y_kN", "lateral_kN", "size_kN", "direction_deg")
_PULLS = ("least_deg", "largest_deg", "axis_deg", "angle_deg")
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


def build_anchors(row: RowStudy, words: Words) -> Table:
    """Force on the ground at every anchor in the drawn case, with its direction."""
    return Table(
        caption=words("caption.anchors"),
        columns=(
            text_column(words("heading.anchor")),
            text_column(words("heading.member")),
            *(quantity_column(words, key) for key in _FORCES),
        ),
        rows=tuple(
            (
                text_cell(show_member(words, anchor.anchor)),
                text_cell(_name_bringer(anchor, words)),
                *(number_cell(words, key, getattr(anchor, key)) for key in _FORCES),
            )
            for anchor in row.anchors
        ),
        empty=words("heading.no_case_converged"),
    )


def _name_bringer(anchor: AnchorRecord, words: Words) -> str:
    """Member that brings a force, and whether it is slack."""
    member = show_member(words, anchor.member)
    return member if anchor.size_kN else words("show.slack", member=member)


def build_pulls(row: RowStudy, words: Words) -> Table:
    """Directions of the pulls on each anchor over all solved cases, and its axis."""
    return Table(
        caption=words("caption.pulls"),
        columns=(
            text_column(words("heading.anchor")),
            text_column(words("heading.kind_of_anchor")),
            *(quantity_column(words, key) for key in _PULLS),
            text_column(words("heading.axis_from")),
        ),
        rows=tuple(
            (
                text_cell(show_member(words, pull.anchor)),
                text_cell(_name_kind(pull, words)),
                *(number_cell(words, key, getattr(pull, key)) for key in _PULLS),
                text_cell(
                    words("show.axis_given" if pull.is_axis_given else "show.axis_mean")
                ),
            )
            for pull in row.pulls
        ),
        empty=words("heading.no_case_converged"),
    )


def _name_kind(pull: PullRecord, words: Words) -> str:
    if not pull.kind:
        return MISSING
    choice = name_choice("kind", pull.kind)
    return words.show(choice) if choice else show_text(pull.kind)


def build_head(row: RowStudy, words: Words) -> Table:
    """Forces on the post head in the drawn case, which sum up to zero."""
    return Table(
        caption=words("caption.head"),
        columns=(
            text_column(words("heading.from")),
            quantity_column(words, "force_x_kN"),
            quantity_column(words, "force_y_kN"),
        ),
        rows=tuple(
            (
                text_cell(show_member(words, force.member)),
                number_cell(words, "force_x_kN", force.x_kN),
                number_cell(words, "force_y_kN", force.y_kN),
            )
            for force in row.head
        ),
        empty=words("heading.no_case_converged"),
    )


def build_guideline(row: RowStudy, words: Words) -> Table:
    """Guideline's load and forces beside those of the coupled solve."""
    record = row.guideline
    columns = (
        text_column(words("heading.load_case")),
        quantity_column(words, "density_kg_m3"),
        *(quantity_column(words, key) for key in _GUIDELINE),
    )
    caption = words("caption.guideline")
    empty = words("heading.no_case_converged")
    if record is None:
        return Table(caption=caption, columns=columns, rows=(), empty=empty)
    solved = (
        text_cell(words("show.coupled_solve", case=words.name_case(record.case))),
        number_cell(words, "density_kg_m3", record.case.density_kg_m3),
        *(
            number_cell(
                words,
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
            text_cell(_name_load_case(case, words)),
            number_cell(words, "density_kg_m3", case.density_kg_m3),
            *(number_cell(words, key, getattr(case, key)) for key in _GUIDELINE),
        )
        for case in record.cases
    )
    return Table(caption=caption, columns=columns, rows=(solved, *cases), empty=empty)


def _name_load_case(case: GuidelineCase, words: Words) -> str:
    named = words.show(name("load_case", case.name))
    if case.reason is None:
        return named
    return words("show.explained", what=named, reason=words.show(case.reason))


def build_spreads(check: CheckRecord | None, words: Words) -> Table:
    """Uncertainty budget of one check: its parts as utilisation, kN and per cent."""
    spreads = check.spreads if check else []
    caption = words("caption.spreads")
    if check:
        caption = words("caption.spreads_of", check=show_check(words, check))

    def head(key: str, unit: str = "") -> str:
        return add_unit(words(f"heading.{key}"), unit)

    ratio = head("utilisation")
    return Table(
        caption=caption,
        columns=(
            *name_columns((head("part"), ratio), numbers=(ratio,)),
            number_column("demand_kN", head("demand_low", "kN")),
            number_column("demand_kN", head("demand_high", "kN")),
            number_column("change_percent", head("below", "%")),
            number_column("change_percent", head("above", "%")),
            *name_columns((head("in_the_verdict"), head("remark")), numbers=()),
        ),
        rows=tuple(_spread_row(check, spread, words) for spread in spreads)
        if check
        else (),
        empty=words("heading.no_utilisation"),
    )


def _spread_row(
    check: CheckRecord, spread: SpreadRecord, words: Words
) -> tuple[Cell, ...]:
    ends = (spread.low, spread.high)
    used, resistance = check.utilisation, check.resistance_kN
    demands = [_scale(end, resistance) for end in ends]
    changes = [_compare(end, used) for end in ends]
    return (
        text_cell(words.show(spread.source)),
        text_cell(words.show_band("utilisation", *ends)),
        *(number_cell(words, "demand_kN", demand) for demand in demands),
        *(number_cell(words, "change_percent", change) for change in changes),
        text_cell(words("show.yes" if spread.in_verdict else "show.for_comparison")),
        text_cell(words.show(spread.note)),
    )


def _scale(value: float | None, scale: float | None) -> float | None:
    return None if value is None or scale is None else value * scale


def _compare(value: float | None, base: float | None) -> float | None:
    return 100.0 * (value / base - 1.0) if value is not None and base else None


def build_independent(row: RowStudy, words: Words) -> Table:
    """Laws that the drawn case must obey whatever the mesh."""
    headings = [words(f"heading.{key}") for key in ("check", "value", "limit", "met")]
    return Table(
        caption=words("caption.independent"),
        columns=name_columns(headings, numbers=headings[1:3]),
        rows=tuple(
            (
                text_cell(words.show(name("law", one.name))),
                share_cell(words, one.value),
                share_cell(words, one.limit),
                text_cell(words("show.yes" if one.is_met else "show.no")),
            )
            for one in row.independent
        ),
        empty=words("heading.no_laws"),
    )


def build_changes(row: RowStudy, words: Words) -> Table:
    """Changes that would make failing or unproven checks pass, and close ones fail."""
    keys = ("check", "verdict", "passes_with", "now", "solves", "remark")
    headings = [words(f"heading.{key}") for key in keys]
    return Table(
        caption=words("caption.changes"),
        columns=name_columns(headings, numbers=headings[3:5]),
        rows=tuple(
            (
                text_cell(show_check(words, check)),
                text_cell(words(f"verdict.{check.verdict}")),
                text_cell(describe_change(change, words)),
                Cell(text=_show(change.now, change.unit, words), number=None),
                given_cell(words, change.solves),
                text_cell(words.show(change.note)),
            )
            for check in row.checks
            for change in check.changes
        ),
        empty=words(
            "heading.no_change_needed"
            if all(map(is_far_from_limit, row.checks))
            else "heading.no_change_alone"
        ),
    )


def is_far_from_limit(check: CheckRecord) -> bool:
    """True of a check that passes, and is told no change that would turn it."""
    _, used = check.utilisation_band
    return check.verdict is Verdict.PASS and (used is None or used < CLOSE)


def list_flips(check: CheckRecord | None, words: Words) -> tuple[str, ...]:
    """Changes that flip one check, in short; none where no change alone does."""
    changes = check.changes if check else []
    return tuple(describe_flip(c, words) for c in changes if c.bound is not None)


def describe_flip(change: ChangeRecord, words: Words) -> str:
    """One change and today's value: ``post spacing at most 1.42 m, now 4 m``."""
    text = describe_change(change, words)
    if change.now is None:
        return text
    now = round(change.now, 3) if change.unit == "m" else change.now  # cos of a slope
    return words("show.change_now", change=text, now=_show(now, change.unit, words))


_SENSES = {
    "at least": "show.change_at_least",
    "at most": "show.change_at_most",
    "has": "show.change_has",
}


def describe_change(change: ChangeRecord, words: Words) -> str:
    """One change in words: ``snow density at most 219 kg/m3``."""
    quantity = words.show(change.quantity)
    if change.bound is None:
        return words("show.change_none", quantity=quantity)
    bound = _show(change.bound, change.unit, words)
    return words(_SENSES[change.sense], quantity=quantity, bound=bound)


def _show(value: float | None, unit: str, words: Words) -> str:
    """Value with its unit; the search has rounded bounds to the side that passes."""
    return MISSING if value is None else words.show_quantity(value, unit)


_FLOOR = (
    "force_kN",
    "inclination_deg",
    "snow_thickness_m",
    "slack",
    "stiffness_kN_per_m",
    "density_kg_m3",
    "height_vertical_m",
    "creep_factor",
    "glide_factor",
    "load_along_kN_per_m",
    "load_across_kN_per_m",
    "chord_tension_kN_per_m",
)


def build_floor(row: RowStudy, words: Words) -> Table:
    """Largest forces by the guideline's load, with what each follows from."""
    floor = row.floor
    empty = words("floor.none")
    if floor is not None and floor.reason is not None:
        empty = words.show(floor.reason)
    assumed = "".join(f"; {words.show(one)}" for one in floor.assumed) if floor else ""
    return Table(
        caption=words("caption.floor") + assumed,
        columns=(
            text_column(words("heading.member")),
            text_column(words("heading.load_case")),
            *(quantity_column(words, key) for key in _FLOOR),
        ),
        rows=tuple(
            (
                text_cell(show_member(words, force.member)),
                text_cell(words.show(name("load_case_short", force.load_case))),
                *(number_cell(words, key, getattr(force, key)) for key in _FLOOR),
            )
            for force in (floor.forces if floor else ())
        ),
        empty=empty,
    )
