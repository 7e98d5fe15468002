"""Page that compares the limit profiles of one run, without script."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from netdesign.checks.check import Check
from netdesign.report.blocks import (
    Cell,
    Items,
    Paragraph,
    Part,
    Table,
    masthead,
    name_columns,
    section,
    strong,
    text_cell,
)
from netdesign.report.page.render import render_page
from netdesign.report.sections.basis import name_profile
from netdesign.report.what_if import mark_verdict
from netdesign.report.words import (
    MISSING,
    Words,
    name_row,
    show_check,
    show_member,
    show_own,
    show_text,
    show_verdict,
)
from netdesign.structure.members import CARRYING_MEMBERS, EndMember, NetPart
from netdesign.study.records import RowStudy, Study
from netdesign.study.scopes import find_governing
from netdesign.words.catalogue import Language

_REST = ""  # checks that follow from no force: geometry, directions


def render_comparison(studies: Sequence[Study], language: Language = "en") -> bytes:
    """Contents of the page.

    Parameters
    ----------
    studies : sequence of Study
        Of one site, one for each profile.
    language : str
        Of the page.
    """
    words, first = Words(language), studies[0]
    title = words("compare.title")
    name = show_text(first.project.name or first.provenance.site_file)
    mark = words("what_if.mark") if first.what_if else ""
    marked = (Paragraph(text=strong(mark), look="word"),) if mark else ()
    profiles = tuple(
        words(
            "show.label", label=show_text(one.profile.id), text=name_profile(one, words)
        )
        for one in studies
    )
    rows = (
        _build_row([study.rows[place] for study in studies], studies, words)
        for place in range(len(first.rows))
    )
    blocks = (
        masthead(title, name, *marked),
        Part(
            id="profiles",
            blocks=(
                Items(items=profiles),
                Paragraph(text=words("compare.lead"), look="text"),
                _build_verdicts(studies, words).shown("profiles"),
                Paragraph(text=_report_differences(studies, words), look="text"),
            ),
        ),
        section(
            "rows",
            words("heading.net_rows"),
            *(table.shown("profiles") for table in rows),
        ),
        section(
            "values",
            words("heading.limit_profile"),
            _build_values(studies, words).shown("profiles"),
        ),
    )
    named = " - ".join(part for part in (mark, name, title) if part)
    return render_page(blocks, named, language).encode()


def _name_profiles(studies: Sequence[Study]) -> list[str]:
    return [show_text(one.profile.id) for one in studies]


def _build_verdicts(studies: Sequence[Study], words: Words) -> Table:
    """Verdict of each row, and of the site, by profiles."""
    lines = [
        (
            text_cell(row.id),
            *(_show_row(study, place, words) for study in studies),
        )
        for place, row in enumerate(studies[0].rows)
    ]
    whole = [text_cell(words("compare.whole"))]
    for study in studies:
        verdict = mark_verdict(study, words)
        whole.append(text_cell(f"{verdict.symbol} {verdict.word}"))
    headings = [words("heading.net_row"), *_name_profiles(studies)]
    return Table(
        caption=words("compare.overall_caption"),
        columns=name_columns(headings, numbers=()),
        rows=(*lines, tuple(whole)),
    )


def _show_row(study: Study, place: int, words: Words) -> Cell:
    verdict = show_verdict(study.rows[place].verdict, words)
    word = verdict.word
    if study.what_if:
        word = words("what_if.verdict", verdict=word)
    return text_cell(f"{verdict.symbol} {word}")


def _build_row(
    rows: Sequence[RowStudy], studies: Sequence[Study], words: Words
) -> Table:
    """Members of one row by profiles: verdict, utilisation, check, clause."""
    groups = [_group(row.checks) for row in rows]
    members = [one for one in _ORDER if any(one in group for group in groups)]
    headings = [words("heading.member"), *_name_profiles(studies)]
    return Table(
        caption=words(
            "compare.rows_caption", row=name_row(show_text(rows[0].id), words)
        ),
        columns=name_columns(headings, numbers=()),
        rows=tuple(
            (
                text_cell(_name_member(one, words)),
                *(_show_checks(group.get(one, []), words) for group in groups),
            )
            for one in members
        ),
        empty=words("heading.no_check"),
    )


_ORDER = (*CARRYING_MEMBERS, *NetPart, *EndMember, _REST)


def _name_member(member: str, words: Words) -> str:
    return show_member(words, member) if member else words("heading.rest")


def _group(checks: Iterable[Check]) -> dict[str, list[Check]]:
    """Checks by member; those without a force under one name."""
    groups: dict[str, list[Check]] = {}
    for check in checks:
        is_force = check.is_of_force and check.member in _ORDER
        groups.setdefault(check.member if is_force else _REST, []).append(check)
    return groups


def _show_checks(checks: Sequence[Check], words: Words) -> Cell:
    """Governing check of a member: verdict, utilisation, name, clause."""
    governing = find_governing(checks)
    if governing is None:
        return text_cell(words("compare.not_checked"))
    verdict = show_verdict(governing.verdict, words)
    used = words.show_number("utilisation", governing.used)
    told = verdict.word if used == MISSING else used
    parts = [f"{verdict.symbol} {told}", show_check(words, governing)]
    if governing.clause and governing.clause != MISSING:
        parts.append(governing.clause)
    return text_cell(words.join(parts))


def _report_differences(studies: Sequence[Study], words: Words) -> str:
    """Members whose verdict depends on the profile."""
    found = []
    for place, row in enumerate(studies[0].rows):
        groups = [_group(study.rows[place].checks) for study in studies]
        for member in _ORDER:
            verdicts = {_find_verdict(group.get(member, [])) for group in groups}
            if len(verdicts) > 1:
                named = _name_member(member, words)
                found.append(f"{show_text(row.id)} {named}")
    if not found:
        return words("compare.same")
    return words("compare.differs", members=tuple(found))


def _find_verdict(checks: Sequence[Check]) -> str | None:
    governing = find_governing(checks)
    return governing.verdict if governing else None


def _build_values(studies: Sequence[Study], words: Words) -> Table:
    """Values of the profiles, where they are not all alike.

    Each is named as the first profile that has it does.
    """
    texts = {
        one.id: show_own(words, one.text)
        for study in reversed(studies)
        for one in study.profile.values
    }
    by_profile = [
        {
            one.id: words.show_quantity(one.value, one.unit)
            for one in study.profile.values
        }
        for study in studies
    ]
    names = dict.fromkeys(name for values in by_profile for name in values)
    lines = [
        (text_cell(texts[name]), *(text_cell(v.get(name, MISSING)) for v in by_profile))
        for name in names
        if len({values.get(name) for values in by_profile}) > 1
    ]
    headings = [words("heading.value"), *_name_profiles(studies)]
    return Table(
        caption=words("compare.factors_caption"),
        columns=name_columns(headings, numbers=()),
        rows=tuple(lines),
        empty=words("compare.alike"),
    )
