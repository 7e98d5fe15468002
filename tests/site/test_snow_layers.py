"""Layers by net row: from sheet Snow to the scenes that are solved."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.envelope.ranges import Case
from netdesign.snow.creep_law import BOUTILLIER_2004, ICE_DENSITY
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun, build_scene
from tests.grid import wrap_results

SNOW = [
    ["row", "layer", "thickness [m normal]", "density [kg/m3]", "temperature [°C]"],
    ["R1", 1, 1.0, 450, None],
    ["R1", 2, 1.5, 300, None],
    ["R1", 3, 0.5, 200, None],
]
MEAN = (1.0 * 450 + 1.5 * 300 + 0.5 * 200) / 3.0


@pytest.fixture
def layered(book):
    book["Snow"] = [list(row) for row in SNOW]
    return book


def test_layers_are_read_from_the_ground_up_in_any_order(layered):
    layered["Snow"][1:] = [layered["Snow"][k] for k in (3, 1, 2)]
    first, second = layered.read().rows
    assert [layer.density for layer in first.layers] == [450.0, 300.0, 200.0]
    assert [layer.thickness for layer in first.layers] == [1.0, 1.5, 0.5]
    assert first.snow_thickness == 3.0
    assert first.mean_density == pytest.approx(MEAN)
    assert second.layers == ()


def test_vertical_heights_become_thicknesses_and_temperatures_kelvin(layered):
    layered["Snow"][0][2] = "thickness [m vertical]"
    for line, celsius in zip(layered["Snow"][1:], (-1, -5, -8), strict=True):
        line[4] = celsius
    layered["Rows"][0][2] = "snow height [m vertical]"
    row = layered.read().rows[0]
    assert row.layers[1].thickness == pytest.approx(1.5 * math.cos(math.radians(40)))
    assert row.snow_thickness == pytest.approx(3.0 * math.cos(math.radians(40)))
    assert [one.temperature for one in row.layers] == pytest.approx(
        [272.15, 268.15, 265.15]
    )


@pytest.mark.parametrize(
    ("cell", "value", "place", "rule"),
    [
        ((1, 0), "R9", "Snow!A2", "is no id of sheet Rows"),
        ((2, 1), 3, "Snow!B3", "is not layer 2 of net row R1"),
        ((2, 1), 1, "Snow!B3", "is not layer 2 of net row R1"),
        ((1, 1), 2, "Snow!B2", "is not layer 1 of net row R1"),
        ((1, 1), 1.5, "Snow!B2", "is not a whole number"),
        ((1, 2), 1.5, "Rows!C2", "differs from the sum of the layers in sheet Snow"),
        ((1, 2), None, "Snow!C2", "is empty"),
        ((3, 2), 0.02, "Snow!C4", "is below 2% of the snowpack"),
        ((1, 3), "4OO", "Snow!D2", "is not a number"),
        ((1, 3), 899, "Snow!D2", "begins layers of mean density"),
        ((1, 4), -3, "Snow!E3", "is empty beside layers with a temperature"),
        ((1, 4), 3, "Snow!E2", "is out of range"),
    ],
)
def test_faults_of_layers_are_refused(layered, cell, value, place, rule):
    layered["Snow"][cell[0]][cell[1]] = value
    found = [(f"{f.sheet}!{f.cell}", str(f.rule)) for f in layered.refuse()]
    assert any(where == place and what.startswith(rule) for where, what in found), found


def test_a_change_of_height_or_density_keeps_the_proportions(layered):
    """What would flip a check is searched with changed rows: rowcheck.flips."""
    row = replace(layered.read().rows[0], snow_thickness=2.4)
    case = Case(density=300.0, friction_angle=0.5, inclination=0.5)
    pack = build_scene(row, case, BOUTILLIER_2004).snowpack
    assert (pack.thickness, pack.density) == (2.4, 300.0)
    assert [layer.thickness for layer in pack.layers] == pytest.approx([0.8, 1.2, 0.4])
    assert [layer.density for layer in pack.layers] == pytest.approx(
        [density * 300.0 / MEAN for density in (450, 300, 200)]
    )


@pytest.mark.parametrize("is_layered", [True, False])
def test_densities_outside_the_creep_law_are_told_layer_by_layer(layered, is_layered):
    low, high = (bound * ICE_DENSITY for bound in BOUTILLIER_2004.calibrated)
    assert low < 400 < 480 < high  # the range itself is inside
    layered["Project"][1][1] = "400 to 480"
    for line, density in zip(layered["Snow"][1:], (500, 420, 300), strict=True):
        line[3] = density
    mean = (1.0 * 500 + 1.5 * 420 + 0.5 * 300) / 3.0
    if not is_layered:
        del layered["Snow"]
    site = layered.read()
    run = CheckRun(settings=SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2]))
    standard = load_standard("nf-p-95-304-style")
    study = judge_site(
        site, [wrap_results(site, row, [], run) for row in site.rows], standard, run
    )
    notes = [str(note) for note in study.notes if "the creep law" in str(note)]
    if not is_layered:
        assert notes == []
        return
    (note,) = notes
    least, largest = 300 * 400 / mean, 500 * 480 / mean
    told = f"net row R1: layer densities of {least:.4g} to {largest:.4g} kg/m³ lie"
    assert note.startswith(told)
