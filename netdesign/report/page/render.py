"""Tools of every page: templates that escape, styles inside the page."""

from __future__ import annotations

import re
from functools import lru_cache, partial
from typing import TYPE_CHECKING

from netdesign.edge.resources import find_resource
from netdesign.report.words import Words
from netdesign.words.catalogue import Language

if TYPE_CHECKING:
    import jinja2
    from markupsafe import Markup


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
    )
    words = Words(language)
    environment.globals["t"] = environment.globals["words"] = words
    environment.filters["subscripts"] = write_subscripts
    environment.filters["unbroken"] = _keep_units
    points = tuple(words("page.breaks").split())
    environment.filters["breakable"] = partial(_offer_breaks, points)
    return environment


def write_subscripts(symbols: str) -> Markup:
    """``E_d`` with a lowered d; everything else is escaped."""
    from markupsafe import Markup, escape

    lowered = re.sub(r"_(\w+)", r"<sub>\1</sub>", str(escape(symbols)))
    return Markup(lowered)


def _keep_units(case: str) -> str:
    """``400 kg/m³, φ 15°`` that breaks at its commas only."""
    return case.replace(" ", "\u00a0").replace(",\u00a0", ", ")


def _offer_breaks(points: tuple[str, ...], heading: str) -> Markup:
    """Heading whose long words may be broken at their joints, in narrow columns.

    Not every browser knows the hyphens of a language; without them it would break a
    word anywhere.
    """
    from markupsafe import Markup, escape

    shown = str(escape(heading))
    for point in points:
        shown = shown.replace(point.replace("|", ""), point.replace("|", "&shy;"))
    return Markup(shown)


def load_style(*names: str) -> Markup:
    """Style sheets of the templates, one after the other."""
    from markupsafe import Markup

    folder = find_resource("templates")
    return Markup("\n".join((folder / n).read_text(encoding="utf-8") for n in names))


def mark_safe(svg: str) -> Markup:
    """Mark a drawing of ours as HTML; nothing that somebody typed may come here."""
    from markupsafe import Markup

    return Markup(svg)
