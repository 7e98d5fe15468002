"""The folder that ``netdesign solve --out`` writes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from netdesign.edge.output import require_free, write_files
from netdesign.files.scene import GivenScene
from netdesign.files.solved_support import SolvedSupport
from netdesign.report.page.solution_page import (
    Solved,
    list_solution_files,
    render_solution,
)
from netdesign.snow.wall import Wall
from netdesign.solving.solve import method_of
from netdesign.study.record_panel import record_solved_panel
from netdesign.words.catalogue import Language


def require_free_folder(folder: Path, given: GivenScene, *, overwrite: bool) -> None:
    """Refuse before solving if any of the outputs exists.

    Raises
    ------
    OutputError
        Naming every path that is in the way.
    """
    names = list_solution_files(
        method_of(given.settings),
        is_wall=isinstance(given.scene.net, Wall),
        has_panel=given.support is not None and given.support.panel is not None,
    )
    require_free([folder / name for name in names], overwrite=overwrite)


def write_solution_folder(
    folder: Path,
    solution: Solved,
    document: dict[str, Any],
    scene_file: str,
    support: SolvedSupport | None = None,
    *,
    overwrite: bool,
    language: Language = "en",
) -> list[Path]:
    """Write page, drawings, tables and document; their paths."""
    panel = None if support is None else record_solved_panel(support.result)
    contents = render_solution(solution, document, scene_file, language, panel)
    files = {folder / name: content for name, content in contents.items()}
    write_files(files, overwrite=overwrite)
    return list(files)
