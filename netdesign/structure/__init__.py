"""From the net's end forces to the forces in posts, guys and anchors."""

from netdesign.structure.anchors import (
    AnchorForces,
    GroundForce,
    compute_anchor_forces,
)
from netdesign.structure.head import FailedSupport, HeadForces, compute_head_forces
from netdesign.structure.layout import SupportLayout, SupportPoints, place_support

__all__ = [
    "AnchorForces",
    "FailedSupport",
    "GroundForce",
    "HeadForces",
    "SupportLayout",
    "SupportPoints",
    "compute_anchor_forces",
    "compute_head_forces",
    "place_support",
]
