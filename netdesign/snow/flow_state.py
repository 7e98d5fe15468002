"""State of the flow: velocities, stresses and forces at one instant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.snow.contact import Contact, start_contact
from netdesign.snow.law import FlowProblem
from netdesign.snow.placed_mesh import PlacedMesh


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FlowState:
    """One iterate, or the solution, of the flow problem.

    Attributes
    ----------
    unknowns, reaction : ndarray, shape (n_dofs,)
        Velocities (and pressures), and forces that net and ground exert on the
        snow, node axes.
    stress : ndarray, shape (n_triangles, n_points, 3 or 4)
        (xx, yy, xy); in the mixed element of the deviator, then the pressure.
    base_shear : ndarray, shape (n_edges, n_points) or None
        Shear stress on a sliding ground.
    contact : Contact
        Stick, slip and loss of contact on net and ground.
    """

    unknowns: Floats
    reaction: Floats
    stress: Floats
    base_shear: Floats | None
    contact: Contact

    def largest_velocity(self, mesh: PlacedMesh) -> float:
        """Largest velocity of all nodes.

        Parameters
        ----------
        mesh : PlacedMesh
            Of the state.

        Returns
        -------
        float
            [velocity scale].
        """
        return float(np.hypot(*mesh.to_slope_axes(self.unknowns)).max())


def rest(problem: FlowProblem, mesh: PlacedMesh) -> FlowState:
    """Snow without stress or velocity, held everywhere.

    Parameters
    ----------
    problem, mesh : FlowProblem, PlacedMesh
        Ground, and mesh against the net's curve.
    """
    slides = problem.ground == "sliding"
    return FlowState(
        unknowns=np.zeros(mesh.n_dofs),
        reaction=np.zeros(mesh.n_dofs),
        stress=np.zeros((*mesh.weights.shape, 4 if mesh.is_mixed else 3)),
        base_shear=np.zeros_like(mesh.base.weights) if slides else None,
        contact=start_contact(mesh),
    )
