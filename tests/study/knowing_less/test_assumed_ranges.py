"""What is typed inside an assumed range pulls no harder than the range: drawn rows."""

import random

import pytest

from netdesign.coupling.scene import SolverSettings
from netdesign.study.cases import search_site
from netdesign.study.row_to_check import CheckRun
from tests.make import read_tables
from tests.study.knowing_less.drawn_tables import draw_tables, empty

RUN = CheckRun(settings=SolverSettings())
CELLS = (
    *(("net_types", 0, "slack"), ("net_types", 0, "net_stiffness")),
    *(("rows", 0, "upslope_length"), ("rows", 0, "altitude")),
)
QUANTITIES = ("density", "friction_angle", "inclination")
SITES_IN_SUITE, SITES = 3, 3000
OF_OPEN_GROUND = 15  # a site whose downhill guy is loaded most by a smaller N
IN_SUITE = (*range(SITES_IN_SUITE), OF_OPEN_GROUND)


def draw_empty(draw, tables):
    """Cells of snow, net and ground to empty, one at least."""
    is_free = tables["rows"][0]["glide_factor"] == "free"
    cells = [one for one in CELLS if not (is_free and one[2] == "upslope_length")]
    found = [one for one in cells if draw.random() < 0.5]
    found += [("project", 0, one) for one in QUANTITIES if draw.random() < 0.4]
    if not is_free and draw.random() < 0.4:
        found.append(("rows", 0, "glide_factor"))
    return found or [("net_types", 0, "slack")]


def assert_no_harder(seed):
    """No force of what is typed exceeds the demand over what is assumed."""
    tables = draw_tables(seed)
    tables["rows"] = tables["rows"][:1]
    tables["rows"][0].pop("gap", None)
    tables["layers"] = [one for one in tables["layers"] if one["row"] == "R1"]
    cells = draw_empty(random.Random(f"assumed {seed}"), tables)
    solved = []
    for one in (tables, empty(tables, cells)):
        solved += search_site(read_tables(one), RUN)
    typed, assumed = solved
    for member, extreme in typed.extremes.items():
        most = assumed.extremes[member].widened.high
        over = extreme.force.value - most
        assert over <= 1e-3 * max(most, extreme.force.value), (seed, cells, member)


@pytest.mark.parametrize(
    "seed",
    [
        pytest.param(seed, marks=() if seed in IN_SUITE else pytest.mark.slow)
        for seed in range(SITES)
    ],
)
def test_no_value_inside_an_assumed_range_pulls_harder(seed):
    assert_no_harder(7000 + seed)
