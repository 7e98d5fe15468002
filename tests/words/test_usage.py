"""How a language is written: signs, one term for one thing, no term of the odd list."""

import re
import tomllib
from functools import cache
from pathlib import Path

from netdesign import words
from netdesign.words.catalogue import LANGUAGES, load_texts
from tests.each import each

GAP = re.compile(r"\{[^{}]*\}")
# Typed, or of another language: times, clauses, addresses, paths, options' forms.
AS_TYPED = re.compile(
    r"\d:\d|\w+://\S*|[A-Z]\w*!\w+|gamma_\w(;\w+)+|-%-|min:max\S*|--\S+|f_R|γ|"
    r"\[?\bsupport\]?(?= et panel| et \[|, avec)|'[^']*'|\"[^\"]*\""
)


@cache
def join_texts(language):
    """All texts with a sign for each gap, without what is typed, a line each."""
    return "\n".join(
        AS_TYPED.sub("x", GAP.sub("0", text)).replace("\n", " ")
        for key, text in load_texts(language).items()
        if not key.startswith(QUOTING)
    )


# What readers of the language stumbled over, or a second term for the same thing.
TERMS = tomllib.loads(Path(words.__file__).with_name("terms.toml").read_text("utf-8"))
# Words of standards that are quoted.
QUOTING = ("profile_source.", "profile_about.", "resistance_source.")
AVOIDED = [
    (language, name, pattern)
    for name, term in TERMS.items()
    for language in LANGUAGES
    for pattern in term.get(f"avoid_{language}", ())
]


def test_every_term_is_defined_in_three_languages_with_its_source():
    assert len(TERMS) > 30
    for term in TERMS.values():
        needed = {"definition", "source", *LANGUAGES}
        assert needed <= term.keys() <= needed | {f"avoid_{one}" for one in LANGUAGES}
        assert all(term[key] for key in term)


@each("language, name, pattern", AVOIDED)
def test_one_term_stands_for_one_thing(language, name, pattern):
    better = TERMS[name][language]
    assert (better, re.findall(pattern, join_texts(language))) == (better, [])
