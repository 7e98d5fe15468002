"""Exported scenes: their files, and an independent code on them."""

import numpy as np
import pytest

from netdesign.evidence.verification.exported import (
    list_another_code,
    list_files,
    load_results,
    solve_exported,
    write_scenes,
)
from tests.verification import quads

SCENES = {scene.name: scene for scene in solve_exported()}


def read_vtk(content):
    """Points, cells by type, density, boundary and forces of a file."""
    lines = iter(content.decode("ascii").splitlines())
    found = {}
    for line in lines:
        head = line.split()
        if head[:1] == ["POINTS"]:
            found["points"] = take(lines, int(head[1]))
        elif head[:1] == ["CELLS"]:
            count = int(head[1])
            found["cells"] = [next(lines).split()[1:] for _ in range(count)]
        elif head[:1] == ["CELL_TYPES"]:
            found["types"] = take(lines, int(head[1]))[:, 0].astype(int)
        elif head[:1] == ["SCALARS"]:
            next(lines)
            found[head[1]] = take(lines, len(found["cells"]))[:, 0]
        elif head[:1] == ["VECTORS"]:
            found[head[1]] = take(lines, len(found["points"]))
    return found


def take(lines, count):
    return np.array(
        [[float(part) for part in next(lines).split()] for _ in range(count)]
    )


@pytest.mark.parametrize("name", SCENES)
def test_file_holds_mass_boundaries_and_forces(name):
    scene = SCENES[name]
    pack = scene.solution.scene.snowpack
    mesh = read_vtk(write_scenes([scene])[f"{name}.vtk"])
    points, types = mesh["points"], mesh["types"]
    cells = [np.array(cell, dtype=int) for cell in mesh["cells"]]
    triangles = np.array(
        [c for c, kind in zip(cells, types, strict=True) if kind == 22]
    )
    edges = np.array([c for c, kind in zip(cells, types, strict=True) if kind == 21])
    # midpoints lie between their corners, but for the curved net
    for corner, middle in ((0, 3), (1, 4), (2, 5)):
        ends = points[triangles[:, corner]] + points[triangles[:, (corner + 1) % 3]]
        away = np.hypot(*(points[triangles[:, middle]] - ends / 2)[:, :2].T)
        assert away.max() < 0.02 * pack.thickness
    a, b, c = (points[triangles[:, k], :2] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    area = np.abs(ux * vy - uy * vx) / 2
    density = mesh["density_kg_m3"][: len(triangles)]
    weight = 9.81 * (area * density).sum() * np.sin(pack.slope_angle)
    balance = scene.solution.balance
    assert weight == pytest.approx(balance.weight_along_slope, rel=3e-3)
    sides = mesh["boundary"][len(triangles) :].astype(int)
    lengths = np.hypot(*(points[edges[:, 0]] - points[edges[:, 1]])[:, :2].T)
    assert lengths[sides == 1].sum() == pytest.approx(pack.upslope_length)
    assert lengths[sides == 4].sum() == pytest.approx(pack.thickness)
    net = lengths[sides == 2].sum()
    assert pack.thickness <= net < 1.3 * pack.thickness
    assert lengths[sides == 3].sum() > 0.9 * pack.upslope_length
    forces = mesh["force_on_net_N_per_m"]
    assert forces.sum(axis=0)[:2] == pytest.approx(scene.resultant, rel=1e-8)
    on_net = np.unique(edges[sides == 2])
    assert np.flatnonzero(np.abs(forces).sum(axis=1)).size <= on_net.size
    assert set(np.flatnonzero(np.abs(forces).sum(axis=1))) <= set(on_net)


def test_snow_of_the_exported_scenes_sticks_to_its_net():
    """Else the flow could not be run again with v = 0 on the net."""
    assert not any(scene.solution.net_slides.any() for scene in SCENES.values())
    assert sorted(list_files()) == sorted(write_scenes(list(SCENES.values())))


def test_text_says_the_equations_and_the_result():
    scene = SCENES["rough-layered"]
    text = write_scenes([scene])["rough-layered.txt"].decode()
    assert f"X: {scene.resultant[0] / 1e3:.5g} kN/m" in text
    assert text.count("density") >= 3
    assert "v = 0" in text


@pytest.mark.parametrize("name", ["free-upright", "rough-leaning"])
def test_independent_code_gives_its_stored_figures(name):
    """On a coarse grid; `python -m tests.verification.quads` for the stored ones."""
    (stored,) = (one for one in load_results() if one.scene == name)
    flow, unit, depth = quads.read_scene(SCENES[name])
    force, moment = quads.solve(flow, parts=8, least=8e-3)
    expected = np.array([stored.force_x, stored.force_y])
    away = np.hypot(*(force * unit / 1e3 - expected))
    assert away < 5e-3 * stored.force
    assert moment * unit * depth / 1e3 == pytest.approx(stored.moment, rel=5e-3)


def test_program_agrees_with_another_code():
    cases = list_another_code()
    assert len(cases) == 9
    assert all(case.passes for case in cases)
    whole = [case for case in cases if not case.id.endswith("force-y")]
    assert max(case.error for case in whole) < 4e-4
