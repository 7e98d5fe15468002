"""The panel between posts as a record: inputs, largest forces, what its ropes bear."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from netdesign.envelope.extremes import Extreme
from netdesign.envelope.panel_forces import PANEL_QUANTITIES
from netdesign.envelope.run import CaseResult
from netdesign.panel.inputs import Rope
from netdesign.panel.solution import FailedPanel
from netdesign.site.model import BorderRope, NetRow
from netdesign.structure.members import RopeForce
from netdesign.study.record_cases import record_extreme
from netdesign.study.records import PanelRecord, RopeRecord
from netdesign.units import kilonewton_from_newton, kilonewton_if_known


def record_panel(
    row: NetRow,
    results: Sequence[CaseResult] = (),
    extremes: Mapping[str, Extreme] = MappingProxyType({}),
) -> PanelRecord | None:
    """Panel of a row with its largest forces over the cases that have some.

    None of a row without a panel.
    """
    if row.panel is None:
        return None
    panel = row.panel.panel
    found = {name: extremes[name] for name in PANEL_QUANTITIES if name in extremes}
    lower = (RopeForce.LOWER_ALONG, RopeForce.LOWER_TENSION)
    upper = (RopeForce.UPPER_ALONG, RopeForce.UPPER_TENSION)
    return PanelRecord(
        cut=panel.cut,
        has_mid_anchors=panel.has_mid_anchors,
        ropes=[
            _record_rope("lower", panel.lower, row.panel.lower, found, lower),
            _record_rope("upper", panel.upper, row.panel.upper, found, upper),
        ],
        extremes=[record_extreme(one) for one in found.values()],
        failed=sum(isinstance(one.panel, FailedPanel) for one in results),
    )


def _record_rope(
    name: str,
    rope: Rope,
    bears: BorderRope,
    extremes: Mapping[str, Extreme],
    forces: tuple[str, str],
) -> RopeRecord:
    along, tension = (
        kilonewton_from_newton(extremes[one].widened.high) if one in extremes else None
        for one in forces
    )
    return RopeRecord(
        rope=name,
        type=bears.type_id,
        stiffness_kN=kilonewton_from_newton(rope.stiffness),
        sag=rope.sag,
        along_kN=along,
        tension_kN=tension,
        breaking_kN=kilonewton_if_known(bears.breaking),
        cell=bears.source,
    )
