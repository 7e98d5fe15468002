"""Files that somebody gives: what is wrong with them is told in words of ours."""

from __future__ import annotations

import pytest

from netdesign.edge.input_files import decode_utf8, find_resource, parse_toml
from netdesign.outcome import ContentError
from tests.each import each

INVALID = "not valid TOML (numbers take a decimal point, texts quotes)"


@each(
    "content, told",
    [
        ("a = 1.37\nb = 2 3\n", "(at line 2, column 7)"),
        ("a =", "(at end of document)"),
        (f"a = {'9' * 5000}", "4300 digits"),
        ("[a]\n[b]\n[a]\n", "(at line 3, column 3)"),
    ],
)
def test_a_fault_of_toml_is_told_by_its_place(content, told):
    with pytest.raises(ContentError) as caught:
        parse_toml(content.encode())
    message = str(caught.value.message)
    assert told in message
    assert message.endswith(INVALID)


def test_bytes_that_are_no_text_are_told_by_their_line():
    with pytest.raises(ContentError, match="line 3 is not in UTF-8"):
        decode_utf8(b"a = 1\nb = 2\nc = '\xe9'\n")
    assert decode_utf8(b"\xef\xbb\xbfa = 1") == "a = 1"
    with pytest.raises(ContentError, match="line 2 is"):
        decode_utf8(b"\xef\xbb\xbfa = 1\n\xff\n")


@pytest.fixture
def package(tmp_path):
    """An empty package in a folder of its own."""
    place = tmp_path / "lib" / "netdesign"
    place.mkdir(parents=True)
    return place


def test_a_wheel_has_them_inside_and_inside_wins(package):
    """Beside an installed package lies site-packages, where anything may lie."""
    (package.parent / "standards").mkdir()
    (package / "_data" / "standards").mkdir(parents=True)
    inside = package / "_data" / "standards"
    assert find_resource("standards", package) == inside
