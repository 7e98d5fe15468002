"""Rounds of flow and net by the compiled core; the same as the steps of ``round.py``.

One call for the mesh along a curve, the flow on it, and the net under its forces. What
hangs on the mesh alone is found once for all scenes on it. Theory: core/THEORY.md.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import accumulate
from typing import Any, NamedTuple

import numpy as np

from netdesign.cable.funicular import CLOSED, Funicular
from netdesign.core.arguments import (
    EffortArgument,
    LawArgument,
    MeshArgument,
    SceneArgument,
    locate,
    point_to,
    to_floats,
)
from netdesign.core.library import SINGULAR, find_core, require_sound
from netdesign.coupling.interface import SupportForces
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.net import NetEquilibrium, SteadyProblem, cut_net
from netdesign.coupling.steady.round import OffMeshError, RoundResult, explain_flow
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.compiled import (
    describe_law,
    describe_placement,
    describe_rules,
    describe_template,
)
from netdesign.snow.contact import Contact, FlowState, may_lift
from netdesign.snow.element import find_once, list_dofs
from netdesign.snow.flow import (
    FIELD_WEIGHT,
    LINEAR_PART,
    PATIENCE,
    SQUARE_FACTOR,
    make_linear,
)
from netdesign.snow.kernel import SingularError, share_end_load
from netdesign.snow.law import FlowProblem, sample_material
from netdesign.snow.mesh import MeshTemplate, follow_net
from netdesign.snow.placed_mesh import EDGE_SHAPE, EDGE_WEIGHTS, PlacedMesh
from netdesign.words.message import say

_Arrays = tuple[np.ndarray[Any, Any], ...]

# What keeps a round from its end, as in round.h.
OFF_MESH, GAVE_UP, NOT_FINITE, OPEN, UNPARTED = range(1, 6)
_FLOWS = {GAVE_UP: Outcome.MAX_ITERATIONS, NOT_FINITE: Outcome.NONFINITE}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CompiledRounds:
    """The core on one scene and one mesh.

    Attributes
    ----------
    library : PyDLL
        The core.
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    still : float
        A net that moves less in a round also hangs under the forces of the stresses
        [thickness].
    argument : SceneArgument
        Scene and mesh as the core takes them.
    places : mapping of slice
        Of each result of a round in the array of all.
    kept : tuple of ndarray, each of any shape
        Arrays whose addresses the argument has.
    """

    library: ctypes.PyDLL
    problem: SteadyProblem
    still: float
    argument: SceneArgument
    places: Mapping[str, slice]
    kept: _Arrays

    def take(
        self,
        curve: Floats,
        state: FlowState | None,
        net: NetEquilibrium,
        tolerance: float,
    ) -> RoundResult:
        """A round, as ``take_round`` takes it.

        Parameters
        ----------
        curve : ndarray, shape (2, n_net)
            Of the net [thickness].
        state : FlowState or None
            Where the flow starts; None if nothing is known of it.
        net : NetEquilibrium
            As it hung last.
        tolerance : float
            Relative error that the last step of the flow may leave [-].

        Raises
        ------
        SolveError
            If there is no mesh, no flow or no equilibrium of the net.
        ValueError
            If an array is not of its shape.
        """
        results = self._lay_out(net.cable.pull, net.parts)
        code = self.play(curve, state, tolerance, results)
        if code == OFF_MESH:
            raise OffMeshError(curve)
        if code in _FLOWS:
            raise explain_flow(self.problem, _FLOWS[code])
        _require_hung(code)
        net = self._view_net(results)
        return RoundResult(
            curve=curve,
            image=net.cable.curve[:, : self.n_net],
            mesh=self._view_mesh(results),
            state=self.view_state(results),
            net=net,
            linear_solves=self.argument.effort.steps,
            change=self.argument.effort.change,
            condense=partial(self._condense, results),
            from_stresses=self._view_from_stresses(results),
        )

    def play(
        self, curve: Floats, state: FlowState | None, tolerance: float, results: Floats
    ) -> int:
        """Round whose results go where a net's pull and parts stand; how it ended.

        Parameters
        ----------
        curve : ndarray, shape (2, n_net)
            Of the net [thickness].
        state : FlowState or None
            Where the flow starts; None if nothing is known of it.
        tolerance : float
            Relative error that the last step of the flow may leave [-].
        results : ndarray, shape (n,)
            Of ``_lay_out``.

        Raises
        ------
        ValueError
            If an array is not of its shape.
        """
        nodes = to_floats(curve, (2, self.n_net))  # a copy lives as long as the call
        if state is not None:
            _copy_state(state, self.view_state(results))
        self.argument.effort.tolerance = tolerance
        return require_sound(
            self.library.nd_round(
                ctypes.byref(self.argument),
                ctypes.c_void_p(locate(nodes)),
                ctypes.c_double(self.still),
                int(state is not None),
                *self._point(results),
            )
        )

    def hang(self, on_net: Floats, pull: Floats, parts: Floats) -> NetEquilibrium:
        """The net under forces, as ``hang_net``.

        Parameters
        ----------
        on_net : ndarray, shape (2, n_net)
            Forces on the nodes in the snow, foot to head [rho g d^2].
        pull : ndarray, shape (2,)
            Guess of the tension near the foot [rho g d^2].
        parts : ndarray, shape (n_parts,)
            Guess of the lengths of its parts [thickness].

        Raises
        ------
        SolveError
            If nothing holds the net, or its contact with the snow's surface is not
            found.
        ValueError
            If an array is not of its shape.
        """
        on_nodes, results = (
            to_floats(on_net, (2, self.n_net)),
            self._lay_out(pull, parts),
        )
        forces = ctypes.c_void_p(locate(on_nodes))
        where = self._point(results)
        code = self.library.nd_hang(ctypes.byref(self.argument), forces, *where)
        _require_hung(require_sound(code))
        return self._view_net(results)

    def _condense(self, results: Floats) -> Floats:
        """Forces on the net per velocity of its nodes, as ``condense_to_net``."""
        root = np.empty((2 * self.n_net, 2 * self.n_net))
        place, where = ctypes.c_void_p(locate(root)), self._point(results)
        code = self.library.nd_root(ctypes.byref(self.argument), *where, place)
        if code == SINGULAR:
            raise SingularError("singular")
        require_sound(code)
        return root

    def _lay_out(self, pull: Floats, parts: Floats) -> Floats:
        """Array for the results of a round, in which a net stands."""
        results = np.empty(self.places["marks"].stop)
        results[self.places["pull"]], results[self.places["parts"]] = pull, parts
        return results

    def _point(self, results: Floats) -> tuple[int, ctypes.c_int64, ctypes.c_void_p]:
        """Results as the core's functions take them, and whether the ground slides."""
        shear = self.places["shear"]
        size, place = ctypes.c_int64(results.size), ctypes.c_void_p(locate(results))
        return int(shear.stop > shear.start), size, place

    @property
    def n_net(self) -> int:
        """Number of the net's nodes in the snow."""
        return int(self.problem.template.net.size)

    def _view_mesh(self, results: Floats) -> PlacedMesh:
        places, template = self.places, self.problem.template
        n_triangles = template.triangles.shape[1]
        return PlacedMesh(
            template=template,
            nodes=results[places["nodes"]].reshape(2, -1),
            weights=results[places["weights"]].reshape(n_triangles, -1),
            gradients=results[places["gradients"]].reshape(2, n_triangles, -1, 6),
            dofs=list_dofs(template, "velocity"),
            load=results[places["unit_load"]],
            net_normal=results[places["normal"]].reshape(2, -1),
            axes=results[places["axes"]].reshape(2, -1),
        )

    def view_state(self, results: Floats) -> FlowState:
        """State of the flow in the results of a round.

        Parameters
        ----------
        results : ndarray, shape (n,)
            Of ``_lay_out``.
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

    def _view_net(self, results: Floats, prefix: str = "") -> NetEquilibrium:
        """Net under the reactions; ``settled_``: under the forces of the stresses."""
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
        return NetEquilibrium(
            cable=cable,
            parts=results[places[f"{prefix}parts"]],
            forces=results[places[f"{prefix}forces"]].reshape(2, -1),
            lengths=results[places[f"{prefix}lengths"]],
        )

    def _view_from_stresses(
        self, results: Floats
    ) -> tuple[SupportForces, NetEquilibrium] | None:
        places, template = self.places, self.problem.template
        unbalanced = float(results[places["unbalanced"]][0])
        if unbalanced < 0.0:
            return None
        net = self._view_net(results, "settled_")
        forces = SupportForces(
            on_net=net.forces[:, : self.n_net],
            on_ground=results[places["on_ground"]],
            ground_normal=results[places["ground_normal"]][may_lift(template)],
            unbalanced=unbalanced,
        )
        return forces, net


def _copy_state(start: FlowState, to: FlowState) -> None:
    for name in ("unknowns", "reaction", "stress", "base_shear"):
        if (own := getattr(to, name)) is not None:
            own[...] = getattr(start, name)
    for name in ("sign", "is_pressed", "is_open", "is_lifted"):
        getattr(to.contact, name)[:] = getattr(start.contact, name)


def _require_hung(code: int) -> None:
    if code == OPEN:
        raise SolveError(Outcome.NO_EQUILIBRIUM)
    if code == UNPARTED:
        raise SolveError(Outcome.NO_EQUILIBRIUM, say("steady.contact_not_found"))


def prepare_rounds(
    problem: SteadyProblem, settings: SolverSettings, still: float
) -> CompiledRounds | None:
    """The core for rounds of a scene on a mesh; None where NumPy has to do.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    settings : SolverSettings
        Newton steps allowed in a round.
    still : float
        A net that moves less in a round also hangs under the forces of the stresses
        [thickness].
    """
    library, template, snow = find_core(), problem.template, problem.snow
    if library is None or snow.element != "velocity":
        return None
    top = float(problem.head[1])
    form = _describe_form(template, library, top, snow.ground == "sliding")
    if form is None:
        return None
    argument = SceneArgument.from_buffer_copy(form.argument)
    layered = template if problem.is_layered else None
    law, first, density, kept = _describe_laws(snow, layered)
    argument.law, argument.first = law, first
    argument.is_uniform = int(density.size == 1)
    arrays = {
        "reference": np.ascontiguousarray(template.nodes, dtype=np.float64),
        "follow": np.ascontiguousarray(follow_net(template), dtype=np.float64),
        "density": density,
        "head": np.array(problem.head, dtype=np.float64),
    }
    point_to(argument, **arrays)
    lifts = may_lift(template)
    argument.rules = describe_rules(snow, locate(lifts))
    argument.gravity[:] = snow.gravity
    argument.end_load = snow.end_load
    argument.length, argument.stiffness = problem.length, problem.stiffness
    argument.effort = EffortArgument(
        linear_part=LINEAR_PART,
        square_factor=SQUARE_FACTOR,
        field_weight=FIELD_WEIGHT,
        most_steps=settings.max_iterations,
        patience=PATIENCE,
    )
    return CompiledRounds(
        library=library,
        problem=problem,
        still=still,
        argument=argument,
        places=form.places,
        kept=(*form.kept, *kept, *arrays.values(), lifts),
    )


@lru_cache(maxsize=8)  # every mesh of a scene asks
def _describe_laws(
    snow: FlowProblem, template: MeshTemplate | None
) -> tuple[LawArgument, LawArgument, Floats, _Arrays]:
    """Laws of the snow and of its linear creep, density, and arrays to keep.

    ``template`` is that of layered snow; uniform snow is the same on all.
    """
    shape = (template.triangles.shape[1], 3) if template else ()
    material = sample_material(snow, template)
    law, kept = describe_law(snow, material, shape)
    linear = make_linear(snow)
    first, more = describe_law(linear, sample_material(linear, template), shape)
    density = np.array(material.density, dtype=np.float64)
    return law, first, density, (*kept, *more)


class _Form(NamedTuple):
    """A template and a net of some height as the core takes them."""

    argument: SceneArgument
    places: Mapping[str, slice]
    kept: _Arrays


@find_once
def _describe_form(
    template: MeshTemplate, library: ctypes.PyDLL, top: float, slides: bool
) -> _Form | None:
    described = describe_template(template, library)
    if described is None:
        return None
    frame, net = _describe_frame(template), cut_net(template, top)
    end = share_end_load(template)
    mesh = MeshArgument(*described.counts, *described.numbers)
    mesh.edge_shape = locate(EDGE_SHAPE)
    placement = describe_placement(described, template.orientation)
    argument = SceneArgument(place=placement, mesh=mesh, plan=described.plan)
    argument.n_vertices = template.n_vertices
    point_to(argument, **frame, **net._asdict())
    point_to(argument, end_share=end, edge_weights=EDGE_WEIGHTS)
    argument.n_elements, argument.n_parts = net.shares.size, net.rises.size
    argument.tolerance = CLOSED
    return _Form(
        argument=argument,
        places=_lay_out(template, net.shares.size, net.rises.size, slides=slides),
        kept=(*described.kept, *frame.values(), *net, end, template.orientation),
    )


def _describe_frame(template: MeshTemplate) -> dict[str, np.ndarray[Any, Any]]:
    """Places of nodes between those of the net, as ``Scene`` of round.c has them."""
    heights, of_net = template.nodes[1], template.net_fractions
    below = np.searchsorted(of_net, heights, side="right") - 1
    below = np.clip(below, 0, of_net.size - 1)
    rise = np.where(below < of_net.size - 1, heights - of_net[below], 0.0)
    return {
        "below": np.ascontiguousarray(below, dtype=np.int32),
        "rise": np.maximum(rise, 0.0),
        "heights": np.ascontiguousarray(of_net, dtype=np.float64),
        "ends": np.ascontiguousarray(template.edges, dtype=np.int32),
    }


def _lay_out(
    template: MeshTemplate, n_elements: int, n_parts: int, *, slides: bool
) -> dict[str, slice]:
    """Places of a round's results; round.c has the same list."""
    nodes, net = template.nodes.shape[1], template.net.size
    points, ground = 3 * template.triangles.shape[1], template.ground.size - 1
    edges = ground // 2 * EDGE_WEIGHTS.size
    on_net = 2 * (2 * n_elements + 1)
    hung = {
        **{"forces": on_net, "lengths": n_elements, "parts": n_parts},
        **{"curve": on_net, "pull": 2, "tension": 2 * n_elements, "ends": 4},
    }
    sizes = {
        **{"nodes": 2 * nodes, "weights": points, "gradients": 12 * points},
        **{"unit_load": nodes, "normal": 2 * net, "axes": 2 * nodes},
        **{"edge_weights": edges, "load": 2 * nodes},
        **{"unknowns": 2 * nodes, "reaction": 2 * nodes, "stress": 3 * points},
        "shear": edges if slides else 0,
        "sign": net - 1,
        **hung,
        **{f"settled_{name}": size for name, size in hung.items()},
        **{"residual": 2 * nodes, "on_ground": 2, "ground_normal": ground},
        **{"unbalanced": 1, "way": 1, "marks": (2 * (net - 1) + ground) // 8 + 1},
    }
    ends = accumulate(sizes.values())
    return {
        name: slice(end - size, end)
        for (name, size), end in zip(sizes.items(), ends, strict=True)
    }
