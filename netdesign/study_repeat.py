"""A stored study, solved again: how it was made, and whether the same comes out."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from enum import Enum
from typing import Any

from netdesign.check_site import METHODS, name_law
from netdesign.coupling.scene import SolverSettings
from netdesign.errors import StudyError
from netdesign.site_cases import CheckRun
from netdesign.study import Study

SAME = 1e-6  # relative; other machines differ in the last digits only
_MADE_BY = ("version", "libraries")  # may differ; a reader of a difference wants them


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """One value of a study that does not come out again; None where one has none."""

    place: str  # "rows.R1.checks.foot_anchor.tendon.demand_kN"
    stored: Any
    again: Any

    def __str__(self) -> str:
        """``rows.R1.verdict: stored 'pass', again 'fail'``."""
        return f"{self.place}: stored {self.stored!r}, again {self.again!r}"


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
    methods = {text: name for name, text in METHODS.items()}
    try:
        run = CheckRun(
            settings=SolverSettings(accuracy=float(given["accuracy"])),
            method=methods[given["method"]],
            jobs=jobs,
            command=made.command,
            started=made.started,
        )
    except (KeyError, ValueError) as error:
        raise StudyError(f"provenance.settings: cannot be had again: {error}") from None
    if given.get("creep law") != name_law(run.creep_law):
        raise StudyError(
            f"provenance.settings: creep law {given.get('creep law')!r:.120}: this "
            f"version solves with {name_law(run.creep_law)!r}"
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
    old, new = (dict(_flatten(_strip(study))) for study in (stored, again))
    places = list(dict.fromkeys((*old, *new)))
    return len(places), [
        Difference(place=place, stored=old.get(place), again=new.get(place))
        for place in places
        if place not in old or place not in new or not _is_same(old[place], new[place])
    ]


def list_versions(study: Study) -> dict[str, str]:
    """Program and libraries that made a study."""
    made = study.provenance
    return {"netdesign": made.version, **made.libraries}


def _strip(study: Study) -> dict[str, Any]:
    document = asdict(study)
    for name in _MADE_BY:
        del document["provenance"][name]
    return document


def _flatten(value: Any, place: str = "") -> Iterator[tuple[str, Any]]:
    """Every value by its place; members of a list by their id, or else their number."""
    if not isinstance(value, dict | list | tuple):
        yield place, str(value) if isinstance(value, Enum) else value
        return
    if not value:
        yield place, value
    pairs = value.items() if isinstance(value, dict) else _name_members(value)
    for name, one in pairs:
        yield from _flatten(one, f"{place}.{name}" if place else str(name))


def _name_members(members: Sequence[Any]) -> Iterator[tuple[str, Any]]:
    """Members of a list by their ids; by number if they have none or one twice."""
    ids = [str(one.get("id", "")) if isinstance(one, dict) else "" for one in members]
    is_named = all(ids) and len(set(ids)) == len(ids)
    return zip(ids if is_named else map(str, range(len(ids))), members, strict=True)


def _is_same(old: Any, new: Any) -> bool:
    if isinstance(old, float) and isinstance(new, float):
        return math.isclose(old, new, rel_tol=SAME, abs_tol=SAME)
    return type(old) is type(new) and bool(old == new)
