"""The examples run as their page says, print what it shows, and find what is so."""

import importlib
import io
import math
import re
import struct
import sys
from contextlib import redirect_stdout
from dataclasses import replace
from itertools import product
from pathlib import Path

import pytest

from netdesign import SolverSettings, solve_steady
from netdesign.examples import envelope, panel

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "netdesign" / "examples"
PAGE = (FOLDER / "README.md").read_text(encoding="utf-8")
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
    scene, settings = envelope.SCENE, SolverSettings(accuracy=envelope.ACCURACY)
    forces = []
    for density, slack in product((250.0, 337.0, 450.0), (0.02, 0.047, 0.1)):
        pack = replace(scene.snowpack, density=density)
        other = replace(scene, snowpack=pack, net=replace(scene.net, slack=slack))
        forces.append(solve_steady(other, settings).foot.size / 1e3)
    assert max(forces) <= bound
    assert max(forces) == pytest.approx(maximum, rel=5e-3)
    assert maximum < bound < 1.02 * maximum


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
