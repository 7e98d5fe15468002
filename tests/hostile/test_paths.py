"""Paths that no file can have are refused as a fault of the command line."""

import pytest

LONG = "9" * 400


@pytest.mark.parametrize(
    "command",
    [
        ("check", LONG),
        ("check", f"{LONG}.csv"),
        ("check", f"{LONG}/site.xlsx"),
        ("check", "site.csv", "--annotate", f"{LONG}.xlsx"),
        ("check", "--example", "--out", LONG),
        ("report", LONG),
        ("diff", LONG, LONG),
        ("solve", LONG),
        ("standards", "show", LONG),
        ("standards", "validate", LONG),
        ("standards", "copy", "eurocode", LONG),
        ("init", LONG),
        ("init", f"{LONG}/site.xlsx"),
    ],
)
def test_a_name_too_long_for_a_file_is_no_bug(call, tmp_path, command):
    (tmp_path / "site.csv").write_text("id;slope\n1;2\n")
    ended = call(*command)
    assert ended.code in (2, 3)
    assert "internal" not in ended.err
    assert LONG in ended.err.replace("\n", "")
    assert [path.name for path in tmp_path.iterdir()] == ["site.csv"]
