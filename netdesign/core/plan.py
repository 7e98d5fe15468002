"""Symbolic phase of a template: the order in which its nodes are eliminated.

Theory: core/THEORY.md, section 1.
"""

from __future__ import annotations

import ctypes

import numpy as np
from numpy.typing import NDArray

from netdesign.core.arguments import locate
from netdesign.core.library import TOO_LARGE, require_sound
from netdesign.numerics.arrays import Floats

Words = NDArray[np.int32]

# Triangles of a smallest part: fewer make more fronts than they save work (measured at
# 63 to 700 triangles).
LEAF = 6
_MOST_NUMBERS = 2**31 - 1  # of a factor: places in it are int32
_WORDS_PER_TRIANGLE = 40  # room for most plans; others are asked for again


def build_plan(
    library: ctypes.PyDLL, triangles: Words, nodes: Floats, net: Words
) -> Words | None:
    """Plan of a template; None where its factor would be too large for the core.

    Parameters
    ----------
    library : PyDLL
        The core.
    triangles : ndarray of int32, shape (n_triangles, 6)
        Their nodes.
    nodes : ndarray, shape (2, n_nodes)
        Reference coordinates [thickness].
    net : ndarray of int32, shape (n_net,)
        Nodes of the net, eliminated last.

    Raises
    ------
    ValueError
        If a node lies in no triangle, or a triangle has nodes that are not there.
    """
    room = _WORDS_PER_TRIANGLE * len(triangles)
    while True:
        plan = np.zeros(room, dtype=np.int32)
        code = library.nd_plan(
            nodes.shape[1],
            len(triangles),
            net.size,
            *(ctypes.c_void_p(locate(one)) for one in (triangles, nodes, net)),
            *(LEAF, _MOST_NUMBERS),
            ctypes.c_void_p(locate(plan)),
            room,
        )
        if code == TOO_LARGE:
            return None
        count = require_sound(code)
        if count <= room:
            plan = plan[:count].copy()
            plan.setflags(write=False)
            return plan
        room = count
