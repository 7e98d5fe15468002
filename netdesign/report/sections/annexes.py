"""Annexes of a report: all checks, other models, cases, profile, provenance."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Sequence

from netdesign.checks.check import CasePoint
from netdesign.outcome import EXIT_CODES, Outcome
from netdesign.report.blocks import (
    Block,
    Cell,
    Column,
    Items,
    Paragraph,
    Part,
    Table,
    key_columns,
    name_columns,
    number_cell,
    quantity_column,
    section,
    symbols,
    text_cell,
)
from netdesign.report.sections import basis, worked
from netdesign.report.sections.basis import label_rows, name_profile
from netdesign.report.what_if import name_study
from netdesign.report.words import (
    MISSING,
    Words,
    add_unit,
    show_member,
    show_own,
    show_text,
    show_unit,
    show_verdict,
)
from netdesign.structure.members import REPORTED_MEMBERS
from netdesign.study.case_records import CaseRecord
from netdesign.study.records import ModelFormRecord, RowStudy, Study
from netdesign.words.catalogue import name
from netdesign.words.message import Message

_NUMBER = re.compile(r"[0-9]+(\.[0-9]+)?(e[+-]?[0-9]+)?")


def list_annexes(study: Study, words: Words) -> Iterator[Part]:
    """Annexes in their order."""
    none = Paragraph(text=words("heading.no_rows"), look="none")
    yield worked.show_all(study, words, _name_symbols(study, words))
    yield show_quality(study, words)
    yield section(
        "annex-cases",
        words("heading.annex_cases"),
        *(build_cases(row, words).shown("extremes") for row in study.rows),
        *(() if study.rows else (none,)),
    )
    yield basis.show_profile(study, words)
    yield section(
        "annex-verify",
        words("heading.annex_verify"),
        Paragraph(text=words("heading.verify_explained"), look="small"),
        build_provenance(study, words).shown("provenance"),
    )


def _name_symbols(study: Study, words: Words) -> Paragraph:
    """Symbols of the calculations of the study, each with its name and unit."""
    steps = (step for row in study.rows for check in row.checks for step in check.steps)
    units = {step.symbol: step.unit for step in steps}
    texts = [
        words("show.label", label=symbol, text=_name_symbol(symbol, unit, words))
        for symbol, unit in units.items()
    ]
    return Paragraph(text=symbols(words.join(texts)), look="small")


def _name_symbol(symbol: str, unit: str, words: Words) -> str:
    name = words(f"symbol.{symbol}")
    return name if unit == "-" else f"{name} [{show_unit(unit)}]"


_BUILT_IN = "example.xlsx"  # which `verify` has, too


def name_verification(study: Study) -> str:
    """Command that solves every case of a report again and compares it."""
    site = study.provenance.site_file
    named = f" --site {shlex.quote(site)}" if site and site != _BUILT_IN else ""
    return show_text(f"netdesign verify --study {name_study(study)}{named}")


def build_provenance(study: Study, words: Words) -> Table:
    """All that is needed to repeat the study."""
    made = study.provenance
    pairs = {
        "verify_report": name_verification(study),
        "program": f"netdesign {made.version}",
        "started": made.started,
        "site_file": made.site_file,
        "site_hash": made.site_sha256,
        "limit_profile": words(
            "show.label", label=study.profile.id, text=name_profile(study, words)
        ),
        "profile_version": study.profile.version,
        "profile_choice": study.profile.choice,
        "profile_hash": study.profile.sha256,
        "schema": study.schema,
    }
    named = {words(f"heading.{key}"): text for key, text in pairs.items()}
    for key, text in made.settings.items():
        setting = words.show(name("setting", key))
        shown = _show_setting(key, text, words)
        named[words("show.setting", setting=setting)] = shown
    libraries = ", ".join(f"{k} {v}" for k, v in made.libraries.items())
    named[words("heading.libraries")] = libraries
    verdict = show_verdict(study.verdict, words)
    code = EXIT_CODES[study.verdict]
    named[words("heading.exit_code")] = words(
        "show.exit_code", code=code, verdict=verdict.word
    )
    return Table(
        caption=words("caption.provenance"),
        columns=key_columns(words, "heading.", ("item", "value")),
        rows=tuple(
            (text_cell(label), text_cell(text)) for label, text in named.items() if text
        ),
    )


def _show_setting(key: str, text: str, words: Words) -> str:
    """Setting as stored; a number, and only that, with the language's mark."""
    if key == "method":
        return words.show(name("method_used", text))
    return words.write(text) if _NUMBER.fullmatch(text) else show_own(words, text)


_QUANTITIES = ("density_kg_m3", "friction_deg", "inclination_deg")


def show_quality(study: Study, words: Words) -> Part:
    """Annex with the forces by other models."""
    return section(
        "annex-quality",
        words("heading.annex_quality"),
        build_opinions(study, words).shown("extremes"),
        *_list_refused(study, words),
        Items(items=tuple(_tell_information(study, words))),
    )


def _tell_information(study: Study, words: Words) -> Iterator[str]:
    """What decides nothing: why the guideline's forces differ, and notes of a row."""
    yield from _list_causes(study, words)
    for row in study.rows:
        for note in row.notes:
            if not basis.is_of_row(note):
                text = words.show(note)
                yield words("show.label", label=show_text(row.id), text=text)


_DENSITY = "guideline.other_density"  # a cause of which each row has its own numbers


