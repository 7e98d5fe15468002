"""Second opinions of a study, worked out again: guideline, closed form, model form."""

from __future__ import annotations

from collections.abc import Iterator

from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CreepLaw
from netdesign.structure.members import Member
from netdesign.study.audit.comparing import is_same, tell_differences
from netdesign.study.audit.envelope_audit import find_largest, same_point
from netdesign.study.effects import load_guideline
from netdesign.study.model_form import span_variants
from netdesign.study.record_cases import read_point
from netdesign.study.record_guideline import compare_case
from netdesign.study.record_slab import compare_slab
from netdesign.study.records import RowStudy
from netdesign.units import newton_from_kilonewton
from netdesign.words.message import Message, say


def audit_slab(row: RowStudy, given: NetRow, law: CreepLaw) -> Iterator[Message]:
    """The closed form, again from the forces that it stands beside."""
    stored = row.slab
    if stored is None:
        return
    again = compare_slab(
        given,
        read_point(stored.case),
        law,
        load=newton_from_kilonewton(stored.solved_load_kN_per_m),
        foot=newton_from_kilonewton(stored.solved_foot_anchor_kN),
    )
    place = say("audit.row", row=row.id)
    yield from tell_differences("audit.other_slab", stored, again, place=place)


def audit_model_form(row: RowStudy) -> Iterator[Message]:
    """The spread of the model form, from the forces of its variants."""
    stored = row.model_form
    if stored is None:
        return
    again, place = span_variants(stored), say("audit.row", row=row.id)
    yield from tell_differences("audit.other_model_form", stored, again, place=place)


def audit_guideline(row: RowStudy, given: NetRow) -> Iterator[Message]:
    """The comparison with the guideline, from the forces that it states."""
    stored = row.guideline
    if stored is None or stored.sha256 != load_guideline().sha256:
        return
    point = stored.case
    again = compare_case(
        given,
        read_point(point),
        load=newton_from_kilonewton(stored.solved_load_kN_per_m),
        foot=newton_from_kilonewton(stored.solved_foot_anchor_kN),
    )
    place = say("audit.row", row=row.id)
    yield from tell_differences("audit.other_guideline", stored, again, place=place)
    largest = find_largest(row, Member.FOOT_ANCHOR)
    if largest is not None and not (
        same_point(point, largest.case)
        and is_same(stored.solved_foot_anchor_kN, largest.foot_anchor_kN)
    ):
        yield say("audit.guideline_case", place=place)
