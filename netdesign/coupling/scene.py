"""Input of one solve, and how it is to be solved."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import accumulate

from netdesign.cable.net import Net
from netdesign.outcome import (
    ModelError,
    require_count,
    require_one_of,
    require_positive,
    require_within,
)
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    FLUIDITY_EXPONENT,
    ICE_DENSITY,
    PAPER_FLUIDITY,
    CreepLaw,
    compute_bulk_factor,
    compute_fluidity,
    compute_settling_fluidity,
    compute_shear_factor,
    require_admissible,
)
from netdesign.snow.ground import GroundLaw
from netdesign.snow.law import FlowLayer, FlowProblem, Sides
from netdesign.snow.mesh import MeshSize
from netdesign.snow.snowpack import Layer, Snowpack
from netdesign.words.message import say

# Snow may stand above the head by this share of the net's height before the scene
# is refused: rounding of a height that was meant to be equal.
_OVERTOPPING = 1e-6
# a / b above which the snow counts as nearly incompressible and takes the mixed
# element; the velocity element's error grows from there (tests/verification).
MIXED_BULK_RATIO = 20.0

# Beyond this many thicknesses upslope of the net, snow on a freely gliding ground only
# hands its weight along the slope on: farther snow becomes a load (measured: from 4
# on nothing changes beyond the mesh's own error).
MODELLED_ASPECT = 8.0
_CUT_FROM = 9.0

# Meshes from the fewest triangles upwards. Sectors around the net's foot are worth
# more than those around its head, and these more than triangles along its middle
# (measured: netdesign bench).
MESH_LEVELS = tuple(
    MeshSize(
        net_spacing=net_spacing,
        corner=corner,
        sectors=sectors,
        head_sectors=head_sectors,
        upslope_spacing=upslope_spacing,
    )
    for net_spacing, corner, sectors, head_sectors, upslope_spacing in (
        (0.34, 1e-2, 3, 3, 1.0),
        (0.34, 2e-3, 5, 3, 0.8),
        (0.2, 1e-4, 8, 4, 0.6),
        (0.1, 4e-5, 12, 7, 0.35),
        (0.06, 2e-5, 18, 12, 0.2),
    )
)


def is_overtopped(net_height: float, thickness: float) -> bool:
    """Test for snow above a net's head, more than rounding of equal heights.

    Parameters
    ----------
    net_height, thickness : float
        Of net and snow, normal to the slope [m].
    """
    return net_height < thickness * (1.0 - _OVERTOPPING)


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """A snowpack on its ground, against a net.

    Attributes
    ----------
    snowpack : Snowpack
        The snow.
    ground : GroundLaw
        Base law.
    net : Net
        What holds the snow.
    creep_law : CreepLaw
        Set of a(D), b(D), n.
    fluidity : float or None
        B [Pa^-n s^-1], of layers without a temperature; None without a value.
    ground_contact, net_contact : str
        ``two-sided`` (the paper) or ``one-sided`` (cannot pull on the snow).
    """

    snowpack: Snowpack
    ground: GroundLaw
    net: Net
    creep_law: CreepLaw = BOUTILLIER_2004
    fluidity: float | None = None
    ground_contact: Sides = "two-sided"
    net_contact: Sides = "two-sided"

    def __post_init__(self) -> None:
        """Refuse combinations that the model cannot represent."""
        height, thickness = self.net.height_normal, self.snowpack.thickness
        if is_overtopped(height, thickness):
            raise ModelError(
                say("scene.net_too_low", height=height, thickness=thickness)
            )
        _require_clear_of_ground(self.net)
        if self.fluidity is not None:
            require_positive("fluidity", self.fluidity, "Pa^-n s^-1")
        if not any(self.snowpack.gravity_direction):
            raise ModelError(say("scene.no_weight"))
        for name in ("ground_contact", "net_contact"):
            require_one_of(name, getattr(self, name), ("two-sided", "one-sided"))
        if self.ground_contact == "one-sided" and self.snowpack.gravity == "parallel":
            raise ModelError(say("scene.nothing_presses"))
        aspect = self.snowpack.aspect
        require_within("upslope length over snow thickness", aspect, 0.25, 200.0)
        if self.creep_law.exponent != FLUIDITY_EXPONENT and self._has_temperatures:
            raise ModelError(
                say(
                    "scene.layer_temperature",
                    known=FLUIDITY_EXPONENT,
                    exponent=self.creep_law.exponent,
                )
            )
        for layer in self.layers:
            require_admissible(self.creep_law, layer.density / ICE_DENSITY)

    @property
    def layers(self) -> tuple[Layer, ...]:
        """Layers from the ground up; a single one for uniform snow."""
        pack = self.snowpack
        whole = Layer(thickness=pack.thickness, density=pack.density)
        return pack.layers or (whole,)

    @property
    def settles_as_stations(self) -> bool:
        """Nobody gave a fluidity or a temperature: settling sets the clock."""
        return self.fluidity is None and not self._has_temperatures

    @property
    def creep_fluidity(self) -> float:
        """B [Pa^-n s^-1]: as given; else of settling at mid-depth, (N25) and (N26).

        Beside layers with a temperature it is the source paper's.
        """
        if self.fluidity is not None:
            return self.fluidity
        if self._has_temperatures:
            return PAPER_FLUIDITY
        pack = self.snowpack
        middle = pack.stress_scale / 2.0
        return compute_settling_fluidity(self.creep_law, pack.density, middle)

    @property
    def _has_temperatures(self) -> bool:
        return any(layer.temperature is not None for layer in self.layers)

    @property
    def layer_tops(self) -> tuple[float, ...]:
        """Heights of the interfaces between layers over the thickness."""
        heights = accumulate(layer.thickness for layer in self.snowpack.layers[:-1])
        return tuple(height / self.snowpack.thickness for height in heights)

    @property
    def flow_problem(self) -> FlowProblem:
        """The scene's snow and ground, dimensionless."""
        tops = (*self.layer_tops, 1.0)
        layers = tuple(
            self._scale_layer(layer, top)
            for layer, top in zip(self.layers, tops, strict=True)
        )
        stiffest = max(layer.bulk_ratio for layer in layers)
        return FlowProblem(
            exponent=self.creep_law.exponent,
            layers=layers,
            gravity=self.snowpack.gravity_direction,
            ground=self.ground.kind,
            slip_ratio=self.ground.slip_length / self.snowpack.thickness,
            friction=self.net.friction,
            element="mixed" if stiffest > MIXED_BULK_RATIO else "velocity",
            ground_contact=self.ground_contact,
            net_contact=self.net_contact,
        )

    @property
    def modelled_aspect(self) -> float:
        """Upslope length over thickness that a steady solve has to model."""
        aspect = self.snowpack.aspect
        hands_on = self.ground.kind == "free" and self.ground_contact == "two-sided"
        return MODELLED_ASPECT if hands_on and aspect > _CUT_FROM else aspect

    @property
    def steady_flow_problem(self) -> FlowProblem:
        """``flow_problem`` with the exact load of the snow that is not modelled."""
        beyond = self.snowpack.aspect - self.modelled_aspect
        problem = self.flow_problem
        if not beyond:
            return problem
        return replace(problem, end_load=beyond * problem.gravity[0])

    @property
    def is_calibrated(self) -> bool:
        """Every layer's density lies where the creep law is given."""
        law = self.creep_law
        return all(law.is_calibrated(la.density / ICE_DENSITY) for la in self.layers)

    @property
    def force_scale(self) -> float:
        """Rho g d^2 [N/m], the scale of forces per metre of width."""
        return self.snowpack.stress_scale * self.snowpack.thickness

    @property
    def velocity_scale(self) -> float:
        """B a^((n+1)/2) (rho g d)^n d [m/s], the scale of velocities."""
        n, pack = self.creep_law.exponent, self.snowpack
        shear = compute_shear_factor(self.creep_law, pack.relative_density)
        rate = self.creep_fluidity * shear ** ((n + 1) / 2) * pack.stress_scale**n
        return float(rate * pack.thickness)

    @property
    def time_scale(self) -> float:
        """Thickness over the velocity scale [s]: the unit of creep time."""
        return self.snowpack.thickness / self.velocity_scale

    def _scale_layer(self, layer: Layer, top: float) -> FlowLayer:
        """Layer relative to snow of the mean density and the scene's fluidity."""
        law, pack = self.creep_law, self.snowpack
        density = layer.density / ICE_DENSITY
        shear = compute_shear_factor(law, density)
        mean_shear = compute_shear_factor(law, pack.relative_density)
        warmth = 1.0
        if layer.temperature is not None:
            warmth = compute_fluidity(layer.temperature) / self.creep_fluidity
        return FlowLayer(
            top=top,
            bulk_ratio=shear / compute_bulk_factor(law, density),
            fluidity_ratio=warmth
            * float((shear / mean_shear) ** ((law.exponent + 1) / 2)),
            density=layer.density / pack.density,
            warmth=warmth,
        )


