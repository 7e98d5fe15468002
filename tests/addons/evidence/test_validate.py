"""``netdesign validate FILE``: what cannot be read is refused by name."""

import pytest


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (None, "No such file"),
        (b"[[structure]]\nx =\n", "at line 2, column 4: not valid TOML"),
        (b"\xff\xfe", "line 1 is not in UTF-8"),
    ],
)
def test_a_file_that_cannot_be_read_is_named_with_its_fault(
    call, tmp_path, content, told
):
    path = tmp_path / "mine.toml"
    if content is not None:
        path.write_bytes(content)
    ended = call("validate", path, "--out", tmp_path / "page")
    assert ended.code == 3
    assert f"{path}: " in ended.err
    assert told.lower() in ended.err.lower()
    assert not (tmp_path / "page").exists()


STRUCTURE = """
[[structure]]
id = "{name}"
title = "My net"
source = "me"
[[structure.measured]]
name = "guy"
members = ["uphill_guy"]
value_kN = 34.17
mark = "read"
[structure.inputs]
slope_deg = {{ value = 37.3, mark = "read" }}
"""
SCHEMA = 'schema = "netdesign.measured/1"\n'


@pytest.mark.parametrize("name", ["my-net", "Ä 7"])
def test_a_fault_of_a_structure_names_it(call, tmp_path, name):
    path = tmp_path / "mine.toml"
    text = SCHEMA + STRUCTURE.format(name=name)
    path.write_text(text, encoding="utf-8")
    ended = call("validate", path, "--out", tmp_path / "page")
    assert ended.code == 3
    assert f"{path}: structure {name}: inputs: accepted" in ended.err
