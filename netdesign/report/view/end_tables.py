"""End effect of a row over gap and glide factor: the profile's beside the own one."""

from __future__ import annotations

from netdesign.report.blocks.table import (
    Cell,
    Table,
    given_cell,
    number_cell,
    number_column,
    text_cell,
    text_column,
)
from netdesign.report.words import Words
from netdesign.study.records import RowStudy
from netdesign.study.support_records import EndEffectRecord

_DECIMALS = "snow_thickness_m"  # the quantity whose decimals these numbers have
_VALUES = (
    ("end_length_m", "end_view.length"),
    ("profile_factor", "end_view.profile_factor"),
    ("profile_width_m", "end_view.profile_width"),
    ("free_factor", "end_view.free_factor"),
    ("free_width_m", "end_view.free_width"),
    ("pulled_factor", "end_view.pulled_factor"),
    ("pulled_width_m", "end_view.pulled_width"),
)


def build_end_effects(row: RowStudy, words: Words) -> Table:
    """End effects of a row; a table without lines where it has none."""
    return Table(
        caption=words("end_view.caption"),
        columns=(
            text_column(words("end_view.gap")),
            number_column("", words("end_view.glide")),
            *(number_column(_DECIMALS, words(key)) for _, key in _VALUES),
            text_column(""),
        ),
        rows=tuple(_list_effect(one, words) for one in row.end_effects),
        empty=words("show.none"),
    )


def _list_effect(effect: EndEffectRecord, words: Words) -> tuple[Cell, ...]:
    gap = effect.gap_m
    return (
        text_cell(words("end_view.no_gap")) if gap is None else given_cell(words, gap),
        given_cell(words, effect.glide_factor),
        *(number_cell(words, _DECIMALS, getattr(effect, key)) for key, _ in _VALUES),
        text_cell(words("end_view.own") if effect.is_own else ""),
    )
