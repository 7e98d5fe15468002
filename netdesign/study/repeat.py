"""A stored study, solved again: how it was made, and whether the same comes out."""

from __future__ import annotations

import re
from dataclasses import replace

from netdesign.coupling.scene import SolverSettings
from netdesign.outcome import StudyError
from netdesign.study.check_run import CheckRun, read_method
from netdesign.study.record_provenance import name_law
from netdesign.study.records import Study
from netdesign.study.values import Difference, compare_listed, list_values
from netdesign.words.message import say

_REPEATED = ("accuracy", "method")
_LOG = re.compile(r"rows\..*\.envelope\.log\.\d+\.\w+(\.\w+)?")


def build_run(study: Study, jobs: int) -> CheckRun:
    """Settings with which a study was made; time and command are taken over.

    Parameters
    ----------
    study : Study
        As stored.
    jobs : int
        Processes; they change nothing.

    Raises
    ------
    StudyError
        If the settings cannot be had again: another creep law, other tolerances.
    """
    given, made = study.provenance.settings, study.provenance
    try:
        run = CheckRun(
            settings=SolverSettings(accuracy=float(given["accuracy"])),
            method=read_method(given["method"]),
            jobs=jobs,
            command=made.command,
            started=made.started,
        )
    except (KeyError, ValueError):
        told = tuple(f"{name} = {given.get(name)!r:.60}" for name in _REPEATED)
        raise StudyError(say("study.settings", given=told)) from None
    if given.get("creep_law") != name_law(run.creep_law):
        raise StudyError(
            say(
                "study.other_law",
                given=f"{given.get('creep_law')!r:.120}",
                own=repr(name_law(run.creep_law)),
            )
        )
    return run


def list_differences(stored: Study, again: Study) -> tuple[int, list[Difference]]:
    """Compare everything but the versions that made the two studies.

    Parameters
    ----------
    stored, again : Study
        The study, and what comes out of its inputs now.

    Returns
    -------
    tuple
        Number of values compared, and those that differ: numbers by more than a
        millionth, all else at all.
    """
    old, new = (list_values(_leave_out_versions(study)) for study in (stored, again))
    return len(old | new), compare_listed(old, new)


def is_of_ties(difference: Difference) -> bool:
    """It says only why a search solved a case, where several reasons tie.

    Rounding decides between them, and so do the kernels of a processor. The cases and
    all that is found from them are compared on their own.
    """
    return _LOG.fullmatch(difference.place) is not None


def list_versions(study: Study) -> dict[str, str]:
    """Program and libraries that made a study."""
    made = study.provenance
    return {"netdesign": made.version, **made.libraries}


def _leave_out_versions(study: Study) -> Study:
    """Study without what made it and the digest over it, which are told beside."""
    made = replace(study.provenance, version="", libraries={})
    return replace(study, provenance=made, digest="")
