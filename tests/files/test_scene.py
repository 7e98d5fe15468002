import copy
import json
import math
import tomllib
from dataclasses import replace

import pytest

from netdesign.coupling.history.settings import TransientSettings
from netdesign.coupling.history.transient import solve_transient
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import FailedSolution
from netdesign.coupling.steady.rigid import solve_rigid
from netdesign.coupling.steady.solve import solve_steady
from netdesign.files.scene import SceneFile, build_given, read_scene
from netdesign.files.solution import write_solution_document
from netdesign.outcome import ModelError, Outcome, SceneFileError
from netdesign.snow.creep_law import PAPER_FLUIDITY, compute_fluidity
from netdesign.snow.ground import build_ground_from_glide_factor
from tests.full_scene import FULL_SCENE

SOUND = """
[slope]
angle_deg = 40
[snow]
thickness_m = 4.0
upslope_length_m = 20
density_kg_m3 = 366.8
[net]
stiffness_kN_per_m = 20000
friction_deg = 30
"""


@pytest.fixture
def tables():
    return tomllib.loads(SOUND)


@pytest.fixture
def read(tmp_path):
    def read_text(text):
        path = tmp_path / "scene.toml"
        path.write_text(text, encoding="utf-8")
        return read_scene(path)

    return read_text


def build(tables):
    return build_given(SceneFile.model_validate(tables)).scene


def test_units_of_the_edge_become_si(read):
    scene, settings = read(FULL_SCENE)
    assert scene.snowpack.slope_angle == math.radians(38)
    assert scene.snowpack.thickness == 2.5
    assert scene.snowpack.upslope_length == 6.0
    assert scene.snowpack.density == 300.0
    assert scene.snowpack.gravity == "parallel"
    assert (scene.ground.kind, scene.ground.slip_length) == ("sliding", 1.5)
    assert scene.net.inclination == math.radians(25)
    assert scene.net.height_normal == 3.0
    assert scene.net.stiffness_per_m == 8e6
    assert scene.net.slack == 0.05
    assert scene.net.friction_angle == math.radians(30)
    assert scene.creep_law.name == "boutillier-2004"
    assert settings == SolverSettings(accuracy=0.1)


def test_defaults_are_those_of_the_interface(read):
    scene, settings = read(SOUND)
    assert scene.net.height_normal == scene.snowpack.thickness == 4.0
    assert scene.net.inclination == math.radians(30)
    assert scene.net.slack == 0.0
    assert scene.ground.kind == "free"
    assert scene.snowpack.gravity == "full"
    assert settings.accuracy == 0.005


def test_vertical_height_is_turned_to_the_normal(tables):
    del tables["snow"]["thickness_m"]
    tables["snow"]["height_vertical_m"] = 4.0
    scene = build(tables)
    assert scene.snowpack.thickness == pytest.approx(
        4.0 * math.cos(math.radians(40)), rel=1e-14
    )
    assert scene.net.height_normal == scene.snowpack.thickness


def test_glide_factor_becomes_a_slip_length(tables):
    tables["ground"] = {"law": "sliding", "glide_factor": 1.5}
    assert build(tables).ground == build_ground_from_glide_factor(1.5, 4.0)
    tables["ground"] = {"law": "sliding", "glide_factor": 1.0}
    assert build(tables).ground.kind == "no-slip"


@pytest.mark.parametrize(
    ("table", "changes", "message"),
    [
        ("snow", {"height_vertical_m": 5.0}, "give exactly one of them"),
        ("snow", {"thickness_m": None}, "give exactly one of them"),
        ("snow", {"creep_law": "zwinger"}, "known are boutillier-2004"),
        ("ground", {"slip_length_m": 1.0}, "belong to a sliding ground"),
        ("ground", {"law": "no-slip", "glide_factor": 2.0}, "law is 'no-slip'"),
        ("ground", {"law": "sliding"}, "needs exactly one of them"),
        (
            "ground",
            {"law": "sliding", "slip_length_m": 1.0, "glide_factor": 2.0},
            "needs exactly one of them",
        ),
        ("ground", {"law": "sliding", "glide_factor": 3.4}, "glide factor = 3.4"),
        ("net", {"height_m": 3.9}, "overtops the net"),
        ("net", {"inclination_deg": 85}, "net inclination = "),
        ("snow", {"upslope_length_m": 0.5}, "upslope length over snow thickness"),
    ],
)
def test_contradictions_are_refused(tables, table, changes, message):
    target = tables.setdefault(table, {})
    target |= changes
    for key in [key for key, value in target.items() if value is None]:
        del target[key]
    with pytest.raises(ModelError, match=message):
        build(tables)


