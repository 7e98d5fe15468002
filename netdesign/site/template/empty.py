"""Notes of the template on a cell: accepted content, and what an empty cell means."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from netdesign.cable.sag import find_sag
from netdesign.site.assumed import Assumed, load_assumed
from netdesign.site.columns.fields import Field
from netdesign.site.columns.office import Column, load_text
from netdesign.words.catalogue import Language, render, set_marks
from netdesign.words.message import say

# What a range is a multiple of, and which of its ends are.
_TIMES = {"net_height": ("D_K", 2), "altitude_factor": ("f_c", 1)}


def say_empty(column: Column, language: Language) -> str:
    """Range or value that is assumed for an empty cell, or a phrase about it."""
    values = column.assumed or _list_ends(column)
    if values:
        texts = dict.fromkeys(_show(value, language) for value in values)
        return f" {load_text('to', language)} ".join(texts)
    if column.said:
        return load_text(column.said, language, "said")
    assumed = _find(column)
    return render(assumed.text, language) if assumed else ""


def say_why(column: Column, language: Language) -> str:
    """Source of the assumed value; empty where nothing is assumed."""
    if language in column.texts["why"]:
        return column.texts["why"][language]
    assumed = _find(column)
    return render(assumed.why, language) if assumed else ""


def say_accepted(column: Column, language: Language) -> str:
    """Bounds or words that a cell accepts, in the shown unit; empty for free text."""
    field = column.field
    low, high = _show_in_unit(column, field.bounds)
    is_share = column.choice == "sag_unit" or column.unit == "%"
    units = ("%",) if is_share else field.units
    shown = replace(field, bounds=(low, high), units=units)
    accepted = describe_accepted(shown, language)
    if not field.may_range:
        return accepted
    return render(say("accepted.or_range", accepted=accepted), language)


def describe_accepted(field: Field, language: Language) -> str:
    """Accepted content of a cell as a phrase; empty where all is accepted."""
    is_open = not field.words and field.bounds[0] == field.bounds[1]
    return "" if is_open else render(field.accepted, language)


def _find(column: Column) -> Assumed | None:
    if column.said or column.field.required or not column.has:
        return None
    return load_assumed().get(column.field.key)


def _list_ends(column: Column) -> Sequence[float | str]:
    assumed = _find(column)
    if assumed is None or assumed.word:
        return ()
    ends = (assumed.low, assumed.high) if assumed.times else assumed.shown
    if assumed.times:
        sign, count = _TIMES[assumed.times]
        return (f"{ends[0]:g} {sign}", f"{ends[1]:g} {sign}" if count > 1 else ends[1])
    return _show_in_unit(column, ends)


def _show_in_unit(column: Column, ends: Sequence[float]) -> tuple[float, ...]:
    """Ends of a range in the unit that the template shows."""
    if column.choice == "sag_unit":
        return tuple(round(100.0 * find_sag(end), 1) for end in ends)
    share = 100.0 if column.unit == "%" and column.field.unit == "-" else 1.0
    return tuple(round(share * end, 6) for end in ends)


def _show(value: float | str, language: Language) -> str:
    text = value if isinstance(value, str) else f"{value:.6g}"
    return set_marks(text, language)
