"""Results of a solve: forces with their error and balances, or a reason."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeVar

import numpy as np

from netdesign.coupling.interface import Estimate
from netdesign.coupling.scene import Scene
from netdesign.numerics.arrays import Floats, Ints, Mask
from netdesign.outcome import Fault, Outcome, OutputError, SolveError
from netdesign.snow.mesh import MeshTemplate
from netdesign.words.catalogue import Language
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# What a reader must know of a net that was to hold the snow on both sides.
RELEASED = say("balance.released")
Method = Literal["steady", "transient", "staggered"]
OnFailure = Literal["return", "raise"]
Found = TypeVar("Found")


@dataclass(frozen=True, slots=True, kw_only=True)
class EndPull:
    """A force per metre of width with its error: a net's pull, a wall's load.

    Attributes
    ----------
    x, y : float
        Along the slope, and normal to it [N/m].
    error : float
        Estimated discretisation error of the vector [N/m].
    """

    x: float
    y: float
    error: float

    @classmethod
    def of_estimate(cls, estimate: Estimate, scale: float) -> EndPull:
        """Pull from a dimensionless estimate.

        Parameters
        ----------
        estimate : Estimate
            Vector of shape (2,) with its error [rho g d^2].
        scale : float
            rho g d^2 [N/m].
        """
        x, y = (float(part) * scale for part in estimate.vector)
        return cls(x=x, y=y, error=estimate.error * scale)

    @property
    def size(self) -> float:
        """Size of the force; at a net's end its tension there [N/m]."""
        return math.hypot(self.x, self.y)


@dataclass(frozen=True, slots=True, kw_only=True)
class Balance:
    """Tests that every solution carries; shares are pure numbers.

    Attributes
    ----------
    weight_along_slope : float
        Of the meshed snow [N/m].
    relative_residual : float
        Force missing from the global balance, over the weight.
    friction_excess : float
        Largest shear beyond the friction limit at a node, over the weight.
    smallest_tension : float or None
        Of the net [N/m]; None for a wall.
    suction_share : float
        Pull of the snow on the net over its pressure [-]; 1 if that is as much, or
        more.
    ground_tension_share : float
        The same of the ground [-].
    """

    weight_along_slope: float
    relative_residual: float
    friction_excess: float
    smallest_tension: float | None
    suction_share: float
    ground_tension_share: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Cost:
    """Work that a solve took; no clock, so that equal solves are equal.

    Attributes
    ----------
    linear_solves, rounds : int
        Of all meshes.
    elements, degrees_of_freedom : int
        Of the finest mesh.
    """

    linear_solves: int
    rounds: int
    elements: int
    degrees_of_freedom: int


class FollowedHistory(Protocol):
    """Record of a history, as far as the core reads it; an add-on follows it."""

    @property
    def unproven(self) -> Message | None:
        """Reason why its forces are no result; None where it came to rest."""

    def write(self, solution: Solution, language: Language) -> dict[str, Any]:
        """Part of the solution document."""

    def write_table(self) -> bytes:
        """Moments as CSV, one a line."""

    def list_flags(self, scene: Scene) -> list[Message]:
        """Remarks that a reader must know before using the numbers."""


class MethodSettings(Hashable, Protocol):
    """Settings of a method that an add-on brings."""

    @property
    def method(self) -> Method:
        """Name of the method."""

    @property
    def accuracy(self) -> float | None:
        """Relative error allowed in the end pulls [-]; None of one without control."""

    def solve(self, scene: Scene) -> Solution | FailedSolution:
        """Snow against the scene's net."""

    def describe(self) -> dict[str, Any]:
        """Tolerances and choices that a rerun needs."""


