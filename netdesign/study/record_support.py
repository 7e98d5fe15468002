"""The drawn case of a net row: section, forces on the ground and on the post head."""

from __future__ import annotations

from netdesign.coupling.face import NetState, find_net_face
from netdesign.envelope.run import CaseResult
from netdesign.site.model import NetRow
from netdesign.structure.anchors import AnchorForces
from netdesign.structure.layout import SupportPoints, place_support
from netdesign.structure.members import Member
from netdesign.study.effects import RowEffects
from netdesign.study.record_cases import record_point
from netdesign.study.support_records import AnchorRecord, Arrow, Drawing, HeadForce
from netdesign.units import degree_from_radian, kilonewton_from_newton

_PRESSURE_DECIMALS = 3  # [kPa]
_DRAWN_DECIMALS = 4  # of positions in drawings: a tenth of a millimetre


def record_anchors(
    result: CaseResult | None, effects: RowEffects
) -> list[AnchorRecord]:
    """Force vectors on the ground with their direction; slack ones have none."""
    if result is None or result.anchors is None:
        return []
    share = effects.lateral_share
    records = []
    for name, force in result.anchors.on_ground.items():
        lateral = share * force.size if force.member == Member.NET else 0.0
        direction = force.direction
        records.append(
            AnchorRecord(
                anchor=name,
                member=force.member,
                force_x_kN=kilonewton_from_newton(force.x),
                force_y_kN=kilonewton_from_newton(force.y),
                lateral_kN=kilonewton_from_newton(lateral),
                size_kN=kilonewton_from_newton(force.size),
                direction_deg=None
                if direction is None
                else degree_from_radian(direction),
            )
        )
    return records


def record_head(row: NetRow, result: CaseResult | None) -> list[HeadForce]:
    """Forces on the post head, the net's pull first; together they are zero.

    The pull is that of the solve; the members' are the reverse of what each does to
    the ground, so that an error in the support would leave the polygon open.
    """
    if result is None or result.solution is None or result.anchors is None:
        return []
    pull, width = result.solution.head, row.layout.post_spacing
    anchors = result.anchors
    members = (anchors.post_base, anchors.uphill_anchor, anchors.downhill_anchor)
    forces = [
        (Member.NET, pull.x * width, pull.y * width),
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


def record_drawing(row: NetRow, result: CaseResult | None) -> Drawing | None:
    """Section of a case with its forces; None where it has no solution."""
    if result is None or result.solution is None or result.anchors is None:
        return None
    solution, anchors = result.solution, result.anchors
    points = place_support(row.layout, solution.head_point)
    curve = solution.net_curve.T.round(_DRAWN_DECIMALS).tolist()
    in_snow = len(solution.net_slides)
    sticks = [not bool(slides) for slides in solution.net_slides]
    edges = solution.mesh_nodes[:, solution.mesh_edges].round(_DRAWN_DECIMALS)
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
        arrows=_list_arrows(points, anchors),
        pressure_kPa=_list_pressures(solution),
    )


def _list_pressures(net: NetState) -> list[float | None]:
    """Pressure of the snow on each net point [kPa]; None where it is not known."""
    face = find_net_face(net, friction=None)
    pressure, _ = face.tractions
    values = (pressure[face.inner] / 1e3).round(_PRESSURE_DECIMALS).tolist()
    before = face.inner.start
    after = net.net_curve.shape[1] - before - len(values)
    return [*[None] * before, *values, *[None] * after]


def _list_arrows(points: SupportPoints, anchors: AnchorForces) -> list[Arrow]:
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
