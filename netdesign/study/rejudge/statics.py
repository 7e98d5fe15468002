"""Statics of the governing states: members' forces from the net's pulls."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from netdesign.checks.schema import LATERAL_SHARE
from netdesign.outcome import Outcome
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.layout import SupportPoints
from netdesign.structure.members import (
    BROUGHT_BY,
    REPORTED_MEMBERS,
    Member,
    NetPart,
    RopeForce,
    name_in_panel,
)
from netdesign.study.case_records import CasePoint, CaseRecord
from netdesign.study.record_independent import (
    DIRECTION,
    DIRECTION_ERRORS,
    LIMITS,
    is_law_met,
)
from netdesign.study.record_support import list_arrows, record_anchors, record_head
from netdesign.study.records import (
    IndependentRecord,
    ProfileRecord,
    RowStudy,
    find_input,
)
from netdesign.study.rejudge.cases import (
    Pair,
    find_largest,
    list_solved,
    read_force,
    report_differences,
    report_unequal,
    report_value,
    same_point,
)
from netdesign.study.support_records import (
    AnchorRecord,
    Drawing,
    StaticsRecord,
)
from netdesign.units import newton_from_kilonewton
from netdesign.words.message import Message, say
from netdesign.words.names import name_member

_LAWS = ("global_balance", "friction_excess", "end_direction", "tension_share")
_END_SHARE = 0.005  # of the chord: the drawn points are rounded to a tenth of a mm
_BESIDE_NET = 0.15  # rad, over so short a piece of a net that sags


def rejudge_drawn(
    row: RowStudy, profile: ProfileRecord, *, is_steady: bool
) -> Iterator[Message]:
    """Sentences on what cannot be true of the drawn case of a row.

    Forces of a history are its largest ones, and need not be of one instant: then
    ``is_steady`` is false, and less is known.
    """
    place, drawing = say("audit.row", row=row.id), row.drawing
    parts = (row.anchors, row.head, row.independent)
    if drawing is None:
        if any(parts) or list_solved(row):
            yield say("audit.no_drawing", place=place)
        return
    drawn = next((one for one in row.cases if same_point(one.case, drawing.case)), None)
    if drawn is None or drawn.outcome is not Outcome.CONVERGED or not all(parts):
        yield say("audit.drawn_without_result", place=place)
        return
    if not same_point(drawing.case, _find_governing(row)):
        yield say("audit.other_drawn", place=place)
    share = next((v.value for v in profile.values if v.id == LATERAL_SHARE), 0.0)
    yield from _rejudge_support(place, row, drawing, share)
    if is_steady:
        yield from _rejudge_sizes(place, row.anchors, drawing, drawn)
    yield from _rejudge_ends(place, row, drawing)
    yield from _rejudge_laws(place, row, drawn, is_steady=is_steady)


def _find_governing(row: RowStudy) -> CasePoint | None:
    """Case that has to be drawn: of the largest utilisation, or of the foot's force."""
    rated = [one for one in row.checks if one.used is not None and one.case]
    if rated:
        return max(rated, key=lambda check: check.used or 0.0).case
    largest = find_largest(row, Member.FOOT_ANCHOR)
    return largest.case if largest else None


def _rejudge_support(
    place: Message, row: RowStudy, drawing: Drawing, share: float
) -> Iterator[Message]:
    """Forces on ground and head from the two pulls of the net, (S1) to (S6)."""
    foot, pull = row.anchors[0], row.head[0]
    points = SupportPoints(
        net_foot=(0.0, 0.0),
        head=drawing.head_m,
        post_base=drawing.post_base_m,
        uphill_anchor=drawing.uphill_anchor_m,
        downhill_anchor=drawing.downhill_anchor_m,
    )
    on_foot, on_head = (
        (newton_from_kilonewton(x), newton_from_kilonewton(y))
        for x, y in ((foot.force_x_kN, foot.force_y_kN), (pull.x_kN, pull.y_kN))
    )
    found = compute_anchor_forces(
        points, foot_pull_per_m=on_foot, head_pull_per_m=on_head, post_spacing=1.0
    )
    if not isinstance(found, AnchorForces):
        yield say("audit.not_held", place=place, reason=found.reason)
        return
    stored = {"anchors": row.anchors, "head": row.head, "arrows": drawing.arrows}
    again = {
        "anchors": record_anchors(found, share),
        "head": record_head(on_head, found),
        "arrows": list_arrows(points, found),
    }
    where = say("audit.drawn_case", place=place)
    yield from report_differences("audit.drawn_otherwise", stored, again, place=where)


