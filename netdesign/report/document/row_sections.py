"""One net row in a document: what its page has on paper, in the same order."""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.report.document.content import (
    Content,
    Grid,
    Piece,
    badge,
    list_cells,
    plain,
    show_demand,
    small,
    symbols,
    turn,
)
from netdesign.report.document.writer import Writer
from netdesign.report.drawing.row_drawings import RowDrawings
from netdesign.report.view.table import Table
from netdesign.report.view.whole import Detail, RowView
from netdesign.report.words import MISSING


@dataclass(frozen=True, slots=True)
class RowWriter:
    """Writes one row."""

    to: Writer
    row: RowView
    drawn: RowDrawings
    detail: Detail

    @property
    def _is_full(self) -> bool:
        return self.detail != "summary"

    def write(self) -> None:
        """All sections of the row."""
        t = self.to.words
        title = Piece(f"{t('heading.net_row')} {self.row.id} ")
        self.to.heading((title, badge(self.row.verdict)))
        self._show_section()
        self._show_checks()
        self._show_changes()
        if not self._is_full:
            return
        self._show_worked()
        if self.detail == "figures":
            self._show_figures()
        self._show_uncertainty()
        self._show_envelope()
        self._show_monitoring()
        self._show_support()
        self._show_panel()
        self._show_independent()
        self.to.subheading("heading.cases_without_result")
        self.to.table(self.row.failed)

    def _show_section(self) -> None:
        """Drawing of the section; of a row that passes only in full."""
        t = self.to.words
        if not self._is_full and self.row.verdict.style == "pass":
            return
        if self.drawn.section:
            caption = t("caption.section", case=self.row.drawn_case)
            self.to.figure(self.drawn.section, caption)
        else:
            self.to.none(t("heading.no_case_converged"))

    def _show_checks(self) -> None:
        t, row = self.to.words, self.row
        self.to.subheading("heading.checks")
        if row.reasons and not row.checks:
            self.to.items(row.reasons)
        if row.lines:
            self.to.grid(self._list_checks())
        if self._is_full and row.requirements:
            self.to.grid(self._list_requirements())
        if not row.checks:
            self.to.none(t("heading.no_check"))

    def _list_checks(self) -> Grid:
        t, row = self.to.words, self.row
        lines: list[tuple[Content, ...]] = []
        for line in row.lines if self._is_full else row.main_lines:
            source = f"\n{line.source}" if line.source != MISSING else ""
            lines.append(
                (
                    (Piece(line.title, is_bold=True), Piece(source, is_small=True)),
                    plain(line.resistance),
                    show_demand(line.inside, t),
                    show_demand(line.end, t),
                )
            )
            if line.remarks:
                fails = line.verdict.style != "pass"
                sign = (badge(line.verdict), Piece("\n")) if fails else ()
                lines.append(((*sign, *small(line.remarks)),))
        inside = t("heading.inside")
        used = f"{t('heading.utilisation')}, {inside[:1].lower()}{inside[1:]}"
        headings = (
            t("heading.check_clause_resistance"),
            f"{t('heading.resistance')}\n[kN]",
            used,
            t("heading.at_end"),
        )
        caption = f"{row.counts}."
        if not self._is_full:
            caption += f" {t('caption.main_checks')}"
        return Grid(
            caption=caption,
            headings=tuple(plain(one) for one in headings),
            numbers=(False, True, False, False),
            lines=tuple(lines),
        )

    def _list_requirements(self) -> Grid:
        t = self.to.words
        headings = ("verdict", "check", "reason")
        lines = []
        for check in self.row.requirements:
            source = f" ({check.source})" if check.source != MISSING else ""
            title = plain(f"{check.title}{source}")
            lines.append(((badge(check.verdict),), title, plain(check.reason)))
        return Grid(
            caption=t("heading.requirements"),
            headings=tuple(plain(t(f"heading.{one}")) for one in headings),
            numbers=(False, False, False),
            lines=tuple(lines),
        )

    def _show_changes(self) -> None:
        t, row = self.to.words, self.row
        self.to.subheading("heading.what_would_change")
        if self._is_full:
            self.to.table(row.changes)
            self.to.table(row.holds)
        elif row.flips and row.governing:
            flips = t.join(row.flips)
            self.to.text(t("show.label", label=row.governing.title, text=flips))
        else:
            is_empty = not row.changes.rows
            no_change = t("heading.no_single_change")
            self.to.none(row.changes.empty if is_empty else no_change)

    def _show_worked(self) -> None:
        t, worked = self.to.words, self.row.worked
        self.to.subheading("heading.worked_check")
        if worked is None:
            self.to.none(t("heading.no_utilisation"))
            return
        headings = ("symbols", "numbers", "result")
        lines = tuple(
            (
                symbols(step.symbols),
                plain(f"= {step.numbers}"),
                (Piece("= "), Piece(step.result, is_bold=True)),
            )
            for step in worked.steps
        )
        self.to.grid(
            Grid(
                caption=worked.title,
                headings=tuple(plain(t(f"heading.{one}")) for one in headings),
                numbers=(False, False, False),
                lines=lines,
            )
        )
        self.to.paragraph(symbols(worked.needed))

    def _show_figures(self) -> None:
        figures = self.row.figures
        self.to.subheading("heading.figures")
        self.to.none(self.to.words("caption.figures"))
        for table in (figures.statics, figures.floor_statics):
            self._show_symbols(table, is_upright=True)
        for table in (figures.sideways, figures.widths, figures.actions):
            self._show_symbols(table)
        if figures.panel_actions.rows:
            self._show_symbols(figures.panel_actions)
        for table in (figures.checks, figures.resistances):
            self._show_symbols(table)
        if figures.tests.rows:
            self._show_symbols(figures.tests)
        self._show_symbols(figures.turns)

    def _show_symbols(self, table: Table, *, is_upright: bool = False) -> None:
        grid = list_cells(table, has_symbols=True)
        if not grid.lines:
            told = self.to.words("show.label", label=table.caption, text=table.empty)
            self.to.none(told)
            return
        self.to.grid(turn(grid) if is_upright else grid)

    def _show_uncertainty(self) -> None:
        t, row = self.to.words, self.row
        self.to.subheading("heading.uncertainty")
        hidden = t("show.for_comparison") if row.model_form_line else ""
        self.to.table(row.spreads, hidden=hidden)
        if row.model_form_line:
            self.to.none(row.model_form_line)

    def _show_envelope(self) -> None:
        t, row, drawn = self.to.words, self.row, self.drawn
        self.to.subheading("heading.envelope")
        if row.searched:
            self.to.text(row.searched)
            for one in drawn.searched[:1]:
                self.to.figure(one.maps or one.lines)
            self.to.table(row.bounds)
            return
        if drawn.envelope:
            self.to.figure(drawn.envelope, row.unloaded)
        else:
            self.to.none(t("heading.no_case_converged"))
        self.to.subheading("heading.largest_forces")
        self.to.table(row.extremes)

    def _show_monitoring(self) -> None:
        if self.drawn.monitoring:
            self.to.subheading("heading.monitoring")
            self.to.figure(self.drawn.monitoring, self.drawn.monitoring_note)

    def _show_support(self) -> None:
        self.to.subheading("heading.anchors_and_head")
        self.to.table(self.row.anchors)
        for note in self.row.notes:
            self.to.none(self.to.words("show.note_sentence", note=note))

    def _show_panel(self) -> None:
        t, panel = self.to.words, self.row.panel
        if panel is None:
            return
        self.to.subheading("panel_view.title")
        if self.drawn.panel:
            caption = t("panel_view.caption", case=self.row.drawn_case)
            self.to.figure(self.drawn.panel, caption)
        self.to.table(panel.forces)
        self.to.table(panel.ropes)
        for sentence in panel.sentences:
            self.to.none(sentence)

    def _show_independent(self) -> None:
        row = self.row
        self.to.subheading("heading.independent_checks")
        if row.laws_met:
            self.to.none(row.laws_met)
        else:
            self.to.table(row.independent)
        self.to.table(row.guideline)
        if row.floor_governs:
            self.to.table(row.floor)
        for line in (row.guideline_sentence, row.slab_line):
            if line:
                self.to.none(line)
