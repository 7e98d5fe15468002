"""The examples run as their page says, print what it shows, and find what is so."""

import csv
import importlib
import io
import math
import re
import struct
import sys
import tomllib
from contextlib import redirect_stdout
from dataclasses import replace
from importlib.resources import files
from itertools import product
from pathlib import Path

import pytest

from netdesign import Snowpack, solve_steady
from netdesign.examples import envelope, history, panel, winter

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "netdesign" / "examples"
PAGE = (FOLDER / "README.md").read_text(encoding="utf-8")
NAMES = sorted(path.stem for path in FOLDER.glob("[!_]*.py"))
GRAVITY = 9.81


def run(name, folder):
    """Lines that an example prints; a warning is an error."""
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(io.StringIO()) as said:
        patch.chdir(folder)
        patch.setattr(sys, "argv", [name])
        importlib.import_module(f"netdesign.examples.{name}").main()
    return said.getvalue().splitlines()


def read_section(name):
    """Section of an example on the page."""
    return PAGE.partition(f"\n## {name}: ")[2].partition("\n## ")[0]


def run_as_shown(name, folder):
    """Lines that an example prints: those of the page, beside a picture of its size."""
    (command,) = re.findall(r"```sh\n(.*?)\n```", read_section(name))
    assert command == f"python -m netdesign.examples.{name}"
    (shown,) = re.findall(r"```text\n(.*?)```", read_section(name), re.DOTALL)
    lines = run(name, folder)
    assert lines == shown.splitlines()
    assert lines[-1] == f"wrote {name}.png"
    kept = FOLDER / "pictures" / f"{name}.png"
    assert read_size(folder / f"{name}.png") == read_size(kept)
    return lines


def read_size(picture):
    """Width and height of a PNG."""
    head = picture.read_bytes()[:24]
    assert head.startswith(b"\x89PNG")
    return struct.unpack(">II", head[16:24])


def numbers(line):
    return [float(text) for text in re.findall(r"\d+\.\d+", line)]


def test_one_net(tmp_path):
    foot, head, along, sag, _ = run_as_shown("one_net", tmp_path)
    (foot_size, foot_error), (head_size, head_error) = numbers(foot), numbers(head)
    assert 0.0 < foot_error < 0.01 * foot_size
    assert 0.0 < head_error < 0.01 * head_size
    assert foot_size > head_size > 0.0
    # The net cannot sag more than its two legs allow where its slack is 5 %.
    thickness = 4.0 * math.cos(math.radians(40))
    chord = thickness / math.cos(math.radians(30))
    assert 0.0 < numbers(sag)[0] < 0.5 * chord * (1.06**2 - 1.0) ** 0.5
    # All snow hangs on the net: rectangle, triangle below the net, and its bulge.
    area = thickness * (20.0 + 0.5 * thickness * math.tan(math.radians(30)))
    area += 2.0 / 3.0 * chord * numbers(sag)[0]
    weight = 380.0 * GRAVITY * math.sin(math.radians(40)) * area
    assert numbers(along)[0] * 1e3 == pytest.approx(weight, rel=5e-3)


def test_envelope(tmp_path):
    largest, bound, _ = run_as_shown("envelope", tmp_path)
    (maximum,), bound = numbers(largest), numbers(bound)[0]
    scene = envelope.TASK.scene
    forces = []
    for density, slack in product((250.0, 337.0, 450.0), (0.02, 0.047, 0.1)):
        pack = replace(scene.snowpack, density=density)
        other = replace(scene, snowpack=pack, net=replace(scene.net, slack=slack))
        forces.append(solve_steady(other, envelope.TASK.settings).foot.size / 1e3)
    assert max(forces) <= bound
    assert max(forces) == pytest.approx(maximum, rel=5e-3)
    assert maximum < bound < 1.02 * maximum


def test_layered_pack(tmp_path):
    heading, *lines, _ = run_as_shown("layered_pack", tmp_path)
    assert heading.startswith("ground")
    kinds = [line[9:16] for line in lines]
    assert kinds == ["layered", "uniform"] * 3
    pulls = [numbers(line[16:]) for line in lines]
    feet = [one[0] for one in pulls]
    # FACTS.md, section 7: scenes LA and LB
    assert feet[0] == pytest.approx(27.987, abs=0.1)
    assert feet[4] == pytest.approx(168.14, abs=pulls[4][1])
    # The more the ground slips, the more hangs on the net.
    assert feet[0] < feet[2] < feet[4]
    assert feet[1] < feet[3] < feet[5]


