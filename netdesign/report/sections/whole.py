"""Study -> blocks: one sequence, which page and document print."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from datetime import UTC, datetime
from typing import Any, Literal

from netdesign.report.blocks import Block, Content, Contents, Piece, link, section
from netdesign.report.sections import (
    annexes,
    basis,
    decision,
    guideline,
    quality,
    schedule,
    worked,
)
from netdesign.report.sections.additions import list_additions
from netdesign.report.sections.row import RowSections
from netdesign.report.what_if import mark_title
from netdesign.report.words import Words, show_text
from netdesign.study.records import Study

Detail = Literal["summary", "full"]  # two pages for the client, and everything
_ANNEXES = (
    *("annex-checks", "annex-model", "annex-profile", "annex-quality"),
    "annex-verify",
)


def build_report(
    study: Study,
    words: Words,
    detail: Detail,
    *,
    is_verified: bool = False,
) -> tuple[Block, ...]:
    """Blocks of a report, from its title to its annexes.

    Parameters
    ----------
    study : Study
        What is shown.
    words : Words
        Of the language.
    detail : str
        ``summary`` has two pages for the client: decision, quantities, scope.
    is_verified : bool
        The stored study was solved again in this run.
    """
    begun = (
        decision.show_title(study, words, is_verified=is_verified),
        decision.show_decision(study, words, has_rows=detail == "full"),
    )
    answered = filter(None, [guideline.show_difference(study, words)])
    if detail == "summary":
        listed = basis.list_scope(study, words)
        scope = section("scope", words("heading.scope"), *listed)
        ordered = schedule.show_quantities(study, words)
        return *begun, *answered, ordered, scope
    return (
        *begun,
        _list_contents(study, words),
        *answered,
        basis.show_basis(study, words),
        schedule.show_schedule(study, words),
        *_list_rows(study, words),
        basis.show_inputs(study, words),
        worked.show_all(study, words),
        annexes.show_model(study, words),
        basis.show_profile(study, words),
        quality.show_quality(study, words),
        annexes.show_verification(study, words),
        *(part for one in list_additions(study) for part in one.show(study, words)),
    )


def _list_rows(study: Study, words: Words) -> Iterator[Block]:
    told = frozenset(basis.share_notes(study, words))
    anchors = basis.anchor_rows(study)
    rows = {anchors[row.id]: row for row in reversed(study.rows)}
    for anchor in dict.fromkeys(anchors.values()):
        ids = [name for name, one in anchors.items() if one == anchor]
        yield RowSections(rows[anchor], ids, anchor, words, told).build()


def _list_contents(study: Study, words: Words) -> Contents:
    """Links to all parts, and to the rows."""
    named = {name: words(f"heading.{name}") for name in ("basis", "schedule")}
    named["inputs"] = words("heading.inputs_of_rows")
    further = [one.annex for one in list_additions(study)]
    for name in (*_ANNEXES, *further):
        named[name] = words(f"heading.{name.replace('-', '_')}")
    lines = [_list_links(named.items())]
    if study.rows:
        label = words("show.label", label=words("heading.net_rows"), text="")
        rows = [
            (anchor, show_text(name))
            for name, anchor in basis.anchor_rows(study).items()
        ]
        lines.append((Piece(label), *_list_links(rows)))
    return Contents(heading=words("heading.contents"), lines=tuple(lines))


def _list_links(links: Iterable[tuple[str, str]]) -> Content:
    return tuple(
        piece for anchor, text in links for piece in (*link(anchor, text), Piece(" "))
    )


def list_properties(study: Study, words: Words) -> dict[str, Any]:
    """Properties of a file of the study; its start is in UTC without a zone."""
    time = datetime(1980, 1, 1)  # of a study that does not say
    if study.provenance.started:
        time = datetime.fromisoformat(study.provenance.started)
    return {
        "title": words("heading.anchor_check"),
        "subject": title_pages(study, words),
        "author": show_text(study.project.author),
        "created": time.astimezone(UTC).replace(tzinfo=None) if time.tzinfo else time,
    }


def title_pages(study: Study, words: Words) -> str:
    """Line that runs along with the pages of a print."""
    project = study.project
    texts = (project.number, project.name, project.revision)
    title = " · ".join(show_text(text) for text in texts if text)
    return mark_title(study, title, words)
