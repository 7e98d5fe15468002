"""Annexes of a report: all checks, other models, cases, profile, provenance."""

from __future__ import annotations

import re
from collections.abc import Iterator

from netdesign.report.blocks import (
    Paragraph,
    Part,
    Table,
    key_columns,
    section,
    symbols,
    text_cell,
)
from netdesign.report.sections import basis, quality, worked
from netdesign.report.sections.basis import name_profile
from netdesign.report.words import (
    VERDICTS,
    Words,
    show_own,
    show_unit,
    show_verdict,
)
from netdesign.study.document import hash_results
from netdesign.study.records import Study
from netdesign.words.names import name

_NUMBER = re.compile(r"[0-9]+(\.[0-9]+)?(e[+-]?[0-9]+)?")


def list_annexes(study: Study, words: Words) -> Iterator[Part]:
    """Annexes in their order."""
    yield worked.show_all(study, words, _name_symbols(study, words))
    yield quality.show_quality(study, words)
    yield section(
        "annex-cases",
        words("heading.annex_cases"),
        quality.stack_rows(
            words("caption.cases"), study, quality.build_cases, words
        ).shown("extremes"),
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
    steps = (step for row in study.rows for one in row.checks for step in one.steps)
    units = {step.symbol: step.unit for step in steps}
    told = [
        words("show.label", label=symbol, text=_name_symbol(symbol, unit, words))
        for symbol, unit in units.items()
    ]
    return Paragraph(text=symbols(words.join(told)), look="small")


def _name_symbol(symbol: str, unit: str, words: Words) -> str:
    name = words(f"symbol.{symbol}")
    return name if unit == "-" else f"{name} [{show_unit(unit)}]"


def _write_command(words: Words) -> str:
    """Command that makes the document again, in its language."""
    language = "" if words.language == "en" else f" --language {words.language}"
    return f"netdesign report study.json{language}"


def build_provenance(study: Study, words: Words) -> Table:
    """All that is needed to repeat the study."""
    made = study.provenance
    pairs = {
        "command_again": _write_command(words),
        "results_hash": hash_results(study),
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
    code = VERDICTS[study.verdict].exit_code
    named[words("heading.exit_code")] = words(
        "show.exit_code", code=code, verdict=verdict.word
    )
    return Table(
        caption=words("caption.provenance"),
        columns=key_columns(words, "heading.", ("item", "value")),
        rows=tuple(
            (text_cell(one), text_cell(text)) for one, text in named.items() if text
        ),
    )


def _show_setting(key: str, text: str, words: Words) -> str:
    """Setting as stored; a number, and only that, with the language's mark."""
    if key == "method":
        return words.show(name("method_used", text))
    return words.write(text) if _NUMBER.fullmatch(text) else show_own(words, text)