def test_history(tmp_path):
    foot, head, plateau, _ = run_as_shown("history", tmp_path)
    steady = solve_steady(history.SCENE)
    for line, pull in ((foot, steady.foot), (head, steady.head)):
        size, error = numbers(line)
        assert 0.0 < error < 0.05 * size
        assert size * 1e3 == pytest.approx(pull.size, rel=0.05)
    assert 1.0 < numbers(plateau)[0] < 48.0


def test_winter(tmp_path):
    largest, snow, highest, _ = run_as_shown("winter", tmp_path)
    (governing,), (top,) = (
        re.findall(r"\d{4}-\d\d-\d\d", line) for line in (largest, highest)
    )
    text = files("netdesign.examples").joinpath("winter_2000.csv").read_text("utf-8")
    lines = {line["date"]: line for line in csv.DictReader(text.splitlines())}
    assert float(lines[top]["HS [cm]"]) == max(
        float(line["HS [cm]"]) for line in lines.values()
    )
    assert top < governing
    # The file has the mass from which its heights were made.
    mass = float(re.findall(r"(\d+) kg/m2", snow)[0])
    assert mass == pytest.approx(float(lines[governing]["true SWE [kg/m2]"]), rel=0.2)
    # Uniform snow of the same height and mass is on the safe side of the layers.
    height = float(lines[governing]["HS [cm]"]) / 100
    pack = Snowpack(
        slope_angle=winter.SNOW.slope_angle,
        thickness=height * math.cos(winter.SNOW.slope_angle),
        upslope_length=winter.SNOW.upslope_length,
        density=mass / height,
    )
    uniform = solve_steady(replace(winter.SCENE, snowpack=pack)).foot.size / 1e3
    assert 0.5 * uniform < numbers(largest)[0] < 1.05 * uniform


def test_panel(tmp_path):
    foot, head, lower, upper, _ = run_as_shown("panel", tmp_path)
    (foot_size, foot_x), (head_size, head_x) = numbers(foot), numbers(head)
    assert foot_size > foot_x
    assert head_size > head_x
    # Feet and heads hold together what the net of one spacing holds of the snow.
    area = panel.THICKNESS * (20.0 + 0.5 * panel.THICKNESS * math.tan(math.radians(30)))
    weight = 380.0 * GRAVITY * math.sin(math.radians(40)) * area * 4.0 / 1e3
    assert weight < foot_x + head_x < 1.03 * weight
    # Each half of a rope pulls on its end with half of that end's load at least.
    assert numbers(lower)[0] > 0.5 * foot_size
    assert numbers(upper)[0] > 0.5 * head_size


@pytest.mark.long
def test_own_site(tmp_path):
    *lines, _ = run_as_shown("own_site", tmp_path)
    found = {numbers(line)[0]: (numbers(line)[1], line.split()[-1]) for line in lines}
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (as_built,) = re.findall(r"^R1 .*? (\d\.\d\d)$", readme, re.MULTILINE)
    assert found[4.0] == (pytest.approx(float(as_built), abs=0.005), "pass")
    # The wider posts carry snow in proportion to their spacing.
    assert found[7.0][0] / found[5.0][0] == pytest.approx(7.0 / 5.0, rel=0.01)
    verdicts = {spacing: verdict for spacing, (_, verdict) in found.items()}
    assert verdicts == {4.0: "pass", 5.0: "pass", 5.85: "not_proven", 7.0: "fail"}


def test_limit_profile(tmp_path):
    *lines, _ = run_as_shown("limit_profile", tmp_path)
    profiles = sorted(path.parent for path in ROOT.glob("standards/*/document.toml"))
    assert [line.split()[0] for line in lines] == [path.name for path in profiles]
    for line, profile in zip(lines, profiles, strict=True):
        table = tomllib.loads((profile / "factors.toml").read_text(encoding="utf-8"))
        factors = {one["id"]: one["value"] for one in table["factor"]}
        tested = factors.get("resistance.pull_out.tested")
        general = factors.get("resistance.pull_out")
        needed = 200.0 * factors["action.snow"] * (tested or general)
        assert numbers(line)[0] == pytest.approx(needed, abs=0.05)
