"""First page: the verdict of each row, what is open, room to sign."""

from __future__ import annotations

import shlex
from collections.abc import Iterator

from netdesign.checks.check import Check
from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.blocks import (
    HIDDEN,
    Badge,
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
    masthead,
    name_columns,
    section,
    strong,
    text_cell,
)
from netdesign.report.sections.basis import (
    anchor_rows,
    count_assumed,
    describe_floor,
    has_other_floor,
    label_rows,
    list_defaults,
    name_profile,
    name_rows,
)
from netdesign.report.sections.checks import (
    badge_cell,
    describe_briefly,
    describe_cause,
    list_flips,
    name_checks,
    name_few,
    show_used,
)
from netdesign.report.sections.scopes import list_exceeding, show_scope
from netdesign.report.what_if import build_what_if, mark_verdict, name_kind, name_study
from netdesign.report.words import (
    MISSING,
    VERDICTS,
    Words,
    show_check,
    show_member,
    show_text,
)
from netdesign.structure.members import CARRYING_MEMBERS, EndMember, NetPart
from netdesign.study.document import compute_digest
from netdesign.study.governing import find_governing
from netdesign.study.records import RowStudy, Study
from netdesign.study.scopes import SCOPES
from netdesign.study.to_do import ToDo
from netdesign.words.names import name

_FLAT_DEG = 10.0  # below the horizontal, of a bore that is hard to fill
_FEW_ROWS = 8  # of more, a matrix of rows by members shows where to look


def show_title(study: Study, words: Words, *, is_verified: bool = False) -> Part:
    """Name of the project; of a what-if, what was replaced."""
    more: list[Block] = []
    if study.what_if:
        more.append(Paragraph(text=strong(words("what_if.mark")), look="word"))
        more.append(build_what_if(study, words))
    title = show_text(study.project.name)
    return masthead(name_kind(study, words, is_verified=is_verified), title, *more)


def show_decision(study: Study, words: Words, *, has_rows: bool) -> Part:
    """Verdict, rows, open points, signatures; links to pages of rows if it has any."""
    verdict = mark_verdict(study, words)
    card = Part(
        kind="div",
        look=f"card {verdict.style}",
        blocks=(
            Paragraph(text=(Badge(verdict, "word"),), look="word"),
            Paragraph(text=verdict.meaning, look="meaning"),
        ),
    )
    heading = Heading(text=words("heading.verdict"), level=2, look=HIDDEN, on="page")
    matrix: tuple[Block, ...] = ()
    has_forces = any(one.is_of_force for row in study.rows for one in row.checks)
    if len(study.rows) > _FEW_ROWS and has_forces:
        matrix = (build_matrix(study, words).shown("matrix"),)
    todo = tuple(list_open_points(study, words)) or (words("todo.none"),)
    pairs = tuple(Pair(name=a, text=b) for a, b in identify(study, words))
    return Part(
        id="decision",
        blocks=(
            heading,
            card,
            Pairs(pairs=pairs, look="pairs"),
            _tabulate_rows(study, words, has_rows=has_rows),
            *matrix,
            section(
                "todo",
                words("heading.todo"),
                Items(items=todo, look="numbered"),
                level=3,
            ),
            *_show_conditions(study, words),
            _sign(study, words),
        ),
    )


def _show_conditions(study: Study, words: Words) -> Iterator[Block]:
    """What has to hold beside the checks; nothing where there is none."""
    lines = list_conditions(study, words)
    if lines:
        shown = Items(items=tuple(lines), look="numbered")
        yield section("conditions", words("heading.conditions"), shown, level=3)


def list_conditions(study: Study, words: Words) -> list[str]:
    """What has to hold beside the checks, with who sees to it, and for which rows."""
    return [
        words(
            "condition.line",
            who=words.show(name("who", one.who)),
            rows=show_text(name_rows(one.rows, study, words)),
            text=words.show(one.message),
        )
        for one in study.conditions
    ]


