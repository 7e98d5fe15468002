"""From the net's end forces to the forces in posts, guys and anchors."""

from netdesign.structure.anchors import (
    AnchorForces,
    GroundForce,
    compute_anchor_forces,
)
from netdesign.structure.head import FailedSupport, HeadForces, compute_head_forces
from netdesign.structure.layout import SupportLayout, SupportPoints, place_support
from netdesign.structure.row_position import (
    EndEffectRule,
    LoadedWidth,
    compute_edge_width,
    list_supports,
)

__all__ = [
    "AnchorForces",
    "EndEffectRule",
    "FailedSupport",
    "GroundForce",
    "HeadForces",
    "LoadedWidth",
    "SupportLayout",
    "SupportPoints",
    "compute_anchor_forces",
    "compute_edge_width",
    "compute_head_forces",
    "list_supports",
    "place_support",
]
