"""What is written is what ``json`` writes, with a margin, from dataclasses."""

import json
from dataclasses import asdict, dataclass, field

import pytest

from netdesign.edge.json_text import join_items, join_members, write_json
from netdesign.outcome import Verdict
from tests.each import each


@dataclass(frozen=True)
class Part:
    name: str
    places: list[tuple[float, float]]
    verdict: Verdict = Verdict.NOT_PROVEN


@dataclass(frozen=True)
class Whole:
    parts: list[Part]
    flat: dict[str, float | None]
    mixed: dict[str, object]
    empty: list[int] = field(default_factory=list)
    none: dict[str, int] = field(default_factory=dict)


WHOLE = Whole(
    parts=[
        Part('a, [b] {c}: "d"\n', [(0.1 + 0.2, -1e-300), (1e22, 5.0)]),
        Part("ü", []),
    ],
    flat={"x": None, 'k"ey': 1.0 / 3.0, "n": 7},
    mixed={"yes": True, "deep": {"er": [[], {}, [1, [2]], "é"]}, "text": "line\nline"},
)


@each("document", [WHOLE, WHOLE.parts, 1.5, "text", None, [], {}, [1], [[1]], {"a": 1}])
def test_the_text_is_that_of_json(document):
    plain = asdict(document) if document is WHOLE else document
    if document is WHOLE.parts:
        plain = [asdict(part) for part in document]
    told = {"separators": (",\n", ": "), "ensure_ascii": False}
    assert write_json(document) == json.dumps(plain, **told)


@pytest.mark.parametrize("sign", ["\x9b", "\u202e", "\ud800"])
def test_a_sign_that_steers_becomes_a_code(sign):
    text = write_json({"a": [f"x{sign}y", {"b": 1}]})
    assert sign not in text
    assert json.loads(text) == {"a": [f"x{sign}y", {"b": 1}]}


@pytest.mark.parametrize("document", [[float("nan")], {"a": [1, [float("inf")]]}])
def test_what_is_no_number_is_refused(document):
    with pytest.raises(ValueError, match="not JSON compliant"):
        write_json(document)


def test_what_is_no_part_of_a_document_is_refused():
    with pytest.raises(TypeError, match="not JSON serializable"):
        write_json({"a": [object()]})


def test_joined_parts_are_the_text_of_the_whole():
    whole = {"a": [WHOLE, 1.5, "\u202e é"], 'ke"y': {}, "none": [], "n": 7}
    items = join_items([write_json(one) for one in whole["a"]])
    parts = {key: write_json(value) for key, value in whole.items()}
    assert join_members({**parts, "a": items}) == write_json(whole)
    assert join_items([]) == write_json([])
    assert join_members({}) == write_json({})
