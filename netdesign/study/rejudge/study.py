"""All that can be said of a stored study without solving anything again."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict

from netdesign.checks import Standard
from netdesign.envelope.parameters import PARAMETERS
from netdesign.outcome import merge_verdicts
from netdesign.site.model import Site
from netdesign.study.notes import list_reasons
from netdesign.study.records import RowStudy, Study, list_verdicts
from netdesign.study.rejudge.cases import Spans, rejudge_cases
from netdesign.study.rejudge.checks import rejudge_checks
from netdesign.study.rejudge.compare import guard, is_of_steady_states, report_verdict
from netdesign.study.rejudge.drawn import rejudge_drawn
from netdesign.study.rejudge.statics import rejudge_statics
from netdesign.words.message import Message, say


def rejudge(
    study: Study, standard: Standard | None = None, site: Site | None = None
) -> list[Message]:
    """Contradictions of a study, each in a sentence that names the place.

    Parameters
    ----------
    study : Study
        As stored.
    standard : Standard, optional
        The limit profile of that id, where it is at hand.
    site : Site, optional
        What the site file holds, where it is at hand. Files whose hash is not that of
        the study are left out: they say nothing about it.

    Returns
    -------
    list of Message
        Empty where everything follows from everything else. That the forces are those
        of the site's snow and nets is what only a new solve shows.

    Verified by
    -----------
    tests/study/rejudge/test_alterations.py
    """
    found = [*_rejudge_profile(study, standard)]
    spans = _read_spans(study)
    is_steady = is_of_steady_states(study)
    tolerance = _read_number(study, "balance_tolerance") if is_steady else math.inf
    law = study.provenance.settings.get("creep_law", "").partition(" ")[0]
    accepts_law = bool(law) and study.project.accepted_law == law
    for row in study.rows:
        parts = (
            rejudge_cases(row, spans, tolerance),
            rejudge_checks(row, study.profile, accepts_law=accepts_law),
            rejudge_drawn(row, study.profile, is_steady=is_steady),
            rejudge_statics(row) if is_steady else iter(()),
            _rejudge_verdict(row),
        )
        place = say("audit.row", row=row.id)
        for part in parts:
            found += guard(place, part)
    if site is not None and site.sha256 == study.provenance.site_sha256:
        from netdesign.study.rejudge.again import judge_again

        found += judge_again(study, site, standard)
    verdict = merge_verdicts(row.verdict for row in study.rows)
    if study.verdict is not verdict:
        found.append(report_verdict(say("audit.study"), study.verdict, verdict))
    return found


def _rejudge_profile(study: Study, standard: Standard | None) -> Iterator[Message]:
    """Values of the profile against its files, where these are the ones of the hash."""
    ids = [value.id for value in study.profile.values]
    if len(set(ids)) < len(ids):
        yield say("audit.value_twice")
    if standard is None or standard.sha256 != study.profile.sha256:
        return
    from netdesign.study.record_provenance import record_profile

    again = record_profile(standard)
    stored = {value.id: asdict(value) for value in study.profile.values}
    listed = {value.id: asdict(value) for value in again.values}
    for name in dict.fromkeys((*stored, *listed)):
        if stored.get(name) != listed.get(name):
            yield say("audit.other_profile", name=name)
    for key in ("id", "title", "edition", "version", "choice", "floor"):
        if getattr(study.profile, key) != getattr(again, key):
            yield say("audit.other_profile", name=key)


def _rejudge_verdict(row: RowStudy) -> Iterator[Message]:
    """Verdict and reasons of a row from its checks and independent checks."""
    place = say("audit.row", row=row.id)
    verdict = merge_verdicts(list_verdicts(row.checks, row.independent))
    if row.verdict is not verdict:
        yield report_verdict(place, row.verdict, verdict)
    reasons = list_reasons(row.checks, row.independent)
    if row.reasons != reasons:
        yield say("audit.other_reasons", place=place)


def _read_spans(study: Study) -> Spans:
    """Ranges as they were understood, by the keys of a case."""
    spans = {}
    for quantity, parameter in PARAMETERS.items():
        if quantity == "slope_angle":
            continue  # of a row, and no range of a site
        name = say(f"column.quantities.{quantity}")
        ends = [
            echo.value
            for end in ("low", "high")
            for echo in study.range_inputs
            if echo.label == say(f"column.{end}_end", name=name)
        ]
        if len(ends) == 2 and all(isinstance(end, float) for end in ends):
            spans[parameter.key] = (float(ends[0]), float(ends[1]))
    return spans


def _read_number(study: Study, setting: str) -> float:
    """Number of a setting; nothing is known without it."""
    try:
        return float(study.provenance.settings.get(setting, math.inf))
    except ValueError:
        return math.inf