# Distance from the net's foot over that of its head. Cases that slip only so far move
# by at most a tenth of their stated error if friction grows (512 cases of a row).
_BY_FOOT = 5e-3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SolvedState:
    """A converged state whose balances were checked, as an envelope keeps it. SI units.

    Attributes
    ----------
    method : str
        ``steady``, ``transient`` or ``staggered``.
    foot, head : EndPull
        Pulls on the net's ends: design values, the largest of a history.
    tension_max : float
        Along the net [N/m].
    net_curve : ndarray, shape (2, n)
        Net nodes in the snow, foot to head [m].
    net_forces : ndarray, shape (2, n)
        Forces of the snow on them [N/m].
    net_slides : ndarray of bool, shape (n,)
        Where the snow slips on the net.
    balance, cost
        See there; of a history the worst balance of all its steps.
    is_released : bool
        A two-sided net contact was asked for, but the snow would pull on the net too
        much: the one-sided one was solved.
    """

    method: Method
    foot: EndPull
    head: EndPull
    tension_max: float
    net_curve: Floats
    net_forces: Floats
    net_slides: Mask
    balance: Balance
    cost: Cost
    is_released: bool = False

    @property
    def outcome(self) -> Outcome:
        """Always converged: anything else is a ``FailedSolution``."""
        return Outcome.CONVERGED

    @property
    def reason(self) -> Message | None:
        """Remark that a reader needs; None of what was solved as asked."""
        return RELEASED if self.is_released else None

    @property
    def head_point(self) -> tuple[float, float]:
        """Position of the net's head [m]."""
        x, y = self.net_curve[:, -1]
        return float(x), float(y)

    @property
    def sticks(self) -> bool:
        """The snow slips nowhere on the net, or only by its foot.

        There, where the pressure is singular, some snow slips at any friction; more
        friction would change next to nothing.
        """
        slides = np.flatnonzero(self.net_slides)
        if not slides.size:
            return True
        (x, y), head = self.net_curve[:, slides[-1]], self.head_point
        return math.hypot(x, y) <= _BY_FOOT * math.hypot(*head)

    @property
    def is_finite(self) -> bool:
        """Whether every number behind a force is finite, and no error is negative."""
        parts = (
            getattr(part, key)
            for part in (self.foot, self.head, self.balance)
            for key in part.__dataclass_fields__
        )
        numbers = [self.tension_max, *(part for part in parts if part is not None)]
        shape = (self.net_curve, self.net_forces)
        return (
            all(math.isfinite(number) for number in numbers)
            and all(bool(np.isfinite(array).all()) for array in shape)
            and min(self.foot.error, self.head.error) >= 0.0
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Solution(SolvedState):
    """A solved state with its scene, mesh and history. SI units.

    Attributes
    ----------
    scene : Scene
        What was solved; with the one-sided contact where the net ``is_released``.
    tension_min : float
        Along the net [N/m].
    sag : float
        Largest distance of the net from its chord, normal to it [m].
    mesh_nodes : ndarray, shape (2, n_nodes)
        [m].
    mesh_triangles : ndarray, shape (3, n_triangles)
        Node numbers of the triangles' corners.
    mesh_density : ndarray, shape (n_triangles,)
        Snow density of the triangles [kg/m3].
    mesh_velocity : ndarray, shape (2, n_nodes)
        Along the slope and normal to it [m/s]; the only result that depends on the
        fluidity.
    history : FollowedHistory or None
        Of a transient or staggered solve; shapes are then those at its end.
    """

    scene: Scene
    tension_min: float
    sag: float
    mesh_nodes: Floats
    mesh_triangles: Ints
    mesh_density: Floats
    mesh_velocity: Floats
    history: FollowedHistory | None = None

    @property
    def largest_velocity(self) -> float:
        """Largest velocity of the snow [m/s]."""
        return float(np.hypot(*self.mesh_velocity).max())

    def plot(self, path: str | Path | None = None) -> Figure:
        """Draw the net in its section, with its pulls on what holds it.

        Parameters
        ----------
        path : str or Path, optional
            Where the picture goes, as PNG, SVG or PDF by its ending.

        Returns
        -------
        Figure
            Of matplotlib.

        Raises
        ------
        OutputError
            If that is not installed: it is an extra, ``netdesign[plot]``.
        """
        try:
            from matplotlib.figure import Figure
        except ImportError:
            raise OutputError(say("program.no_matplotlib")) from None

        x, y = self.net_curve
        figure = Figure(figsize=(5.0, 3.4), layout="constrained")
        axes = figure.subplots()
        axes.plot(x, y, "k.-", label="net")
        longest = max(self.foot.size, self.head.size)
        for end, pull in ((0, self.foot), (-1, self.head)):
            scale = 0.5 * self.scene.net.height_normal / longest
            tip = x[end] + scale * pull.x, y[end] + scale * pull.y
            arrow = {"width": 1, "facecolor": "0.7"}
            axes.annotate("", tip, (x[end], y[end]), arrowprops=arrow)
            axes.text(*tip, f"  {pull.size / 1e3:.1f} kN/m", va="top")
        axes.axhline(0.0, color="black", linewidth=2.0)
        axes.set(xlabel="downslope [m]", ylabel="above the ground [m]")
        axes.axis("equal")
        axes.legend(loc="upper left")
        if path is not None:
            figure.savefig(path)
        return figure


@dataclass(frozen=True, slots=True, kw_only=True)
class FailedSolution:
    """A solve that gave no number that may be used.

    ``fault`` is what failed in the program, where it was the program.
    """

    outcome: Outcome
    reason: Message
    fault: Fault | None = None


def end_solve(
    solve: Callable[[], Found], on_failure: OnFailure = "return"
) -> Found | FailedSolution:
    """Result of a solve, or how it failed.

    Parameters
    ----------
    solve : callable
        Gives the result.
    on_failure : str
        ``return`` a FailedSolution, or ``raise`` the SolveError.

    Raises
    ------
    SolveError
        If ``on_failure`` says so.
    """
    try:
        return solve()
    except SolveError as failure:
        if on_failure == "raise":
            raise
        return FailedSolution(outcome=failure.outcome, reason=failure.reason)


def require_solved(solution: Found | FailedSolution) -> Found:
    """The solution itself, if it is one.

    Parameters
    ----------
    solution : Solution or FailedSolution
        Of any solve.

    Raises
    ------
    SolveError
        With outcome and reason of the failure.
    """
    if isinstance(solution, FailedSolution):
        raise SolveError(solution.outcome, solution.reason)
    return solution


def triangle_density(scene: Scene, template: MeshTemplate) -> Floats:
    """Snow density of the triangles of a mesh that has not moved [kg/m3].

    Parameters
    ----------
    scene : Scene
        With uniform or layered snow.
    template : MeshTemplate
        Mesh of the snow's thickness 1.

    Returns
    -------
    ndarray, shape (n_triangles,)
        That of the layer which a triangle lies in.
    """
    if not scene.layer_tops:
        return np.full(template.triangles.shape[1], scene.layers[0].density)
    heights = template.nodes[1, template.triangles[:3]].mean(axis=0)
    layer = np.searchsorted(np.array(scene.layer_tops), heights)
    return np.asarray(np.array([layer.density for layer in scene.layers])[layer])
