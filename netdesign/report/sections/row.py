"""One net row as blocks: drawing, checks, what would change them, and their reasons."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from netdesign.report.blocks.block import (
    Block,
    Figure,
    Heading,
    Items,
    Paragraph,
    Part,
    section,
)
from netdesign.report.blocks.table import (
    Cell,
    Column,
    Medium,
    Table,
    name_columns,
    rich_cell,
    text_cell,
    turn,
)
from netdesign.report.blocks.text import (
    Badge,
    Piece,
    keep_units,
    link,
    refer,
    small,
    strong,
    symbols,
)
from netdesign.report.drawing.row_drawings import RowDrawings
from netdesign.report.sections.cells import badge_cell, demand_cell
from netdesign.report.view.whole import Detail, RowView
from netdesign.report.words import MISSING, Words


@dataclass(frozen=True, slots=True)
class RowSections:
    """Builds the sections of one row."""

    row: RowView
    drawn: RowDrawings
    detail: Detail
    words: Words

    def build(self) -> Part:
        """All sections of the row."""
        row, t = self.row, self.words
        name = f"{t('heading.net_row')} {row.id}"
        title = (Piece(name, "name"), Piece(" "), Badge(row.verdict))
        further = self._list_further() if self._is_full else ()
        return Part(
            kind="article",
            id=row.anchor,
            look="row",
            blocks=(
                Heading(text=title, level=2),
                self._show_drawing(),
                self._section("checks", "heading.checks", *self._show_checks()),
                self._section(
                    "changes", "heading.what_would_change", *self._show_changes()
                ),
                *further,
                Paragraph(text=name, look="running", on="page"),
            ),
        )

    @property
    def _is_full(self) -> bool:
        return self.detail != "summary"

    def _section(
        self,
        name: str,
        heading: str,
        *blocks: Block,
        look: str = "",
        on: Medium = "all",
    ) -> Part:
        return section(
            f"{self.row.anchor}-{name}",
            self.words(heading),
            *blocks,
            level=3,
            look=look,
            on=on,
        )

    def _none(self, key: str) -> Paragraph:
        return Paragraph(text=self.words(key), look="none")

    def _note(self, text: str, on: Medium = "all") -> Iterator[Paragraph]:
        if text:
            yield Paragraph(text=text, look="small", on=on)

    def _show_drawing(self) -> Part:
        """Section drawn; a summary on paper has it of rows that do not pass."""
        t, row = self.words, self.row
        shown: Block = self._none("heading.no_case_converged")
        if self.drawn.section:
            caption = t("caption.section", case=keep_units(row.drawn_case))
            shown = Figure(svg=self.drawn.section, caption=caption)
        passes = not self._is_full and row.verdict.style == "pass"
        heading = Heading(text=t("heading.section"), level=3, on="screen")
        return Part(
            id=f"{row.anchor}-drawing",
            on="screen" if passes else "all",
            blocks=(heading, shown),
        )

    def _show_checks(self) -> Iterator[Block]:
        row = self.row
        if row.reasons and not row.checks:
            yield Items(items=row.reasons, look="reasons")
        if row.lines:
            yield self._tabulate_checks()
        if self._is_full and row.requirements:
            yield self._tabulate_requirements()
        if not row.checks:
            yield self._none("heading.no_check")

    def _tabulate_checks(self) -> Table:
        t, row = self.words, self.row
        lines: list[tuple[Cell, ...]] = []
        for line in row.lines if self._is_full else row.main_lines:
            source = small([line.source]) if line.source != MISSING else ()
            lines.append(
                (
                    rich_cell((Piece(line.title, "name"), *source)),
                    text_cell(line.resistance),
                    demand_cell(line.inside, t),
                    demand_cell(line.end, t),
                )
            )
            if line.remarks:
                fails = line.verdict.style != "pass"
                sign = (Badge(line.verdict),) if fails else ()
                lines.append((rich_cell((*sign, *small(line.remarks))),))
        main = "" if self._is_full else f" {t('caption.main_checks')}"
        return Table(
            caption=f"{row.counts}.{main}",
            note=refer("reading", t("heading.reading")),
            columns=(
                Column(heading=t("heading.check_clause_resistance")),
                Column(heading=f"{t('heading.resistance')}\n[kN]", is_number=True),
                Column(heading=f"{t('heading.utilisation')}\n{t('heading.inside')}"),
                Column(heading=t("heading.at_end")),
            ),
            rows=tuple(lines),
            look="checks",
        )

    def _tabulate_requirements(self) -> Table:
        t = self.words
        headings = [t(f"heading.{one}") for one in ("verdict", "check", "reason")]
        lines = []
        for check in self.row.requirements:
            source = f" ({check.source})" if check.source != MISSING else ""
            title = text_cell(f"{check.title}{source}")
            lines.append((badge_cell(check.verdict), title, text_cell(check.reason)))
        return Table(
            caption=t("heading.requirements"),
            columns=name_columns(headings, numbers=()),
            rows=tuple(lines),
            look="requirements",
        )

    def _show_changes(self) -> Iterator[Block]:
        t, row = self.words, self.row
        if self._is_full:
            yield row.changes.shown("changes")
            yield row.holds.shown("holds")
        elif row.flips and row.governing:
            flips = t.join(row.flips)
            label = t("show.label", label=row.governing.title, text=flips)
            yield Paragraph(text=label)
        else:
            no_change = t("heading.no_single_change")
            told = no_change if row.changes.rows else row.changes.empty
            yield Paragraph(text=told, look="none")

    def _list_further(self) -> Iterator[Part]:
        """Sections that only a reviewer of the row needs."""
        yield self._section("worked", "heading.worked_check", *self._show_worked())
        yield self._show_figures()
        yield self._section(
            "uncertainty", "heading.uncertainty", *self._show_uncertainty()
        )
        yield self._section("envelope", "heading.envelope", *self._show_envelope())
        yield self._section(
            "extremes",
            "heading.largest_forces",
            self.row.extremes.shown("extremes"),
            on="screen" if self.row.searched else "all",
        )
        if self.drawn.monitoring:
            measured = Figure(
                svg=self.drawn.monitoring, caption=self.drawn.monitoring_note
            )
            yield self._section("monitoring", "heading.monitoring", measured)
        yield self._section(
            "support", "heading.anchors_and_head", *self._show_support()
        )
        if self.row.panel:
            yield self._section("panel", "panel_view.title", *self._show_panel())
        yield self._section(
            "independent", "heading.independent_checks", *self._show_independent()
        )
        yield self._section(
            "failed",
            "heading.cases_without_result",
            self.row.failed,
            look="" if self.row.failed.rows else "run-in",
        )
        yield self._section(
            "inputs", "heading.inputs", self.row.inputs.shown("inputs"), on="screen"
        )

    def _show_worked(self) -> Iterator[Block]:
        t, worked = self.words, self.row.worked
        if worked is None:
            yield self._none("heading.no_utilisation")
            return
        headings = [t(f"heading.{one}") for one in ("symbols", "numbers", "result")]
        yield Table(
            caption=worked.title,
            columns=name_columns(headings, numbers=()),
            rows=tuple(
                (
                    rich_cell(symbols(step.symbols)),
                    text_cell(f"= {step.numbers}"),
                    rich_cell((Piece("= "), *strong(step.result))),
                )
                for step in worked.steps
            ),
            look="worked",
        )
        yield Paragraph(text=symbols(worked.needed), look="small")

    def _show_figures(self) -> Part:
        """All figures of the checks; shut, they are not on paper either."""
        t, tables = self.words, self.row.figures
        listed = [
            (turn(tables.statics), "upright"),
            (turn(tables.floor_statics), "upright"),
            (tables.sideways, ""),
            (tables.widths, "narrow"),
            (tables.actions, ""),
            *([(tables.panel_actions, "narrow")] if tables.panel_actions.rows else []),
            (tables.checks, ""),
            (tables.resistances, "resistances"),
            *([(tables.tests, "narrow")] if tables.tests.rows else []),
            (tables.turns, "narrow"),
        ]
        is_open = self.detail == "figures"
        caption = (
            Piece(f"{t('caption.figures')} "),
            *link("formulas", t("heading.formulas")),
        )
        fold = Part(
            kind="div",
            fold=t("heading.unfold"),
            is_open=is_open,
            blocks=tuple(
                table.shown(f"figures {look}".rstrip(), symbols="headings")
                for table, look in listed
            ),
        )
        return self._section(
            "figures",
            "heading.figures",
            Paragraph(text=caption, look="caption"),
            fold,
            look="of-figures",
            on="all" if is_open else "page",
        )

    def _show_uncertainty(self) -> Iterator[Block]:
        t, row = self.words, self.row
        hidden = t("show.for_comparison") if row.model_form_line else ""
        yield row.spreads.shown("spreads", not_on_paper=hidden)
        yield row.model_form.shown("spreads", "screen")
        yield from self._note(row.model_form_line)

    def _show_envelope(self) -> Iterator[Block]:
        """Figures first, then the largest forces of a search."""
        t, row, drawn = self.words, self.row, self.drawn
        if not row.searched:
            listed = t("heading.workbook_lists_cases")
            caption = f"{row.unloaded} {listed}" if row.unloaded else listed
            if drawn.envelope:
                yield Figure(svg=drawn.envelope, caption=caption)
            else:
                yield self._none("heading.no_case_converged")
            return
        yield Paragraph(text=row.searched, look="search")
        for place, one in enumerate(drawn.searched):
            on: Medium = "screen" if place else "all"
            yield Figure(svg=one.maps or one.lines, look="parts", on=on)
            if one.maps:
                yield Figure(svg=one.lines, look="parts", on="screen")
        yield row.bounds.shown("extremes")
        for one in drawn.searched:
            yield Figure(svg=one.drivers, look="parts", on="screen")
        if row.unloaded:
            yield Paragraph(text=row.unloaded, look="caption", on="screen")
        yield row.drivers.shown("extremes", "screen")

    def _show_support(self) -> Iterator[Block]:
        t, row = self.words, self.row
        yield row.anchors.shown("forces")
        yield row.pulls.shown("forces", "screen")
        beside: list[Block] = [row.head.shown("head")]
        if self.drawn.head:
            caption = t("caption.polygon")
            beside.append(Figure(svg=self.drawn.head, caption=caption, look="half"))
        yield Part(kind="div", look="beside", on="screen", blocks=tuple(beside))
        for note in row.notes:
            yield from self._note(t("show.note_sentence", note=note))
        if row.end_effects.rows:
            yield Part(
                kind="div",
                fold=t("end_view.unfold"),
                on="screen",
                blocks=(row.end_effects.shown("extremes"),),
            )

    def _show_panel(self) -> Iterator[Block]:
        panel = self.row.panel
        if panel is None:
            return
        if self.drawn.panel:
            case = keep_units(self.row.drawn_case)
            caption = self.words("panel_view.caption", case=case)
            yield Figure(svg=self.drawn.panel, caption=caption)
        yield panel.forces.shown("forces")
        yield panel.ropes.shown("forces")
        for sentence in panel.sentences:
            yield from self._note(sentence)

    def _show_independent(self) -> Iterator[Block]:
        row = self.row
        yield row.independent.shown("independent", "screen" if row.laws_met else "all")
        yield from self._note(row.laws_met, on="paper")
        yield row.guideline.shown("extremes guideline")
        yield row.floor.shown(
            "extremes guideline", "all" if row.floor_governs else "screen"
        )
        yield from self._note(row.guideline_sentence)
        yield row.slab.shown("extremes guideline", "screen")
        yield from self._note(row.slab_line, on="paper")
