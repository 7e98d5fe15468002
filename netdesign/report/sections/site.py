"""Sections about all rows as blocks: decision, signatures, summary, basis, annexes."""

from __future__ import annotations

from collections.abc import Iterator

from netdesign.report.blocks.block import (
    Block,
    Contents,
    Heading,
    Items,
    Pair,
    Pairs,
    Paragraph,
    Part,
    masthead,
    section,
)
from netdesign.report.blocks.table import (
    Cell,
    Table,
    name_columns,
    rich_cell,
    text_cell,
)
from netdesign.report.blocks.text import (
    HIDDEN,
    SMALL,
    Badge,
    Content,
    Piece,
    keep_units,
    link,
    refer,
    small,
    strong,
    symbols,
)
from netdesign.report.sections.cells import badge_cell, show_utilisation
from netdesign.report.view.check_view import CheckView
from netdesign.report.view.whole import ReportView, RowView
from netdesign.report.words import MISSING, Words

_FULL = ("formulas", "profile", "quality")  # sections that a summary has not


def show_title(view: ReportView, words: Words) -> Part:
    """Name of the project; of a what-if, what was replaced."""
    more: tuple[Block, ...] = ()
    if view.mark:
        more = (Paragraph(text=strong(view.mark), look="word"), view.what_if)
    title = view.identification[0][1]
    return masthead(words("heading.anchor_check"), title, *more)


def show_verdict(view: ReportView, words: Words, *, is_full: bool) -> Part:
    """Verdict, what governs it, and what stands behind it."""
    row = view.governing_row
    governing = row.governing if row else None
    lead = Part(
        kind="div",
        look="lead",
        blocks=(
            Paragraph(text=(Badge(view.verdict, "word"),), look="word"),
            Paragraph(text=view.verdict.meaning, look="meaning"),
        ),
    )
    gauge = (_show_gauge(governing, words),) if governing and governing.bar else ()
    facts = (*gauge, Pairs(pairs=tuple(_list_facts(view, words))))
    card = Part(
        kind="div",
        look=f"card {view.verdict.style}",
        blocks=(lead, Part(kind="div", look="facts", blocks=facts)),
    )
    keys = Pairs(look="keys", pairs=tuple(_list_keys(view, words, is_full=is_full)))
    heading = Heading(text=words("heading.verdict"), level=2, look=HIDDEN, on="page")
    return Part(id="verdict", blocks=(heading, card, keys))


def _show_gauge(check: CheckView, words: Words) -> Part:
    label = Piece(f"{words('heading.utilisation')} ", HIDDEN)
    used = Paragraph(text=(label, *show_utilisation(check, "figure")))
    legend = Paragraph(text=words("heading.gauge"), look="small", on="page")
    return Part(kind="div", look="gauge", blocks=(used, legend))


def _list_facts(view: ReportView, words: Words) -> Iterator[Pair]:
    row = view.governing_row
    yield Pair(name=words("heading.governing_check"), text=_tell_governing(row, words))
    told = words("heading.no_single_change")
    if row and row.governing and row.flips:
        passes = row.governing.verdict.style == "pass"
        told = words(
            "heading.passes_only_up_to" if passes else "heading.passes_with_any"
        )
    yield Pair(
        name=words("heading.what_would_flip_it"),
        text=told,
        items=row.flips if row else (),
    )
    if row and row.held:
        yield Pair(name=words("heading.single_values"), items=row.held)
    if row and row.model_form_line:
        yield Pair(name=words("opinion.second"), text=row.model_form_line)
    for label, text in view.counts:
        yield Pair(name=label, text=text)
    declared = str(len(view.declared)) if view.declared else words("show.none")
    yield Pair(
        name=words("heading.declared_elsewhere"), text=declared, items=view.declared
    )


def _tell_governing(row: RowView | None, words: Words) -> Content | str:
    check = row.governing if row else None
    if row is None or check is None:
        return words("heading.no_check")
    has_case = check.case != MISSING
    case = f"{words.semicolon} {keep_units(check.case)}" if has_case else ""
    load = f"\n{check.load}" if check.load else ""
    return (
        *strong(check.title),
        Piece(f", {words('heading.in_net_row')} "),
        *link(row.anchor, row.id),
        Piece(f"{case}\n{check.reason}{load}"),
    )


def _list_keys(view: ReportView, words: Words, *, is_full: bool) -> Iterator[Pair]:
    """Assumptions to confirm, and how a reader verifies the report."""
    assumed: Content = (Piece(f"{view.assumed_line or words('show.none')} "),)
    if is_full:
        assumed += refer("assumptions", words("heading.basis"))
    yield Pair(name=words("heading.assumed"), text=assumed)
    if view.defaults_line:
        yield Pair(name=words("heading.not_typed"), text=view.defaults_line)
    for label, text in view.verification:
        yield Pair(name=label, text=text)


def list_contents(view: ReportView, words: Words, *, is_full: bool) -> Contents:
    """Links to all sections, and to the rows."""
    named = ("identification", "summary", "basis", *_FULL, "checklist", "provenance")
    wanted = [name for name in named if is_full or name not in _FULL]
    lines = [
        _list_links([(name, words(f"heading.{name}")) for name in wanted]),
    ]
    if view.rows:
        label = words("show.label", label=words("heading.net_rows"), text="")
        rows = _list_links([(row.anchor, row.id) for row in view.rows])
        lines.append((Piece(label), *rows))
    return Contents(heading=words("heading.contents"), lines=tuple(lines))


