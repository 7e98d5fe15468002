"""The folder that ``netdesign solve --out`` writes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from netdesign.coupling.scene import Scene
from netdesign.edge.output import require_free, write_files
from netdesign.report.page.solution_page import (
    Solved,
    list_solution_files,
    render_solution,
)
from netdesign.snow.wall import Wall
from netdesign.solving.solve import Settings, method_of
from netdesign.words.catalogue import Language


def require_free_folder(
    folder: Path, scene: Scene, settings: Settings, *, overwrite: bool
) -> None:
    """Refuse before solving if any of the outputs exists.

    Raises
    ------
    OutputError
        Naming every path that is in the way.
    """
    is_wall = isinstance(scene.net, Wall)
    names = list_solution_files(method_of(settings), is_wall=is_wall)
    require_free([folder / name for name in names], overwrite=overwrite)


def write_solution_folder(
    folder: Path,
    solution: Solved,
    document: dict[str, Any],
    scene_file: str,
    *,
    overwrite: bool,
    language: Language = "en",
) -> list[Path]:
    """Write page, drawings, tables and document; their paths."""
    contents = render_solution(solution, document, scene_file, language)
    files = {folder / name: content for name, content in contents.items()}
    write_files(files, overwrite=overwrite)
    return list(files)
