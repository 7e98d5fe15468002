"""A round of flow and net by the compiled core; the same as the steps of ``rounds``.

One call for the mesh along a curve, the flow on it, and the net under its forces.
Theory: core/THEORY.md.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np

from netdesign.cable.funicular import Funicular
from netdesign.core.arguments import (
    SceneArgument,
    locate,
    to_floats,
)
from netdesign.core.library import find_core, require_sound
from netdesign.coupling.interface import SupportForces
from netdesign.coupling.steady.compiled_scene import describe_scene
from netdesign.coupling.steady.hanging import (
    Hanging,
    SteadyProblem,
)
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome
from netdesign.snow.contact import Contact, may_lift
from netdesign.snow.element import list_dofs
from netdesign.snow.flow import ask_effort
from netdesign.snow.flow_state import FlowState
from netdesign.snow.placed_mesh import (
    EDGE_WEIGHTS,
    PlacedMesh,
)

_Arrays = tuple[np.ndarray[Any, Any], ...]


class Settled(NamedTuple):
    """Forces from the stresses of the snow alone, and the net under them."""

    forces: SupportForces
    hanging: Hanging


class Known(Protocol):
    """Snow and net that a round starts from."""

    @property
    def state(self) -> FlowState | None:
        """Flow; None if nothing is known of it."""

    @property
    def hanging(self) -> Hanging:
        """Net as it hung last."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Played:
    """Results of a round; what only the last one is asked for is read when it is.

    Attributes
    ----------
    core : CompiledRounds
        Whose they are.
    results : ndarray, shape (n,)
        All of them.
    linear_solves : int
        Taken by the flow.
    change : float
        Relative error that its last step left [-].
    """

    core: CompiledRounds
    results: Floats
    linear_solves: int
    change: float

    @property
    def moved(self) -> float:
        """Largest distance along an axis of the net and the curve given [thickness]."""
        return float(self.results[self.core.places["way"].start])

    @property
    def image(self) -> Floats:
        """Net's nodes in the snow as found, shape (2, n_net) [thickness]."""
        curve = self.results[self.core.places["curve"]].reshape(2, -1)
        return curve[:, : self.core.n_net]

    @cached_property
    def state(self) -> FlowState:
        """Flow along the curve."""
        return self.core.view_state(self.results)

    @cached_property
    def hanging(self) -> Hanging:
        """Net under the flow's forces."""
        return self.core.view_hanging(self.results)

    @cached_property
    def mesh(self) -> PlacedMesh:
        """Mesh along the curve."""
        return self.core.view_mesh(self.results)

    @cached_property
    def settled(self) -> Settled | None:
        """Net that hardly moved, at rest; its rounding is not removed."""
        return self.core.view_settled(self.results)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CompiledRounds:
    """The core on one scene and one mesh.

    Attributes
    ----------
    library : PyDLL
        The core.
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    argument : SceneArgument
        The same as the core takes it.
    places : mapping of slice
        Of each result of a round in the array of all.
    kept : tuple of ndarray, each of any shape
        Arrays whose addresses the argument has.
    """

    library: ctypes.PyDLL
    problem: SteadyProblem
    argument: SceneArgument
    places: Mapping[str, slice]
    kept: _Arrays

    def play(
        self,
        curve: Floats,
        start: Known,
        tolerance: float,
        still: float,
        max_iterations: int,
    ) -> Played | None:
        """A round; None where a step of it fails.

        Parameters
        ----------
        curve : ndarray, shape (2, n_net)
            Of the net in the snow [thickness].
        start : Known
            Where it starts; the results of another round, for one.
        tolerance : float
            Relative error that the last step of the flow may leave [-].
        still : float
            A net that moves less is settled [thickness].
        max_iterations : int
            Newton steps allowed.

        Raises
        ------
        ValueError
            If an array is not of its shape.
        """
        given = to_floats(curve, (2, self.n_net))  # a copy lives as long as the call
        results = np.empty(self.places["marks"].stop)
        is_known = self._copy_start(start, results)
        self.argument.effort = ask_effort(tolerance, max_iterations)
        code = self.library.nd_round(
            ctypes.byref(self.argument),
            ctypes.c_void_p(locate(given)),
            ctypes.c_double(still),
            int(self.places["shear"].stop > self.places["shear"].start),
            int(is_known),
            ctypes.c_int64(results.size),
            ctypes.c_void_p(locate(results)),
        )
        if require_sound(code):
            return None
        effort = self.argument.effort
        return Played(
            core=self,
            results=results,
            linear_solves=effort.steps,
            change=effort.change,
        )

    def _copy_start(self, start: Known, results: Floats) -> bool:
        """Write where a round starts into its results; whether the flow is known."""
        places = self.places
        if isinstance(start, Played) and start.core is self:
            going_on = slice(places["unknowns"].start, places["pull"].stop)
            for part in (going_on, places["marks"]):
                results[part] = start.results[part]
            return True
        state, hanging = start.state, start.hanging
        if state is not None:
            _copy_state(state, self.view_state(results))
        results[places["parts"]] = hanging.parts
        results[places["pull"]] = hanging.cable.pull
        return state is not None

    @property
    def n_net(self) -> int:
        """Number of the net's nodes in the snow."""
        return int(self.problem.template.net.size)

    def view_mesh(self, results: Floats) -> PlacedMesh:
        """Mesh of a round.

        Parameters
        ----------
        results : ndarray, shape (n,)
            Of the round.
        """
        places, template = self.places, self.problem.template
        n_triangles = template.triangles.shape[1]
        return PlacedMesh(
            template=template,
            nodes=results[places["nodes"]].reshape(2, -1),
            weights=results[places["weights"]].reshape(n_triangles, -1),
            gradients=results[places["gradients"]].reshape(2, n_triangles, -1, 6),
            folded=None,
            dofs=list_dofs(template, "velocity"),
            load=results[places["unit_load"]],
            net_normal=results[places["normal"]].reshape(2, -1),
            axes=results[places["axes"]].reshape(2, -1),
        )

    def view_state(self, results: Floats) -> FlowState:
        """Flow of a round.

        Parameters
        ----------
        results : ndarray, shape (n,)
            Of the round.
        """
        places, template = self.places, self.problem.template
        shear = results[places["shear"]]
        marks = results[places["marks"]].view(np.bool_)
        n_net, n_ground = self.n_net - 1, template.ground.size - 1
        return FlowState(
            unknowns=results[places["unknowns"]],
            reaction=results[places["reaction"]],
            stress=results[places["stress"]].reshape(template.triangles.shape[1], 3, 3),
            base_shear=shear.reshape(-1, EDGE_WEIGHTS.size) if shear.size else None,
            contact=Contact(
                sign=results[places["sign"]].view(np.int64),
                is_pressed=marks[:n_net],
                is_open=marks[n_net : 2 * n_net],
                is_lifted=marks[2 * n_net : 2 * n_net + n_ground],
            ),
        )

    def view_hanging(self, results: Floats, prefix: str = "") -> Hanging:
        """Net of a round.

        Parameters
        ----------
        results : ndarray, shape (n,)
            Of the round.
        prefix : str
            ``settled_`` for that under the forces of the stresses alone.
        """
        places = self.places
        ends = results[places[f"{prefix}ends"]]
        cable = Funicular(
            outcome=Outcome.CONVERGED,
            curve=results[places[f"{prefix}curve"]].reshape(2, -1),
            pull=results[places[f"{prefix}pull"]],
            tension=results[places[f"{prefix}tension"]].reshape(2, -1),
            foot_pull=ends[:2],
            head_pull=ends[2:],
        )
        return Hanging(
            cable=cable,
            parts=results[places[f"{prefix}parts"]],
            forces=results[places[f"{prefix}forces"]].reshape(2, -1),
            lengths=results[places[f"{prefix}lengths"]],
        )

    def view_settled(self, results: Floats) -> Settled | None:
        """Forces and net of a round that settled.

        Parameters
        ----------
        results : ndarray, shape (n,)
            Of the round.
        """
        places, template = self.places, self.problem.template
        unbalanced = float(results[places["unbalanced"]][0])
        if unbalanced < 0.0:
            return None
        hanging = self.view_hanging(results, "settled_")
        forces = SupportForces(
            on_net=hanging.forces[:, : self.n_net],
            on_ground=results[places["on_ground"]],
            ground_normal=results[places["ground_normal"]][may_lift(template)],
            unbalanced=unbalanced,
        )
        return Settled(forces, hanging)


def prepare_rounds(problem: SteadyProblem) -> CompiledRounds | None:
    """The core for rounds of a scene on a mesh; None where NumPy has to do.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    """
    library = find_core()
    if library is None or problem.snow.element != "velocity":
        return None
    described = describe_scene(library, problem)
    if described is None:
        return None
    return CompiledRounds(library=library, problem=problem, **described._asdict())


def _copy_state(start: FlowState, to: FlowState) -> None:
    for name in ("unknowns", "reaction", "stress", "base_shear"):
        if (own := getattr(to, name)) is not None:
            own[...] = getattr(start, name)
    for name in ("sign", "is_pressed", "is_open", "is_lifted"):
        getattr(to.contact, name)[:] = getattr(start.contact, name)
