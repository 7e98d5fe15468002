"""No text shows words of another language, and all that users read has a text."""

import ast
import re
import string

import pytest

from netdesign.site.columns.all_tables import PROJECT_ITEMS, RANGE_QUANTITIES, SHEETS
from netdesign.site.columns.fields import normalise
from netdesign.words.catalogue import LANGUAGES, load_texts, render
from netdesign.words.message import dump, restore, say
from tests.sources import walk_package
from tests.words.english import find_words

GUARDS = ("require_positive", "require_count", "require_within", "require_one_of")
# What a program's own tests of itself say, and the checks of the report's numbers.
OF_DEVELOPERS = ("evidence", "report", "bench.py")
OF_TERRAIN = ("terrain",)  # English only


# Titles of documents stay in their language.
QUOTING = ("profile_source.",)


def list_words(text):
    """Words of a text without its gaps, but with what joins the parts of a list."""
    for literal, _, joint, _ in string.Formatter().parse(text):
        yield f"{literal} {joint or ''}"


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_text_shows_words_of_another_language(language):
    others = [one for one in LANGUAGES if one != language]
    mixed = {}
    for key, text in load_texts(language).items():
        if key.startswith(QUOTING):
            continue
        plain = re.sub(r"--[a-z-]+", " ", " ".join(list_words(text)))  # options
        found = find_words(plain, others)
        if found and not key.startswith("profile_source."):  # quotes titles
            mixed[key] = found
    assert mixed == {}


def list_raised():
    """Every ``raise SomeError(argument)`` of the program with its first arguments."""
    for module, node in walk_package():
        if set(module.split("/")) & {*OF_DEVELOPERS, *OF_TERRAIN}:
            continue
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
            name = ast.unparse(node.exc.func)
            yield f"{module}:{node.lineno}", name, node.exc.args


# Told to nobody: what code does wrong, or what a caller catches and words itself.
OWN = ("ValueError", "TypeError", "KeyError", "RuntimeError", "SingularError")
OWN += ("AttributeError", "SystemExit")  # of Python itself


def test_nothing_is_raised_with_a_text():
    wrong = [
        place
        for place, name, arguments in list_raised()
        if name not in OWN
        for one in arguments
        if isinstance(one, ast.JoinedStr)
        or (isinstance(one, ast.Constant) and isinstance(one.value, str))
    ]
    assert wrong == []


def list_guarded():
    """Every name that a guard is called with."""
    for _, node in walk_package():
        is_call = isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
        if is_call and node.func.id in (*GUARDS, "require_lengths") and node.args:
            name = node.args[0]
            if isinstance(name, ast.Constant):
                yield name.value


def test_every_guarded_quantity_has_a_name():
    from netdesign.outcome import name_quantity

    names = set(list_guarded())
    assert len(names) > 50
    assert {name for name in names if str(name_quantity(name)) != name} == set()


FIELDS = [
    *(field for plan in SHEETS for field in plan.fields),
    *PROJECT_ITEMS,
    *RANGE_QUANTITIES,
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
    plain = dump(message)
    assert plain["arguments"]["lines"][1] == "site.xlsx"
    assert restore(plain) == message
    assert str(restore(plain)) == "3 cases\nsite.xlsx\n3 cases"


def test_a_sentence_inside_of_another_has_no_full_stop():
    reason = say("outcome.diverged")
    told = str(say("history.no_start", reason=reason))
    assert str(reason).endswith("residual.")
    assert "residual): choose" in told
