"""What is installed and shipped: pinned, licensed, and never asking the network."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.make import write_rows

ROOT = Path(__file__).resolve().parent.parent
CI = ROOT / ".ci"
NO_NETWORK = """
import socket
def refuse(*args, **kwargs):
    raise AssertionError(f"the network was asked: {args}")
for name in ("getaddrinfo", "gethostbyname", "create_connection"):
    setattr(socket, name, refuse)
for name in ("connect", "connect_ex", "bind", "sendto"):
    setattr(socket.socket, name, refuse)
import sys
sys.argv = ["netdesign", *sys.argv[1:]]
from netdesign.cli import main; main()
"""


def load(name):
    spec = importlib.util.spec_from_file_location(name, CI / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def list_pinned(path):
    text = path.read_text(encoding="utf-8")
    pins = re.findall(r"^([\w.-]+)==(\S+)", text, flags=re.MULTILINE)
    return {(re.sub(r"[-_.]+", "-", name).lower(), version) for name, version in pins}


def test_every_pinned_version_has_its_hashes():
    assert list_pinned(CI / "requirements.txt") == list_pinned(CI / "constraints.txt")
    text = (CI / "requirements.txt").read_text(encoding="utf-8")
    blocks = re.split(r"^(?=[\w.-]+==)", text, flags=re.MULTILINE)[1:]
    assert len(blocks) > 60
    for block in blocks:
        assert re.search(r"--hash=sha256:[0-9a-f]{64}", block), block[:60]


def test_everything_a_plain_install_brings_is_pinned_and_its_licence_listed():
    licences = load("licences")
    needed = licences.find_needed()
    assert {"numpy", "scipy", "mdurl"} <= set(needed)  # the last one by rich
    assert not {"matplotlib", "pillow"} & set(needed)  # extras
    assert set(needed) <= {name for name, _ in list_pinned(CI / "constraints.txt")}
    text = (CI / "licences.md").read_text(encoding="utf-8")
    listed = dict(re.findall(r"^\| ([\w-]+) \| (.+) \|$", text, flags=re.MULTILINE))
    assert listed.pop("package") == "licence"
    assert set(listed) == set(needed)
    assert all(len(licence) > 2 for licence in listed.values())
    assert not re.search(r"\b[AL]?GPL", text), "does it suit the MIT licence?"


def test_every_dependency_has_a_lowest_version(capsys):
    load("lowest").main()
    stated = capsys.readouterr().out.splitlines()
    assert "numpy==1.26.4" in stated


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="sockets are otherwise there")
def test_a_site_is_checked_without_a_network(tmp_path):
    """In two processes; every way to a socket of the network is an error."""
    write_rows(tmp_path / "site.xlsx", ["R1"])
    program = [sys.executable, "-c", NO_NETWORK, "check", "site.xlsx"]
    ended = subprocess.run(
        [*cut_off(), *program, "--accuracy", "0.1", "--jobs", "2", "--no-cache"],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ended.returncode == 0, ended.stderr
    assert (tmp_path / "netdesign-out" / "report.html").exists()


def cut_off():
    """Command that takes the network away, where the system lets us."""
    own = ["unshare", "--net"]
    try:
        subprocess.run([*own, "true"], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        return []
    return own
