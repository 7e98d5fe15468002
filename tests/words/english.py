"""Frequent words of each language that the two others do not have."""

import re

from netdesign.words.catalogue import load_texts

WORD = re.compile(r"[^\W\d_]+")
SIGNS = {"max", "min", "positive"}  # of formulas; "positive" is French as well

FREQUENT = {
    "en": (
        "the is are with not must that which has been cannot should than there needs "
        "its of and more below above given stands holds read or file row sheet"
    ),
    "fr": "le la les est une pas dans avec pour aucun trop doit sont il au du",
    "de": "der das und ist nicht ein eine von muss mit kein keine zu sich wird auf",
}


def find_words(text, languages):
    """Frequent words of some languages that stand in a text."""
    words = set(re.findall(r"[^\W\d_]+", text.casefold()))
    return {
        word
        for language in languages
        for word in FREQUENT[language].split()
        if word in words
    }


def list_words(text):
    """Words of more than two letters, without signs."""
    return {one for one in WORD.findall(text.casefold()) if len(one) > 2} - SIGNS


def list_vocabulary(language):
    """Words of all texts of a language."""
    texts = load_texts(language).values()
    return set().union(*(list_words(re.sub(r"\{[^{}]*\}", " ", one)) for one in texts))