@pytest.mark.parametrize(
    ("table", "key", "value"),
    [
        ("slope", "angle_deg", -0.1),
        ("slope", "angle_deg", 80.1),
        ("slope", "angle_deg", math.nan),
        ("slope", "angle_deg", "40"),
        ("slope", "angle_deg", True),
        ("slope", "angle_degrees", 40),
        ("snow", "thickness_m", 0.0),
        ("snow", "thickness_m", math.inf),
        ("snow", "thickness_m", math.nan),
        ("snow", "density_kg_m3", 0.0),
        ("snow", "density_kg_m3", 917.0),
        ("snow", "density_kg_m3", math.nan),
        ("snow", "upslope_length_m", -20.0),
        ("snow", "creep_exponent", 0.9),
        ("snow", "creep_exponent", 10.1),
        ("snow", "fluidity_per_MPa3_a", 0.0),
        ("snow", "temperature_C", 0.1),
        ("snow", "layers", []),
        ("ground", "law", "rough"),
        ("ground", "slip_length_m", 0.0),
        ("ground", "glide_factor", 0.9),
        ("ground", "contact", "glued"),
        ("net", "kind", "membrane"),
        ("net", "inclination_deg", -1.0),
        ("net", "inclination_deg", 90.0),
        ("net", "height_m", 0.0),
        ("net", "stiffness_kN_per_m", 0.0),
        ("net", "stiffness_kN_per_m", math.inf),
        ("net", "slack", -0.01),
        ("net", "slack", 0.51),
        ("net", "slack", False),
        ("net", "friction_deg", -0.1),
        ("net", "friction_deg", 60.1),
        ("gravity", "mode", "none"),
        ("solve", "method", "guess"),
        ("solve", "accuracy", 0.00009),
        ("solve", "accuracy", 0.11),
        ("solve", "accuracy", math.nan),
        ("solve", "start", "slack"),
        ("solve", "horizon_days", 0.0),
        ("wind", "speed", 3.0),
    ],
)
def test_a_value_that_is_not_accepted_is_refused(tables, table, key, value):
    tables.setdefault(table, {})[key] = value
    with pytest.raises(ValueError, match=rf"(?m)^{table}"):
        build(tables)


@pytest.mark.parametrize(
    ("table", "key", "value"),
    [
        ("slope", "angle_deg", 0),
        ("slope", "angle_deg", 80.0),
        ("net", "inclination_deg", 0.0),
        ("net", "slack", 0.5),
        ("net", "friction_deg", 0.0),
        ("net", "friction_deg", 60),
        ("snow", "temperature_C", -60.0),
        ("solve", "accuracy", 0.1),
        ("solve", "accuracy", 0.0001),
    ],
)
def test_the_bounds_themselves_are_accepted(tables, table, key, value):
    tables.setdefault(table, {})[key] = value
    scene = build(tables)
    assert scene.snowpack.density == 366.8


@pytest.mark.parametrize(
    ("table", "key"),
    [
        ("slope", "angle_deg"),
        ("snow", "upslope_length_m"),
        ("snow", "density_kg_m3"),
        ("net", "stiffness_kN_per_m"),
        ("net", "friction_deg"),
        ("slope", None),
        ("snow", None),
        ("net", None),
    ],
)
def test_what_has_no_default_must_be_given(tables, table, key):
    spoilt = copy.deepcopy(tables)
    if key is None:
        del spoilt[table]
    else:
        del spoilt[table][key]
    place = table if key is None else rf"{table}\.{key}"
    with pytest.raises((ValueError, ModelError), match=rf"(?m)^{place}"):
        build(spoilt)


def test_every_fault_is_told_with_its_key_and_value(read, tmp_path):
    with pytest.raises(SceneFileError) as caught:
        read(SOUND.replace("40", "95").replace("366.8", "'heavy'") + "colour = 1\n")
    lines = str(caught.value).splitlines()
    file = tmp_path / "scene.toml"
    assert len(lines) == 3
    assert lines[0].startswith(f"{file}: slope.angle_deg = 95: ")
    assert lines[1].startswith(f"{file}: snow.density_kg_m3 = 'heavy': ")
    assert lines[2].startswith(f"{file}: net.colour = 1: ")