def _list_links(links: list[tuple[str, str]]) -> Content:
    return tuple(
        piece for anchor, text in links for piece in (*link(anchor, text), Piece(" "))
    )


def show_identification(view: ReportView, words: Words) -> Part:
    """Subject of the report, and room for signatures and revisions."""
    pairs = tuple(Pair(name=label, text=text) for label, text in view.identification)
    people = [words(f"heading.{one}") for one in ("prepared", "checked", "approved")]
    names = (view.prepared, view.checked, "")
    signers = [(role, name) for role, name in zip(people, names, strict=True)]
    changes = [(view.revision, view.date), ("", "")]
    return section(
        "identification",
        words("heading.identification"),
        Pairs(pairs=pairs, look="pairs"),
        _sign("signatures", ("role", "name", "date", "signature"), signers, words),
        _sign(
            *("revisions", ("revision", "date", "change"), changes, words),
            " / ".join(people),
        ),
    )


def _sign(
    name: str,
    columns: tuple[str, ...],
    lines: list[tuple[str, str]],
    words: Words,
    *further: str,
) -> Table:
    """Table with room to write in; two cells of a line are known at most."""
    headings = [*(words(f"heading.{one}") for one in columns), *further]
    return Table(
        caption=words(f"heading.{name}"),
        columns=name_columns(headings, numbers=()),
        rows=tuple(
            (*(Cell(text=one) for one in line), Cell(), Cell()) for line in lines
        ),
        look="sign" if name == "signatures" else f"sign {name}",
    )


def show_summary(view: ReportView, words: Words) -> Part:
    """Matrix of rows by members, and the governing check of each row."""
    t = words
    if not view.rows:
        summary: Block = Paragraph(text=t("heading.no_rows"), look="none")
    else:
        numbers = [
            f"{t('heading.demand')}\n[kN]",
            f"{t('heading.resistance')}\n[kN]",
        ]
        headings = [
            *(t("heading.net_row"), t("heading.verdict")),
            *(t("heading.governing_check_and_case"), *numbers),
            t("heading.utilisation"),
        ]
        summary = Table(
            caption=t("heading.summary_caption"),
            columns=name_columns(headings, numbers=numbers),
            rows=tuple(line for row in view.rows for line in _sum_up(row, t)),
            look="summary",
        )
    return section(
        "summary", t("heading.summary_of_rows"), view.matrix.shown("matrix"), summary
    )


def _sum_up(row: RowView, words: Words) -> Iterator[tuple[Cell, ...]]:
    """One line of a row, and one below it where there is more to say."""
    check = row.governing
    name = rich_cell((Piece(row.id, "name", link=row.anchor),))
    verdict = badge_cell(row.verdict)
    if check is None:
        none = text_cell(MISSING)
        yield (name, verdict, text_cell(words("heading.no_check")), none, none, none)
    else:
        case = keep_units(check.case) if check.case != MISSING else check.reason
        yield (
            *(name, verdict, rich_cell((Piece(check.title), Piece(case, SMALL)))),
            *(text_cell(check.demand), text_cell(check.resistance)),
            rich_cell(show_utilisation(check)),
        )
    more = [*row.reasons, *([check.load] if check and check.load else [])]
    if row.highest:
        high = row.highest
        found = {"utilisation": high.utilisation, "band": high.band}
        more.append(words("show.highest", **found, check=high.title))
    if more:
        yield (rich_cell(small(more)),)


def show_basis(view: ReportView, words: Words, *, is_full: bool) -> Part:
    """Statements for all rows: scope, reading, ranges, inputs, notes, assumptions."""
    notes = (*view.notes, *view.shared_notes)
    none = Paragraph(text=words("show.none"), look="none")
    listed: dict[str, tuple[Block, ...]] = {
        "scope": (Items(items=view.scope),),
        "reading": (Items(items=tuple(symbols(one) for one in view.reading)),),
        "ranges": (view.ranges.shown("inputs"),),
        "inputs": tuple(one.shown("site-inputs") for one in view.site_inputs),
        "notes": (Items(items=notes) if notes else none,),
    }
    if is_full:
        listed["assumptions"] = (view.assumptions.shown("assumptions"),)
    sections = (
        section(name, words(f"heading.{name}"), *blocks, level=3)
        for name, blocks in listed.items()
    )
    heading = Heading(text=words("heading.basis"), level=2)
    return Part(kind="article", id="basis", blocks=(heading, *sections))


def show_annexes(view: ReportView, words: Words, *, is_open: bool) -> Iterator[Part]:
    """Formulas, on paper where all figures are; profile; quality of the solutions."""
    yield section(
        "formulas",
        words("heading.formulas"),
        view.figure_tables.shown("holding", symbols="cells"),
        view.formulas.shown("formulas", symbols="cells"),
        on="all" if is_open else "screen",
    )
    yield section(
        "profile",
        words("heading.limit_profile"),
        Paragraph(text=view.profile_title),
        view.numbered_profile.shown("profile"),
        *(Paragraph(text=source, look="small") for source in view.sources),
    )
    yield section(
        "quality",
        words("heading.solver_quality"),
        view.quality.shown("quality"),
        view.outcomes,
    )


def show_end(view: ReportView, words: Words) -> Iterator[Part]:
    """Checklist and provenance."""
    for name, table in (("checklist", view.checklist), ("provenance", view.provenance)):
        yield section(name, words(f"heading.{name}"), table.shown(name))
