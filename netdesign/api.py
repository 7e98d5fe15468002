"""Use from Python in a few lines: a site checked, its reports, the parts of a solve.

SI units in everything that is given and returned, as in the whole program; the frame of
a study has the units of its reports, each in the name of its column.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from pathlib import Path

from netdesign.checks import Standard, load_default, load_standard
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.edge.progress import RunProgress, show_stages
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.rows import RowEnvelope, build_search
from netdesign.envelope.search import search_rows
from netdesign.guideline.load_model import (
    SnowLoad,
    compute_snow_load,
    load_guideline,
    read_load_model,
)
from netdesign.outcome import ModelError
from netdesign.site.frames import Change, Frames
from netdesign.site.model import Site
from netdesign.site.reader import read_frames, read_site
from netdesign.solving.runner import Runner, open_runner
from netdesign.solving.store import find_store
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout, place_support
from netdesign.study.cases import list_phases
from netdesign.study.check_site import check_site
from netdesign.study.document import load_study
from netdesign.study.records import Study
from netdesign.study.row_to_check import CheckRun
from netdesign.words.catalogue import Language
from netdesign.words.message import say


def check(
    site: Site | str | Path | Frames,
    rows: Sequence[str] | None = None,
    change: Change | None = None,
    jobs: int | None = None,
    progress: Callable[[str], object] | None = None,
    *,
    standard: Standard | str | Path | None = None,
    accuracy: float = 0.01,
    reliability: bool = False,
) -> Study:
    """Study of a site against a limit profile, as ``netdesign check`` makes it.

    Finished cases are kept, and those of earlier runs used.

    Parameters
    ----------
    site : Site, str, Path, or mapping of str to DataFrame
        As read, its workbook, or frames by name of their sheet: ``Rows``,
        ``Net types``, ``Anchors``, ``Project``, ... Columns are keys of
        ``site/columns/office.toml``, in the unit that the template shows, or its
        headings.
    rows : sequence of str, optional
        Ids of the net rows that are checked; such a study is no pass of the site.
    change : mapping of str to mapping of str to object, optional
        Other values, by id of the net row and key of the column, in its unit:
        ``{"A1": {"post_spacing": 3.0}}``. The study is marked as a what-if.
    jobs : int, optional
        Processes; this one alone unless told otherwise.
    progress : callable, optional
        Takes a line of text at each stage of the run: ``print``.
    standard : Standard, str or Path, optional
        Limit profile, its id or its folder; that of the site unless told otherwise.
    accuracy : float
        Relative error allowed in every end force of the net [-].
    reliability : bool
        Work out a notional annual reliability of each governing check, too.

    Raises
    ------
    SiteDataError, StandardError
        If workbook, frames or profile cannot be read.
    ModelError
        If a net row is not there, or a site that is read already is to be changed.

    Verified by
    -----------
    tests/test_api.py
    """
    chosen = _take_rows(_read(site, change or {}), rows)
    profile = _choose_profile(standard, chosen)
    run = CheckRun(
        settings=SolverSettings(accuracy=accuracy),
        started=datetime.now(UTC).isoformat(timespec="seconds"),
        has_reliability=reliability,
    )
    phases = list_phases(chosen)
    tell = progress or (lambda _: None)
    watch = RunProgress(phases, show_stages(lambda standing: tell(str(standing.line))))
    with open_runner(
        executor="",
        processes=jobs or 1,
        store=find_store(),
        tell=_LOG.warning,
        expected=sum(phase.cases for phase in phases),
    ) as runner:
        runner.on_ask, runner.on_done = watch.ask, watch.count_case
        (study,) = check_site(chosen, [profile], run, runner, watch)
    for fault in runner.faults:
        _LOG.warning(str(fault))
    return study


_LOG = logging.getLogger("netdesign")


def _read(site: Site | str | Path | Frames, change: Change) -> Site:
    if isinstance(site, Site):
        if change:
            raise ModelError(say("api.change_of_site"))
        return site
    if isinstance(site, str | Path):
        return read_site(site, change=change)
    return read_frames(site, change)


def _take_rows(site: Site, ids: Sequence[str] | None) -> Site:
    own = tuple(row.id for row in site.rows)
    strange = tuple(row_id for row_id in ids or () if row_id not in own)
    if strange:
        raise ModelError(say("usage.no_row", rows=strange, given=own))
    return site if ids is None else site.take_rows(ids)


def _choose_profile(standard: Standard | str | Path | None, site: Site) -> Standard:
    """Profile that is given, else that of the site, else the default."""
    if isinstance(standard, Standard):
        return standard
    named = standard or site.project.standard
    return load_standard(named) if named else load_default()


def read_study(path: str | Path) -> Study:
    """Study from ``study.json``.

    Raises
    ------
    StudyError
        If the file cannot be read, or is no study.

    Verified by
    -----------
    tests/test_api.py
    """
    return load_study(Path(path))


def write_reports(
    study: Study,
    folder: str | Path,
    *,
    language: Language = "en",
    kinds: Sequence[str] = ("html", "xlsx"),
    overwrite: bool = False,
) -> list[Path]:
    """Write ``study.json`` and the reports of a study into a folder.

    Parameters
    ----------
    study : Study
        From `check` or `read_study`.
    folder : str or Path
        Made where it is not there.
    language : str
        ``en``, ``fr`` or ``de``.
    kinds : sequence of str
        Of ``html``, ``xlsx``, ``docx``, ``pdf`` and ``csv``.
    overwrite : bool
        Whether files of others may be replaced; its own are.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    OutputError
        If a file is in the way.

    Verified by
    -----------
    tests/test_api.py
    """
    from netdesign.edge.output import STUDY_FILE, require_free, write_files
    from netdesign.report.files import NAMES, ReportStyle, render_files

    unknown = tuple(kind for kind in kinds if kind not in NAMES)
    if unknown:
        raise ModelError(say("api.no_kind", given=unknown, known=tuple(NAMES)))
    files = [STUDY_FILE, *(NAMES[kind] for kind in kinds)]
    paths = [Path(folder) / name for name in files]
    require_free(paths, overwrite=overwrite, may_force=False)
    plan = dict.fromkeys(paths, study)
    contents = render_files(plan, ReportStyle(language=language))
    write_files(contents, overwrite=overwrite, is_recorded=True)
    return paths


def find_envelope(
    scene: Scene,
    ranges: Ranges,
    layout: SupportLayout | None = None,
    *,
    accuracy: float = 0.01,
) -> RowEnvelope:
    """Largest forces of a scene over ranges of its parameters, with their bounds.

    Parameters
    ----------
    scene : Scene
        Has all values that the ranges leave alone.
    ranges : Ranges
        Of the parameters that vary.
    layout : SupportLayout, optional
        Of a support; without it the net's own tensions are followed, per metre.
    accuracy : float
        Of every solve, and of the search's bound [-].

    Returns
    -------
    RowEnvelope
        ``extremes`` by member; ``gap`` says what is not known.

    Verified by
    -----------
    tests/test_api.py
    """
    layouts = () if layout is None else (layout,)
    task = build_search(scene, ranges, accuracy, layouts)
    (envelope,) = search_rows([task], Runner())
    return envelope


def find_anchor_forces(
    solution: Solution, layout: SupportLayout
) -> AnchorForces | FailedSupport:
    """Forces on anchors, guys and post of one support, from a solved net.

    Theory: structure/THEORY.md, eqs. (S5) and (S6).

    Parameters
    ----------
    solution : Solution
        Its pulls per metre go to a support that carries ``layout.post_spacing``.
    layout : SupportLayout
        Of the support.

    Returns
    -------
    AnchorForces or FailedSupport
        ``member_forces`` in N, or why the support cannot stand.

    Verified by
    -----------
    tests/test_api.py
    """
    return compute_anchor_forces(
        place_support(layout, solution.head_point),
        foot_pull_per_m=(solution.foot.x, solution.foot.y),
        head_pull_per_m=(solution.head.x, solution.head.y),
        post_spacing=layout.post_spacing,
    )


def find_guideline_load(scene: Scene, glide_factor: float) -> SnowLoad[float]:
    """Load of the Swiss guideline on the net of a scene, per metre of row.

    Theory: guideline/THEORY.md, eqs. (G1) to (G6).

    Parameters
    ----------
    scene : Scene
        Uniform snow; its net's height and inclination count, not its stiffness.
    glide_factor : float
        N [-].

    Returns
    -------
    SnowLoad
        [N/m].

    Raises
    ------
    ModelError
        If a number is out of its range, or the snow has layers.

    Verified by
    -----------
    tests/test_api.py
    """
    snow, net = scene.snowpack, scene.net
    if snow.layers:
        raise ModelError(say("api.no_guideline_load"))
    return compute_snow_load(
        read_load_model(load_guideline()),
        density=snow.density,
        height_vertical=snow.thickness / math.cos(snow.slope_angle),
        slope_angle=snow.slope_angle,
        glide_factor=glide_factor,
        net_height=net.height_normal,
        inclination=net.inclination,
    )
