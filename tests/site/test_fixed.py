"""Single values and words of empty cells, as a row lists them."""

import copy

import pytest

from netdesign.site.reader import read_site
from tests.old_example import load_example
from tests.site_lines import write_lines

EMPTIED = {
    "design_life": [("Nets", "design_life")],
    "anchor_axes": [("Nets", "anchor_axes")],
    "guy_anchors": [("Nets", "guy_anchors")],
    "panel_system": [("Nets", "panel_system")],
    "net_cut": [("Nets", "net_cut")],
    "anchor_kind": [("Anchors", "kind"), ("Anchors", "lever_arm")],
    "lever_arm": [("Anchors", "lever_arm")],
    "base_friction": [("Posts", "base_friction")],
    "end_guy_angle": [("Ends", "end_guy_angle")],
    "support_types": [("Ends", "support_types")],
}


def list_keys(path, cells):
    """What is assumed of the rows of the example without some columns, in all."""
    lines = copy.deepcopy(load_example())
    for sheet, key in cells:
        for line in lines[sheet]:
            line.pop(key, None)
    write_lines(path, lines)
    return {one.key for row in read_site(path).rows for one in row.assumed}


def test_of_the_example_which_types_everything_nothing_is_assumed(tmp_path):
    assert list_keys(tmp_path / "site.xlsx", []) == set()


@pytest.mark.parametrize("key", EMPTIED)
def test_what_is_emptied_is_listed_and_nothing_else(tmp_path, key):
    kind_alone = {"lever_arm"} if key == "anchor_kind" else set()
    assert list_keys(tmp_path / "site.xlsx", EMPTIED[key]) == {key} | kind_alone
