"""Second opinions on a row's forces: closed form, spread of the model form."""

from __future__ import annotations

from netdesign.report.blocks.table import (
    Cell,
    Table,
    given_cell,
    number_cell,
    quantity_column,
    text_cell,
    text_column,
)
from netdesign.report.words import (
    Words,
    show_member,
    show_text,
)
from netdesign.study.opinion_records import ModelFormRecord, SlabCase, VariantRecord
from netdesign.study.records import RowStudy
from netdesign.words.names import name

_SLIP = "matched_slip_m"  # shown in centimetres: nobody typed it
_SLAB = (
    "influence_length_m",
    "dynamic_kN_per_m",
    "at_rest_kN_per_m",
    "wedge_kN_per_m",
    "load_kN_per_m",
    "foot_anchor_kN",
    "uphill_guy_kN",
    "post_kN",
    "load_difference_percent",
    "foot_difference_percent",
)
_ANSWERS = {"yes": "show.yes", "no": "show.no"}
_FORCES = ("foot_anchor_kN", "uphill_guy_kN", "post_kN")


def build_slab(row: RowStudy, words: Words) -> Table:
    """Creep and glide pressure in closed form beside the coupled solve."""
    record = row.slab
    columns = (
        text_column(words("opinion.ground")),
        *(quantity_column(words, key) for key in (_SLIP, *_SLAB)),
    )
    caption, empty = words("opinion.slab"), words("heading.no_case_converged")
    if record is None:
        return Table(caption=caption, columns=columns, rows=(), empty=empty)
    known = {
        "load_kN_per_m": record.solved_load_kN_per_m,
        "foot_anchor_kN": record.solved_foot_anchor_kN,
    }
    solved = (
        text_cell(words("show.coupled_solve", case=words.name_case(record.case))),
        *(number_cell(words, key, known.get(key)) for key in (_SLIP, *_SLAB)),
    )
    cases = tuple(
        (
            text_cell(_name_ground(case, words)),
            number_cell(words, _SLIP, case.slip_length_m),
            *(number_cell(words, key, getattr(case, key)) for key in _SLAB),
        )
        for case in record.cases
    )
    return Table(caption=caption, columns=columns, rows=(solved, *cases), empty=empty)


def tell_slab(row: RowStudy, words: Words) -> str:
    """The closed form's forces in one line, one part for each ground; "" without."""
    if row.slab is None:
        return ""
    parts = [
        words(
            "opinion.slab_case",
            ground=_name_ground(case, words),
            load=words.show_with_unit("load_kN_per_m", case.load_kN_per_m),
            foot=words.show_with_unit("foot_anchor_kN", case.foot_anchor_kN),
        )
        for case in row.slab.cases
    ]
    return words(
        "opinion.slab_line",
        load=words.show_with_unit("load_kN_per_m", row.slab.solved_load_kN_per_m),
        foot=words.show_with_unit("foot_anchor_kN", row.slab.solved_foot_anchor_kN),
        cases=words.join(parts),
    )


def _name_ground(case: SlabCase, words: Words) -> str:
    named = words.show(name("slab_ground", case.name))
    if case.reason is None:
        return named
    return words("show.explained", what=named, reason=words.show(case.reason))


def build_model_form(row: RowStudy, words: Words) -> Table:
    """Governing case by other models of the same snow, with each one's force."""
    record = row.model_form
    return Table(
        caption=words("opinion.model_form"),
        columns=(
            text_column(words("opinion.model")),
            text_column(words("opinion.law")),
            *(quantity_column(words, key) for key in ("exponent", _SLIP)),
            text_column(words("opinion.stated")),
            text_column(words("opinion.given")),
            *(quantity_column(words, key) for key in _FORCES),
            quantity_column(words, "change_percent"),
            text_column(words("heading.remark")),
        ),
        rows=tuple(_list_variant(one, words) for one in record.variants)
        if record
        else (),
        empty=words("opinion.none"),
    )


def _list_variant(one: VariantRecord, words: Words) -> tuple[Cell, ...]:
    change = None if one.ratio is None else 100.0 * (one.ratio - 1.0)
    return (
        text_cell(words.show(name("variant", one.kind))),
        text_cell(show_text(one.creep_law)),
        given_cell(words, one.exponent),
        number_cell(words, _SLIP, one.slip_length_m),
        text_cell(_tell(one.stated, words)),
        text_cell(words("show.yes" if one.is_calibrated else "show.no")),
        *(number_cell(words, key, getattr(one, key)) for key in _FORCES),
        number_cell(words, "change_percent", change),
        text_cell(words.show(one.reason)),
    )


def _tell(answer: str, words: Words) -> str:
    """``yes`` or ``no`` in the language; whatever else a study may hold, as it is."""
    return words(_ANSWERS[answer]) if answer in _ANSWERS else show_text(answer)


def tell_model_form(record: ModelFormRecord | None, words: Words) -> str:
    """Spread of the model form beside the numerical interval; "" without any."""
    if record is None:
        return ""
    given: dict[str, str | int] = {
        "member": show_member(words, record.member),
        "force": words.show_with_unit("solved_kN", record.force_kN),
        "count": sum(one.ratio is not None for one in record.variants),
        "low": words.show_with_unit("solved_kN", record.force_kN * record.low_ratio),
        "high": words.show_with_unit("solved_kN", record.force_kN * record.high_ratio),
    }
    ends = {
        "use_low": record.utilisation_low,
        "use_high": record.utilisation_high,
        "num_low": record.numerical_low,
        "num_high": record.numerical_high,
    }
    if None in ends.values():
        return words("model.sentence", **given)
    shown = {
        key: words.show_with_unit("utilisation", value) for key, value in ends.items()
    }
    return words("model.sentence_use", **given, **shown)
