"""Frequent words of each language that the two others do not have."""

import re

from netdesign.words.catalogue import load_texts

WORD = re.compile(r"[^\W\d_]+")
SIGNS = {"max", "min", "positive"}  # of formulas; "positive" is French as well


def list_words(text):
    """Words of more than two letters, without signs."""
    return {one for one in WORD.findall(text.casefold()) if len(one) > 2} - SIGNS


def list_vocabulary(language):
    """Words of all texts of a language."""
    texts = load_texts(language).values()
    return set().union(*(list_words(re.sub(r"\{[^{}]*\}", " ", one)) for one in texts))
