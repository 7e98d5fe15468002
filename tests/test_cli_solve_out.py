"""`netdesign solve --out` and `netdesign paper`: files, exit codes, refusals."""

import csv
import io
import json

from netdesign.addons.history.moments import write_moments
from tests.digits import write_force

SCENE = """
[slope]
angle_deg = 40
[snow]
thickness_m = 4.0
upslope_length_m = 20
density_kg_m3 = 366.8
[net]
inclination_deg = 30
{net}
friction_deg = 30
[solve]
accuracy = 0.1
horizon_days = {days}
densification = {dense}
"""
CABLE = "stiffness_kN_per_m = 20000"


def write_scene(folder, net=CABLE, days=1e-3, dense="true"):
    path = folder / "scene.toml"
    path.write_text(SCENE.format(net=net, days=days, dense=dense), encoding="utf-8")
    return path


def names(folder):
    return {path.name for path in folder.iterdir()}


def test_steady_scene_becomes_a_folder(tmp_path, call):
    out = tmp_path / "out"
    told = call("solve", write_scene(tmp_path), "--out", out)
    assert told.code == 0
    assert names(out) == {"solution.json"}
    document = json.loads((out / "solution.json").read_text(encoding="utf-8"))
    pull = document["anchor_forces"]["foot"]["size_kN_per_m"]
    assert write_force(pull) in told.out
    assert "wrote" in told.err


PANEL = """
[support]
post_spacing_m = 3.5
[panel]
rope_stiffness_kN = 18000
rope_sag = 0.05
cut = "upper"
end_guy_deg = 45
"""


def test_a_panel_is_printed(tmp_path, call):
    scene, out = write_scene(tmp_path), tmp_path / "out"
    text = scene.read_text(encoding="utf-8").replace(CABLE, CABLE + "\nslack = 0.04")
    scene.write_text(text + PANEL, encoding="utf-8")
    printed = call("solve", scene, "--out", out).out
    support = json.loads((out / "solution.json").read_text(encoding="utf-8"))["support"]
    for force in (
        support["plain"]["post_kN"],
        support["panel"]["uphill_guy_kN"],
        support["panel"]["lower_rope"]["T_kN"],
        support["row_end"]["foot_kN"]["z"],
        support["row_end"]["end_guy_kN"],
    ):
        assert write_force(force) in printed


def test_history_without_plateau_says_so_and_ends_with_4(tmp_path, call):
    out = tmp_path / "out"
    scene = write_scene(tmp_path)
    assert call("solve", scene, "--method", "transient", "--out", out).code == 4
    assert names(out) == {"solution.json", "history.csv"}
    document = json.loads((out / "solution.json").read_text(encoding="utf-8"))
    lines = (out / "history.csv").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 1 + len(document["history"])


def test_history_table_has_a_column_for_each_node():
    moment = {"time_d": 1.0, "foot_kN_per_m": 2.0, "node_forces": [[3.0, 4.0], [5, 6]]}
    (row,) = csv.DictReader(io.StringIO(write_moments([moment]).decode()))
    assert row["time_d"] == "1.0"
    assert row["node_2_y_kN_per_m"] == "6"


def test_paper_writes_its_folder_and_names_failures(tmp_path, monkeypatch, call):
    from netdesign.addons.evidence.paper import study as module
    from netdesign.addons.evidence.paper.study import find_history
    from tests.build_paper import build_study

    made = build_study()
    monkeypatch.setattr(module, "run_study", lambda *_, **__: made)
    out = tmp_path / "paper"
    told = call("paper", "--out", out)
    assert told.code == 0
    assert names(out) == {"index.html"}
    assert "index.html" in told.err
    assert call("paper", "--out", out).code == 2
    failing = build_study(failing=[find_history(0.0)])
    monkeypatch.setattr(module, "run_study", lambda *_, **__: failing)
    assert call("paper", "--out", out, "--force", "--quiet").code == 4
