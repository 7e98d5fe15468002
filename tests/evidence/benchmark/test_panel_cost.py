"""Cost of a panel: the same row with and without; no time is asked for."""

import json

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.evidence.benchmark.panel_cost import MOST, measure_panel_cost

COARSE = SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2])


def test_the_document_holds_what_was_measured():
    document = measure_panel_cost(repeats=1, rows=1, settings=COARSE)
    numbers = {name: document[name] for name in document.keys() - {"what", "reach"}}
    assert json.loads(json.dumps(numbers, allow_nan=False)) == numbers
    assert "1.5" in str(document["reach"])
    (row,) = document["rows"]
    assert row["is_closed"]
    assert min(row["plain_cases"], row["panel_cases"]) >= 35
    assert document["median"] == row["times"] > 0.0
    assert document["reached"] is (row["times"] <= MOST)