def _require_clear_of_ground(net: Net) -> None:
    """Refuse slack that would let the net hang on the ground below its foot.

    The net leaves its foot at the chord's angle to the ground, less the end slope of
    a parabola of its unstressed length, 4 f / c.
    """
    sag = math.sqrt(3.0 * net.slack / 8.0)
    if math.atan(4.0 * sag) >= math.pi / 2 - net.inclination:
        steepest = math.pi / 2 - net.inclination
        most = 8.0 / 3.0 * (math.tan(steepest) / 4.0) ** 2
        raise ModelError(
            say(
                "net.lies_on_ground",
                slack=net.slack,
                inclination=math.degrees(net.inclination),
                most=float(most),
            )
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class SolverSettings:
    """Tolerances of one solve; pure numbers, printed in every result.

    Attributes
    ----------
    accuracy : float
        Relative error allowed in each end force [-]; the mesh is refined until the
        estimate is below it.
    stress_tolerance : float
        Relative error that the last Newton step may leave [-]; a 25th of the accuracy
        if that is less.
    shape_tolerance : float
        Movement of the net in the last round, over the snow thickness; a 25th of the
        accuracy if that is less.
    balance_tolerance : float
        Force that may be missing, over the weight of the snow.
    max_rounds, max_iterations : int
        Rounds between snow and net; Newton steps in one of them.
    patience : float
        How many times the usual linear solves the rounds on one mesh may take [-].
    levels : tuple of MeshSize
        Meshes from coarse to fine, at least two.
    """

    accuracy: float = 0.01
    stress_tolerance: float = 2e-4
    shape_tolerance: float = 2e-4
    balance_tolerance: float = 1e-8
    max_rounds: int = 80
    max_iterations: int = 60
    patience: float = 1.0
    levels: tuple[MeshSize, ...] = field(default=MESH_LEVELS)

    def describe(self) -> dict[str, float]:
        """Tolerances that a rerun needs."""
        names = ("accuracy", "stress_tolerance", "shape_tolerance", "balance_tolerance")
        return {name: getattr(self, name) for name in names}

    def __post_init__(self) -> None:
        """Refuse settings that would make every result look converged."""
        require_within("accuracy", self.accuracy, 1e-4, 0.1)
        require_within("stress tolerance", self.stress_tolerance, 1e-14, 2e-4)
        require_within("shape tolerance", self.shape_tolerance, 1e-14, 2e-4)
        require_within("balance tolerance", self.balance_tolerance, 1e-14, 1e-6)
        require_count("rounds", self.max_rounds)
        require_count("iterations", self.max_iterations)
        require_positive("patience", self.patience)
        if len(self.levels) < 2:
            raise ModelError(say("scene.two_levels"))
