"""One net row as blocks: drawing, inputs, checks, worked check, envelope, changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from netdesign.checks.check import Check, SingleTest, TestSeries
from netdesign.outcome import Verdict
from netdesign.report.blocks import (
    Badge,
    Block,
    Cell,
    Column,
    Figure,
    Heading,
    Items,
    Paragraph,
    Part,
    Piece,
    Table,
    keep_units,
    key_columns,
    name_columns,
    number_cell,
    section,
    small,
    symbols,
    text_cell,
)
from netdesign.report.drawing.chain_figure import draw_chains
from netdesign.report.drawing.charts import (
    describe_monitoring,
    draw_monitoring,
)
from netdesign.report.drawing.panel_figure import draw_panel
from netdesign.report.drawing.section_figure import draw_section
from netdesign.report.sections.basis import is_of_row, show_value
from netdesign.report.sections.checks import (
    CheckLine,
    describe_loads,
    list_lines,
    name_few,
    part_lines,
    show_changes,
    show_used,
)
from netdesign.report.sections.schedule import find_largest, show_proof_load
from netdesign.report.sections.worked import work_out
from netdesign.report.words import (
    MISSING,
    Words,
    append_unit,
    name_row,
    show_check,
    show_member,
    show_text,
    show_verdict,
)
from netdesign.study.governing import find_shown, is_far_from_limit
from netdesign.study.records import RowStudy
from netdesign.words.message import Message

_Tested = list[tuple[Check, TestSeries, float | None]]


def show_tests(row: RowStudy, words: Words) -> Iterator[Table]:
    """Tables of the anchor types that were tested; none without tests."""
    tested = list(_list_types(row))
    if tested:
        yield _tabulate_tested(tested, words)
    if any(tests.singles for _, tests, _ in tested):
        yield _tabulate_singles(tested, words)


def _list_types(
    row: RowStudy,
) -> Iterator[tuple[Check, TestSeries, float | None]]:
    """First check of each tested type, its tests, and the largest design force [kN]."""
    checks: dict[str, list[Check]] = {}
    for check in row.checks:
        if check.tests is not None:
            checks.setdefault(check.resistance_type, []).append(check)
    for first, *others in checks.values():
        if first.tests is not None:
            yield first, first.tests, find_largest([first, *others], "E_d")


def _tabulate_tested(tested: _Tested, words: Words) -> Table:
    heading = "R_k [kN]"
    headings = [words("heading.type"), words("tests.number"), heading]
    rows: list[tuple[Cell, ...]] = []
    for check, tests, _ in tested:
        kind, count = text_cell(check.resistance_type), text_cell(f"{tests.count}")
        resistance = number_cell(words, "resistance_kN", check.read("R_k"))
        rows.append((kind, count, resistance))
        held = sum(one.is_held is True for one in tests.singles)
        if held:
            key = "tests.all_held" if held == tests.count else "tests.some_held"
            remark = words(key, held=held, count=tests.count)
            rows.append((Cell(content=(Piece(remark, "small"),)),))
    return Table(
        caption=words("tests.resistance"),
        columns=name_columns(headings, numbers=(heading,)),
        rows=tuple(rows),
        look="tests",
        symbols="headings",
    )


def _tabulate_singles(tested: _Tested, words: Words) -> Table:
    keys = ("load", "proof", "displacement", "outcome", "wanted", "accepted")
    return Table(
        caption=words("tests.acceptance"),
        columns=(
            *key_columns(words, "", ("heading.type", "tests.cell")),
            *key_columns(words, "tested.", keys, numbers=(*keys[:3], "wanted")),
        ),
        rows=tuple(
            _show_single(check, one, tests.proof_factor, force, words)
            for check, tests, force in tested
            for one in tests.singles
        ),
        look="tests",
        symbols="headings",
    )


def _show_single(
    check: Check,
    one: SingleTest,
    factor: float | None,
    force: float | None,
    words: Words,
) -> tuple[Cell, ...]:
    wanted = None if factor is None or force is None else factor * force
    moved = one.displacement_mm
    outcome = {True: "held", False: "pulled", None: "not_said"}[one.is_held]
    return (
        text_cell(check.resistance_type),
        text_cell(show_text(one.cell)),
        number_cell(words, "demand_kN", one.load_kN),
        number_cell(words, "demand_kN", one.proof_load_kN),
        text_cell(MISSING if moved is None else words.write(f"{moved:.1f}")),
        text_cell(words(f"tested.{outcome}")),
        show_proof_load(wanted, [check], words),
        text_cell(words(f"tested.{_judge(one, wanted)}")),
    )


def _judge(one: SingleTest, wanted: float | None) -> str:
    """Acceptance of an anchor by its test: yes, no, or open."""
    if one.is_held is False:
        return "no"
    loads = [load for load in (wanted, one.proof_load_kN) if load is not None]
    if loads and one.load_kN < max(loads):
        return "no"
    return "yes" if one.is_held and wanted is not None else "open"


# Inputs beside the drawing; all of them stand in the table of all rows.
_SHOWN = (
    *("slope_angle", "snow_thickness", "snow_height", "upslope_length", "ground_law"),
    *("slip_length", "glide_factor", "net_height", "net_stiffness", "slack"),
    *("post_spacing", "post_tilt", "panel_system", "gap"),
)


@dataclass(frozen=True, slots=True)
class RowSections:
    """Builds the sections of one row, the notes that are ``told`` elsewhere left out.

    ``anchor`` is its place in the page, ``ids`` are the names of all rows like it.
    """

    row: RowStudy
    ids: Sequence[str]
    anchor: str
    words: Words
    told: frozenset[str]

    def build(self) -> Part:
        """All sections of the row."""
        row, t = self.row, self.words
        name = name_row(", ".join(map(show_text, self.ids)), t, count=len(self.ids))
        title = (
            Piece(name, "name"),
            Piece(" "),
            Badge(show_verdict(row.verdict, t)),
        )
        heading, changes = show_changes(row, t)
        return Part(
            kind="article",
            id=self.anchor,
            look="row",
            blocks=(
                Heading(text=title, level=2),
                Part(
                    id=f"{self.anchor}-drawing",
                    blocks=tuple(self._show_drawing()),
                ),
                self._section("checks", t("heading.checks"), *self._show_checks()),
                self._section(
                    "worked", t("heading.worked_check"), *self._show_worked()
                ),
                *self._show_further(),
                self._section("changes", heading, *changes),
                *self._show_notes(),
                Paragraph(text=name, look="running", on="page"),
            ),
        )

    def _section(self, name: str, heading: str, *blocks: Block) -> Part:
        return section(f"{self.anchor}-{name}", heading, *blocks, level=3)

    def _none(self, key: str) -> Paragraph:
        return Paragraph(text=self.words(key), look="none")

    def _show_drawing(self) -> Iterator[Block]:
        """Section to scale, and the inputs that it shows."""
        t, row = self.words, self.row
        if row.drawing:
            case = keep_units(t.name_case(row.drawing.case))
            caption = t("caption.section", case=case)
            svg = draw_section(row.drawing, self.anchor, t)
            yield Figure(svg=svg, caption=caption)
        else:
            yield self._none("heading.no_case_converged")
        yield Paragraph(text=t.join(self._list_inputs()), look="given")

    def _list_inputs(self) -> Iterator[str]:
        t = self.words
        for echo in self.row.inputs:
            label = echo.label
            key = label.key.rpartition(".")[2] if isinstance(label, Message) else ""
            if key in _SHOWN and echo.value != "":
                value = append_unit(show_value(echo, t), echo.unit.replace("-", ""))
                yield t("show.label", label=t.show(label), text=value)

    def _show_checks(self) -> Iterator[Block]:
        row, t = self.row, self.words
        lines = tuple(list_lines(row.checks))
        if row.reasons and not row.checks:
            reasons = tuple(t.show(one) for one in row.reasons)
            yield Items(items=reasons, look="reasons")
        if lines:
            alone, beside = part_lines(lines)
            yield self._tabulate_checks(alone)
            if beside:
                yield Paragraph(text=symbols(self._list_beside(beside)), look="small")
            yield Figure(svg=draw_chains(row, t))
        further = [one for one in row.checks if not one.is_of_force]
        if further:  # on paper they stand beside the figure: nothing comes between
            yield from self._show_requirements(further)
        if lines:
            yield from show_tests(row, t)
        if not row.checks:
            yield self._none("heading.no_check")

    def _tabulate_checks(self, checks: Sequence[CheckLine]) -> Table:
        t = self.words
        lines: list[tuple[Cell, ...]] = []
        for line in checks:
            verdict = Badge(show_verdict(line.verdict, t), "sign")
            first = line.checks[0]
            lines.append(
                (
                    Cell(content=(verdict, Piece(line.name(t), "name"))),
                    text_cell(first.resistance_type),
                    number_cell(t, "resistance_kN", first.resistance_kN),
                    *self._show_place(line.inside),
                    *self._show_place(line.end),
                )
            )
            remarks = line.list_remarks(t)
            if remarks:
                lines.append((Cell(content=small(remarks)),))
        return Table(
            caption=t("caption.checks_of_row"),
            columns=tuple(self._list_columns()),
            rows=tuple(lines),
            look="checks",
            symbols="headings",
        )

    def _list_beside(self, lines: Mapping[str, Sequence[CheckLine]]) -> str:
        """Modes that share the design force of a more used one, by member."""
        t = self.words
        members = (
            t.join(
                t("show.label", label=show_member(t, member), text=one.describe(t))
                if place == 0
                else one.describe(t)
                for place, one in enumerate(of_member)
            )
            for member, of_member in lines.items()
        )
        return t("show.less_used", checks=" · ".join(members))

    def _list_columns(self) -> Iterator[Column]:
        t = self.words
        yield Column(heading=t("heading.check"))
        yield Column(heading=t("heading.type"))
        yield Column(heading="R_d\n[kN]", is_number=True)
        for place in ("inside", "at_end"):
            name = t(f"heading.{place}")
            yield Column(heading="E_d\n[kN]", is_number=True)
            yield Column(heading=f"{t('heading.utilisation')}\n{name}")

    def _show_place(self, check: Check | None) -> tuple[Cell, Cell]:
        """Design force and utilisation of a check; of none that there is none."""
        if check is None:
            return text_cell(MISSING), text_cell(MISSING)
        demand = number_cell(self.words, "demand_kN", check.demand_kN)
        is_near = not is_far_from_limit(check)
        return demand, Cell(content=show_used(check, self.words, with_interval=is_near))

    def _show_requirements(self, checks: Sequence[Check]) -> Iterator[Block]:
        """Checks without a force: those that are met by name, the others at length."""
        t = self.words
        met = [show_check(t, x) for x in checks if x.verdict is Verdict.PASS]
        if met:
            text = t("show.requirements_met", names=t.join(met))
            yield Paragraph(text=text, look="small")
        others: dict[tuple[Verdict, str], list[Check]] = {}
        for one in checks:
            if one.verdict is not Verdict.PASS:
                others.setdefault((one.verdict, t.show(one.reason)), []).append(one)
        if others:
            told = tuple(
                (
                    Badge(show_verdict(verdict, t)),
                    Piece(" "),
                    Piece(t("show.label", label=name_few(shared, t), text=reason)),
                )
                for (verdict, reason), shared in others.items()
            )
            yield Items(items=told, look="reasons")

    def _show_worked(self) -> Iterator[Block]:
        t, check = self.words, find_shown(self.row.checks)
        if check is None:
            yield self._none("heading.no_utilisation")
            return
        yield work_out(check, t)
        loads = describe_loads(check, t)
        if loads:
            yield Paragraph(text=loads, look="small")

    def _show_further(self) -> Iterator[Part]:
        """Panel and measurements, of a row that has them."""
        t, row = self.words, self.row
        panel = draw_panel(row.panel, t) if row.panel else ""
        if panel:
            yield self._section("panel", t("panel_view.title"), Figure(svg=panel))
        monitoring = draw_monitoring(row.monitoring, t)
        if monitoring:
            caption = describe_monitoring(row.monitoring, t)
            figure = Figure(svg=monitoring, caption=caption)
            yield self._section("monitoring", t("heading.monitoring"), figure)

    def _show_notes(self) -> Iterator[Part]:
        notes = tuple(self._list_notes())
        if notes:
            heading = self.words("heading.notes")
            yield self._section("notes", heading, Items(items=notes))

    def _list_notes(self) -> Iterator[str]:
        """Notes that this row alone has, and cases that gave no numbers."""
        t, row = self.words, self.row
        for note in row.notes:
            text = t.show(note)
            if text not in self.told and is_of_row(note):
                yield text
        if row.panel and row.panel.assumed:
            names = tuple(map(t.show, row.panel.assumed))
            yield t("panel.assumed", names=names)
