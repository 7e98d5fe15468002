"""Post spacing at which a check passes: in proportion to its width."""

from netdesign.structure.row_position import LoadedWidth
from netdesign.study.remedies import find_spacing_remedy


def test_spacing_is_in_proportion_inside_the_row():
    width = LoadedWidth(position="intermediate", width=4.0)
    assert find_spacing_remedy(4.0, width, 1.25).bound == 3.2


def test_spacing_at_the_edge_leaves_its_end_effect():
    """Edge 4 / 2 + 1.5 * 2 = 5 m, used 1.25: 4 m allowed, 2 (4 - 3) = 2 m."""
    width = LoadedWidth(position="edge", width=5.0, end_factor=1.5, end_length=2.0)
    assert find_spacing_remedy(4.0, width, 1.25).bound == 2.0
    assert find_spacing_remedy(4.0, width, 2.0).bound is None
