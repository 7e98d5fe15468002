"""Profile and origin of a study, as records."""

from __future__ import annotations

import importlib.metadata
import platform
from dataclasses import replace

from netdesign import __version__
from netdesign.checks import Standard, StandardValue, load_standard
from netdesign.checks.schema import GLIDE_FACTORS
from netdesign.core.library import name_core
from netdesign.site.model import Site
from netdesign.snow.creep_law import CreepLaw
from netdesign.study.check_run import CheckRun
from netdesign.study.effects import load_glide_limits, load_guideline
from netdesign.study.records import ProfileRecord, ProfileValue, Provenance

_LIBRARIES = ("numpy", "scipy", "scikit-fem")


def record_profile(standard: Standard) -> ProfileRecord:
    """Every value of a limit profile, as a study states it."""
    return ProfileRecord(
        id=standard.id,
        title=standard.title,
        edition=standard.edition,
        sha256=standard.sha256,
        version=standard.version,
        choice=standard.choice,
        floor=standard.floor,
        is_floor_overruled=standard.is_floor_overruled,
        is_default=standard.is_default,
        values=[
            *map(_record_value, standard.listed),
            *map(_record_value, _list_floor_values(standard)),
        ],
    )


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
    tables = [one for one in guideline.tables if one.id in GLIDE_FACTORS]
    used = [
        *(one for one in guideline.values if one.id.startswith("snow.")),
        *(one for table in tables for one in table.values if one.value in limits),
    ]
    if all(one in standard.listed for one in used):
        return []
    return [replace(one, id=f"floor.{one.id}") for one in used]


def _record_value(value: StandardValue) -> ProfileValue:
    return ProfileValue(
        id=value.id,
        clause=value.clause,
        text=value.text,
        value=value.value,
        unit=value.unit,
        status=value.status,
        source=value.source,
        reason_below_one=value.reason_below_one,
    )


def record_provenance(site: Site, run: CheckRun) -> Provenance:
    """Versions, files and settings of a run."""
    settings = run.settings
    return Provenance(
        version=__version__,
        command=run.command,
        started=run.started,
        site_file=site.file_name,
        site_sha256=site.sha256,
        settings={
            "method": run.method,
            "creep_law": name_law(run.creep_law),
            "accuracy": repr(settings.accuracy),  # in full: the study is solved again
            "stress_tolerance": f"{settings.stress_tolerance:g}",
            "shape_tolerance": f"{settings.shape_tolerance:g}",
            "balance_tolerance": f"{settings.balance_tolerance:g}",
            **_list_map(site),
        },
        libraries={
            "python": platform.python_version(),
            **{name: importlib.metadata.version(name) for name in _LIBRARIES},
            "netdesign.core": name_core(),
        },
    )


def _list_map(site: Site) -> dict[str, str]:
    """File that says what headings of the workbook mean, and its digest."""
    if not site.map_file:
        return {}
    return {"map": f"{site.map_file}, sha256 {site.map_sha256}"}


def name_law(law: CreepLaw) -> str:
    """Name and source of a creep law, as a study states it."""
    return f"{law.name} ({law.source})"
