"""The installation's name: another one for all that could change a last digit."""

import sys

import pytest

from netdesign.solving import store as module
from netdesign.solving.store import identify_installation, identify_program


@pytest.fixture
def resources(tmp_path, monkeypatch):
    """Folders of profiles and templates that a test may change."""
    for name in ("standards", "templates"):
        (tmp_path / name / "one").mkdir(parents=True)
        (tmp_path / name / "one" / "file.txt").write_bytes(b"text")
    monkeypatch.setattr(module, "find_resource", lambda name: tmp_path / name)
    return tmp_path


@pytest.mark.parametrize("name", ["standards", "templates"])
def test_a_changed_profile_or_template_is_another_installation(resources, name):
    before = identify_installation()
    place = resources / name / "one" / "file.txt"
    place.write_bytes(b"texT")
    after = identify_installation()
    place.rename(place.with_name("other.txt"))
    assert len({before, after, identify_installation()}) == 3


@pytest.mark.parametrize(
    "variable", ["OPENBLAS_CORETYPE", "OMP_NUM_THREADS", "PYTHONHASHSEED", "NPY_X"]
)
def test_a_variable_that_could_move_a_digit_counts(resources, monkeypatch, variable):
    monkeypatch.delenv(variable, raising=False)
    before = identify_installation()
    monkeypatch.setenv(variable, "7")
    assert identify_installation() != before


def test_every_library_counts_also_those_that_others_need(
    resources, monkeypatch, tmp_path
):
    monkeypatch.setattr(sys, "path", [*sys.path, str(tmp_path / "more")])
    place = tmp_path / "more" / "markupsafe-3.0.0.dist-info"
    place.mkdir(parents=True)
    before = identify_installation()
    place.rename(place.with_name("markupsafe-3.0.1.dist-info"))
    assert identify_installation() != before


def test_the_text_of_every_module_counts(tmp_path):
    """A copy of the package with one more sign in any part is another program."""
    names = set()
    parts = ("search/maxima.py", "structure/head.py", "units.py")
    for place in parts:
        root = tmp_path / place
        for path in parts:
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text("#" if path == place else "")
        names.add(identify_program(root))
    assert len(names) == 3
