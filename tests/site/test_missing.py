"""What a row lacks is told in one go, not the forces' lack first."""

import copy

import pytest

from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.reader import read_site
from netdesign.site.template.workbook import load_example
from tests.site_lines import write_lines

NAMES = {(plan.name, one.key): one.label for plan in SHEETS for one in plan.fields}
FORCES = ("uphill_anchor_distance", "downhill_anchor_distance", "snow_layers")
LATER = [
    *(("Nets", key) for key in ("uphill_guy", "post", "foot_anchor")),
    *(("Nets", "downhill_anchor"), ("Posts", "bearing")),
]


def read_without(path, cells):
    """Site of the example without some columns."""
    lines = copy.deepcopy(load_example())
    for sheet, key in cells:
        for line in lines[sheet]:
            line.pop(key, None)
    write_lines(path, lines)
    return read_site(path)


@pytest.mark.long
@pytest.mark.parametrize("later", LATER, ids=map(str, LATER))
@pytest.mark.parametrize("first", FORCES)
def test_what_checks_lack_is_named_with_what_forces_lack(tmp_path, first, later):
    site = read_without(tmp_path / "site.xlsx", [("Nets", first), later])
    told = [list(map(str, row.unsaid)) for row in site.rows]
    assert all(NAMES["Nets", first] in one for one in told)
    named = NAMES[later]
    with_sheet = f"{named} (sheet {later[0]})"
    assert any({named, with_sheet}.intersection(one) for one in told)


def test_a_row_that_only_its_checks_lack_something_has_forces(tmp_path):
    site = read_without(tmp_path / "site.xlsx", [("Nets", "anchor_axes")])
    assert not any(row.unsaid for row in site.rows)


def test_a_whole_row_lacks_nothing(tmp_path):
    site = read_without(tmp_path / "site.xlsx", [("Nets", "slack")])
    told = {row.id: list(map(str, row.unsaid)) for row in site.rows}
    assert told["R1"] == told["R7"] == ["slack"]
    assert told["R3"] == ["slack", "bearing resistance"]
