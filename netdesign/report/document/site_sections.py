"""Sections of a document about all rows: verdict, signatures, summary, basis."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.report.document import styles
from netdesign.report.document.content import (
    Content,
    Grid,
    Piece,
    badge,
    list_pairs,
    plain,
    show_utilisation,
    small,
    symbols,
)
from netdesign.report.document.writer import Writer
from netdesign.report.view.table import Table
from netdesign.report.view.whole import ReportView, RowView
from netdesign.report.words import MISSING


def write_verdict(to: Writer, view: ReportView) -> None:
    """Title, verdict, and what stands behind it."""
    t = to.words
    to.text(t("heading.anchor_check"), styles.SMALL)
    to.text(view.identification[0][1], styles.TITLE)
    if view.mark:
        to.paragraph((Piece(view.mark, is_bold=True),), styles.VERDICT)
        to.table(view.what_if)
    to.paragraph((badge(view.verdict),), styles.VERDICT)
    to.text(view.verdict.meaning)
    row = view.governing_row
    pairs = _list_governing(to, row)
    pairs += [(label, plain(text)) for label, text in view.counts]
    declared = (str(len(view.declared)), *view.declared)
    none = t("show.none")
    pairs.append(
        (
            t("heading.declared_elsewhere"),
            plain("\n".join(declared) if view.declared else none),
        )
    )
    pairs.append((t("heading.assumed"), plain(view.assumed_line or none)))
    if view.defaults_line:
        pairs.append((t("heading.not_typed"), plain(view.defaults_line)))
    pairs += [(label, plain(text)) for label, text in view.verification]
    to.grid(list_pairs("", pairs))


def _list_governing(to: Writer, row: RowView | None) -> list[tuple[str, Content]]:
    """Governing check of the site, what would flip it, how far it holds."""
    t = to.words
    check = row.governing if row else None
    if row is None or check is None:
        return [(t("heading.governing_check"), plain(t("heading.no_check")))]
    case = f"; {check.case}" if check.case != MISSING else ""
    told = f", {t('heading.in_net_row')} {row.id}{case}\n{check.reason}"
    told += f"\n{check.load}" if check.load else ""
    used = (Piece("\n"), *show_utilisation(check)) if check.bar else ()
    governing = (Piece(check.title, is_bold=True), Piece(told), *used)
    passes = check.verdict.style == "pass"
    key = "passes_only_up_to" if passes else "passes_with_any"
    flips = (t(f"heading.{key}"), *row.flips)
    no_change = t("heading.no_single_change")
    pairs: list[tuple[str, Content]] = [
        (t("heading.governing_check"), governing),
        (
            t("heading.what_would_flip_it"),
            plain("\n".join(flips) if row.flips else no_change),
        ),
    ]
    if row.held:
        pairs.append((t("heading.single_values"), plain("\n".join(row.held))))
    if row.model_form_line:
        pairs.append((t("opinion.second"), plain(row.model_form_line)))
    return pairs


def write_identification(to: Writer, view: ReportView) -> None:
    """Subject of the report, and room for signatures and revisions."""
    t = to.words
    to.heading(plain(t("heading.identification")))
    to.grid(
        list_pairs("", [(label, plain(text)) for label, text in view.identification])
    )
    roles = ("prepared", "checked", "approved")
    names = (view.prepared, view.checked, "")
    _sign(
        to,
        "signatures",
        [t(f"heading.{one}") for one in ("role", "name", "date", "signature")],
        [
            (t(f"heading.{role}"), name, "", "")
            for role, name in zip(roles, names, strict=True)
        ],
    )
    people = " / ".join(t(f"heading.{role}") for role in roles)
    headings = [t(f"heading.{one}") for one in ("revision", "date", "change")]
    lines = [(view.revision, view.date, "", ""), ("", "", "", "")]
    _sign(to, "revisions", [*headings, people], lines)


def _sign(
    to: Writer, name: str, headings: list[str], lines: Sequence[tuple[str, ...]]
) -> None:
    to.grid(
        Grid(
            caption=to.words(f"heading.{name}"),
            headings=tuple(plain(one) for one in headings),
            numbers=(False,) * len(headings),
            lines=tuple(tuple(plain(one) for one in line) for line in lines),
        )
    )


def write_summary(to: Writer, view: ReportView) -> None:
    """Matrix of rows by members, and the governing check of each row."""
    t = to.words
    to.heading(plain(t("heading.summary_of_rows")))
    to.table(view.matrix)
    if not view.rows:
        to.none(t("heading.no_rows"))
        return
    headings = (
        t("heading.net_row"),
        t("heading.verdict"),
        t("heading.governing_check_and_case"),
        f"{t('heading.demand')}\n[kN]",
        f"{t('heading.resistance')}\n[kN]",
        t("heading.utilisation"),
    )
    to.grid(
        Grid(
            caption=t("heading.summary_caption"),
            headings=tuple(plain(one) for one in headings),
            numbers=(False, False, False, True, True, True),
            lines=tuple(line for row in view.rows for line in _sum_up(to, row)),
        )
    )


def _sum_up(to: Writer, row: RowView) -> list[tuple[Content, ...]]:
    """One line of a row, and one below it where there is more to say."""
    t, check = to.words, row.governing
    first = ((Piece(row.id, is_bold=True),), (badge(row.verdict),))
    if check is None:
        blank = plain(MISSING)
        lines = [(*first, plain(t("heading.no_check")), blank, blank, blank)]
    else:
        case = check.case if check.case != MISSING else check.reason
        title = (Piece(check.title), Piece(f"\n{case}", is_small=True))
        both = (plain(check.demand), plain(check.resistance))
        lines = [(*first, title, *both, show_utilisation(check))]
    more = [*row.reasons, *([check.load] if check and check.load else [])]
    if row.highest:
        highest = row.highest
        more.append(
            t(
                "show.highest",
                utilisation=highest.utilisation,
                band=highest.band,
                check=highest.title,
            )
        )
    return [*lines, *([(small(more),)] if more else [])]


def write_basis(to: Writer, view: ReportView, *, is_full: bool) -> None:
    """Statements for all rows: scope, reading, ranges, inputs, notes, assumptions."""
    t = to.words
    to.heading(plain(t("heading.basis")))
    to.subheading("heading.scope")
    to.items(view.scope)
    to.subheading("heading.reading")
    for sentence in view.reading:
        to.paragraph(symbols(sentence))
    to.subheading("heading.ranges")
    to.table(view.ranges)
    to.subheading("heading.inputs")
    for inputs in view.site_inputs:
        to.table(inputs)
    to.subheading("heading.notes")
    notes = (*view.notes, *view.shared_notes)
    to.items(notes)
    if not notes:
        to.none(t("show.none"))
    if is_full:
        to.subheading("heading.assumptions")
        to.table(view.assumptions)


def write_formulas(to: Writer, view: ReportView) -> None:
    """Formulas of all figures."""
    to.heading(plain(to.words("heading.formulas")))
    for table in (view.figure_tables, view.formulas):
        to.grid(_list_sentences(table))


def _list_sentences(table: Table) -> Grid:
    """Table of text with symbols."""
    return Grid(
        caption=table.caption,
        headings=tuple(plain(column.heading) for column in table.columns),
        numbers=tuple(False for _ in table.columns),
        lines=tuple(tuple(symbols(one.text) for one in line) for line in table.rows),
    )


def write_profile(to: Writer, view: ReportView) -> None:
    """Limit profile with its sources, and the quality of the solutions."""
    to.heading(plain(to.words("heading.limit_profile")))
    to.text(view.profile_title)
    to.table(view.numbered_profile)
    for source in view.sources:
        to.none(source)
    to.heading(plain(to.words("heading.solver_quality")))
    to.table(view.quality)
    to.table(view.outcomes)


def write_end(to: Writer, view: ReportView) -> None:
    """Checklist and provenance."""
    to.heading(plain(to.words("heading.checklist")))
    to.table(view.checklist)
    to.heading(plain(to.words("heading.provenance")))
    to.table(view.provenance)
    to.none("\u00a0")