def test_a_contradiction_is_told_with_its_file(read):
    with pytest.raises(SceneFileError, match=r"scene\.toml: ground\.slip_length_m and"):
        read(SOUND + "[ground]\nlaw = 'sliding'\n")


@pytest.mark.parametrize("text", ["[slope", "a = 1\na = 2", "x = 2026-13-45"])
def test_what_is_not_toml_is_refused(read, text):
    with pytest.raises(SceneFileError, match="cannot be read as TOML"):
        read(text)


def test_unreadable_files_are_refused(tmp_path):
    with pytest.raises(SceneFileError, match="cannot be read"):
        read_scene(tmp_path / "none.toml")
    with pytest.raises(SceneFileError, match="cannot be read"):
        read_scene(tmp_path)
    path = tmp_path / "latin.toml"
    path.write_bytes(b"# \xe9t\xe9\n")
    with pytest.raises(SceneFileError, match="cannot be read"):
        read_scene(path)


@pytest.fixture(scope="module")
def solved():
    scene = build_given(SceneFile.model_validate(tomllib.loads(FULL_SCENE))).scene
    settings = SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2])
    solution = solve_steady(scene, settings)
    return solution, write_solution_document(solution, settings, wall_s=1.5)


def test_solution_document_has_the_keys_of_the_interface(solved):
    _, document = solved
    pull = {"x_kN_per_m", "y_kN_per_m", "size_kN_per_m", "error_kN_per_m"}
    assert document["schema"] == "netdesign.solution/1"
    assert (document["outcome"], document["method"]) == ("converged", "steady")
    assert set(document["anchor_forces"]) == {"foot", "head"}
    assert set(document["anchor_forces"]["foot"]) == pull
    assert set(document["anchor_forces"]["head"]) == pull
    assert document["wall"] is None
    assert document["history"] is None
    assert set(document["tension_kN_per_m"]) == {"foot", "head", "min", "max"}
    assert {"weight_along_slope_kN_per_m", "relative_residual"} <= set(
        document["balance"]
    )
    assert {"wall_s", "linear_solves", "elements", "degrees_of_freedom"} <= set(
        document["cost"]
    )
    assert {"version", "core", "creep_law", "clock", "element", "settings"} == set(
        document["provenance"]
    )
    assert document["cost"]["wall_s"] == 1.5


def test_solution_document_is_in_kilonewton(solved):
    solution, document = solved
    for end, pull in (("foot", solution.foot), ("head", solution.head)):
        written = document["anchor_forces"][end]
        assert written["x_kN_per_m"] == pull.x / 1000.0
        assert written["y_kN_per_m"] == pull.y / 1000.0
        assert written["error_kN_per_m"] == pull.error / 1000.0
        assert written["size_kN_per_m"] == document["tension_kN_per_m"][end]
    assert document["tension_kN_per_m"]["max"] == solution.tension_max / 1000.0
    assert document["sag_m"] == solution.sag
    balance = document["balance"]["weight_along_slope_kN_per_m"]
    assert balance == solution.balance.weight_along_slope / 1000.0


def test_nodes_of_the_document_carry_the_snow_on_the_net(solved):
    """The net hangs in balance: node forces and end pulls sum to nothing."""
    solution, document = solved
    nodes = document["nodes"]
    assert (nodes[0]["x_m"], nodes[0]["y_m"]) == (0.0, 0.0)
    assert len(nodes) == solution.net_forces.shape[1]
    for axis in ("x", "y"):
        snow = sum(node[f"force_{axis}_kN_per_m"] for node in nodes)
        ends = sum(
            document["anchor_forces"][end][f"{axis}_kN_per_m"]
            for end in ("foot", "head")
        )
        assert ends == pytest.approx(snow, rel=1e-6, abs=1e-6)
    assert {node["sliding"] for node in nodes} <= {True, False}


def test_solution_document_is_json_without_nan(solved):
    _, document = solved
    text = json.dumps(document, allow_nan=False)
    assert json.loads(text) == document


def test_a_failure_carries_its_reason_and_no_number():
    failure = FailedSolution(outcome=Outcome.DIVERGED, reason="residual grew")
    document = write_solution_document(failure, SolverSettings(), wall_s=1.0)
    assert document == {
        "schema": "netdesign.solution/1",
        "outcome": "diverged",
        "reason": "residual grew",
    }


# --- layers, temperature, contacts, walls, sets of one's own -------------------------