def _rejudge_sizes(
    place: Message, anchors: list[AnchorRecord], drawing: Drawing, drawn: CaseRecord
) -> Iterator[Message]:
    """Forces on the ground against those of the case; one anchor may carry two."""
    if len(anchors) != len(BROUGHT_BY) or anchors[-1].force_y_kN > 0.0:
        return  # a post that pulls: its guys count as if its foot gave way
    foot, uphill, downhill, post = (one.size_kN for one in anchors)
    is_shared = drawing.uphill_anchor_m == (0.0, 0.0)
    sizes = (foot + uphill if is_shared else foot, uphill, downhill, post)
    yield from report_unequal(
        say("audit.drawn_case", place=place),
        [
            (m, s, read_force(drawn, m))
            for m, s in zip(REPORTED_MEMBERS, sizes, strict=True)
        ],
    )


def _rejudge_ends(place: Message, row: RowStudy, drawing: Drawing) -> Iterator[Message]:
    """A net pulls on its ends along itself, as far as its drawing shows that."""
    foot, pull = row.anchors[0], row.head[0]
    for name, points, force in (
        ("foot", drawing.net_m, (foot.force_x_kN, foot.force_y_kN)),
        ("head", drawing.net_m[::-1], (pull.x_kN, pull.y_kN)),
    ):
        angle = _find_angle(points, force)
        if angle is None or angle > _BESIDE_NET:
            yield say("audit.beside_net", place=place, end=name_member(name))


def _find_angle(
    points: Sequence[tuple[float, float]], force: tuple[float, float]
) -> float | None:
    """Angle between a force and the curve that leaves the first point [rad]."""
    (x0, y0), (x1, y1) = points[0], points[-1]
    least = _END_SHARE * math.hypot(x1 - x0, y1 - y0)
    for x, y in points[1:]:
        if math.hypot(x - x0, y - y0) >= least:
            turn = math.atan2(y - y0, x - x0) - math.atan2(force[1], force[0])
            return abs(math.remainder(turn, 2.0 * math.pi))
    return None


def _rejudge_laws(
    place: Message, row: RowStudy, drawn: CaseRecord, *, is_steady: bool
) -> Iterator[Message]:
    wanted = {*_LAWS, *(["capstan_ratio"] if is_steady else [])}
    wanted |= {"head_balance"} if len(row.head) > 1 else set()
    named = [law.name for law in row.independent]
    if len(set(named)) < len(named) or not wanted <= set(named):
        yield say(
            "audit.other_laws",
            place=place,
            named=tuple(named),
            wanted=tuple(sorted(wanted)),
        )
    for law in row.independent:
        where = say("audit.law", place=place, law=law.name)
        if law.is_met is not is_law_met(law.name, law.value, law.limit):
            yield report_value(where, "is_met", law.is_met, not law.is_met)
        yield from report_unequal(where, _list_law_pairs(law, row, drawn))


def _list_law_pairs(
    law: IndependentRecord, row: RowStudy, drawn: CaseRecord
) -> list[Pair]:
    """Pairs that a law's numbers must form, known without the solved case."""
    if law.name == "end_direction":
        errors = DIRECTION_ERRORS * (drawn.error_percent or 0.0) / 100.0
        return [("limit", law.limit, max(DIRECTION, errors))]
    if law.name not in LIMITS:
        return []
    pairs: list[Pair] = [("limit", law.limit, LIMITS[law.name])]
    if law.name == "global_balance":
        pairs.append(("value", law.value, drawn.balance_residual))
    if law.name == "head_balance":
        open_part = math.hypot(
            sum(one.x_kN for one in row.head), sum(one.y_kN for one in row.head)
        )
        largest = max(math.hypot(one.x_kN, one.y_kN) for one in row.head)
        pairs.append(("value", law.value, open_part / largest if largest else None))
    return pairs


def rejudge_statics(row: RowStudy) -> Iterator[Message]:
    """Sentences on states whose forces do not follow, or are not those of the checks.

    Of steady states only: the forces of a history need not be of one instant.
    """
    spacing = find_input(row, "post_spacing")  # as it was read [m]
    if spacing is None or not row.forces:
        return
    place = say("audit.row", row=row.id)
    for number, state in enumerate(row.statics):
        where = say("audit.statics", place=place, number=number)
        yield from report_unequal(where, _follow(state, spacing))
    yield from _rejudge_largest(place, row)
    yield from _rejudge_sideways(place, row, spacing)


