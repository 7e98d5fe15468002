"""Page that compares the limit profiles of one run, without script."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.report.blocks.block import (
    Items,
    Paragraph,
    Part,
    masthead,
    section,
)
from netdesign.report.blocks.text import strong
from netdesign.report.page.render import render_page
from netdesign.report.view.comparison import compare_profiles
from netdesign.report.words import Words
from netdesign.study.records import Study
from netdesign.words.catalogue import Language


def render_comparison(studies: Sequence[Study], language: Language = "en") -> bytes:
    """Contents of the page.

    Parameters
    ----------
    studies : sequence of Study
        Of one site, one for each profile.
    language : str
        Of the page.
    """
    view, words = compare_profiles(studies, language), Words(language)
    title = words("compare.title")
    mark = (Paragraph(text=strong(view.mark), look="word"),) if view.mark else ()
    blocks = (
        masthead(title, view.name, *mark),
        Part(
            id="profiles",
            blocks=(
                Items(items=view.profiles),
                Paragraph(text=words("compare.lead"), look="text"),
                view.verdicts.shown("profiles"),
                Paragraph(text=view.told, look="text"),
            ),
        ),
        section(
            "rows",
            words("heading.net_rows"),
            *(table.shown("profiles") for table in view.rows),
        ),
        section(
            "values", words("heading.limit_profile"), view.values.shown("profiles")
        ),
    )
    named = " - ".join(part for part in (view.mark, view.name, title) if part)
    return render_page(blocks, named, language).encode()
