"""Texts of help by the English ones, in the other languages.

A command has its help in English, as click wants it: the docstring, and the ``help`` of
each option in ``options.toml``. ``words/help/LANGUAGE.toml`` gives each of these texts
in another language, by the English one, paragraph by paragraph: one that changes is
missed at once. Help in English reads none of them.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from netdesign.words.catalogue import Language, keep_together

_EXTRAS = re.compile(r"(.*?)  \[([^\]]*)\]", re.DOTALL)  # click: "text  [default: 1]"
_COLUMNS = re.compile(r"(\s{2,})")
_METAVAR = re.compile(r"(?<![\w-])[A-Z][A-Z_]+(?: RANGE)?(?![\w.]*/)")
_AS_IT_STANDS = "\b"  # click breaks no line of such a paragraph
_CUT = "..."


@dataclass(frozen=True, slots=True)
class HelpTexts:
    """Texts of one language by the English ones.

    Attributes
    ----------
    texts : mapping of str to str
        Paragraphs, descriptions, and click's own headings.
    signs : mapping of str to str
        What is typed in the place of a value: ``DIRECTORY``, ``SITE_FILE``.
    extras : mapping of str to str
        What click adds to an option: ``default: `` with what follows it.
    """

    texts: Mapping[str, str]
    signs: Mapping[str, str]
    extras: Mapping[str, str]

    def tell(self, text: str) -> str:
        """One paragraph; of a text that click has cut short, the whole one."""
        key = " ".join(text.split())
        if key not in self.texts and key.endswith(_CUT):
            start = key.removesuffix(_CUT)
            key = next((one for one in self.texts if one.startswith(start)), key)
        return self.texts.get(key, text)

    def translate_paragraphs(self, text: str) -> str:
        """A command's help: paragraphs, and lines whose breaks are kept."""
        return "\n\n".join(
            "\n".join(self._describe_columns(line) for line in one.split("\n"))
            if one.startswith(_AS_IT_STANDS)
            else self.tell(one)
            for one in text.split("\n\n")
        )

    def translate_option(self, text: str) -> str:
        """Description of an option with what click has added to it."""
        found = _EXTRAS.fullmatch(text)
        if found is None:
            return self.tell(text)
        told = [self._describe_extra(one) for one in found[2].split("; ")]
        extras = self.extras.get("; ", "; ").join(told)
        return f"{self.tell(found[1])}  [{extras}]"

    def translate_signs(self, text: str) -> str:
        """Names of options and arguments with the signs of their values."""
        return _METAVAR.sub(lambda one: self.signs.get(one[0], one[0]), text)

    def _describe_columns(self, line: str) -> str:
        return "".join(self.tell(part) for part in _COLUMNS.split(line))

    def _describe_extra(self, extra: str) -> str:
        name, mark, value = extra.partition(": ")
        return self.extras.get(name + mark, name + mark) + value


@lru_cache
def load_help(language: Language) -> HelpTexts:
    """Texts of help in a language; none for English, which the commands have."""
    if language == "en":
        return HelpTexts({}, {}, {})
    # every start of the program would pay for them, also where none asks for help
    import tomllib
    from importlib.resources import files

    file = files("netdesign.words") / "help" / f"{language}.toml"
    tables = tomllib.loads(file.read_text(encoding="utf-8"))
    if language == "fr":
        tables["texts"] = {
            key: keep_together(text) for key, text in tables["texts"].items()
        }
    return HelpTexts(**tables)