def identify(study: Study, words: Words) -> tuple[tuple[str, str], ...]:
    """Subject of the report: names with what stands beside them."""
    project = study.project
    pairs = (
        ("number", project.number),
        ("revision", project.revision),
        ("site_file", study.provenance.site_file),
        ("date", study.provenance.started[:10]),
        ("limit_profile", name_profile(study, words)),
    )
    return tuple((words(f"heading.{key}"), show_text(text)) for key, text in pairs)


def _tabulate_rows(study: Study, words: Words, *, has_rows: bool) -> Block:
    if not study.rows:
        return Paragraph(text=words("heading.no_rows"), look="none")
    keys = (
        *("net_row", "verdict", *(f"scope_{one}" for one in SCOPES)),
        *("governing_check", "utilisation", "reason"),
    )
    anchors = anchor_rows(study)
    return Table(
        caption=words("caption.decision"),
        columns=key_columns(words, "heading.", keys),
        rows=tuple(
            _list_row(row, anchors[row.id] if has_rows else "", words)
            for row in study.rows
        ),
        look="summary",
    )


def _list_row(row: RowStudy, anchor: str, words: Words) -> tuple[Cell, ...]:
    check = find_governing(row.checks)
    named = show_check(words, check) if check else words("heading.no_check")
    used = Cell(content=show_used(check, words)) if check else text_cell(MISSING)
    return (
        Cell(content=(Piece(show_text(row.id), "name", link=anchor),)),
        badge_cell(row.verdict, words),
        *(text_cell(show_scope(row, scope, words)[0]) for scope in SCOPES),
        text_cell(named),
        used,
        text_cell(describe_briefly(row, words)),
    )


def build_matrix(study: Study, words: Words) -> Table:
    """Worst verdict and largest utilisation of each row by members, and the rest."""
    known = {one.member for row in study.rows for one in row.checks if one.is_of_force}
    members = [one for one in (*CARRYING_MEMBERS, *NetPart, *EndMember) if one in known]
    columns = [show_member(words, one) for one in members]
    headings = [words("heading.net_row"), *columns, words("heading.rest")]
    return Table(
        caption=words("caption.matrix"),
        columns=name_columns(headings, numbers=()),
        rows=tuple(
            (
                text_cell(row.id),
                *(_sum_up(_list_of(row, one), words) for one in members),
                _sum_up([one for one in row.checks if not one.is_of_force], words),
            )
            for row in study.rows
        ),
        empty=words("heading.no_rows"),
    )


def _list_of(row: RowStudy, member: str) -> list[Check]:
    return [one for one in row.checks if one.member == member and one.is_of_force]


def _sum_up(checks: list[Check], words: Words) -> Cell:
    """Symbol of the worst verdict, and the largest utilisation that is known."""
    if not checks:
        return text_cell(MISSING)
    worst = min((one.verdict for one in checks), key=SEVERITY.index)
    known = [one.used for one in checks if one.used is not None]
    symbol = VERDICTS[worst].symbol
    if not known:
        return text_cell(symbol)
    most = words.show_number("utilisation", max(known))
    return text_cell(f"{symbol} {most}")


def show_line(line: ToDo, study: Study, words: Words) -> str:
    """What is to be done, after the net rows that need it."""
    rows = show_text(name_rows(list(line.rows), study, words))
    return words("to_do.line", rows=rows, text=words.show(line.text))


def list_open_points(study: Study, words: Words) -> Iterator[str]:
    """Points to settle before the report can be signed, the worst first."""
    yield from _list_open_checks(study, Verdict.FAIL, words)
    yield from _list_open_checks(study, Verdict.NOT_PROVEN, words)
    yield from list_exceeding(study, words)
    yield from _list_open_rows(study, words)
    yield from _list_declared(study, words)
    if has_other_floor(study):
        floor = words("heading.floor")
        yield words("show.label", label=floor, text=describe_floor(study, words))
    for topic in study.profile.not_checked:
        who = words(f"scope.{topic}_by")
        yield words("todo.not_checked", what=words(f"scope.{topic}"), who=who)
    assumed, count = count_assumed(study)
    if assumed:
        yield words("todo.unconfirmed", assumed=assumed, count=count)
    panels = [row.id for row in study.rows if row.panel and row.panel.assumed]
    if panels:
        yield words("todo.panels", rows=name_rows(panels, study, words))
    yield from _list_rising(study, words)
    defaults = len(list_defaults(study, words))
    if defaults:
        yield words("todo.defaults", count=defaults)