OWN_SET = {
    "name": "mine",
    "source": "my tests",
    "shear_fit": [16.03, 19.25],
    "bulk_fit": [16.75, 22.51],
    "branch": 0.81,
    "calibrated": [0.3, 0.7],
}

LAYERS = [
    {"thickness_m": 1.0, "density_kg_m3": 450.0},
    {"thickness_m": 3.0, "density_kg_m3": 300.0, "temperature_C": -5.0},
]


def test_layers_give_the_mean_density(tables):
    del tables["snow"]["density_kg_m3"]
    tables["snow"]["layers"] = LAYERS
    pack = build(tables).snowpack
    assert pack.density == pytest.approx((450 + 3 * 300) / 4, rel=1e-14)
    assert [layer.temperature for layer in pack.layers] == [None, 268.15]


def test_layers_that_do_not_add_up(tables):
    del tables["snow"]["density_kg_m3"]
    tables["snow"]["layers"] = LAYERS[:1]
    told = r"thicknesses: the layers give 1 m, .* has 4 m"
    with pytest.raises(ModelError, match=told):
        build(tables)


def test_layers_do_not_replace_the_thickness(tables):
    del tables["snow"]["density_kg_m3"], tables["snow"]["thickness_m"]
    with pytest.raises(ModelError) as uniform:
        build(tables)
    tables["snow"]["layers"] = LAYERS
    with pytest.raises(ModelError) as layered:
        build(tables)
    assert "layers" not in str(uniform.value)
    assert "layers does not replace it" in str(layered.value)


def test_density_and_layers_exclude_each_other(tables):
    tables["snow"]["layers"] = LAYERS
    with pytest.raises(ModelError, match="exactly one of them"):
        build(tables)


def test_temperature_and_fluidity_exclude_each_other(tables):
    tables["snow"] |= {"temperature_C": -5.0, "fluidity_per_MPa3_a": 20.0}
    with pytest.raises(ModelError, match="one of them at most"):
        build(tables)


def test_without_either_the_clock_is_that_of_settling(tables):
    scene = build(tables)
    assert scene.settles_as_stations
    assert 1e-27 < scene.creep_fluidity < 1e-24
    tables["snow"]["fluidity_per_MPa3_a"] = 20.0
    given = build(tables)
    assert not given.settles_as_stations
    assert given.creep_fluidity == PAPER_FLUIDITY


def test_a_history_says_its_clock(tables):
    scene = build(tables)
    for one, source, count in ((scene, "settling", 1), (warm(scene), "scene", 0)):
        settings = TransientSettings(accuracy=0.1, horizon=1e-4 * one.time_scale)
        solution = solve_transient(one, settings, on_failure="raise")
        document = write_solution_document(solution, settings, wall_s=0.0)
        clock = document["provenance"]["clock"]
        assert clock["source"] == source
        si = clock["fluidity_per_MPa_n_a"] / (1e18 * 365.25 * 86400.0)
        assert si == pytest.approx(one.creep_fluidity, rel=1e-9)
        told = [flag for flag in document["flags"] if "clock of settling" in flag]
        assert len(told) == count


def warm(scene):
    return replace(scene, fluidity=compute_fluidity(272.0))


def test_temperature_becomes_fluidity(tables):
    tables["snow"]["temperature_C"] = -10.0
    assert build(tables).fluidity == compute_fluidity(263.15)


def test_contacts_and_wall(tables):
    tables["ground"] = {"contact": "one-sided"}
    tables["net"]["contact"] = "one-sided"
    scene = build(tables)
    assert (scene.ground_contact, scene.net_contact) == ("one-sided", "one-sided")
    tables["net"] = {"kind": "rigid", "inclination_deg": 10.0}
    wall = build(tables).net
    assert (wall.friction_angle, wall.inclination) == (None, math.radians(10))
    tables["net"]["slack"] = 0.1
    with pytest.raises(ModelError, match="a wall has none"):
        build(tables)


def test_creep_law_of_ones_own(tables):
    tables["snow"]["creep_law"] = dict(OWN_SET)
    law = build(tables).creep_law
    assert (law.name, law.calibrated, law.clamp) == ("mine", (0.3, 0.7), 0.0)
    # 3a < 2b at D = 0.3: refused on load
    tables["snow"]["creep_law"]["bulk_fit"] = [18.0, 22.51]
    with pytest.raises(ModelError, match="shrink sideways"):
        build(tables)


