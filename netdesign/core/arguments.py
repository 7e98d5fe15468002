"""Arguments of the core's functions: structures of C, and arrays as addresses.

A structure keeps no array alive; whoever fills one does.
"""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from netdesign.numerics.arrays import Floats

_POINTER, _INT, _REAL = ctypes.c_void_p, ctypes.c_int32, ctypes.c_double


class MeshArgument(ctypes.Structure):
    """``Mesh`` of element.h: a placed mesh and the load on it."""

    _fields_ = [
        *((name, _INT) for name in ("n_nodes", "n_triangles", "n_net", "n_edges")),
        *((name, _POINTER) for name in ("triangles", "net", "ground", "edges")),
        *((name, _POINTER) for name in ("gradients", "weights", "axes")),
        *((name, _POINTER) for name in ("edge_weights", "edge_shape", "load")),
    ]


class LawArgument(ctypes.Structure):
    """``Law`` of element.h: creep and sliding."""

    _fields_ = [
        *((name, _REAL) for name in ("exponent", "slip_exponent", "floor")),
        *((name, _INT) for name in ("stride", "slip_stride")),
        *((name, _POINTER) for name in ("bulk", "fluidity", "slip")),
    ]


class RulesArgument(ctypes.Structure):
    """``Rules`` of element.h: friction, and what may let go."""

    _fields_ = [
        ("friction", _REAL),
        *((name, _INT) for name in ("net_lets_go", "ground_lets_go", "holds_along")),
        ("may_lift", _POINTER),
    ]


class EffortArgument(ctypes.Structure):
    """``Effort`` of round.h: what is asked of a flow, and what it took."""

    _fields_ = [
        *((name, _REAL) for name in ("tolerance", "linear_part")),
        *((name, _REAL) for name in ("square_factor", "field_weight")),
        *((name, _INT) for name in ("most_steps", "patience", "steps")),
        ("change", _REAL),
    ]


class PlacementArgument(ctypes.Structure):
    """``Placement`` of round.h: a template, where its nodes are, and the results."""

    _fields_ = [
        *((name, _INT) for name in ("n_nodes", "n_triangles", "n_net")),
        *((name, _POINTER) for name in ("triangles", "net", "orientation")),
        *((name, _POINTER) for name in ("reference", "shape", "point_weights")),
        *((name, _POINTER) for name in ("edge_tangent", "nodes", "gradients")),
        *((name, _POINTER) for name in ("weights", "load", "axes", "normal")),
    ]


class SceneArgument(ctypes.Structure):
    """``Scene`` of round.c: a scene on one mesh."""

    _fields_ = [
        *(("place", PlacementArgument), ("mesh", MeshArgument)),
        *(("law", LawArgument), ("first", LawArgument), ("rules", RulesArgument)),
        *(("plan", _POINTER), ("effort", EffortArgument), ("n_vertices", _INT)),
        *((name, _POINTER) for name in ("reference", "follow", "below")),
        *((name, _POINTER) for name in ("rise", "heights", "ends")),
        *(("gravity", _REAL * 2), ("is_uniform", _INT)),
        *((name, _POINTER) for name in ("density", "end_share", "edge_weights")),
        *((name, _INT) for name in ("n_elements", "n_parts")),
        *((name, _POINTER) for name in ("shares", "part", "firsts", "rises", "head")),
        *((name, _REAL) for name in ("end_load", "length", "stiffness", "tolerance")),
    ]


class BodyArgument(ctypes.Structure):
    """``Body`` of history.c: snow of a step where equilibrium is taken."""

    _fields_ = [
        *(("place", PlacementArgument), ("mesh", MeshArgument)),
        *((name, LawArgument) for name in ("law", "first")),
        *((name, _POINTER) for name in ("plan", "is_free")),
        *((name, _POINTER) for name in ("edge_rule", "edge_weights")),
        ("slides", _INT),
    ]


class IterateArgument(ctypes.Structure):
    """``Iterate`` of history.c: velocities and stresses."""

    _fields_ = [
        *((name, _POINTER) for name in ("unknowns", "stress", "shear", "imbalance")),
        ("change", _REAL),
    ]


class YieldingArgument(ctypes.Structure):
    """``Yielding`` of yielding.c: nodes, net, what is asked, and where it ends."""

    _fields_ = [
        ("n", _INT),
        *(("friction", _REAL), ("stiffness", _REAL), ("head", _REAL * 2)),
        *((name, _POINTER) for name in ("positions", "forces", "compliance")),
        ("old_lengths", _POINTER),
        *((name, _REAL) for name in ("last_way", "least_share", "shortest_part")),
        *((name, _REAL) for name in ("breach", "backward", "largest_bend")),
        *((name, _INT) for name in ("most_iterations", "free_rounds", "most_rounds")),
        *((name, _POINTER) for name in ("place", "slides", "signs")),
        *((name, _POINTER) for name in ("lengths", "tensions")),
    ]


class PanelArgument(ctypes.Structure):
    """``Panel`` of panel.c: strips, ropes of each panel, and what is asked."""

    _fields_ = [
        *((name, _INT) for name in ("n_strips", "n_points", "n_shears")),
        *((name, _POINTER) for name in ("offsets", "weights")),
        *((name, _REAL) for name in ("stiffness", "load_size")),
        *((name, _REAL * 2) for name in ("load", "to_foot", "head")),
        *((name, _POINTER) for name in ("lengths", "deflection", "shear")),
        *((name, _POINTER) for name in ("rope_weights", "rope_stiffness", "excess")),
        *((name, _REAL) for name in ("still", "longest_step")),
        *((name, _INT) for name in ("most_steps", "most_halvings")),
    ]


def locate(array: np.ndarray[Any, Any] | None) -> int:
    """Address of a contiguous array; 0 for none.

    Raises
    ------
    ValueError
        If the array is not contiguous.
    """
    if array is None:
        return 0
    if not array.flags.c_contiguous:
        raise ValueError("the compiled core takes contiguous arrays")
    if array.size and array.flags.writeable:  # some twenty times faster
        return ctypes.addressof(ctypes.c_char.from_buffer(array.data))
    return int(array.__array_interface__["data"][0])


def locate_all(*arrays: np.ndarray[Any, Any] | None) -> list[int]:
    """Addresses of contiguous arrays, as ``locate``."""
    return [locate(array) for array in arrays]


def point_to(argument: ctypes.Structure, **arrays: np.ndarray[Any, Any]) -> None:
    """Set fields of a structure to the addresses of contiguous arrays."""
    for name, array in arrays.items():
        setattr(argument, name, locate(array))


def to_floats(values: object, shape: tuple[int, ...]) -> Floats:
    """Numbers as the core takes them: of this shape, contiguous.

    Raises
    ------
    ValueError
        If the shape is another.
    """
    array = np.ascontiguousarray(values, dtype=np.float64)
    if array.shape != shape:
        raise ValueError(f"shape {array.shape}, expected {shape}")
    return array
