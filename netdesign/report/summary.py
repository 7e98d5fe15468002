"""Study and its view -> the summary that a terminal shows."""

from __future__ import annotations

from netdesign.report.terminal import Headings, RowLine, Summary
from netdesign.report.view.check_view import rank_check
from netdesign.report.view.row_tables import describe_flip, is_far_from_limit
from netdesign.report.view.whole import ReportView, RowView, build_view
from netdesign.report.words import MISSING, Words, show_check, show_text
from netdesign.study.records import ChangeRecord, Study
from netdesign.words.catalogue import Language


def build_summary(
    study: Study,
    language: Language = "en",
    view: ReportView | None = None,
    *,
    explain: bool = False,
) -> Summary:
    """Summary of a study in a language.

    Parameters
    ----------
    study : Study
        What was found.
    language : str
        Of the summary, and of ``view``.
    view : ReportView, optional
        That of the study, if it is known.
    explain : bool
        Whether to say what would flip each failing, unproven or close check.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    words, view = Words(language), view or build_view(study, language)
    none = words("heading.no_check")
    return Summary(
        headings=_name_columns(words),
        rows=tuple(_show_row(row, none) for row in view.rows),
        mark=view.mark,
        legend=view.legend,
        lines=tuple(_list_lines(view, words)),
        overall=words("show.overall", verdict=""),
        verdict=view.verdict.word,
        style=view.verdict.style,
        meaning=view.verdict.meaning,
        changes=tuple(list_changes(study, words)) if explain else (),
    )


def _name_columns(words: Words) -> Headings:
    return Headings(
        row=words("heading.net_row"),
        verdict=words("heading.verdict"),
        check=words("heading.governing_check"),
        utilisation=words("heading.utilisation"),
        utilisation_band=words("show.utilisation_band"),
        demand=words("heading.demand"),
        resistance=words("heading.resistance"),
        case=words("heading.case"),
    )


def _show_row(row: RowView, none: str) -> RowLine:
    check, verdict = row.governing, row.verdict
    known = {"id": row.id, "verdict": verdict.word, "style": verdict.style}
    if check is None:
        return RowLine(
            **known,
            check=none,
            check_and_case=none,
            utilisation=MISSING,
            band="",
            demand=MISSING,
            resistance=MISSING,
            case=MISSING,
        )
    return RowLine(
        **known,
        check=check.title,
        check_and_case=f"{check.title}\n{check.case_short}",
        utilisation=check.utilisation,
        band="" if check.band == MISSING else check.band,
        demand=check.demand,
        resistance=check.resistance,
        case=check.case_short,
    )


def _list_lines(view: ReportView, words: Words) -> list[str]:
    def name(label: str, text: str) -> str:
        return words("show.label", label=label, text=text)

    lines = [name(row.id, reason) for row in view.rows for reason in row.reasons]
    lines = lines or [words("show.reasons_none")]
    lines += [
        name(words("show.label", label=row.id, text=row.governing.title), load)
        for row in view.rows
        if row.governing and (load := row.governing.load)
    ]
    lines += [name(label, text) for label, text in view.counts]
    lines += [name(words("heading.declared_elsewhere"), one) for one in view.declared]
    assumed = view.assumed_line or words("show.none")
    notes = [words("show.note", note=note) for note in view.notes]
    return [*lines, words("show.assumed_line", values=assumed), *notes]


def list_changes(study: Study, words: Words) -> list[str]:
    """Lines of what flips each failing, unproven or close check; else why nothing.

    Of each row the governing check comes first.
    """
    checks = [
        (row, check)
        for row in study.rows
        for check in sorted(row.checks, key=rank_check)
    ]
    found = []
    for row, check in checks:
        place = words(
            "show.row_and_check",
            row=row.id,
            check=show_check(words, check),
            verdict=words(f"verdict.{check.verdict}"),
        )
        for change in check.changes:
            told = _describe_change(change, words)
            found.append(show_text(words("show.label", label=place, text=told)))
    if found:
        return found
    is_far = all(is_far_from_limit(check) for _, check in checks)
    return [words("show.no_change" if is_far else "show.no_change_alone")]


def _describe_change(change: ChangeRecord, words: Words) -> str:
    text = describe_flip(change, words)
    if change.bound is not None:
        text = words("show.passes_with", change=text)
    if change.solves == 1:
        text = words("show.after_one_solve", change=text)
    elif change.solves:
        text = words("show.after_solves", change=text, count=change.solves)
    if change.note is None:
        return text
    return words("show.with_note", text=text, note=words.show(change.note))
