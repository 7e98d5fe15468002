"""Files of ``check``: their places, refused where something is there, and contents."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from netdesign.commands.report_options import choose_style, list_wanted
from netdesign.commands.sizing import Sized, mark_names, mark_paths, render_sized
from netdesign.edge.output import PROFILES_FILE, STUDY_FILE

if TYPE_CHECKING:
    from netdesign.report.files import ReportStyle
    from netdesign.report.view.whole import ReportView
    from netdesign.solving.runner import Runner
    from netdesign.study.records import Study

# Made by other processes, which first read the study: so this one makes the workbook,
# which takes longest.
_APART = (".html", ".docx")


@dataclass(frozen=True, slots=True, kw_only=True)
class Outputs:
    """Places of all files, and the style of the reports.

    Attributes
    ----------
    folder : Path or None
        Of all files; None where none are written.
    of_studies : list of list of Path
        Of each profile.
    sized : list of list of Path
        Of the what-if studies of ``--size``, as far as there will be any.
    together : list of Path
        Of the page that compares several profiles.
    style : ReportStyle
        Of the reports.
    """

    folder: Path | None
    of_studies: list[list[Path]]
    sized: list[list[Path]]
    together: list[Path]
    style: ReportStyle


def plan_outputs(
    folder: Path | None,
    profiles: Sequence[str],
    reports: Mapping[str, bool],
    looks: dict[str, Any],
    *,
    size: bool,
    is_what_if: object,
    overwrite: bool,
) -> Outputs:
    """Places of the outputs of each profile, by their ids.

    ``reports`` are the kinds asked for, ``looks`` language, detail and template.

    Raises
    ------
    OutputError
        Where something is there.
    """
    from netdesign.edge.output import require_free
    from netdesign.report.files import name_files

    kinds = list_wanted({**reports, "template": looks["template"]})
    names = name_files(
        folder, profiles, mark_names([STUDY_FILE, *kinds], is_what_if=is_what_if)
    )
    is_compared = folder is not None and "report.html" in kinds and len(profiles) > 1
    page = mark_names([PROFILES_FILE], is_what_if=is_what_if)
    outputs = Outputs(
        folder=folder,
        of_studies=names,
        sized=mark_paths(names) if size else [],
        together=[folder / name for name in page] if folder and is_compared else [],
        style=choose_style(looks),
    )
    groups = (*outputs.of_studies, *outputs.sized, outputs.together)
    require_free([path for group in groups for path in group], overwrite=overwrite)
    return outputs


def begin_outputs(
    outputs: Outputs, studies: Sequence[Study], runner: Runner
) -> dict[Path, Callable[[], bytes]]:
    """Reports that processes of the run make while this one makes the others.

    What is returned for each waits for it.
    """
    from netdesign.report.files import render_kind

    pool = runner.workers.pool
    if pool is None:
        return {}
    return {
        path: pool.begin(render_kind, path.suffix, study, outputs.style)
        for study, paths in zip(studies, outputs.of_studies, strict=True)
        for path in paths
        if path.suffix in _list_apart(paths)
    }


def _list_apart(paths: Sequence[Path]) -> list[str]:
    """Suffixes of a study's files that other processes make.

    Not of its only file, nor of a page that is printed, too.
    """
    kinds = {path.suffix for path in paths}
    apart = [one for one in _APART if not (one == ".html" and ".pdf" in kinds)]
    return apart if len(paths) > 1 else []


def render_outputs(
    outputs: Outputs,
    studies: Sequence[Study],
    sized: Sequence[Sized],
    views: Sequence[ReportView],
    begun: Mapping[Path, Callable[[], bytes]],
) -> dict[Path, bytes]:
    """Contents of all files; ``begun`` are those of `begin_outputs`."""
    from netdesign.report.files import render_files
    from netdesign.report.page.comparison_page import render_comparison

    style = outputs.style
    files = render_files(studies, outputs.of_studies, style, views, begun)
    files |= render_sized(sized, outputs.sized, style)
    for place in outputs.together:
        files[place] = render_comparison(studies, style.language)
    return files
