import click
import pytest

from netdesign.commands.options import RANGE
from tests.each import each


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("250:450", (250.0, 450.0, None)),
        ("15:45:7", (15.0, 45.0, 7)),
        ("0:0.1:2", (0.0, 0.1, 2)),
        ("-5:5", (-5.0, 5.0, None)),
    ],
)
def test_ranges_are_read(text, expected):
    found = RANGE.convert(text, None, None)
    assert (found.low, found.high, found.count) == expected


@each(
    "text, told",
    [
        ("450:250", "is reversed: accepted is low:high"),
        ("300:300", "is empty: accepted is low below high"),
        ("300", "accepted is low:high or low:high:n"),
        ("", "accepted is low:high or low:high:n"),
        ("a:b", "accepted is low:high or low:high:n"),
        ("1:2:3:4", "accepted is low:high or low:high:n"),
        ("1:2:x", "accepted is low:high or low:high:n"),
        ("1:2:2.5", "accepted is low:high or low:high:n"),
        ("nan:2", "accepted is low:high or low:high:n"),
        ("1:inf", "accepted is low:high or low:high:n"),
        ("1:2:1", "accepted are 2 to 1000 samples"),
        ("1:2:0", "accepted are 2 to 1000 samples"),
        ("1:2:1001", "accepted are 2 to 1000 samples"),
    ],
)
def test_faulty_ranges_are_refused_with_the_text_and_what_is_accepted(text, told):
    with pytest.raises(click.BadParameter) as caught:
        RANGE.convert(text, None, None)
    assert repr(text) in str(caught.value)
    assert told in str(caught.value)
