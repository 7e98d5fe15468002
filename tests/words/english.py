"""Frequent words of each language that the two others do not have."""

import re

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