def test_flags_tell_of_use_outside_the_calibration(tables):
    tables["snow"] |= {"density_kg_m3": 300.0, "creep_exponent": 2.0}
    scene = build(tables)
    solution = solve_steady(scene, SolverSettings(levels=MESH_LEVELS[:2], accuracy=0.1))
    document = write_solution_document(solution, SolverSettings(), wall_s=0.0)
    assert [flag.split()[0] for flag in document["flags"]] == ["snow", "creep"]


def test_document_of_a_wall(tables):
    tables["net"] = {"kind": "rigid", "inclination_deg": 0.0}
    tables["ground"] = {"law": "no-slip"}
    solution = solve_rigid(build(tables), SolverSettings(accuracy=0.05))
    document = write_solution_document(solution, SolverSettings(), wall_s=0.0)
    assert document["anchor_forces"] is None
    assert document["tension_kN_per_m"] is None
    wall = document["wall"]
    assert wall["force_x_kN_per_m"] == solution.force.x / 1000.0
    assert wall["moment_about_foot_kN"] == solution.moment_about_foot / 1000.0
    total = sum(node["force_x_kN_per_m"] for node in document["nodes"])
    assert total == pytest.approx(wall["force_x_kN_per_m"], rel=1e-12)
    json.dumps(document, allow_nan=False)


def take_layers(tables, *layers):
    tables["snow"].pop("density_kg_m3", None)
    tables["snow"]["layers"] = list(layers)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("thickness_m", 0.0),
        ("thickness_m", math.nan),
        ("thickness_m", math.inf),
        ("density_kg_m3", 0.0),
        ("density_kg_m3", 917.0),
        ("density_kg_m3", math.nan),
        ("density_kg_m3", math.inf),
        ("temperature_C", 0.1),
        ("temperature_C", -60.1),
        ("temperature_C", math.nan),
        ("temperature_C", -math.inf),
        ("hardness", 3.0),
    ],
)
def test_fault_in_a_layer_is_told_with_its_place(tables, key, value):
    take_layers(tables, LAYERS[0], {**LAYERS[1], key: value})
    with pytest.raises(ValueError, match=rf"(?m)^snow\.layers\.1\.{key}"):
        build(tables)


def test_thin_layer_is_refused(tables):
    take_layers(
        tables,
        {"thickness_m": 0.079, "density_kg_m3": 300.0},
        {"thickness_m": 3.921, "density_kg_m3": 300.0},
    )
    with pytest.raises(ModelError, match="layer thickness over snow thickness"):
        build(tables)


def test_layer_outside_the_calibration_is_flagged(tables):
    """The mean density alone would not tell."""
    take_layers(
        tables,
        {"thickness_m": 3.0, "density_kg_m3": 450.0},
        {"thickness_m": 1.0, "density_kg_m3": 200.0},
    )
    scene = build(tables)
    assert scene.creep_law.is_calibrated(scene.snowpack.relative_density)
    assert not scene.is_calibrated


def test_layer_where_the_set_is_inadmissible(tables):
    tables["snow"]["creep_law"] = "gagliardini-1997"
    take_layers(
        tables,
        {"thickness_m": 3.0, "density_kg_m3": 600.0},
        {"thickness_m": 1.0, "density_kg_m3": 400.0},
    )
    with pytest.raises(ModelError, match=r"relative density = 0\.436.*shrink sideways"):
        build(tables)


OWN = {
    "name": "mine",
    "source": "my tests",
    "shear_fit": [16.03, 19.25],
    "bulk_fit": [16.75, 22.51],
    "branch": 0.81,
    "calibrated": [0.4, 1.0],
}


@pytest.mark.parametrize(
    "changes",
    [
        {"shear_fit": [1.0]},
        {"bulk_fit": [1.0, 2.0, 3.0]},
        {"shear_fit": [math.nan, 1.0]},
        {"bulk_fit": [1.0, math.inf]},
        {"branch": 0.0},
        {"branch": math.nan},
        {"clamp": -0.1},
        {"clamp": math.nan},
        {"calibrated": [math.nan, 1.0]},
        {"calibrated": [0.4]},
        {"exponent": 3.0},
        {"name": None},
    ],
    ids=str,
)
def test_set_of_ones_own_that_is_not_a_set(tables, changes):
    tables["snow"]["creep_law"] = {**OWN, **changes}
    (key,) = changes
    with pytest.raises(ValueError, match=rf"(?m)^snow\.creep_law\..*{key}"):
        build(tables)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"branch": 0.991}, "branch density"),
        ({"clamp": 0.82}, "clamp density"),
        ({"calibrated": [0.6, 0.5]}, "calibrated density"),
        ({"calibrated": [0.4, 1.01]}, "calibrated density"),
    ],
    ids=str,
)
def test_set_of_ones_own_that_is_no_law(tables, changes, message):
    tables["snow"]["creep_law"] = {**OWN, **changes}
    with pytest.raises(ModelError, match=message):
        build(tables)


