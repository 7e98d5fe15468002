"""Settings of the transient and the staggered method.

They stand apart from the solvers, so that a scene file is read without loading these.

Theory: coupling/THEORY.md, sections 6 and 7.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import FailedSolution, Method, Solution
from netdesign.outcome import (
    ModelError,
    require_count,
    require_positive,
    require_within,
)
from netdesign.snow.mesh import MeshSize
from netdesign.units import day_from_second
from netdesign.words.message import say

Start = Literal["steady", "straight", "sagged"]

# Meshes from the fewest triangles upwards; as for the steady state, sectors around the
# net's ends are worth more than triangles along its middle. Corners much smaller than
# the way that the snow makes past them would be swept away.
TRANSIENT_LEVELS = (
    MeshSize(
        net_spacing=0.34, corner=0.03, sectors=3, head_sectors=3, upslope_spacing=1.0
    ),
    MeshSize(
        net_spacing=0.34, corner=0.01, sectors=5, head_sectors=3, upslope_spacing=0.8
    ),
    MeshSize(
        net_spacing=0.2, corner=0.003, sectors=8, head_sectors=5, upslope_spacing=0.6
    ),
)
# Relative change of the stress in the last Newton iteration of a step [-], and
# iterations of a step at most: of a history, and of the exchange.
STRESS_TOLERANCE, MOST_ITERATIONS = 1e-4, 20
EXCHANGE_TOLERANCE, MOST_EXCHANGE_ITERATIONS = 1e-6, 40
# Creep time that a run follows at most: its steps are short.
LONGEST_EXCHANGE = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class TransientSettings:
    """Settings of a history.

    Attributes
    ----------
    accuracy : float
        Relative error allowed in the end pulls, in space and time [-].
    start : str
        ``steady``, ``sagged`` or ``straight``.
    horizon : float
        Time to follow [s].
    densifies : bool
        The creep law follows the density.
    stops_at_plateau : bool
        End once the plateau is proven instead of at the horizon.
    balance_tolerance : float
        Of every step, as in ``SolverSettings`` [-].
    max_steps : int
        Steps of the run.
    levels : tuple of MeshSize
        Meshes from coarse to fine, at least two.
    """

    method: ClassVar[Method] = "transient"

    accuracy: float = 0.01
    start: Start = "steady"
    horizon: float = 30.0 * 86400.0
    densifies: bool = True
    stops_at_plateau: bool = False
    balance_tolerance: float = 1e-9
    max_steps: int = 1000
    levels: tuple[MeshSize, ...] = field(default=TRANSIENT_LEVELS)

    def solve(self, scene: Scene) -> Solution | FailedSolution:
        """Snow against the scene's net, followed in time."""
        from netdesign.addons.history.transient import solve_transient

        return solve_transient(scene, self)

    def describe(self) -> dict[str, Any]:
        """Tolerances and choices that a rerun needs."""
        return {
            "accuracy": self.accuracy,
            "start": self.start,
            "horizon_d": day_from_second(self.horizon),
            "densification": self.densifies,
            "stress_tolerance": STRESS_TOLERANCE,
            "balance_tolerance": self.balance_tolerance,
        }

    def __post_init__(self) -> None:
        """Refuse settings that would make every result look converged."""
        require_within("accuracy", self.accuracy, 1e-4, 0.1)
        require_positive("horizon", self.horizon, "s")
        require_within("balance tolerance", self.balance_tolerance, 1e-14, 1e-6)
        require_count("steps", self.max_steps)
        if len(self.levels) < 2:
            raise ModelError(say("scene.two_levels"))


@dataclass(frozen=True, slots=True, kw_only=True)
class StaggeredSettings:
    """Settings of the paper's exchange; pure numbers.

    Attributes
    ----------
    base_drag : float
        Shear stress on the ground [rho g d] over its velocity [the snow's velocity
        scale]; the smaller, the shorter the steps must be.
    step_share : float
        Step over the longest that is about stable.
    start : str
        ``straight`` (the paper), ``sagged`` or ``steady``.
    horizon : float
        Creep time to follow, over thickness by velocity scale.
    size : MeshSize
        Resolution.
    """

    method: ClassVar[Method] = "staggered"
    accuracy: ClassVar[None] = None  # one mesh: nothing controls its error

    base_drag: float = 0.02
    step_share: float = 1.0
    start: Start = "straight"
    horizon: float = LONGEST_EXCHANGE
    size: MeshSize = field(default=TRANSIENT_LEVELS[0])

    def solve(self, scene: Scene) -> Solution | FailedSolution:
        """Snow against the scene's net by the paper's exchange."""
        from netdesign.addons.history.staggered import solve_staggered

        return solve_staggered(scene, self)

    def describe(self) -> dict[str, Any]:
        """Tolerances and choices that a rerun needs."""
        return {
            "start": self.start,
            "base_drag": self.base_drag,
            "step_share": self.step_share,
            "horizon_creep_time": self.horizon,
            "stress_tolerance": EXCHANGE_TOLERANCE,
        }

    def __post_init__(self) -> None:
        """Refuse a singular or an unstable scheme."""
        require_within("base drag", self.base_drag, 1e-5, 10.0)
        require_within("step share", self.step_share, 1e-3, 2.0)
        require_positive("horizon", self.horizon)


def build_transient(
    _: Scene, accuracy: float, start: Start | None, horizon: float, densifies: bool
) -> TransientSettings:
    """Settings of a history, as a scene file gives them; ``horizon`` in s."""
    return TransientSettings(
        accuracy=accuracy,
        start=start or "steady",
        horizon=horizon,
        densifies=densifies,
    )


def build_staggered(
    scene: Scene, _: float, start: Start | None, horizon: float, __: bool
) -> StaggeredSettings:
    """Settings of the paper's exchange, as ``build_transient``."""
    creep_time = min(horizon / scene.time_scale, LONGEST_EXCHANGE)
    return StaggeredSettings(start=start or "sagged", horizon=creep_time)