def _list_causes(study: Study, words: Words) -> list[str]:
    """Why the guideline's forces differ: each cause once, with its net rows."""
    rows: dict[str, list[str]] = {}
    densities: dict[str, list[Message]] = {}
    for row in study.rows:
        sentence = row.guideline.sentence if row.guideline else None
        causes = sentence.arguments.get("causes", (sentence,)) if sentence else ()
        for cause in causes if isinstance(causes, tuple) else ():
            if isinstance(cause, Message) and cause.key == _DENSITY:
                densities.setdefault(row.id, []).append(cause)
            elif isinstance(cause, Message):
                rows.setdefault(words.show(cause), []).append(row.id)
    if densities:
        known = [cause for causes in densities.values() for cause in causes]
        text = words(_DENSITY, **{x: _show_span(known, x, words) for x in _LOADS})
        rows = {text: list(densities), **rows}
    return label_rows(rows, study, words)


_LOADS = ("guideline", "coupled")


def _show_span(messages: Sequence[Message], name: str, words: Words) -> str:
    """Least and largest of a number that messages have, in whole ones."""
    numbers = [float(str(message.arguments[name])) for message in messages]
    low, high = (words.show_fixed(x, 0) for x in (min(numbers), max(numbers)))
    return low if low == high else words("show.from_to", low=low, high=high)


def explain_case(case: CaseRecord, words: Words) -> Cell:
    """End of a case with its reason."""
    if case.outcome is Outcome.CONVERGED:
        return text_cell(words.show(case.reason))
    sentence = words.show(case.outcome.message)
    if case.reason is None:
        return text_cell(sentence)
    reason = words.show(case.reason)
    return text_cell(
        words("show.sentence_and_reason", sentence=sentence, reason=reason)
    )


def build_cases(row: RowStudy, words: Words) -> Table:
    """Every case of a row with its forces or the reason why there are none.

    How each ended is said where one ended otherwise than converged.
    """
    keys = [f"{member}_kN" for member in REPORTED_MEMBERS]
    keys += ["error_percent", "balance_residual"]
    caption, name = words("caption.cases"), show_text(row.id)
    odd = any(x.reason or x.outcome is not Outcome.CONVERGED for x in row.cases)
    return Table(
        caption=words("show.label", label=name, text=caption),
        columns=(
            *list_case_columns(words, row),
            *(quantity_column(words, key) for key in keys),
            *(key_columns(words, "heading.", ("outcome", "reason")) if odd else ()),
        ),
        rows=tuple(
            (
                *_show_case(case.case, words),
                *(number_cell(words, key, getattr(case, key)) for key in keys),
                *(_tell_end(case, words) if odd else ()),
            )
            for case in row.cases
        ),
        empty=words("show.none"),
    )


def _tell_end(case: CaseRecord, words: Words) -> tuple[Cell, ...]:
    return text_cell(words(f"ended.{case.outcome}")), explain_case(case, words)


def list_case_columns(words: Words, row: RowStudy) -> tuple[Column, ...]:
    """Columns of the quantities of a row's cases."""
    keys = row.cases[0].case.values if row.cases else _QUANTITIES
    return tuple(quantity_column(words, key) for key in keys)


def _show_case(case: CasePoint, words: Words) -> tuple[Cell, ...]:
    return tuple(number_cell(words, *value) for value in case.values.items())


def _list_refused(study: Study, words: Words) -> Iterator[Block]:
    """Other creep laws that give no force, each reason once, with its net rows."""
    rows: dict[str, list[str]] = {}
    for row in study.rows:
        for variant in row.model_form.variants if row.model_form else ():
            if variant.ratio is None:
                reason = words.show(variant.reason)
                named = words("spread.creep_law", law=variant.creep_law)
                text = reason if named in reason else f"{named}, {reason}"
                rows.setdefault(text, []).append(row.id)
    if rows:
        yield Items(items=tuple(label_rows(rows, study, words)), look="small")


def build_opinions(study: Study, words: Words) -> Table:
    """Forces by other models beside the coupled one, a line a row."""
    headings = [
        add_unit(words(f"opinion.{key}"), "kN")
        for key in ("coupled", "load_case_1", "load_case_2")
    ]
    others = words("opinion.other_snow")
    return Table(
        caption=words("opinion.caption"),
        columns=(
            Column(heading=words("heading.net_row")),
            *name_columns(headings, numbers=headings),
            Column(heading=others),
        ),
        rows=tuple(_opinion_row(row, words) for row in study.rows),
        empty=words("show.none"),
    )


def _opinion_row(row: RowStudy, words: Words) -> tuple[Cell, ...]:
    guideline = row.guideline
    coupled = guideline.solved_foot_anchor_kN if guideline else None
    cases = guideline.cases if guideline else []
    by_case = {case.name: case.foot_anchor_kN for case in cases}
    return (
        text_cell(row.id),
        number_cell(words, "foot_anchor_kN", coupled),
        number_cell(words, "foot_anchor_kN", by_case.get("load_case_1")),
        number_cell(words, "foot_anchor_kN", by_case.get("load_case_2")),
        text_cell(_describe_model_form(row.model_form, words)),
    )


def _describe_model_form(record: ModelFormRecord | None, words: Words) -> str:
    """Spread of the governing force over other models of the snow; "-" without."""
    if record is None:
        return MISSING
    ends = [record.force_kN * ratio for ratio in record.ratios]
    return words(
        "opinion.spread",
        member=show_member(words, record.member),
        band=words.show_band("solved_kN", *ends),
        count=sum(variant.ratio is not None for variant in record.variants),
    )
