"""Page that compares the limit profiles of one run, without script."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.edge.given_files import make_printable
from netdesign.edge.output import PROFILES_FILE
from netdesign.report.page.render import build_environment, load_style
from netdesign.report.view.comparison import compare_profiles
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
    view = compare_profiles(studies, language)
    template = build_environment(language).get_template(PROFILES_FILE)
    css = load_style("report.css", "study.css")
    page = template.render(language=language, css=css, view=view)
    return make_printable(page).encode()
