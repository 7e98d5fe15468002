"""Profile and origin of a study, as records."""

from __future__ import annotations

import importlib.metadata
import platform
from dataclasses import fields, replace
from functools import cache
from typing import Any, cast, get_args

from netdesign import __version__
from netdesign.checks import Standard, StandardValue, load_standard
from netdesign.checks.comparison import find_proof_factor
from netdesign.checks.schema import GLIDE_FACTORS
from netdesign.core.library import name_core
from netdesign.coupling.scene import SolverSettings
from netdesign.edge.json_text import list_fields
from netdesign.guideline.load_model import load_guideline
from netdesign.outcome import StudyError
from netdesign.site.cells.cells import TextFormat
from netdesign.site.cells.numbers import DecimalMark
from netdesign.site.model import Site
from netdesign.snow.creep_law import CreepLaw
from netdesign.study.document import Difference, compare_listed, list_values
from netdesign.study.guideline_load import load_glide_limits
from netdesign.study.records import ProfileRecord, Provenance, Study
from netdesign.study.row_to_check import CheckRun
from netdesign.words.message import say

_LIBRARIES = ("numpy", "scipy", "scikit-fem")


def record_profile(standard: Standard) -> ProfileRecord:
    """Every value of a limit profile, as a study states it."""
    shared = (field.name for field in fields(ProfileRecord))
    alike: dict[str, Any] = {
        name: getattr(standard, name) for name in shared if hasattr(standard, name)
    }
    own = {
        "not_checked": list(standard.not_checked),
        "proof_factor": find_proof_factor(standard),
        "values": [*standard.listed, *_list_floor_values(standard)],
    }
    return ProfileRecord(**alike | own)


def load_own_profile(record: ProfileRecord, named: str | None = None) -> Standard:
    """Profile of a study, by its id or another name, with the floor chosen for it.

    Raises
    ------
    StandardError
        If there is no such profile.
    """
    profile = replace(load_standard(named or record.id), is_default=record.is_default)
    if not record.is_floor_overruled:
        return profile
    return profile.overrule_floor("guideline" if profile.floor == "none" else "none")


def _list_floor_values(standard: Standard) -> list[StandardValue]:
    """Numbers of the floor's load model, unless they are those of the profile itself.

    Every demand rests on them, under whatever profile.
    """
    if standard.floor == "none":
        return []
    guideline, limits = load_guideline(), load_glide_limits()
    tables = [table for table in guideline.tables if table.id in GLIDE_FACTORS]
    used = [
        *(value for value in guideline.values if value.id.startswith("snow.")),
        *(value for table in tables for value in table.values if value.value in limits),
    ]
    if all(value in standard.listed for value in used):
        return []
    return [replace(value, id=f"floor.{value.id}") for value in used]


def record_provenance(site: Site, run: CheckRun) -> Provenance:
    """Versions, files and settings of a run."""
    settings, file = run.settings, site.map_file  # of what headings mean
    text = list_fields(site.text_format)
    return Provenance(
        version=__version__,
        started=run.started,
        site_file=site.file_name,
        site_sha256=site.sha256,
        settings={
            "method": "steady",
            "creep_law": name_law(run.creep_law),
            "accuracy": repr(settings.accuracy),  # in full: the study is solved again
            "stress_tolerance": f"{settings.stress_tolerance:g}",
            "shape_tolerance": f"{settings.shape_tolerance:g}",
            "balance_tolerance": f"{settings.balance_tolerance:g}",
            **({"map": f"{file}, sha256 {site.map_sha256}"} if file else {}),
            **({"net_types": _name_library(site)} if site.library_file else {}),
            **{key: declared for key, declared in text.items() if declared},
        },
        libraries={
            "python": platform.python_version(),
            **{name: _find_version(name) for name in _LIBRARIES},
            "netdesign.core": name_core(),
        },
    )


_find_version = cache(importlib.metadata.version)

_SHA256 = ", sha256 "


def _name_library(site: Site) -> str:
    return f"{site.library_file}{_SHA256}{site.library_sha256}"


def read_library_name(made: Provenance) -> str:
    """File of further net types that a study was made with; empty without one."""
    return made.settings.get("net_types", "").partition(_SHA256)[0]


def name_law(law: CreepLaw) -> str:
    """Name and source of a creep law, as a study states it."""
    return f"{law.name} ({law.source})"


def read_text_format(made: Provenance) -> TextFormat:
    """Form of the site file's text that was declared when the study was made."""
    sign, mark_text = (
        made.settings.get(key, "") for key in ("delimiter", "decimal_mark")
    )
    mark = cast(DecimalMark, mark_text if mark_text in get_args(DecimalMark) else "")
    is_sign = len(sign) == 1 and not sign.isalnum() and sign not in '"\r\n'
    return TextFormat(delimiter=sign if is_sign else "", decimal_mark=mark)


def build_run(study: Study) -> CheckRun:
    """Settings with which a stored study was made; its time is taken over.

    Raises
    ------
    StudyError
        If the settings cannot be had again: another creep law, other tolerances.
    """
    settings, made = study.provenance.settings, study.provenance
    try:
        run = CheckRun(
            settings=SolverSettings(accuracy=float(settings["accuracy"])),
            started=made.started,
            has_reliability=any(row.reliability for row in study.rows),
        )
    except (KeyError, ValueError):
        accuracy = f"accuracy = {settings.get('accuracy')!r:.60}"
        raise StudyError(say("study.settings", given=(accuracy,))) from None
    if settings.get("creep_law") != name_law(run.creep_law):
        raise StudyError(
            say(
                "study.other_law",
                given=f"{settings.get('creep_law')!r:.120}",
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


def _leave_out_versions(study: Study) -> Study:
    """Study without what made it and the digest over it, which are told beside."""
    made = replace(study.provenance, version="", libraries={})
    return replace(study, provenance=made, digest="")