def test_set_of_ones_own_takes_the_exponent_of_the_snow(tables):
    tables["snow"] |= {"creep_law": OWN, "creep_exponent": 2.0}
    assert build(tables).creep_law.exponent == 2.0


def test_set_of_ones_own_has_no_glide_table(tables):
    tables["snow"]["creep_law"] = OWN
    tables["ground"] = {"law": "sliding", "glide_factor": 1.5}
    with pytest.raises(ModelError, match="'mine' has no table of slip lengths"):
        build(tables)


@pytest.mark.parametrize("name", ["boutillier-2004", "zwinger-2007"])
def test_glide_factor_is_that_of_the_creep_law(tables, name):
    tables["snow"]["creep_law"] = name
    tables["ground"] = {"law": "sliding", "glide_factor": 1.5}
    scene = build(tables)
    assert scene.ground == build_ground_from_glide_factor(1.5, 4.0, name)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"stiffness_kN_per_m": 2e4}, "a wall has none"),
        ({"slack": 0.0}, "a wall has none"),
        ({"inclination_deg": 80.1}, "wall inclination"),
        ({"height_m": 3.9}, "overtops the net"),
    ],
    ids=str,
)
def test_wall_is_refused(tables, changes, message):
    tables["net"] = {"kind": "rigid", "inclination_deg": 0.0, **changes}
    with pytest.raises(ModelError, match=message):
        build(tables)


def test_slack_that_would_lie_on_the_ground(tables):
    tables["net"] |= {"slack": 0.5, "inclination_deg": 40.0}
    with pytest.raises(ModelError, match="lie on the ground"):
        build(tables)


@pytest.mark.parametrize(("density", "n_flags"), [(0.4 * 917, 0), (0.399 * 917, 1)])
def test_flag_at_the_bound_of_the_calibration(tables, density, n_flags):
    tables["snow"]["density_kg_m3"] = density
    tables["net"] = {"kind": "rigid", "inclination_deg": 0.0}
    tables["ground"] = {"law": "no-slip"}
    solution = solve_rigid(build(tables), SolverSettings(accuracy=0.1))
    document = write_solution_document(solution, SolverSettings(), wall_s=0.0)
    assert len(document["flags"]) == n_flags


def test_largest_velocity_is_in_mm_per_day(solved):
    solution, document = solved
    expected = solution.largest_velocity * 1000.0 * 24 * 3600
    assert document["largest_velocity_mm_per_day"] == pytest.approx(expected, rel=1e-14)


# --- what is known for creep exponent 3 only -----------------------------------------


def test_glide_factor_needs_the_exponent_of_its_table(tables):
    tables["ground"] = {"law": "sliding", "glide_factor": 1.5}
    assert build(tables).ground.kind == "sliding"
    tables["snow"]["creep_exponent"] = 1.0
    with pytest.raises(ModelError, match=r"ground\.glide_factor: .*exponent 3"):
        build(tables)


@pytest.mark.parametrize("place", ["snow", "layer"])
def test_temperature_needs_the_exponent_of_its_law(tables, place):
    tables["snow"]["creep_exponent"] = 1.0
    if place == "snow":
        tables["snow"]["temperature_C"] = -5.0
    else:
        del tables["snow"]["density_kg_m3"]
        tables["snow"]["layers"] = LAYERS
    with pytest.raises(ModelError, match=r"temperature.*exponent 3"):
        build(tables)


def test_own_set_may_not_take_the_name_of_a_shipped_one(tables):
    tables["snow"]["creep_law"] = OWN_SET | {"name": "boutillier-2004"}
    with pytest.raises(ModelError, match="is a shipped set"):
        build(tables)


@pytest.mark.parametrize("fit", [[800.0, 0.0], [1e300, 19.0], [61.0, 1.0]])
def test_fit_that_overflows_is_refused(tables, fit):
    tables["snow"]["creep_law"] = OWN_SET | {"shear_fit": fit}
    with pytest.raises(ModelError, match="fit coefficient"):
        build(tables)
