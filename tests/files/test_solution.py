"""The solution document holds numbers only, whatever the scene."""

import json

from netdesign.addons.evidence.benchmark.scenes import build_tables, draw_scene
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import FailedSolution
from netdesign.files.solution import write_solution_document
from netdesign.outcome import ModelError
from netdesign.solving.solve import solve_scene

ROUGH = SolverSettings(accuracy=0.05)


def list_scenes(count):
    """Random scenes on free ground with gravity along the slope only."""
    found, number = [], 0
    while len(found) < count:
        number += 1
        tables = draw_scene(17, number)
        tables["snow"]["creep_law"] = "boutillier-2004"
        tables["snow"]["density_kg_m3"] = 150.0 + 7.3 * (number % 40)
        tables["snow"].pop("layers", None)
        tables["ground"] = {"law": "free"}
        tables["gravity"] = {"mode": "parallel"}
        try:
            found.append(build_tables(tables))
        except ModelError:
            continue
    return found


def test_ground_without_pressure_gives_numbers():
    """A share of a ground force that is zero was infinite, which is not JSON."""
    shares = []
    for scene in list_scenes(8):
        solution = solve_scene(scene, ROUGH)
        document = write_solution_document(solution, ROUGH, 0.0)
        json.dumps(document, allow_nan=False)
        if not isinstance(solution, FailedSolution):
            shares.append(solution.balance.ground_tension_share)
    assert 1.0 in shares
    assert min(shares) >= 0.0
