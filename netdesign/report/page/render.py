"""Tools of every page: templates that escape, styles inside the page."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache, partial
from typing import TYPE_CHECKING

from markupsafe import Markup, escape

from netdesign.edge.given_files import find_resource
from netdesign.report.words import Words
from netdesign.words.catalogue import Language

if TYPE_CHECKING:
    import jinja2

    from netdesign.report.view.table import Cell, Column

_LOWERED = re.compile(r"_(\w+)")
_MARKS = re.compile("[&<>'\"]")  # what HTML has another sign for


@lru_cache(maxsize=8)
def build_environment(language: Language = "en") -> jinja2.Environment:
    """Templates in which all text is escaped and a missing value is an error.

    Kept with what they compile to: a check against several profiles has several pages.

    Parameters
    ----------
    language : str
        Of the texts; templates ask for one by its key: ``t("heading.checks")``.
    """
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(find_resource("templates")),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        optimized=False,  # takes longer than it saves in a page or two
    )
    words = Words(language)
    environment.globals["t"] = environment.globals["words"] = words
    environment.filters["subscripts"] = write_subscripts
    environment.filters["unbroken"] = _keep_units
    environment.filters["line"] = write_line
    points = tuple(words("page.breaks").split())
    # every row has the same headings
    offer_breaks = lru_cache(maxsize=512)(partial(_offer_breaks, points))
    environment.filters["breakable"] = offer_breaks
    return environment


def write_subscripts(symbols: str) -> Markup:
    """``E_d`` with a lowered d; everything else is escaped."""
    shown = str(escape(symbols))
    return Markup(_LOWERED.sub(r"<sub>\1</sub>", shown) if "_" in shown else shown)


def write_line(cells: Sequence[Cell], columns: Sequence[Column], mark: str) -> Markup:
    """Cells of a table's line; the first one names it.

    ``mark`` is the class of numbers, ``n``, or that of texts, ``t``. A template that
    writes cell by cell takes three times as long, and a page has 20,000 of them.
    """
    looks = [
        f' class="{mark}">' if column.is_number is (mark == "n") else ">"
        for column in columns
    ]
    texts = [
        escape(cell.text) if _MARKS.search(cell.text) else cell.text for cell in cells
    ]
    written = [
        f"<td{look}{text}</td>" for look, text in zip(looks[1:], texts[1:], strict=True)
    ]
    return Markup(f'<th scope="row"{looks[0]}{texts[0]}</th>{"".join(written)}')


def _keep_units(case: str) -> str:
    """``400 kg/m³, φ 15°`` that breaks at its commas only."""
    return case.replace(" ", "\u00a0").replace(",\u00a0", ", ")


def _offer_breaks(points: tuple[str, ...], heading: str) -> Markup:
    """Heading whose long words may be broken at their joints, in narrow columns.

    Not every browser knows the hyphens of a language; without them it would break a
    word anywhere.
    """
    shown = str(escape(heading))
    for point in points:
        shown = shown.replace(point.replace("|", ""), point.replace("|", "&shy;"))
    return Markup(shown)


def load_style(*names: str) -> Markup:
    """Style sheets of the templates, one after the other."""
    folder = find_resource("templates")
    return Markup("\n".join((folder / n).read_text(encoding="utf-8") for n in names))


def mark_safe(svg: str) -> Markup:
    """Mark a drawing of ours as HTML; nothing that somebody typed may come here."""
    return Markup(svg)
