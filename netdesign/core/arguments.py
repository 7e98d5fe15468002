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
        *((name, _POINTER) for name in ("triangles", "net", "edges")),
        *((name, _POINTER) for name in ("gradients", "weights", "axes")),
        *((name, _POINTER) for name in ("edge_weights", "edge_shape", "load")),
    ]


class LawArgument(ctypes.Structure):
    """``Law`` of element.h: creep and sliding."""

    _fields_ = [
        *((name, _REAL) for name in ("exponent", "slip_exponent", "slip", "floor")),
        ("stride", _INT),
        *((name, _POINTER) for name in ("bulk", "fluidity")),
    ]


class StepArgument(ctypes.Structure):
    """``Step`` of element.h: where a step starts, and where its results go."""

    _fields_ = [
        *((name, _POINTER) for name in ("stress", "shear", "is_free")),
        *((name, _POINTER) for name in ("shares", "bears", "unknowns")),
        *((name, _POINTER) for name in ("reaction", "new_stress", "new_shear")),
        ("root", _POINTER),
    ]


def locate(array: np.ndarray[Any, Any] | None) -> int | None:
    """Address of a contiguous array; None for none.

    Raises
    ------
    ValueError
        If the array is not contiguous.
    """
    if array is None:
        return None
    if not array.flags.c_contiguous:
        raise ValueError("the compiled core takes contiguous arrays")
    return int(array.__array_interface__["data"][0])


def to_floats(values: object, shape: tuple[int, ...]) -> Floats:
    """Values as the core takes them: of this shape, contiguous.

    Raises
    ------
    ValueError
        If the shape is another.
    """
    array = np.ascontiguousarray(values, dtype=np.float64)
    if array.shape != shape:
        raise ValueError(f"shape {array.shape}, expected {shape}")
    return array
