"""Names of a site's inputs in the language of a report, from the site workbook."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from netdesign.report.words import Words, show_text
from netdesign.site.columns.all_tables import SHEETS
from netdesign.words.catalogue import Language

_ENDS = ("low", "high", "samples")
# What ranges, which has no column of its own.
_OWN = {
    "density": "input.density",
    "friction angle": "change.friction_angle",
    "net inclination": "input.net_inclination",
}
_DERIVED, _LAYER = ", from the ", "layer "


def show_input(words: Words, label: str) -> str:
    """Name of an input as the reader of the site gives it: a column, or a part of one.

    Parts are an end of a range, a layer, or what was derived from another input.
    """
    if words.language == "en":
        return show_text(label)
    name, mark, other = label.partition(_DERIVED)
    if mark:
        derived, origin = _show_column(words, name), _show_column(words, other)
        return words("show.input_derived", input=derived, other=origin)
    name, _, end = label.rpartition(", ")
    if end in _ENDS:
        shown, part = _show_column(words, name), words(f"input_end.{end}")
        return words("show.input_end", input=shown, end=part)
    if name.startswith(_LAYER):
        shown, number = _show_column(words, end), name.removeprefix(_LAYER)
        return words("show.input_layer", number=number, input=shown)
    return _show_column(words, label)


def _show_column(words: Words, label: str) -> str:
    if label in _OWN:
        return words(_OWN[label])
    return show_text(_list_labels(words.language).get(label, label))


@lru_cache(maxsize=3)
def _list_labels(language: Language) -> Mapping[str, str]:
    """Names of the inputs, as the site workbook has them."""
    return {
        field.label: field.wordings[language].label
        for plan in reversed(SHEETS)  # a net row's fields count more than a type's
        for field in plan.fields
        if language in field.wordings
    }