def _follow(state: StaticsRecord, spacing: float) -> list[Pair]:
    """Stored forces beside those that follow from the pulls: (S1) to (S8)."""
    points = SupportPoints(
        net_foot=(0.0, 0.0),
        head=(state.head_x_m, state.head_y_m),
        post_base=(state.base_x_m, 0.0),
        uphill_anchor=(state.uphill_x_m, 0.0),
        downhill_anchor=(state.downhill_x_m, 0.0),
    )
    found = compute_anchor_forces(
        points,
        foot_pull_per_m=(state.foot_x_kN_per_m, state.foot_y_kN_per_m),
        head_pull_per_m=(state.head_x_kN_per_m, state.head_y_kN_per_m),
        post_spacing=spacing,
    )
    if not isinstance(found, AnchorForces):
        return [("post_kN", state.post_kN, None)]
    head = found.head
    return [
        ("foot_anchor_kN", state.foot_anchor_kN, found.foot_anchor.size),
        ("uphill_guy_kN", state.uphill_guy_kN, head.guy_demands[0]),
        ("downhill_guy_kN", state.downhill_guy_kN, head.guy_demands[1]),
        ("post_kN", state.post_kN, head.post_compression),
        ("post_base_kN", state.post_base_kN, max(-found.post_base.y, 0.0)),
        ("post_foot_kN", state.post_foot_kN, head.post_tension),
    ]


def read_state(state: StaticsRecord, member: str) -> float:
    """Force of a state in one member [kN]; one anchor of net and guy has both.

    NaN where the state is by the section and the force by the panel, or the other way.
    """
    by_panel = name_in_panel("")
    is_of_panel = member.startswith(by_panel)
    if is_of_panel is not state.is_by_panel:
        return math.nan
    member = member.removeprefix(by_panel)
    is_shared = state.uphill_x_m == 0.0
    if is_of_panel and member == Member.FOOT_ANCHOR:
        guy = state.uphill_guy_kN if is_shared else 0.0
        return max(state.foot_anchor_kN + guy, state.mid_foot_kN)
    if is_shared and member in (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR):
        return state.foot_anchor_kN + state.uphill_guy_kN
    forces: dict[str, float] = {
        Member.FOOT_ANCHOR: state.foot_anchor_kN,
        Member.UPHILL_GUY: state.uphill_guy_kN,
        Member.UPHILL_ANCHOR: state.uphill_guy_kN,
        Member.DOWNHILL_GUY: state.downhill_guy_kN,
        Member.DOWNHILL_ANCHOR: state.downhill_guy_kN,
        Member.POST: state.post_kN,
        Member.POST_BASE: state.post_base_kN,
        NetPart.MESH: max(  # under the guideline's load it is largest at an end
            math.hypot(state.foot_x_kN_per_m, state.foot_y_kN_per_m),
            math.hypot(state.head_x_kN_per_m, state.head_y_kN_per_m),
        ),
        Member.POST_FOOT: state.post_foot_kN,
    }
    return forces[member]


def _rejudge_largest(place: Message, row: RowStudy) -> Iterator[Message]:
    """Each largest force stands in the state that is said to bring it."""
    stateless = (*RopeForce, NetPart.MESH)
    solved = {one.quantity: one.value_kN for one in row.forces}
    solved = {name: force for name, force in solved.items() if name not in stateless}
    least = {
        one.member: one.force_kN for one in (row.floor.forces if row.floor else ())
    }
    for key, wanted, states in (
        ("value_kN", solved, [one for one in row.statics if one.load is None]),
        ("force_kN", least, [one for one in row.statics if one.load is not None]),
    ):
        for member, force in wanted.items():
            if not force:
                continue
            found = [read_state(one, member) for one in states if member in one.brings]
            where = say("audit.part", place=place, part=name_member(member))
            yield from report_unequal(
                where, [(key, force, found[0] if len(found) == 1 else None)]
            )


def _lacks_altitude(row: RowStudy) -> bool:
    """Note of the row that its altitude is not known."""
    told = (one for one in row.notes if isinstance(one, Message))
    return any(one.key == "row.altitude_assumed" for one in told)


def _rejudge_sideways(
    place: Message, row: RowStudy, spacing: float
) -> Iterator[Message]:
    """The pull and the tension by which the load along the row is shared."""
    held = row.held_sideways
    if held is None:
        return
    pulls = [
        spacing * math.hypot(one.head_x_kN_per_m, one.head_y_kN_per_m)
        for one in row.statics
        if "head_pull" in one.brings
    ]
    least = max(held.solved_tension_kN - held.hidden_tension_kN, 0.0)
    if held.floor_tension_kN is not None:
        least = min(least, held.floor_tension_kN)
    is_assumed = row.panel is not None and bool(row.panel.assumed)
    if is_assumed or (held.floor_tension_kN is not None and _lacks_altitude(row)):
        least = 0.0
    yield from report_unequal(
        place,
        [
            ("held_sideways.pull_kN", held.pull_kN, max(pulls, default=None)),
            ("held_sideways.least_tension_kN", held.least_tension_kN, least),
        ],
    )
