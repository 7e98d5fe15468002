"""Order of the compiled core, against an order of least degrees."""

import numpy as np
import pytest

from netdesign.core.library import find_core
from netdesign.coupling.scene import MESH_LEVELS
from netdesign.snow.compiled import describe_template
from netdesign.snow.mesh import build_template

HEAD, RECORD = 9, 5  # words, as in core.h
NEEDS_CORE = pytest.mark.skipif(find_core() is None, reason="no compiled core")


def read_fronts(template):
    """Pivots, size, and triangles of each front; nodes have two unknowns."""
    plan = describe_template(template, find_core()).kept[-1]
    records = plan[HEAD : HEAD + RECORD * plan[4]].reshape(-1, RECORD)
    return records[:, [0, 1, 3]].T


def count_front_work(template):
    """Products of the factor: of each pivot the square of what is left with it."""
    return sum(
        float(np.square(2 * size - np.arange(2 * pivots)).sum())
        for pivots, size, _ in read_fronts(template).T
    )


def count_least_degree_work(template):
    """The same where the node of the fewest neighbours goes first, the net's never."""
    beside = [set() for _ in range(template.nodes.shape[1])]
    for nodes in template.triangles.T.tolist():
        for node in nodes:
            beside[node].update(nodes)
    for node, others in enumerate(beside):
        others.discard(node)
    left, work = set(range(len(beside))) - set(template.net.tolist()), 0.0
    while left:
        node = min(left, key=lambda one: len(beside[one]))
        left.discard(node)
        size = 2 * (len(beside[node]) + 1)
        work += size**2 + (size - 1) ** 2
        for other in beside[node]:
            beside[other] |= beside[node]
            beside[other] -= {other, node}
    return work


@NEEDS_CORE
@pytest.mark.parametrize(("aspect", "level"), [(3.7, 2), (5.1, 2), (8.7, 2)])
def test_parts_cost_no_more_than_an_order_of_least_degrees(aspect, level):
    """Rays keep the separators of the rings short; without them it is 1.4 times."""
    template = build_template(aspect, MESH_LEVELS[level])
    assert count_front_work(template) < 1.25 * count_least_degree_work(template)


@NEEDS_CORE
@pytest.mark.parametrize("level", range(4))
@pytest.mark.parametrize("tops", [(), (0.27, 0.61)])
def test_every_triangle_is_in_one_part_and_no_part_is_empty(level, tops):
    template = build_template(6.3, MESH_LEVELS[level], tops)
    counts = read_fronts(template)[2]
    leaves = counts[counts > 0]
    assert leaves.sum() == template.triangles.shape[1]
    assert 2 * leaves.size - 1 == counts.size
