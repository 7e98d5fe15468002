"""Input of one solve, and how it is to be solved."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from netdesign.cable.net import Net
from netdesign.errors import ModelError
from netdesign.guards import require_positive, require_within
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    CreepLaw,
    compute_bulk_factor,
    compute_shear_factor,
)
from netdesign.snow.flow import FlowLaw
from netdesign.snow.ground import GroundLaw
from netdesign.snow.mesh import MeshSize
from netdesign.snow.snowpack import Snowpack

# Snow may stand above the head by this share of the net's height before the scene
# is refused: rounding of a height that was meant to be equal.
_OVERTOPPING = 1e-6

# Meshes from the fewest triangles upwards; each halves the sizes of the one before.
MESH_LEVELS = (
    MeshSize(net_spacing=0.25, corner=4e-3, sectors=2, upslope_spacing=1.0),
    MeshSize(net_spacing=0.125, corner=1e-3, sectors=3, upslope_spacing=0.5),
    MeshSize(net_spacing=0.0625, corner=2.5e-4, sectors=4, upslope_spacing=0.25),
    MeshSize(net_spacing=0.03125, corner=1e-4, sectors=6, upslope_spacing=0.125),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """A snowpack on its ground, hanging on a net."""

    snowpack: Snowpack
    ground: GroundLaw
    net: Net
    creep_law: CreepLaw = BOUTILLIER_2004

    def __post_init__(self) -> None:
        """Refuse combinations that the model cannot represent."""
        height, thickness = self.net.height_normal, self.snowpack.thickness
        if height < thickness * (1.0 - _OVERTOPPING):
            raise ModelError(
                f"net height = {height:g} m is below the snow thickness of "
                f"{thickness:g} m (both normal to the slope): the model has no rule "
                "for snow that overtops the net; raise the net or lower the snow"
            )
        require_within(
            "upslope length over snow thickness",
            self.snowpack.upslope_length / thickness,
            0.25,
            200.0,
        )

    @property
    def flow_law(self) -> FlowLaw:
        """The scene's snow and ground, dimensionless."""
        density = self.snowpack.relative_density
        shear = compute_shear_factor(self.creep_law, density)
        bulk = compute_bulk_factor(self.creep_law, density)
        return FlowLaw(
            exponent=self.creep_law.exponent,
            bulk_ratio=shear / bulk,
            gravity=self.snowpack.gravity_direction,
            ground=self.ground.kind,
            slip_ratio=self.ground.slip_length / self.snowpack.thickness,
            friction=self.net.friction,
        )

    @property
    def force_scale(self) -> float:
        """Rho g d^2 [N/m], the scale of forces per metre of width."""
        return self.snowpack.stress_scale * self.snowpack.thickness

    @property
    def weight_along_slope(self) -> float:
        """Weight of the snow upslope of a straight net, along the slope [N/m]."""
        pack, net = self.snowpack, self.net
        wedge = pack.thickness**2 * math.tan(net.inclination) / 2.0
        area = pack.upslope_length * pack.thickness + wedge
        stress = pack.stress_scale * math.sin(pack.slope_angle)
        return stress * area / pack.thickness


@dataclass(frozen=True, slots=True, kw_only=True)
class SolverSettings:
    """Tolerances of one solve; pure numbers, printed in every result.

    Attributes
    ----------
    accuracy : float
        Relative error allowed in each end force; the mesh is refined until the
        estimate is below it.
    stress_tolerance : float
        Relative change of the stress in the last Newton step.
    shape_tolerance : float
        Movement of the net in the last round, over the snow thickness.
    balance_tolerance : float
        Force that may be missing, over the weight of the snow.
    max_rounds, max_iterations : int
        Rounds between snow and net; Newton steps in one of them.
    """

    accuracy: float = 0.01
    stress_tolerance: float = 1e-8
    shape_tolerance: float = 1e-7
    balance_tolerance: float = 1e-8
    max_rounds: int = 60
    max_iterations: int = 40
    levels: tuple[MeshSize, ...] = field(default=MESH_LEVELS)

    def __post_init__(self) -> None:
        """Refuse settings that would make every result look converged."""
        require_within("accuracy", self.accuracy, 1e-4, 0.1)
        require_within("stress tolerance", self.stress_tolerance, 1e-14, 1e-4)
        require_within("shape tolerance", self.shape_tolerance, 1e-14, 1e-4)
        require_within("balance tolerance", self.balance_tolerance, 1e-14, 1e-6)
        require_positive("rounds", self.max_rounds)
        require_positive("iterations", self.max_iterations)
        if len(self.levels) < 2:
            raise ModelError("an error estimate needs at least two mesh levels")
