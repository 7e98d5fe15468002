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