def _list_rising(study: Study, words: Words) -> Iterator[str]:
    """Anchors whose boreholes are so flat that mortar may run out of them."""
    rising = [
        (row.id, show_member(words, one.anchor))
        for row in study.rows
        for one in row.pulls
        if one.dip_deg < _FLAT_DEG - 1e-9
    ]
    if rising:
        ids, anchors = (list(dict.fromkeys(one)) for one in zip(*rising, strict=True))
        named = show_text(name_rows(ids, study, words))
        yield words("todo.rising", anchors=words.join(anchors), rows=named)


def _list_open_checks(study: Study, verdict: Verdict, words: Words) -> Iterator[str]:
    """Checks of one verdict; checks with one cause, and rows alike, share a point."""
    points: dict[tuple[str, str], list[str]] = {}
    for row in study.rows:
        causes: dict[str, list[Check]] = {}
        for check in row.checks:
            if check.verdict is verdict:
                is_by_force = check.is_of_force and verdict is Verdict.FAIL
                told = (
                    words("todo.fail") if is_by_force else describe_cause(check, words)
                )
                causes.setdefault(told, []).append(check)
        for cause, checks in causes.items():
            told = _add_change(checks, cause, words)
            points.setdefault((name_few(checks, words), told), []).append(row.id)
    for (named, told), ids in points.items():
        place = f"{show_text(name_rows(ids, study, words))}, {named}"
        yield words("show.label", label=place, text=told)


def _add_change(checks: list[Check], cause: str, words: Words) -> str:
    """Cause of a point; of a single check with what makes it pass."""
    flips = list_flips(checks[0], words) if len(checks) == 1 else ()
    return words("todo.with_change", what=cause, change=flips[0]) if flips else cause


def _list_open_rows(study: Study, words: Words) -> Iterator[str]:
    """Laws that rows do not meet; those that rows share are told once."""
    rows: dict[str, list[str]] = {}
    for row in study.rows:
        for reason in row.unmet:
            rows.setdefault(words.show(reason), []).append(row.id)
    yield from label_rows(rows, study, words)


def _list_declared(study: Study, words: Words) -> Iterator[str]:
    """Documents that are said to prove checks, each with the checks."""
    found: dict[tuple[str, str], list[Check]] = {}
    for row in study.rows:
        for check in row.checks:
            if check.declared and check.verdict is Verdict.DECLARED:
                proof = words.show(check.declared.describe())
                found.setdefault((show_text(row.id), proof), []).append(check)
    for (row_id, proof), checks in found.items():
        place = f"{row_id}, {name_checks(checks, words)}"
        yield words("todo.declared", checks=place, proof=proof)


def _sign(study: Study, words: Words) -> Part:
    """Room for signatures, and what ties them to the study."""
    project = study.project
    people = {
        "prepared": project.author,
        "checked": project.checker,
        "approved": "",
    }
    keys = ("role", "name", "date", "signature")
    table = Table(
        caption=words("heading.signatures"),
        columns=key_columns(words, "heading.", keys),
        rows=tuple(
            (
                Cell(text=words(f"heading.{role}")),
                Cell(text=show_text(name) if name.strip() else ""),
                *(Cell(), Cell()),
            )
            for role, name in people.items()
        ),
        look="sign",
    )
    tied = words("show.signed_study", digest=compute_digest(study))
    command: Content = (Piece(f"{tied} "), Piece(name_verification(study), "code"))
    return Part(
        kind="div",
        look="sign-off",
        blocks=(table, Paragraph(text=command, look="small")),
    )


_BUILT_IN = "example.xlsx"  # which `verify` has, too


def name_verification(study: Study) -> str:
    """Command that solves every case of a report again and compares it."""
    site = study.provenance.site_file
    named = f" --site {shlex.quote(site)}" if site and site != _BUILT_IN else ""
    return show_text(f"netdesign verify --study {name_study(study)}{named}")
