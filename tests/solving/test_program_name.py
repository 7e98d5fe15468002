"""The program's name: another one for all of its text, and for the profiles."""

import pytest

from netdesign.solving import store as module
from netdesign.solving.store import identify_program


def test_a_changed_profile_is_another_program(tmp_path, monkeypatch):
    place = tmp_path / "standards" / "one" / "file.txt"
    place.parent.mkdir(parents=True)
    place.write_bytes(b"text")
    monkeypatch.setattr(module, "find_resource", lambda name: tmp_path / name)
    before = identify_program()
    place.write_bytes(b"texT")
    after = identify_program()
    place.rename(place.with_name("other.txt"))
    assert len({before, after, identify_program()}) == 3


@pytest.mark.parametrize("variable", ["OPENBLAS_CORETYPE", "OMP_NUM_THREADS"])
def test_a_variable_that_moves_a_digit_counts(monkeypatch, variable):
    monkeypatch.delenv(variable, raising=False)
    before = identify_program()
    monkeypatch.setenv(variable, "7")
    assert identify_program() != before


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
