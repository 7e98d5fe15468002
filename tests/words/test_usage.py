"""How a language is written: signs, one term for one thing, no term of the odd list."""

import re

import pytest

from netdesign.commands.help_texts import load_help
from netdesign.words.catalogue import load_texts, render
from netdesign.words.message import say

NO_BREAK = "\u00a0"
GAP = re.compile(r"\{[^{}]*\}")
# Typed, or of another language: times, clauses, addresses, paths, options' forms.
AS_TYPED = re.compile(
    r"\d:\d|\w+://\S*|[A-Z]\w*!\w+|gamma_\w(;\w+)+|-%-|min:max\S*|--\S+|f_R|γ|"
    r"\[?\bsupport\]?(?= et panel| et \[|, avec)|'[^']*'|\"[^\"]*\""
)


def list_texts(language):
    """Texts by their key, and those of help by the English ones."""
    return {**load_texts(language), **load_help(language).texts}


def strip(text):
    """Text with a sign for each gap, without what is typed."""
    return AS_TYPED.sub("x", GAP.sub("0", text))


def find(language, pattern, *, but=()):
    """Where a pattern stands, and what stands there."""
    found = {
        key: [one[0] for one in re.finditer(pattern, strip(text))]
        for key, text in list_texts(language).items()
        if not key.startswith(but)
    }
    return {key: ones for key, ones in found.items() if ones}


def test_french_has_a_no_break_space_before_double_signs():
    quoting = ("profile_source.", "profile_title.")
    assert find("fr", r"[^\s\u00a0](?:[;?!»]|:(?!\w))|«(?!\u00a0)", but=quoting) == {}


@pytest.mark.parametrize("language", ["fr", "de"])
def test_a_space_stands_before_per_cent(language):
    assert find(language, r"[^\s\u00a0\[(/]%(?!\w)") == {}


@pytest.mark.parametrize("language", ["fr", "de"])
def test_a_share_that_is_rounded_has_the_space_too(language):
    suction = say("balance.suction", share=0.753, accepted=0.01)
    text = render(suction, language)
    assert f"75{NO_BREAK}%" in text
    assert f"1{NO_BREAK}%" in text
    assert "75%" in render(suction, "en")


# What readers of the language stumbled over, or a second term for the same thing.
ODD = {
    "fr": {
        r"\bbandes?\b(?! (?:plane|de filet|entre))": "intervalle",
        r"[Nn]ulle part au-dessus": "majorant",
        r"[Ss]ortant du sol": "normal à la pente",
        r"\bessayés?\b": "justifié par essais",
        r"inverserait": "ce qui changerait le verdict",
        r"ils se ferment": "équilibre vérifié",
        r"\bla pied\b|\bune ouvrage\b": "au pied, un ouvrage",
        r"\bscènes?\b": "situation",
        r"\bsupports?\b": "appui",
        r"[Hh]istorique": "évolution",
        r"\bmurs?\b|\bparois?\b": "écran",
        r"échange alterné": "échange décalé",
        r"simulation couplée": "calcul couplé",
        r"(?<!directive )\bclauses?\b": "article",
        r"[Cc]âbles? de bord": "câble de rive",
        r"\btravées?\b": "panneau",
        r"\bdensités?\b": "masse volumique",
        r"[Ff]acteurs? partiels?": "coefficient partiel",
        r"\bfeuille (?:Monitoring|Ranges|Nets)\b": "nom de la feuille en français",
        r"’": "'",
    },
    "de": {
        r"(?<!Standort)(?<!Arbeits)[Mm]appe\b": "Arbeitsmappe",
        r"Abstützung": "Stütze",
        r"\bUrteil": "Ergebnis",
        r"\bKlausel\b": "Ziffer",
        r"[Uu]ntere Schranke": "Untergrenze",
        r"Korrelationsbeiwert": "Streuungsfaktor",
        r"Randwirkung|Randeinfluss": "Randeffekt",
        r"Querlast": "Last längs der Reihe",
        r"Herausziehwiderstand": "Ausziehwiderstand",
        r"gestaffelte": "versetzter Austausch",
        r"\bGeschichte\b": "Verlauf",
        r"\bGelände\b": "Standort",
        r"Elementnetz|Netz der Elemente": "Rechennetz",
        r"\bStich\b": "Durchhang",
        r"\bkippen\b|\bwendet\b": "das Ergebnis ändern",
        r"Blatt (?:Monitoring|Ranges|Nets)\b": "Name des Blatts auf Deutsch",
        r"[«»]": "„ “",
    },
}


@pytest.mark.parametrize(
    ("language", "term"), [(one, term) for one in ODD for term in ODD[one]]
)
def test_one_term_stands_for_one_thing(language, term):
    better = ODD[language][term]
    quoting = ("profile_source.",) if term.startswith("[«") else ()
    assert (better, find(language, term, but=quoting)) == (better, {})


@pytest.mark.parametrize(
    ("language", "count", "told"),
    [
        ("fr", 0, "0 réponse à donner"),
        ("fr", 1, "1 réponse à donner"),
        ("fr", 2, "2 réponses à donner"),
        ("de", 1, "1 Antwort fehlt,"),
        ("de", 0, "0 Antworten fehlen,"),
    ],
)
def test_a_count_brings_its_noun_along(language, count, told):
    assert render(say("map.missing", count=count), language).startswith(told)


@pytest.mark.parametrize(
    ("language", "told"),
    [
        ("en", "2017-12-01, 2018-02-17"),
        ("fr", "1er décembre 2017, 17 février 2018"),
        ("de", "01.12.2017, 17.02.2018"),
    ],
)
def test_days_in_sentences_are_written_as_the_language_has_them(language, told):
    days = say("winter_sheet.days", days=("2017-12-01", "2018-02-17"))
    assert render(days, language).replace(NO_BREAK, " ") == told


def test_what_is_no_day_stays():
    days = say("winter_sheet.days", days=("2017-13-45", "-"))
    assert render(days, "de") == "2017-13-45, -"
