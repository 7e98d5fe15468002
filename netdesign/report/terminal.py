"""Study -> a terminal: a line for each net row, what is to be done, the verdict."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from netdesign import addon_table
from netdesign.edge.json_text import list_fields
from netdesign.edge.output import print_lines, spell
from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.blocks import SMALL, Badge, Content, Piece, write_plain
from netdesign.report.sections.basis import (
    describe_cases,
    describe_floor,
    has_other_floor,
    list_conditions,
    list_notes,
    name_cases,
    show_line,
)
from netdesign.report.sections.checks import (
    describe_briefly,
    describe_loads,
    describe_study_scopes,
    list_changes,
    list_exceeding,
    name_case,
)
from netdesign.report.sections.decision import show_structure
from netdesign.report.sections.rated import (
    ANCHORS,
    find_shown,
    list_anchor,
    rate,
    show_rated,
    sign,
)
from netdesign.report.what_if import mark_verdict, title_pages
from netdesign.report.words import MISSING, Words, show_check, show_member, show_text
from netdesign.structure.members import EndMember, Member
from netdesign.study.guideline_anchors import AnchorForce, RowAnchors
from netdesign.study.records import RowStudy, Study
from netdesign.study.scopes import Scope, find_governing
from netdesign.study.to_do import MOST_LINES, WHO, list_to_do
from netdesign.words.catalogue import Language, name, name_check

if TYPE_CHECKING:
    from rich.console import Console

_STYLES = {
    "pass": "green",
    "fail": "bold red",
    "not-proven": "yellow",
    "declared": "cyan",
}
_HEADINGS = (
    "terminal.row",
    *("terminal.foot", "terminal.uphill", "terminal.downhill", "terminal.end"),
    *("terminal.structure", "terminal.siting", "terminal.assumed"),
    "terminal.governing",
)
_LACKS = {  # short
    "outside": "terminal.outside",
    "unsure": "terminal.unsure",
    "nothing_given": "terminal.nothing_given",
}
# Columns of a terminal, and of its parts.
_WIDE = 100  # has room for the utilisation by the guideline
_ANCHOR, _ANCHOR_WIDE, _STRUCTURE, _COUNT = 9, 12, 13, 2
_LONGEST_ID, _GOVERNING, _LEAST_GOVERNING = 10, 45, 8


class Matrix:
    """Lines of net rows, one below the other, each as soon as its row is known.

    Every column has its width before any row is known.
    """

    def __init__(self, ids: Collection[str], console: Console, words: Words) -> None:
        """Take the ids of all rows, where the lines are printed, and the language."""
        self._console, self._words = console, words
        self._headings = [words(key) for key in _HEADINGS]
        self._widths = self._find_widths(ids)

    def _find_widths(self, ids: Collection[str]) -> list[int]:
        from rich.cells import cell_len

        total = self._console.width
        row, *_, siting, _, _ = map(cell_len, self._headings)
        longest = max((cell_len(self._spell(show_text(x))) for x in ids), default=0)
        anchor = _ANCHOR_WIDE if total >= _WIDE else _ANCHOR
        known = [*(anchor for _ in ANCHORS), _STRUCTURE, siting, _COUNT]
        room = total - sum(known) - len(known) - 1
        name = max(row, min(longest, max(_LONGEST_ID, room - _GOVERNING)))
        rest = room - name
        return [name, *known, *([rest] if rest >= _LEAST_GOVERNING else [])]

    def print_head(self, title: str) -> None:
        """Print the title of the matrix, and its headings."""
        print_lines([title], self._console)
        self._print([(heading, "") for heading in self._headings])

    def print_row(self, row: RowStudy) -> None:
        """Print the line of a net row."""
        words, scopes = self._words, row.scopes
        anchors = (rate(list_anchor(row, group)) for group in ANCHORS.values())
        contents = [
            *(show_rated(rated, words) for rated in anchors),
            show_structure(row, words, _LACKS),
            (sign(scopes[Scope.SITING].verdict, words),),
        ]
        fitted = zip(contents, self._widths[1:], strict=False)
        cells = [
            self._cut(show_text(row.id), self._widths[0], at_front=True),
            *(self._fit(content, width) for content, width in fitted),
            str(max(scope.assumed for scope in scopes.values()) or ""),
            self._name_governing(row),
        ]
        styles = ["", *map(_find_style, contents), "", ""]
        self._print(zip(cells, styles, strict=True))

    def print_legend(self) -> None:
        """Print what signs and numbers are."""
        is_wide = self._widths[1] == _ANCHOR_WIDE
        numbers = "terminal.numbers_wide" if is_wide else "terminal.numbers"
        keys = ("terminal.legend", numbers)
        print_lines(map(self._words, keys), self._console)

    def _print(self, cells: Iterable[tuple[str, str]]) -> None:
        from rich.cells import set_cell_size
        from rich.text import Text

        line = Text()
        for (text, style), width in zip(cells, self._widths, strict=False):
            line.append(" " if line else "")
            line.append(set_cell_size(self._spell(text), width), style)
        line.rstrip()
        self._console.print(line, soft_wrap=True)

    def _spell(self, text: str) -> str:
        return spell(text, self._console.encoding)

    def _cut(self, text: str, width: int, *, at_front: bool = False) -> str:
        """Text in so many columns: what has no room at its end, or front, is left out.

        Ids of rows differ at their ends.
        """
        from rich.cells import cell_len, set_cell_size

        spelled, mark = self._spell(text), self._spell("…")[0]
        if cell_len(spelled) <= width:
            return spelled
        if not at_front:
            return set_cell_size(spelled, width - 1) + mark
        while cell_len(spelled) >= width:
            spelled = spelled[1:]
        return mark + spelled

    def _fit(self, content: Content, width: int) -> str:
        """Content in so many columns; no number is cut.

        What stands beside it goes first, then the lower end of a span.
        """
        short = [piece for piece in content if not _is_beside(piece)]
        whole, plain = (
            " ".join(self._spell(write_plain(tuple(parts))).split())
            for parts in (content, short if len(short) > 1 else content)
        )
        first, _, span = plain.partition(" ")
        upper = f"{first} {span.rpartition(self._spell('–'))[2]}"
        fitting = (text for text in (whole, plain, upper) if len(text) <= width)
        return next(fitting, self._cut(plain, width))

    def _name_governing(self, row: RowStudy) -> str:
        """Check that decides, by as long a name as there is room for."""
        words, width = self._words, self._widths[-1]
        check = find_shown(row)
        if check is None:
            return self._cut(describe_briefly(row, words), width)
        names = (
            show_check(words, check),
            words.show(name_check(check.member, check.mode)),
            show_member(words, check.member),
        )
        fitting = (text for text in names if len(self._spell(text)) <= width)
        return next(fitting, self._cut(names[-1], width))


def _is_beside(piece: object) -> bool:
    return isinstance(piece, Piece) and piece.look in ("beside", SMALL)


def _find_style(content: Content) -> str:
    badges = (badge.verdict.style for badge in content if isinstance(badge, Badge))
    return _STYLES[next(badges, "pass")]


def print_summary(
    study: Study,
    console: Console,
    language: Language = "en",
    *,
    explain: bool = False,
    scopes: Collection[str] = (),
    has_rows: bool = False,
) -> None:
    """Print a line for each net row, what is to be done, the verdict, explanations.

    Colour, width and destination are those of ``console``; texts of the site
    are never read as markup.

    Parameters
    ----------
    study : Study
        Whose rows are printed.
    console : rich.console.Console
        Where it is printed.
    language : str
        Of the summary.
    explain : bool
        Whether to say all that is open, the loads, and what would turn each check.
    scopes : collection of str
        Those that are asked for; none for all.
    has_rows : bool
        Whether the lines of the net rows stand there already.
    """
    words = Words(language)
    matrix = Matrix([row.id for row in study.rows], console, words)
    if not has_rows:
        matrix.print_head(title_pages(study, words))
        for row in study.rows:
            matrix.print_row(row)
    matrix.print_legend()
    _print_to_do(study, console, words, None if explain else MOST_LINES)
    print_lines(_list_remarks(study, words, is_short=not explain), console, 2)
    _print_verdict(study, console, words)
    if study.rows:
        print_lines(_list_scopes(study, words, scopes), console, 2)
    if explain:
        print_lines(_explain(study, words), console, 2)


def _print_verdict(study: Study, console: Console, words: Words) -> None:
    from rich.text import Text

    verdict = mark_verdict(study, words)
    style = _STYLES[verdict.style]
    overall = Text(spell(words("show.overall", verdict=""), console.encoding))
    overall.append(spell(verdict.word, console.encoding), style)
    console.print(overall, soft_wrap=True)
    print_lines([verdict.meaning], console, 2)


def _list_scopes(study: Study, words: Words, asked: Collection[str]) -> Iterator[str]:
    """Anchors, structure and siting of all rows; numbers of checks and cases."""
    yield describe_study_scopes(study, words)
    if asked:
        named = tuple(words(f"of_scope.{scope}") for scope in asked)
        verdict = words(f"verdict.{study.find_verdict(asked)}")
        yield words("scopes.asked", scopes=named, verdict=verdict)
    verdicts = [check.verdict for row in study.rows for check in row.checks]
    checks = _count_verdicts(verdicts, words)
    yield words("show.counts", checks=checks, cases=describe_cases(study, words))


def _list_remarks(study: Study, words: Words, *, is_short: bool) -> Iterator[str]:
    """What holds beside the numbers: conditions, the floor, add-ons."""
    conditions = list_conditions(study, words)
    if is_short and conditions:
        yield words("terminal.conditions", count=len(study.conditions))
    elif conditions:
        yield from conditions
    if has_other_floor(study):
        floor = words("heading.floor")
        yield words("show.label", label=floor, text=describe_floor(study, words))
    for list_lines in addon_table.load_for_rows(addon_table.LINES, study.rows):
        yield from list_lines(study, words)
    yield from list_exceeding(study, words)


def _print_to_do(
    study: Study, console: Console, words: Words, most: int | None
) -> None:
    """What is to be done, by who has it: his name before his first line."""
    lines = list_to_do(study, most)
    names = {who: words.show(name("who", who)) for who in WHO}
    width = max((len(names[line.who]) for line in lines), default=0)
    for who in WHO:
        label = names[who]
        for line in lines:
            if line.who == who:
                text = show_line(line, study, words)
                print_lines([f"{label:{width}}  {text}"], console, width + 4)
                label = ""


def _count_verdicts(verdicts: Iterable[Verdict], words: Words) -> str:
    """Numbers of verdicts, the worst first: ``1 FAIL, 4 PASS``."""
    counts = Counter(verdicts)
    shown = [
        words(
            "show.count_verdict",
            count=counts[verdict],
            verdict=words(f"verdict.{verdict}"),
        )
        for verdict in SEVERITY
        if counts[verdict]
    ]
    return ", ".join(shown) or words("show.none")


def _explain(study: Study, words: Words) -> Iterator[str]:
    """Loads of the governing checks, notes, and what turns each check."""
    yield name_cases(study, words)
    for row in study.rows:
        check = find_governing(row.checks)
        if check and (loads := describe_loads(check, words)):
            place = f"{show_text(row.id)}, {show_check(words, check)}"
            text = words.join([name_case(check, words), loads])
            yield words("show.label", label=place, text=text)
    floor = describe_floor(study, words)
    yield words("show.label", label=words("heading.floor"), text=floor)
    for note in list_notes(study, words):
        yield words("show.note", note=note)
    yield from list_changes(
        [
            (row.id, check)
            for row in study.rows
            for check in sorted(row.checks, key=lambda check: check.rank)
        ],
        words,
    )


if TYPE_CHECKING:
    from rich.console import Console

SCHEMA = "netdesign.table/1"
# Supports of each line: those that a row's end loads are one, by the worse of them.
_PLACES = {"table.inside": ("intermediate",), "table.at_end": ("second", "edge")}
_SHOWN: Mapping[str, str] = {
    Member.FOOT_ANCHOR: "table.foot_anchor",
    Member.UPHILL_ANCHOR: "table.uphill_anchor",
    Member.DOWNHILL_ANCHOR: "table.downhill_anchor",
    EndMember.LATERAL_ANCHOR: "table.lateral_anchor",
    EndMember.END_GUY_ANCHOR: "table.end_guy_anchor",
}


def print_anchor_table(
    rows: Sequence[RowAnchors], console: Console, words: Words
) -> None:
    """Print the forces of each row, inside and at its end, and what they rest on.

    Parameters
    ----------
    rows : sequence of RowAnchors
        With coupled forces where a study has them.
    console : rich.console.Console
        Where it is printed.
    words : Words
        Of the language.
    """
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0))
    table.add_column(words("table.row"), overflow="fold", min_width=3)
    table.add_column(words("table.place"), overflow="fold")
    table.add_column(words("table.by"), no_wrap=True)
    for heading in _SHOWN.values():
        table.add_column(words(heading), justify="right", min_width=8)
    for line in list_table_lines(rows, words):
        table.add_row(*map(Text, line))
    print_lines((words("table.title"),), console)
    console.print(table)
    print_lines(_list_table_remarks(rows, words), console)


def list_table_lines(
    rows: Iterable[RowAnchors], words: Words
) -> Iterator[tuple[str, ...]]:
    """Cells of each line: row, place, by what, force on each anchor."""
    for row in rows:
        name = show_text(row.id)
        for place, positions in _PLACES.items():
            anchors = [row.find(anchor, *positions) for anchor in _SHOWN]
            if not any(anchors):
                continue
            forces = [_show_force(anchor, words) for anchor in anchors]
            yield name, words(place), words("table.guideline"), *forces
            name = ""
            if any(
                anchor is not None and anchor.coupled_kN is not None
                for anchor in anchors
            ):
                coupled = [_show_coupled(anchor, words) for anchor in anchors]
                yield "", "", words("table.coupled"), *coupled


def _show_force(anchor: AnchorForce | None, words: Words) -> str:
    return words.show_number("guideline_kN", anchor.guideline_kN if anchor else None)


def _show_coupled(anchor: AnchorForce | None, words: Words) -> str:
    """Coupled force, and in brackets its ratio to the guideline's."""
    if anchor is None or anchor.coupled_kN is None:
        return MISSING
    force = words.show_number("coupled_kN", anchor.coupled_kN)
    ratio = words.show_fixed(anchor.ratio, 2)
    return force if anchor.ratio is None else f"{force} ({ratio})"


def _list_table_remarks(rows: Sequence[RowAnchors], words: Words) -> Iterator[str]:
    """Remarks on rows, each once for all of them, and on the table."""
    by_remark: dict[str, list[str]] = {}
    for row in rows:
        for note in (*([row.reason] if row.reason else []), *row.notes):
            by_remark.setdefault(words.show(note), []).append(show_text(row.id))
    for remark, ids in by_remark.items():
        yield words("show.label", label=", ".join(ids), text=remark)
    forces = [anchor for row in rows for anchor in row.anchors]
    if any(force.coupled_kN is not None for force in forces):
        yield words("table.ratio")
    yield words("table.ropes")


def write_anchor_table(rows: Sequence[RowAnchors], words: Words) -> dict[str, Any]:
    """Document of the table: every support of each row, forces in kN.

    Parameters
    ----------
    rows : sequence of RowAnchors
        As they are printed.
    words : Words
        Of the language of notes and reasons.
    """
    return {
        "schema": SCHEMA,
        "rows": [
            {
                "id": row.id,
                "anchors": [list_fields(anchor) for anchor in row.anchors],
                "reason": words.show(row.reason) if row.reason else None,
                "notes": [words.show(note) for note in row.notes],
            }
            for row in rows
        ],
    }
