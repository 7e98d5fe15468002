"""A round of flow and net by the compiled core; the same as the steps of ``rounds``.

One call for the mesh along a curve, the flow on it, and the net under its forces.
Theory: core/THEORY.md.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import accumulate
from typing import Any, NamedTuple, Protocol

import numpy as np

from netdesign.cable.funicular import CLOSED, Funicular
from netdesign.core.arguments import (
    LawArgument,
    MeshArgument,
    SceneArgument,
    locate,
    locate_all,
    to_floats,
)
from netdesign.core.library import find_core, require_sound
from netdesign.coupling.interface import SupportForces
from netdesign.coupling.steady.hanging import (
    Hanging,
    SteadyProblem,
    cut_net,
)
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome
from netdesign.snow.compiled import (
    describe_law,
    describe_rules,
    describe_template,
)
from netdesign.snow.compiled_mesh import describe_placement
from netdesign.snow.contact import Contact, may_lift
from netdesign.snow.element import list_dofs
from netdesign.snow.flow import ask_effort, make_linear
from netdesign.snow.flow_state import FlowState
from netdesign.snow.kernel import share_end_load
from netdesign.snow.law import FlowProblem, sample_material
from netdesign.snow.mesh import MeshTemplate, follow_net
from netdesign.snow.placed_mesh import (
    EDGE_SHAPE,
    EDGE_TANGENT,
    EDGE_WEIGHTS,
    PlacedMesh,
)
from netdesign.snow.shared_mesh import find_once

# Fields of ``SceneArgument``: which of the net's nodes are beside a node; its parts.
_FRAME = ("below", "rise", "heights", "ends")
_NET = ("shares", "part", "firsts", "rises")

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
    return _prepare(library, problem)


def _prepare(library: ctypes.PyDLL, problem: SteadyProblem) -> CompiledRounds | None:
    template, snow = problem.template, problem.snow
    top = float(problem.head[1])
    form = _describe_form(template, library, top, snow.ground == "sliding")
    if form is None:
        return None
    laws = _describe_laws(snow, template if snow.layers[1:] else None)
    head = np.array(problem.head, dtype=np.float64)
    argument = SceneArgument.from_buffer_copy(form.argument)
    argument.law, argument.first = laws.law, laws.first
    places = _describe_places(template)
    argument.reference, argument.follow = places.addresses
    argument.rules = describe_rules(snow, places.lifts)
    argument.gravity[:] = snow.gravity
    argument.is_uniform = int(laws.density.size == 1)
    argument.density, argument.head = locate_all(laws.density, head)
    argument.end_load = snow.end_load
    argument.length, argument.stiffness = problem.length, problem.stiffness
    return CompiledRounds(
        library=library,
        problem=problem,
        argument=argument,
        places=form.places,
        kept=(*form.kept, *places.kept, *laws.kept, laws.density, head),
    )


class _Laws(NamedTuple):
    """Laws of creep and sliding as the core takes them, and the snow's density."""

    law: LawArgument
    first: LawArgument  # of linear creep
    density: Floats
    kept: _Arrays


@lru_cache(maxsize=8)  # every mesh of a scene asks
def _describe_laws(snow: FlowProblem, template: MeshTemplate | None) -> _Laws:
    """``template`` is that of layered snow; uniform snow is the same on all."""
    described = []
    for problem in (snow, make_linear(snow)):
        material = sample_material(problem, template)
        shape = (template.triangles.shape[1], 3) if template else ()
        described.append(describe_law(problem, material, shape))
    (law, kept), (first, more) = described
    density = np.array(sample_material(snow, template).density, dtype=np.float64)
    return _Laws(law, first, density, (*kept, *more))


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
    frame, net = _describe_frame(template), _describe_net(template, top)
    end = share_end_load(template)
    mesh = MeshArgument(*described.counts, *described.numbers)
    mesh.edge_shape = locate(EDGE_SHAPE)
    argument = SceneArgument(place=describe_placement(template, EDGE_TANGENT))
    # numbers have caches of their own: the form keeps the arrays of one alone
    argument.place.triangles, argument.place.net = mesh.triangles, mesh.net
    argument.mesh, argument.plan = mesh, described.plan
    argument.n_vertices = template.n_vertices
    for name, place in zip(_FRAME, locate_all(*frame), strict=True):
        setattr(argument, name, place)
    for name, place in zip(_NET, locate_all(*net), strict=True):
        setattr(argument, name, place)
    argument.end_share, argument.edge_weights = locate_all(end, EDGE_WEIGHTS)
    argument.n_elements, argument.n_parts = net[0].size, net[-1].size
    argument.tolerance = CLOSED
    return _Form(
        argument=argument,
        places=_lay_out(template, net[0].size, net[-1].size, slides=slides),
        kept=(*described.kept, *frame, *net, end, template.orientation),
    )


def _describe_net(template: MeshTemplate, top: float) -> _Arrays:
    """The net's parts, as ``Scene`` of round.c has them."""
    parts = cut_net(template, top)
    return (
        np.ascontiguousarray(parts.shares, dtype=np.float64),
        np.ascontiguousarray(parts.part, dtype=np.int64),
        np.ascontiguousarray(parts.firsts, dtype=np.int64),
        np.ascontiguousarray(parts.rises, dtype=np.float64),
    )


class _Places(NamedTuple):
    """Nodes of a template, how they follow the net, and which may lift."""

    kept: _Arrays
    addresses: tuple[int, int]  # of the first two
    lifts: int


@lru_cache(maxsize=256)
def _describe_places(template: MeshTemplate) -> _Places:
    nodes = np.ascontiguousarray(template.nodes, dtype=np.float64)
    follow = np.ascontiguousarray(follow_net(template), dtype=np.float64)
    lifts = may_lift(template)
    return _Places(
        kept=(nodes, follow, lifts),
        addresses=(locate(nodes), locate(follow)),
        lifts=locate(lifts),
    )


def _describe_frame(template: MeshTemplate) -> _Arrays:
    """Places of nodes between those of the net, as ``Scene`` of round.c has them."""
    heights, of_net = template.nodes[1], template.net_fractions
    below = np.searchsorted(of_net, heights, side="right") - 1
    below = np.clip(below, 0, of_net.size - 1)
    rise = np.where(below < of_net.size - 1, heights - of_net[below], 0.0)
    return (
        np.ascontiguousarray(below, dtype=np.int32),
        np.maximum(rise, 0.0),
        np.ascontiguousarray(of_net, dtype=np.float64),
        np.ascontiguousarray(template.edges, dtype=np.int32),
    )


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


def _copy_state(start: FlowState, to: FlowState) -> None:
    for name in ("unknowns", "reaction", "stress", "base_shear"):
        if (own := getattr(to, name)) is not None:
            own[...] = getattr(start, name)
    for name in ("sign", "is_pressed", "is_open", "is_lifted"):
        getattr(to.contact, name)[:] = getattr(start.contact, name)
