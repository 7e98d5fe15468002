"""Use from Python in a few lines: a site checked, its reports, the parts of a solve.

SI units in everything that is given and returned, as in the whole program; the frame of
a study has the units of its reports, each in the name of its column.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from netdesign.cable.net import Net
from netdesign.checks import Standard, load_standard
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.rows import RowEnvelope, RowTask
from netdesign.envelope.search import search_rows
from netdesign.guideline.load_model import (
    SnowLoad,
    compute_snow_load,
    load_guideline,
    read_load_model,
)
from netdesign.outcome import ModelError
from netdesign.search.maxima import SearchSettings
from netdesign.site.model import Site
from netdesign.site.reader import read_site
from netdesign.solving.runner import Runner
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout, place_support
from netdesign.study.check_run import CheckRun
from netdesign.study.check_site import check_site
from netdesign.study.document import load_study
from netdesign.study.records import Study
from netdesign.words.catalogue import Language
from netdesign.words.message import say


def check(
    site: Site | str | Path,
    standard: Standard | str | Path = "nf-p-95-304-style",
    *,
    accuracy: float = 0.01,
    reliability: bool = False,
) -> Study:
    """Study of a site against a limit profile, as ``netdesign check`` makes it.

    Parameters
    ----------
    site : Site, str or Path
        As read, or its workbook.
    standard : Standard, str or Path
        Limit profile, its id or its folder.
    accuracy : float
        Relative error allowed in every end force of the net [-].
    reliability : bool
        Work out a notional annual reliability of each governing check, too.

    Raises
    ------
    SiteDataError, StandardError
        If workbook or profile cannot be read.

    Verified by
    -----------
    tests/test_api.py
    """
    given = site if isinstance(site, Site) else read_site(site)
    profile = standard if isinstance(standard, Standard) else load_standard(standard)
    run = CheckRun(
        settings=SolverSettings(accuracy=accuracy),
        started=datetime.now(UTC).isoformat(timespec="seconds"),
        has_reliability=reliability,
    )
    (study,) = check_site(given, [profile], run)
    return study


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
    from netdesign.report.files import ReportStyle, render_files

    names = {"csv": "cases.csv"}
    unknown = tuple(one for one in kinds if one not in _KINDS)
    if unknown:
        raise ModelError(say("api.no_kind", given=unknown, known=_KINDS))
    files = [STUDY_FILE, *(names.get(kind, f"report.{kind}") for kind in kinds)]
    paths = [Path(folder) / name for name in files]
    require_free(paths, overwrite=overwrite, may_force=False)
    style = ReportStyle(language=language)
    contents = render_files([study], [paths], style)
    write_files(contents, overwrite=overwrite, is_recorded=True)
    return paths


_KINDS = ("html", "xlsx", "docx", "pdf", "csv")


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
    task = RowTask(
        scene=scene,
        ranges=ranges,
        layout=layout,
        settings=SolverSettings(accuracy=accuracy),
        search=SearchSettings(gap=accuracy),
        confirmed_by=None,
    )
    (found,) = search_rows([task], Runner())
    return found


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
    if snow.layers or not isinstance(net, Net):
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
