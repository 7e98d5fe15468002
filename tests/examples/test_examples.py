"""The examples run as their texts say, and print what the solvers find."""

import re
import subprocess
import sys
import xml.etree.ElementTree as ET

import pytest


def run(name, folder):
    """Lines that an example prints; a warning is an error."""
    result = subprocess.run(
        [sys.executable, "-W", "error", "-m", f"netdesign.examples.{name}"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stderr
    assert result.stderr == ""
    return result.stdout.splitlines()


def numbers(line):
    return [float(text) for text in re.findall(r"\d+\.\d+", line)]


def test_one_net(tmp_path):
    foot, head, sag, wrote = run("one_net", tmp_path)
    # Scene file of the README but for its ground; two meshes say how far it is off.
    (foot_size, foot_error), (head_size, head_error) = numbers(foot), numbers(head)
    assert 0.0 < foot_error < 0.01 * foot_size
    assert 0.0 < head_error < 0.01 * head_size
    assert foot_size > head_size > 0.0
    # The net cannot sag more than its two legs allow where its slack is 5 %.
    chord = 4.0 * 0.766 / 0.866
    assert 0.0 < numbers(sag)[0] < 0.5 * chord * (1.06**2 - 1.0) ** 0.5
    assert wrote == "wrote one_net.svg"
    picture = (tmp_path / "one_net.svg").read_text(encoding="utf-8")
    assert ET.fromstring(picture).tag == "{http://www.w3.org/2000/svg}svg"


def test_layered_pack(tmp_path):
    heading, *lines = run("layered_pack", tmp_path)
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
