"""No text shows words of another language, and all that users read has a text."""

import ast
import json

import pytest

from netdesign.edge.json_text import write_json
from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.columns.fields import normalise
from netdesign.words.catalogue import LANGUAGES, render
from netdesign.words.message import restore, say
from tests.site.columns.fields import FIELDS as BY_TABLE
from tests.site.columns.fields import QUANTITIES
from tests.sources import list_calls

GUARDS = ("require_positive", "require_count", "require_within", "require_one_of")


# Told to nobody: what code does wrong, or what a caller catches and words itself.
OWN = ("ValueError", "TypeError", "KeyError", "RuntimeError", "SingularError")
OWN += ("AttributeError", "SystemExit")  # of Python itself


def list_guarded():
    """Every name that a guard is called with."""
    for _, node, called in list_calls():
        if called in GUARDS and node.args and isinstance(node.args[0], ast.Constant):
            yield node.args[0].value


def test_every_guarded_quantity_has_a_name():
    from netdesign.outcome import name_quantity

    names = set(list_guarded())
    assert len(names) > 50
    assert {name for name in names if str(name_quantity(name)) != name} == set()


FIELDS = [
    field for table in (*BY_TABLE.values(), *QUANTITIES.values()) for field in table
]


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_refusal_names_headings_and_words_that_are_accepted(language):
    for field in FIELDS:
        assert normalise(render(field.name, language)) in field.names
        spellings = set(map(normalise, field.spellings))
        for word in field.words:
            shown = render(field.name_word(word), language)
            assert normalise(shown) in spellings
    for plan in SHEETS:
        assert plan.matches(render(plan.title, language))


def test_a_message_is_stored_and_comes_back():
    inner = say("unit.count_cases", count=3)
    message = say("text.lines", lines=(inner, "site.xlsx", inner))
    plain = json.loads(write_json(message))
    assert plain["arguments"]["lines"][1] == "site.xlsx"
    assert restore(plain) == message
    assert str(restore(plain)) == "3 cases\nsite.xlsx\n3 cases"
