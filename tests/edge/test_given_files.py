"""Files that somebody gives: what is wrong with them is told in words of ours."""

from __future__ import annotations

import pytest

from netdesign.edge.given_files import decode_utf8, parse_toml
from netdesign.outcome import ContentError
from netdesign.words.catalogue import render
from tests.each import each

INVALID = "kein gültiges TOML (Zahlen mit Dezimalpunkt, Texte in Anführungszeichen)"


@each(
    "content, told",
    [
        ("a = 1.37\nb = 2 3\n", f"in Zeile 2, Spalte 7: {INVALID}"),
        ("a =", f"am Ende: {INVALID}"),
        ('a = """x\n', f"am Ende: {INVALID}"),
        (f"a = {'9' * 5000}", "eine Zahl darin ist zu lang"),
        (
            "a = {b=1, b=2}",
            "in Zeile 1, Spalte 14: ein Schlüssel oder eine Tabelle zum zweiten Mal",
        ),
        (
            "[a]\n[b]\n[a]\n",
            "in Zeile 3, Spalte 3: ein Schlüssel oder eine Tabelle zum zweiten Mal",
        ),
    ],
)
def test_a_fault_of_toml_is_told_by_its_place(content, told):
    with pytest.raises(ContentError) as caught:
        parse_toml(content.encode())
    assert render(caught.value.message, "de") == told


def test_bytes_that_are_no_text_are_told_by_their_line():
    with pytest.raises(ContentError, match="line 3 is not in UTF-8"):
        decode_utf8(b"a = 1\nb = 2\nc = '\xe9'\n")
    assert decode_utf8(b"\xef\xbb\xbfa = 1") == "a = 1"
    with pytest.raises(ContentError, match="line 2 is"):
        decode_utf8(b"\xef\xbb\xbfa = 1\n\xff\n")
