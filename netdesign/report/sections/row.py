"""Net row in a report: sketch, loads, governing checks, what would turn one, notes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from netdesign.checks.check import Check
from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.blocks import (
    Badge,
    Block,
    Cell,
    Content,
    Figure,
    Figures,
    Heading,
    Items,
    Paragraph,
    Part,
    Piece,
    Table,
    force_cell,
    key_columns,
    section,
    strong,
    symbols,
    text_cell,
)
from netdesign.report.drawing.pressure_figure import (
    draw_pressure,
    find_friction,
    find_larger_case,
)
from netdesign.report.drawing.section_figure import draw_section
from netdesign.report.sections.checks import (
    describe_cause,
    list_flips,
)
from netdesign.report.sections.rated import (
    ANCHOR_MEMBERS,
    PARTS,
    Rated,
    find_deciding,
    find_demand,
    find_structure,
    find_worked,
    list_anchor,
    list_part,
    rate,
    show_answer,
    show_used,
)
from netdesign.report.words import (
    MISSING,
    Words,
    name_row,
    show_check,
    show_member,
    show_text,
    show_verdict,
    understand,
)
from netdesign.study.records import RowStudy, find_input
from netdesign.study.scopes import STRUCTURE, is_of_structure
from netdesign.study.to_do import name_few_checks
from netdesign.words.catalogue import name_check, name_mode
from netdesign.words.message import Message, say

_MOST_REASONS = 4  # of the points of a row that its page has room for
_DRAWN = ("foot_anchor", "uphill_anchor", "downhill_anchor", "post_base")


@dataclass(frozen=True, slots=True)
class RowPage:
    """Builds the part of one row, with the notes that no other row has.

    ``anchor`` is its place in the page, ``ids`` are the names of all rows like it.
    """

    row: RowStudy
    ids: Sequence[str]
    anchor: str
    words: Words
    notes: tuple[str, ...]

    def build(self) -> Part:
        """All of the part."""
        t = self.words
        ids = ", ".join(map(show_text, self.ids))
        name = name_row(ids, t, count=len(self.ids))
        says = self._tell(find_deciding(self.row))
        title: Content = (Piece(name, "name"), Piece(f" {says}", "says"))
        head = Part(
            kind="header",
            blocks=(
                Heading(text=title, level=2),
                Paragraph(text=symbols(self._list_facts()), look="meta"),
            ),
        )
        return Part(
            kind="article",
            id=self.anchor,
            look="row",
            blocks=(
                head,
                *self._show_figures(),
                section(
                    f"{self.anchor}-checks",
                    t("row_page.checks", row=ids),
                    *self._show_checks(),
                    level=3,
                ),
                *self._show_beside(),
            ),
        )

    def _tell(self, shown: Check | None) -> str:
        """``passes, 0.95: Net anchor (foot), pull-out``."""
        t = self.words
        text = t(f"row_page.{self.row.verdict}")
        if shown is None:
            return text
        if shown.used is None and shown.declared:
            document = show_text(shown.declared.document)
            return t("row_page.by_document", document=document)
        used = t.show_with_unit("demand_kN", shown.demand_kN)
        if shown.used is not None:
            used = show_used(shown, shown.used, t)
        named = t.show(name_check(shown.member, shown.mode))
        if used == MISSING:
            used = describe_cause(shown, t)
        return t("row_page.title", verdict=text, used=used, check=named)

    def _list_facts(self) -> str:
        """What a reader knows the row by."""
        t, row = self.words, self.row
        glide = find_input(row, "glide_factor")
        pairs = [
            ("net", _find_height(row), 2),
            ("snow", _find_snow(row), 2),
            ("normal", row.drawing.snow_thickness_m if row.drawing else None, 2),
            ("posts", find_input(row, "post_spacing"), 2),
            ("upslope", find_input(row, "upslope_length"), 1),
            ("altitude", find_input(row, "altitude"), 0),
        ]
        texts = [
            t(f"row_page.{key}", value=t.show_fixed(value, decimals))
            for key, value, decimals in pairs
            if value is not None
        ]
        slope = find_input(row, "slope_angle")
        if slope is not None:
            texts.insert(0, t("row_page.slope", value=t.show_given(slope)))
        ground = f"N {t.show_given(glide)}" if glide is not None else self._name_law()
        texts[4:4] = [ground] if ground else []
        return " · ".join(texts)

    def _name_law(self) -> str:
        """Law of the ground, in the reader's language; "" where none is given."""
        label = say("column.rows.glide_factor")
        laws = [echo for echo in self.row.inputs if echo.label == label and echo.value]
        return str(understand(laws[0], self.words)) if laws else ""

    def _show_figures(self) -> Iterator[Block]:
        """Section to scale; beside it the pressures, with the loads in words."""
        t, row = self.words, self.row
        if row.drawing is None:
            yield Paragraph(text=t("heading.no_case_converged"), look="none")
            return
        case = t.name_case(row.drawing.case)
        svg = draw_section(row.drawing, row.pulls, self._list_forces(), t)
        drawn = Figure(svg=svg, caption=symbols(t("row_page.shown", case=case)))
        height, record = _find_height(row), row.guideline
        pressure = draw_pressure(record, height, t) if record and height else ""
        beside = Figure(svg=pressure, caption=self._tell_loads())
        yield Figures(figures=(drawn, beside) if pressure else (drawn,))

    def _list_forces(self) -> dict[str, tuple[float, str]]:
        """Largest design force of each drawn member, with its utilisation."""
        forces = {}
        for member in _DRAWN:
            known = list_anchor if member in ANCHOR_MEMBERS else list_part
            checks = known(self.row, (member,))
            force, rated = find_demand(checks), rate(checks)
            if force is not None and rated is not None:
                shown = self.words.show_with_unit("demand_kN", force)
                used = show_verdict(rated.verdict, self.words).symbol
                if rated.used is not None and rated.verdict is not Verdict.DECLARED:
                    used = show_used(rated.check, rated.used, self.words)
                forces[member] = (force, f"{shown} · {used}")
        return forces

    def _tell_loads(self) -> str:
        """Load along the slope by the model and by the guideline, per metre."""
        t, record = self.words, self.row.guideline
        if record is None:
            return ""
        friction, larger = find_friction(record), find_larger_case(record)
        loads = {"model": record.solved_load_kN_per_m, "friction": friction}
        same = next(
            (x.load_kN_per_m for x in record.cases if x.name == "same_snow"), None
        )
        loads["same"] = same
        shown = {k: t.show_number("load_kN_per_m", x) for k, x in loads.items()}
        texts = [t("row_page.load_model", **shown)]
        if larger is not None:
            load = t.show_number("load_kN_per_m", larger.load_kN_per_m)
            case = t(f"load_case.{larger.name}")
            texts.append(t("row_page.load_guideline", load=load, case=case, **shown))
        return " ".join(texts)

    def _show_checks(self) -> Iterator[Block]:
        row, t = self.row, self.words
        groups = [(list_anchor(row, (x,)), x) for x in ANCHOR_MEMBERS]
        links = [x for x in list_part(row, ANCHOR_MEMBERS) if x.is_of_force]
        whole = find_structure(row)
        if whole is None:
            groups += [(links, ""), *((list_part(row, (x,)), x) for x in PARTS)]
        rated = [
            (member, shown)
            for checks, member in groups
            if (shown := rate([x for x in checks if x.is_of_force]))
        ]
        if whole is not None and (shown := rate([whole])):
            rated.append((whole.member, shown))
        if rated:
            yield self._tabulate(rated)
        known = {shown.check.id for _, shown in rated if _says_all(shown.check)}
        others = [check for check in row.checks if check.id not in known]
        if whole is not None and whole.declared:  # what it proves is information
            others = [other for other in others if not is_of_structure(other)]
        within = [x for x in others if x.mode == "approval" and x.finding is not None]
        yield from self._show_others(others, within)
        if not row.checks:
            yield Items(items=(t("heading.no_check"),), look="reasons")

    def _tabulate(self, rated: Sequence[tuple[str, Rated]]) -> Table:
        t = self.words
        numbers = ("demand", "resistance")
        keys = ("member", "mode", "type", "place", *numbers, "used")
        lines = []
        for member, shown in rated:
            check = shown.check
            place = "at_end" if check.position == "edge" else "inside"
            if check.position == "second":
                place = "second"
            named = show_member(t, member) if member else t("row_page.links")
            proof = check.declared if member == STRUCTURE else None
            kind = proof.document if proof else check.resistance_type
            lines.append(
                (
                    text_cell(named),
                    text_cell(t.show(name_mode(check.mode))),
                    text_cell(kind),
                    text_cell(t(f"row_page.{place}")),
                    force_cell(t, check.demand_kN),
                    force_cell(t, check.resistance_kN),
                    Cell(content=show_answer(shown, t)),
                )
            )
        return Table(
            caption="",
            columns=key_columns(t, "row_page.", keys, numbers=numbers),
            rows=tuple(lines),
            look="checks cards",
            symbols="headings",
        )

    def _show_others(
        self, checks: Sequence[Check], within: Sequence[Check]
    ) -> Iterator[Block]:
        """Checks that are not shown: those that are met by number, others at length.

        Of an approval that is kept its limits stand beside the values of the row.
        """
        t = self.words
        others: dict[tuple[object, ...], list[Check]] = {}
        for check in checks:
            if check.verdict is not Verdict.PASS:
                key = (check.verdict, *_name_reasons(check))
                others.setdefault(key, []).append(check)
        texts: list[Content] = []
        for shared in sorted(others.values(), key=_rank)[:_MOST_REASONS]:
            badge = Badge(show_verdict(shared[0].verdict, t), "sign")
            texts.append((badge, Piece(self._tell_shared(shared))))
        rest = len(others) - len(texts)
        met = [check for check in checks if check.verdict is Verdict.PASS]
        for check in within:
            if check in met:
                limits = symbols(t.show(check.finding))
                texts.append((Badge(show_verdict(check.verdict, t), "sign"), *limits))
        if rest > 0:
            texts.append((Piece(t("row_page.more", count=rest)),))
        if texts:
            yield Items(items=tuple(texts), look="reasons")
        if met:
            yield Paragraph(text=t("row_page.met", count=len(met)), look="small")

    def _tell_shared(self, checks: Sequence[Check]) -> str:
        """Names of checks that are open alike, with the reason of the worst of them."""
        t, worst = self.words, max(checks, key=lambda check: check.used or 0.0)
        if _says_all(worst):
            return self._name_used(checks)
        is_open = worst.verdict is Verdict.NOT_PROVEN  # as its sign says
        reasons = (worst.open_reasons if is_open else ()) or (worst.plain_reason,)
        named = t.join(map(t.show, name_few_checks(checks)))
        if len(checks) == 1:
            named = show_check(t, worst)
        return t("show.label", label=named, text=t.join(map(t.show, reasons)))

    def _name_used(self, checks: Sequence[Check]) -> str:
        """Checks that say no more than their utilisations, with these."""
        t = self.words
        texts = [
            f"{show_check(t, x)} {show_used(x, x.used or 0.0, t)}"
            for x in checks[:_MOST_REASONS]
        ]
        rest = len(checks) - len(texts)
        return t.join(
            texts + ([t("to_do.more_checks", count=rest)] if rest > 0 else [])
        )

    def _show_beside(self) -> Iterator[Block]:
        """What the governing check passes with, and notes on this row alone."""
        t, row = self.words, self.row
        check = find_worked(row)
        flips = list_flips(check, t) if check else ()
        passes = row.verdict in (Verdict.PASS, Verdict.DECLARED)
        lines: list[Content] = []
        if check and flips:
            key = "row_page.passes_while" if passes else "row_page.would_pass"
            label = t(key, check=show_check(t, check))
            lines.append((*strong(f"{label} "), *symbols(t.join(flips))))
        lines += map(symbols, self.notes)
        if lines:
            yield Items(items=tuple(lines), look="reasons")


