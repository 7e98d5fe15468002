"""Languages of the reports: all renders in each, none shows words of another."""

import re
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.checks import load_standard
from netdesign.report.page import render_html
from netdesign.report.words import Words, show_own
from netdesign.words.catalogue import LANGUAGES, load_texts, render
from netdesign.words.message import Message, say
from tests.report.build_study import SCRIPT, build_study
from tests.words.gaps import list_gaps

SHIPPED = ("nf-p-95-304-style", "eurocode", "onr-24805-style", "swiss-guideline-2007")
OTHERS = [language for language in LANGUAGES if language != "en"]
OF_NUMBER = re.compile(r"[+,]?\d*(\.\d+)?[%gef]?")  # all else is for words of ours
TYPED = st.text(st.characters(codec="utf-8"), max_size=20)
NUMBER = st.floats(allow_nan=False, allow_infinity=False)


def fill(key, argument):
    """Message of a key whose every gap has the same argument."""
    return Message(key, dict.fromkeys(list_gaps(load_texts("en")[key]), argument))


@given(
    key=st.sampled_from(sorted(load_texts("en"))),
    number=NUMBER,
    language=st.sampled_from(LANGUAGES),
)
def test_every_text_takes_any_number(key, number, language):
    gaps = re.findall(r"\{(\w+):([^{}]*)\}", load_texts("en")[key])
    told = [name for name, form in gaps if not OF_NUMBER.fullmatch(form)]
    whole = dict.fromkeys(told, say("show.none"))
    message = Message(key, {**fill(key, number).arguments, **whole})
    assert render(message, language)


@given(typed=TYPED, language=st.sampled_from(LANGUAGES))
def test_what_somebody_typed_stays_as_it_is(typed, language):
    shown = render(say("check.of_cell", what=say("check.type", type=typed), cell="A"),
                   language)  # fmt: skip
    assert typed in shown


@pytest.mark.parametrize("language", OTHERS)
def test_shipped_profiles_are_translated(language):
    words, profiles = Words(language), [load_standard(one) for one in SHIPPED]
    texts = [f"{profile.title}, {profile.edition}" for profile in profiles]
    texts += [
        text
        for profile in profiles
        for one in profile.listed
        for text in (one.text, one.source)
    ]
    texts += [profile.choice_text for profile in profiles if profile.choice]
    assert len(set(texts)) > 90
    assert [text for text in texts if show_own(words, text) == text] == []


def test_what_somebody_typed_is_never_translated():
    study = build_study()
    row = replace(study.rows[-1], id="Post")
    page = render_html(replace(study, rows=[*study.rows[:-1], row]), "fr")
    assert "Couloir 1" in page
    assert ">Post</a>" in page
    assert SCRIPT not in page
