"""The drawn case of a net row: section, forces on the ground and on the post head."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from netdesign.coupling.interface import NetState, find_net_face
from netdesign.envelope.extremes import Extreme
from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.numerics.arrays import Floats
from netdesign.panel.inputs import Rope
from netdesign.panel.solve import FailedPanel
from netdesign.panel.strips import ROPE_POINTS
from netdesign.site.model import NetRow, Resistance
from netdesign.solving.solve import SolvedState
from netdesign.structure.anchors import AnchorForces
from netdesign.structure.layout import Point, SupportPoints, place_support
from netdesign.structure.members import Member, NetPart, RopeForce
from netdesign.study.record_envelope import record_point
from netdesign.study.support_records import (
    AnchorRecord,
    Arrow,
    Drawing,
    HeadForce,
    PanelDrawing,
    PanelRecord,
    RopeRecord,
)
from netdesign.units import (
    degree_from_radian,
    degree_if_known,
    kilonewton_from_newton,
    kilonewton_if_known,
)

_DECIMALS = 4  # of positions in drawings: a tenth of a millimetre


def record_panel(
    row: NetRow,
    results: Sequence[CaseResult] = (),
    extremes: Mapping[str, Extreme] = MappingProxyType({}),
    drawn: CaseResult | None = None,
) -> PanelRecord | None:
    """Panel of a row, with what its ropes bear over the cases that have some.

    None of a row without a panel. ``drawn`` is the case that is shown.
    """
    if not row.panels:
        return None
    panel = row.panels[0]
    ropes = [rope for rope in RopeForce if rope in extremes]
    highs = {rope: extremes[rope].widened.high for rope in ropes}
    return PanelRecord(
        cut=panel.cut,
        has_mid_anchors=panel.has_mid_anchors,
        assumed=list(row.panel_assumed),
        ropes=[]
        if row.panel_assumed
        else [
            _record_rope(
                *("lower", panel.lower),
                highs.get(RopeForce.LOWER_ALONG),
                highs.get(RopeForce.LOWER_TENSION),
                row.find_net_part(NetPart.LOWER_ROPE),
            ),
            _record_rope(
                *("upper", panel.upper),
                highs.get(RopeForce.UPPER_ALONG),
                highs.get(RopeForce.UPPER_TENSION),
                row.find_net_part(NetPart.RIDGE_ROPE),
            ),
        ],
        failed=sum(isinstance(one.panel, FailedPanel) for one in results),
        end_guy_deg=degree_if_known(row.row_end.guy_angle if row.row_end else None),
        drawing=_draw(drawn) if drawn and not row.panel_assumed else None,
    )


def _draw(drawn: CaseResult) -> PanelDrawing | None:
    """Half a panel of a case; None where it has none."""
    panel = drawn.panel
    if not isinstance(panel, PanelForces):
        return None
    solved = panel.solution
    half = solved.panel.post_spacing / 2.0
    order = np.argsort(solved.stations)  # from the post to mid-panel
    lower, upper = (solved.curves[order][:, :, end] for end in (0, -1))
    head = drawn.solution.head_point if drawn.solution else (0.0, 0.0)
    return PanelDrawing(
        case=record_point(drawn.case),
        places_m=_round(solved.stations[order]),
        post_head_m=_list_points(np.array([head]))[0],
        lower_m=_list_points(lower),
        upper_m=_list_points(upper),
        mid_net_m=_list_points(solved.curves[-1].T),
        rope_places_m=_round(half * (1.0 - ROPE_POINTS[::-1])),
        lower_tensions_kN=_show(solved.lower.tensions),
        upper_tensions_kN=_show(solved.upper.tensions),
        foot_kN=_show_point(solved.foot),
        mid_foot_kN=_show_point(solved.mid_foot),
        head_kN=_show_point(solved.head),
        lower_along_kN=kilonewton_from_newton(solved.lower.along),
        upper_along_kN=kilonewton_from_newton(solved.upper.along),
    )


def _round(places: Floats) -> list[float]:
    return [round(float(one), _DECIMALS) for one in places]


def _list_points(points: Floats) -> list[tuple[float, float]]:
    """Points of shape (n, 2) to what a drawing shows [m]."""
    return [(round(float(x), _DECIMALS), round(float(y), _DECIMALS)) for x, y in points]


def _show(forces: Floats) -> list[float]:
    """Tensions from the post on, as ``rope_places_m`` has them [kN]."""
    return [round(kilonewton_from_newton(float(one)), 3) for one in forces[::-1]]


def _show_point(force: Point) -> tuple[float, float]:
    return kilonewton_from_newton(force[0]), kilonewton_from_newton(force[1])


def _record_rope(
    name: str,
    rope: Rope,
    along: float | None,
    tension: float | None,
    bears: Resistance | None = None,
) -> RopeRecord:
    """Rope with its largest forces [N], and what it bears where that is known."""
    return RopeRecord(
        rope=name,
        type=bears.type_id if bears else "",
        stiffness_kN=kilonewton_from_newton(rope.stiffness),
        sag=rope.sag,
        along_kN=kilonewton_if_known(along),
        tension_kN=kilonewton_if_known(tension),
        breaking_kN=kilonewton_if_known(bears.value if bears else None),
        cell=bears.source if bears else "",
    )


_PRESSURE_DECIMALS = 3  # [kPa]


def record_anchors(anchors: AnchorForces, share: float) -> list[AnchorRecord]:
    """Force vectors on the ground with their direction; slack ones have none.

    ``share`` of the net's force acts along the row.
    """
    return [
        AnchorRecord(
            anchor=name,
            member=force.member,
            force_x_kN=kilonewton_from_newton(force.x),
            force_y_kN=kilonewton_from_newton(force.y),
            lateral_kN=kilonewton_from_newton(
                share * force.size if force.member == Member.NET else 0.0
            ),
            size_kN=kilonewton_from_newton(force.size),
            direction_deg=degree_if_known(force.direction),
        )
        for name, force in anchors.on_ground.items()
    ]


def record_head(pull: Point, anchors: AnchorForces) -> list[HeadForce]:
    """Forces on the post head, the net's pull [N] first; together they are zero.

    The pull is that of the solve; the members' are the reverse of what each does to
    the ground, so that an error in the support would leave the polygon open.
    """
    members = (anchors.post_base, anchors.uphill_anchor, anchors.downhill_anchor)
    forces = [
        (Member.NET, *pull),
        *((force.member, -force.x, -force.y) for force in members if force.size > 0),
    ]
    return [
        HeadForce(
            member=member,
            x_kN=kilonewton_from_newton(x),
            y_kN=kilonewton_from_newton(y),
        )
        for member, x, y in forces
    ]


def record_drawn(
    row: NetRow, result: CaseResult | None, share: float
) -> tuple[Drawing | None, list[AnchorRecord], list[HeadForce]]:
    """Section of a case, its forces on the ground and on the post head.

    Nothing of a case without a solution. ``share`` of the net's force acts along the
    row.
    """
    if result is None or result.solution is None or result.anchors is None:
        return None, [], []
    pull, width = result.solution.head, row.layout.post_spacing
    return (
        _record_drawing(row, result, result.solution, result.anchors),
        record_anchors(result.anchors, share),
        record_head((pull.x * width, pull.y * width), result.anchors),
    )


def _record_drawing(
    row: NetRow, result: CaseResult, solution: SolvedState, anchors: AnchorForces
) -> Drawing:
    points = place_support(row.layout, solution.head_point)
    curve = solution.net_curve.T.round(_DECIMALS).tolist()
    in_snow = len(solution.net_slides)
    sticks = [not bool(slides) for slides in solution.net_slides]
    edges = solution.mesh_nodes[:, solution.mesh_edges].round(_DECIMALS)
    return Drawing(
        case=record_point(result.case),
        slope_deg=degree_from_radian(row.slope_angle),
        snow_thickness_m=row.at(result.case).held_thickness,
        net_m=[(x, y) for x, y in curve],
        sticks=sticks + [True] * (len(curve) - in_snow),
        mesh_edges_m=[
            (float(x0), float(y0), float(x1), float(y1))
            for (x0, x1), (y0, y1) in zip(edges[0].T, edges[1].T, strict=True)
        ],
        head_m=points.head,
        post_base_m=points.post_base,
        uphill_anchor_m=points.uphill_anchor,
        downhill_anchor_m=points.downhill_anchor,
        arrows=list_arrows(points, anchors),
        pressure_kPa=list_pressures(solution),
    )


def list_pressures(net: NetState) -> list[float | None]:
    """Pressure of the snow on each net point [kPa]; None where it is not known."""
    face = find_net_face(net)
    values = (face.pressures[face.inner] / 1e3).round(_PRESSURE_DECIMALS).tolist()
    before = face.inner.start
    after = net.net_curve.shape[1] - before - len(values)
    return [*[None] * before, *values, *[None] * after]


def list_arrows(points: SupportPoints, anchors: AnchorForces) -> list[Arrow]:
    """Forces on the ground at their points; that on the base is drawn as the post's."""
    places = (
        points.net_foot,
        points.uphill_anchor,
        points.downhill_anchor,
        points.post_base,
    )
    return [
        Arrow(
            member=Member.POST if name == Member.POST_BASE else name,
            x_m=place[0],
            y_m=place[1],
            force_x_kN=kilonewton_from_newton(force.x),
            force_y_kN=kilonewton_from_newton(force.y),
        )
        for (name, force), place in zip(anchors.on_ground.items(), places, strict=True)
    ]
