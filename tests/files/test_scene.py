import copy
import math
import tomllib

import pytest

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.files.scene import SceneFile, build_scene_of_file, read_scene
from netdesign.files.solution import write_solution_document
from netdesign.outcome import ModelError, SceneFileError
from netdesign.snow.ground import build_ground_from_glide_factor
from tests.each import each
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
    return build_scene_of_file(SceneFile.model_validate(tables)).scene


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


def test_vertical_height_is_turned_to_the_normal(tables):
    del tables["snow"]["thickness_m"]
    tables["snow"]["height_vertical_m"] = 4.0
    scene = build(tables)
    assert scene.snowpack.thickness == pytest.approx(
        4.0 * math.cos(math.radians(40)), rel=1e-14
    )
    assert scene.net.height_normal == scene.snowpack.thickness


REFUSED = {
    ("slope", "angle_deg"): [-0.1, 80.1, math.nan, "40", True],
    ("slope", "angle_degrees"): [40],
    ("snow", "thickness_m"): [0.0, math.inf, math.nan],
    ("snow", "density_kg_m3"): [0.0, 917.0, math.nan],
    ("snow", "upslope_length_m"): [-20.0],
    ("snow", "creep_exponent"): [0.9, 6.1],
    ("snow", "fluidity_per_MPa3_a"): [0.0],
    ("snow", "temperature_C"): [0.1],
    ("snow", "layers"): [[]],
    ("ground", "law"): ["rough"],
    ("ground", "slip_length_m"): [0.0],
    ("ground", "glide_factor"): [0.9],
    ("ground", "contact"): ["glued"],
    ("net", "kind"): ["membrane"],
    ("net", "inclination_deg"): [-1.0, 90.0],
    ("net", "height_m"): [0.0],
    ("net", "stiffness_kN_per_m"): [0.0, math.inf],
    ("net", "slack"): [-0.01, 0.51, False],
    ("net", "friction_deg"): [-0.1, 60.1],
    ("gravity", "mode"): ["none"],
    ("solve", "method"): ["guess"],
    ("solve", "accuracy"): [9e-05, 0.11, math.nan],
    ("solve", "start"): ["slack"],
    ("solve", "horizon_days"): [0.0],
    ("wind", "speed"): [3.0],
}
BOUNDS = {
    ("slope", "angle_deg"): [0, 80.0],
    ("net", "inclination_deg"): [0.0],
    ("net", "slack"): [0.5],
    ("net", "friction_deg"): [0.0, 60],
    ("snow", "temperature_C"): [-60.0],
    ("solve", "accuracy"): [0.1, 0.0001],
}


@each("key, values", REFUSED.items())
def test_values_that_are_not_accepted_are_refused(key, values):
    table, name = key
    for value in values:
        tables = tomllib.loads(SOUND)
        tables.setdefault(table, {})[name] = value
        with pytest.raises(ValueError, match=rf"(?m)^{table}"):
            build(tables)


@each("key, values", BOUNDS.items())
def test_the_bounds_themselves_are_accepted(key, values):
    table, name = key
    for value in values:
        tables = tomllib.loads(SOUND)
        tables.setdefault(table, {})[name] = value
        assert build(tables).snowpack.density == 366.8


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


@pytest.fixture(scope="module")
def solved():
    scene = build_scene_of_file(
        SceneFile.model_validate(tomllib.loads(FULL_SCENE))
    ).scene
    settings = SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2])
    solution = solve_steady(scene, settings)
    return solution, write_solution_document(solution, settings, wall_s=1.5)


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


def take_layers(tables, *layers):
    tables["snow"].pop("density_kg_m3", None)
    tables["snow"]["layers"] = list(layers)


BAD_LAYERS = {
    "thickness_m": [0.0, math.nan, math.inf],
    "density_kg_m3": [0.0, 917.0, math.nan, math.inf],
    "temperature_C": [0.1, -60.1, math.nan, -math.inf],
    "hardness": [3.0],
}


@each("key, values", BAD_LAYERS.items())
def test_fault_in_a_layer_is_told_with_its_place(tables, key, values):
    for value in values:
        take_layers(tables, LAYERS[0], {**LAYERS[1], key: value})
        with pytest.raises(ValueError, match=rf"(?m)^snow\.layers\.1\.{key}"):
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
    tables["snow"]["creep_law"] = {**OWN_SET, **changes}
    with pytest.raises(ModelError, match=message):
        build(tables)


@pytest.mark.parametrize("name", ["boutillier-2004", "zwinger-2007"])
def test_glide_factor_is_that_of_the_creep_law(tables, name):
    tables["snow"]["creep_law"] = name
    tables["ground"] = {"law": "sliding", "glide_factor": 1.5}
    assert build(tables).ground == build_ground_from_glide_factor(1.5, 4.0, name)
    tables["ground"]["glide_factor"] = 1.0
    assert build(tables).ground.kind == "no-slip"
    tables["ground"]["glide_factor"], tables["snow"]["creep_exponent"] = 1.5, 1.0
    with pytest.raises(ModelError, match=r"ground\.glide_factor: .*exponent 3"):
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
