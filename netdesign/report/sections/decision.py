"""First page: the decision, its matrix, what is to be done, room to sign."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from netdesign.checks.check import Check
from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.blocks import (
    HIDDEN,
    SMALL,
    Block,
    Cell,
    Content,
    Heading,
    Items,
    Pair,
    Pairs,
    Paragraph,
    Part,
    Piece,
    Table,
    key_columns,
    strong,
    symbols,
    text_cell,
)
from netdesign.report.sections.basis import (
    anchor_rows,
    count_assumed,
    describe_floor,
    has_other_floor,
    list_conditions,
    list_limits,
    name_rows,
    show_line,
)
from netdesign.report.sections.checks import (
    describe_briefly,
    describe_cause,
    describe_eased,
    list_exceeding,
)
from netdesign.report.sections.rated import (
    ANCHORS,
    draw_bar,
    find_shown,
    find_structure,
    is_span,
    list_anchor,
    rate,
    rate_scope,
    show_need,
    show_rated,
    sign,
    used_cell,
)
from netdesign.report.what_if import build_what_if, mark_verdict, name_kind
from netdesign.report.words import Words, append_unit, show_text, show_unit, understand
from netdesign.site.model import InputEcho
from netdesign.study.document import compute_digest
from netdesign.study.records import RowStudy, Study, find_input
from netdesign.study.scopes import Scope
from netdesign.study.to_do import WHO, list_to_do
from netdesign.words.catalogue import name, name_check
from netdesign.words.message import Message, say

_NO_BREAK = "\u00a0"
_APART = f"{3 * _NO_BREAK} "  # between the groups of a line
_SHOWN = (0.95, 0.54)  # utilisations of the legend


def show_decision(study: Study, words: Words, *, is_verified: bool = False) -> Part:
    """All of the first page; links to the pages of rows."""
    return Part(
        id="decision",
        look="sheet",
        blocks=(
            *_show_title(study, words, is_verified=is_verified),
            Paragraph(text=_name_rows_by_state(study, words), look="say"),
            *_show_matrix(study, words),
            Heading(text=words("heading.decision"), level=2, look=HIDDEN),
            *list_to_confirm(study, words),
            _sign(study, words),
        ),
    )


def list_to_confirm(study: Study, words: Words) -> Iterator[Part]:
    """What is to be done, and what whoever signs confirms."""
    to_do = Part(kind="div", blocks=tuple(_show_to_do(study, words)))
    beside = (to_do, _show_assumed(study, words))
    yield Part(kind="div", look="two", blocks=beside)
    yield Part(kind="div", blocks=tuple(_show_conditions(study, words)))


def _show_title(study: Study, words: Words, *, is_verified: bool) -> Iterator[Block]:
    """Kind and title; of a what-if, what was replaced."""
    project, verdict = study.project, mark_verdict(study, words)
    kind = name_kind(study, words, is_verified=is_verified)
    named = show_text(project.name.strip() or study.provenance.site_file)
    title = words(f"decision.{study.verdict}", name=named)
    number = project.number
    if project.revision:
        revision = show_text(project.revision)
        number = words("decision.revision", number=number, revision=revision)
    facts = [
        number,
        words.join(filter(None, (study.provenance.started[:10], project.author))),
        study.profile.id,
    ]
    head = (Paragraph(text=kind, look="kind"), Heading(text=title, level=1))
    meta = "\n".join(show_text(fact) for fact in facts if fact)
    yield Part(
        kind="header",
        look="head",
        blocks=(Part(kind="div", blocks=head), Paragraph(text=meta, look="meta")),
    )
    if study.what_if:
        yield Paragraph(text=strong(words("what_if.mark")), look="word")
        yield build_what_if(study, words)
    overall = words("show.overall", verdict=verdict.word)
    text = f"{overall}. {verdict.meaning}"
    yield Paragraph(text=text, look="meaning")


def _name_rows_by_state(study: Study, words: Words) -> Content:
    """Rows of each verdict, the worst first."""
    texts: list[Content] = []
    for verdict in SEVERITY:
        ids = [row.id for row in study.rows if row.verdict is verdict]
        if ids:
            named = show_text(name_rows(ids, study, words))
            state = words("show.label", label=words(f"verdict.{verdict}"), text="")
            texts.append((sign(verdict, words), Piece(state), *strong(named)))
    return tuple(piece for content in texts for piece in (*content, Piece(_APART)))


def _show_matrix(study: Study, words: Words) -> Iterator[Block]:
    if not study.rows:
        yield Paragraph(text=words("heading.no_rows"), look="none")
        return
    yield build_matrix(study, words)
    key: Content = (
        Piece(words.show_fixed(_SHOWN[0], 2), "ratio"),
        Piece(f" {words('matrix.used')} "),
        draw_bar(*_SHOWN),
        Piece(f" {words.show_fixed(_SHOWN[1], 2)} {words('matrix.by_guideline')} · "),
        *(
            piece
            for verdict in (*SEVERITY[::-1],)
            for piece in (
                sign(verdict, words),
                Piece(f"{words(f'verdict.{verdict}').lower()}{_APART}"),
            )
        ),
    )
    yield Paragraph(text=key, look="key")


def build_matrix(study: Study, words: Words) -> Table:
    """Utilisation of each group of anchors, structure, siting, and what governs."""
    keys = ("row", *ANCHORS, "structure", "siting", "governing")
    anchors = anchor_rows(study)
    return Table(
        caption="",
        columns=key_columns(words, "matrix.", keys),
        rows=tuple(_list_row(row, anchors[row.id], words) for row in study.rows),
        empty=words("heading.no_rows"),
        look="matrix cards",
        symbols="headings",
    )


def _list_row(row: RowStudy, anchor: str, words: Words) -> tuple[Cell, ...]:
    name: Content = (
        sign(row.verdict, words),
        Piece(show_text(row.id), "name", link=anchor),
        Piece(_describe_row(row, words), SMALL, has_symbols=True),
    )
    groups = (list_anchor(row, members) for members in ANCHORS.values())
    siting = row.scopes[Scope.SITING]
    return (
        Cell(text=show_text(row.id), content=name),
        *(used_cell(rate(group), words) for group in groups),
        Cell(content=show_structure(row, words)),
        Cell(content=(sign(siting.verdict, words),)),
        Cell(content=_tell_governing(row, words)),
    )


LACKS = {
    "outside": "rated.outside",
    "unsure": "rated.unsure",
    "nothing_given": "rated.nothing_given",
}


def show_structure(
    row: RowStudy, words: Words, lacks: Mapping[str, str] = LACKS
) -> Content:
    """Utilisation of the structure; the document that proves all of it.

    Parameters
    ----------
    row : RowStudy
        Whose structure it is.
    words : Words
        Of the language.
    lacks : mapping of str to str
        Texts that say why no document proves it.
    """
    line = find_structure(row)
    if line is None:
        return show_rated(rate_scope(row, Scope.STRUCTURE), words)
    first = sign(row.scopes[Scope.STRUCTURE].verdict, words)
    if line.declared is None:
        return (first, Piece(words(lacks[_find_lack(row, line)]), "beside"))
    return (first, Piece(show_text(line.declared.document), "beside"))


def _find_lack(row: RowStudy, line: Check) -> str:
    """Why no document proves the structure: none is there, or it may not hold."""
    if line.mode != "approval":
        return "nothing_given"
    limits = (check for check in row.checks if check.mode == line.mode)
    is_outside = any(check.verdict is Verdict.FAIL for check in limits)
    return "outside" if is_outside else "unsure"


def _describe_row(row: RowStudy, words: Words) -> str:
    """Slope and height of the net, by which a reader knows a row."""
    slope, height = find_input(row, "slope_angle"), find_input(row, "net_height")
    texts = []
    if slope is not None:
        texts.append(f"{words.show_given(slope)}°")
    if height is not None:
        texts.append(f"D_K {words.show_fixed(height, 1)} m")
    return " · ".join(texts).replace(" ", _NO_BREAK)


def _tell_governing(row: RowStudy, words: Words) -> Content:
    """Governing check; below it E_d against R_d, or what is needed."""
    check = find_shown(row)
    if check is None or (
        check.verdict is not row.verdict and row.verdict is not Verdict.DECLARED
    ):
        return (Piece(describe_briefly(row, words)),)
    text = _compare(check, words)
    named = words.show(name_check(check.member, check.mode))
    return (Piece(named), Piece(text, SMALL, has_symbols=True))


def _compare(check: Check, words: Words) -> str:
    """``441 > 159 kN, needs R_k ≥ 602 kN``; else the reason in few words."""
    demand, resistance = check.demand_kN, check.resistance_kN
    if demand is None and check.declared:
        return show_text(check.declared.document)
    if demand is None or check.is_unbounded:
        return describe_cause(check, words)
    force = words.show_number("demand_kN", demand)
    if resistance is None:
        text = f"{force} kN"
        if check.declared:
            return words.join((text, show_text(check.declared.document)))
        needed = show_need(check, words)
        return words.join((text, needed or describe_cause(check, words)))
    relation = ">" if demand > resistance else "≤"
    text = f"{force} {relation} {words.show_number('resistance_kN', resistance)} kN"
    eased = "" if is_span(check) else describe_eased(check, words)
    texts = (text, eased, show_need(check, words))
    return words.join(filter(None, texts))


def _show_to_do(study: Study, words: Words) -> Iterator[Block]:
    """Points by who has them."""
    lines = list_to_do(study)
    yield Heading(text=words("heading.todo"), level=3)
    pairs = [
        Pair(
            name=words.show(name("who", who)),
            text=symbols("\n".join(show_line(x, study, words) for x in own)),
        )
        for who in WHO
        if (own := [x for x in lines if x.who == who])
    ]
    none = Paragraph(text=words("todo.none"), look="none")
    listed = Pairs(pairs=tuple(pairs), look="todo") if pairs else none
    yield Part(id="todo", kind="div", blocks=(listed,))


def _show_conditions(study: Study, words: Words) -> Iterator[Block]:
    """What the engineer on site sees to, and what holds of the whole study."""
    floor = [describe_floor(study, words)] if has_other_floor(study) else []
    assumed, count = count_assumed(study)
    if assumed:
        floor.append(words("todo.unconfirmed", assumed=assumed, count=count))
    texts = (
        *floor,
        *list_conditions(study, words),
        *list_exceeding(study, words),
        *filter(None, [words.join(list_limits(study, words))]),
    )
    if texts:
        yield Heading(text=words("heading.conditions"), level=3)
        yield Items(items=tuple(map(symbols, texts)), look="conditions")


def _show_assumed(study: Study, words: Words) -> Part:
    """Ranges and values that hold for the study; whoever signs confirms them."""
    rows = []
    for line in list_assumed(study, words):
        value: list[Piece] = [Piece(line.value)]
        if line.rows:
            named = show_text(name_rows(list(line.rows), study, words))
            value.append(Piece(f" ({named})", "beside"))
        rows.append((text_cell(line.name), Cell(content=tuple(value))))
    table = Table(
        caption="",
        columns=key_columns(words, "assumed_range.", ("name", "value")),
        rows=tuple(rows),
        empty=words("show.none"),
        look="ranges",
    )
    heading = Heading(text=words("assumed_range.heading"), level=3)
    return Part(kind="div", blocks=(heading, table))


def _sign(study: Study, words: Words) -> Part:
    """Room for signatures, and what ties them to the study."""
    project = study.project
    people = {
        "prepared": project.author,
        "checked": project.checker,
        "approved": "",
    }
    room = words("decision.room")
    names = (show_text(person) if person.strip() else "" for person in people.values())
    table = Table(
        caption=words("decision.signing"),
        columns=key_columns(words, "heading.", tuple(people)),
        rows=(tuple(Cell(content=(Piece(f"{x}\n{room}\n"),)) for x in names),),
        look="sign",
    )
    tied = words("show.signed_study", digest=compute_digest(study))
    return Part(
        kind="div",
        look="sign-off",
        blocks=(table, Paragraph(text=tied, look="small")),
    )


DEFAULT = "default"  # cell of an input that takes its default value
# Left empty, its factor is taken by the guideline's load.
ALTITUDE = say("column.rows.altitude")


@dataclass(frozen=True, slots=True, kw_only=True)
class AssumedLine:
    """One range or value, with the rows that have it; none: all of them."""

    name: str
    value: str
    rows: tuple[str, ...] = ()


def list_assumed(study: Study, words: Words) -> Iterator[AssumedLine]:
    """Searched ranges, then other assumed values, each name once.

    Rows whose ranges differ share a line: least low end to largest high end.
    """
    values: dict[str, dict[str, None]] = {}
    ends: dict[str, list[float]] = {}
    rows: dict[str, dict[str, None]] = {}
    units: dict[str, str] = {}
    for row in study.rows:
        for value in row.assumed:
            name = words.show(value.input)
            rows.setdefault(name, {})[row.id] = None
            values.setdefault(name, {})[words.show(value.text)] = None
            if value.low is not None and value.high is not None:
                ends.setdefault(name, []).extend((value.low, value.high))
                units[name] = value.unit.removeprefix("-")
        for echo in row.inputs:
            shown, name = _show_default(echo, words), words.show(echo.label)
            if shown and row.id not in rows.get(name, {}):
                rows.setdefault(name, {})[row.id] = None
                values.setdefault(name, {})[shown] = None
    yield from (x for x in _list_ranges(study, words) if x.name not in rows)
    for name, ids in rows.items():
        texts = list(values[name])
        if name in ends and len(texts) > 1:
            texts = [_show_ends(ends[name], units[name], words)]
        some = () if len(ids) == len(study.rows) else tuple(ids)
        yield AssumedLine(name=name, value=words.join(texts), rows=some)


def _show_ends(ends: list[float], unit: str, words: Words) -> str:
    """Least and largest of some ends, to four digits, with their unit."""
    low, high = (words.show_given(float(f"{x:.4g}")) for x in (min(ends), max(ends)))
    text = low if low == high else words("show.from_to", low=low, high=high)
    return append_unit(text, show_unit(unit)) if unit else text


def _show_default(echo: InputEcho, words: Words) -> str:
    """What an empty cell was taken as; "" of one that says nothing."""
    if echo.cell == DEFAULT and echo.value != "":
        return words.show_quantity(understand(echo, words), echo.unit)
    if echo.label == ALTITUDE and echo.value == "":
        return words("show.largest_altitude_factor")
    return ""


def _list_ranges(study: Study, words: Words) -> Iterator[AssumedLine]:
    """Ranges of the site, low and high end in one line."""
    ends: dict[str, list[InputEcho]] = {}
    names: dict[str, Message] = {}
    for echo in study.range_inputs:
        named = echo.label.arguments.get("name") if _is_message(echo) else None
        if isinstance(named, Message) and isinstance(echo.value, float):
            ends.setdefault(named.key, []).append(echo)
            names[named.key] = named
    for key, echoes in ends.items():
        numbers = [echo.value for echo in echoes if isinstance(echo.value, float)]
        shown = _show_ends(numbers, echoes[0].unit, words)
        yield AssumedLine(name=words.show(names[key]), value=shown)


def _is_message(echo: InputEcho) -> bool:
    return isinstance(echo.label, Message)