def _rank(checks: Sequence[Check]) -> tuple[int, float]:
    """Order of the points of a row: the worst verdict, then the most used."""
    verdict = min(SEVERITY.index(check.verdict) for check in checks)
    return verdict, -max(check.used or 0.0 for check in checks)


def _says_all(check: Check) -> bool:
    """The numbers of a check are all that it says."""
    if check.verdict is Verdict.PASS:
        return True
    return check.used is not None and not (check.open or check.open_reasons)


# Open points of which several checks of a row differ by their numbers alone.
_BY_NUMBERS = (
    *("assumed.by_ropes", "assumed.by_stiffness", "check.assumed_together"),
    "direction.no_head",
)


def _name_reasons(check: Check) -> Iterator[str]:
    """What is open of a check but for its numbers: those of the worst are told."""
    if _says_all(check):
        return
    for message in check.open_reasons or (check.plain_reason,):
        name = message.arguments.get("name")
        is_alike = message.key in _BY_NUMBERS or isinstance(name, Message)
        yield f"{message.key} {name}" if is_alike else str(message)


def _find_height(row: RowStudy) -> float | None:
    """Height of the net, normal to the slope [m]."""
    given = find_input(row, "net_height")
    return row.drawing.head_m[1] if given is None and row.drawing else given


def _find_snow(row: RowStudy) -> float | None:
    """Vertical height of the snow that was drawn [m]."""
    if row.drawing is None:
        return None
    return row.drawing.snow_thickness_m / math.cos(math.radians(row.drawing.slope_deg))
