"""Writes outputs whole or not at all, and never over an existing file unasked."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from pathlib import Path

from netdesign.errors import OutputError


def require_free(paths: list[Path], *, overwrite: bool) -> None:
    """Refuse before any work if an output exists or its folder is unfit.

    Raises
    ------
    OutputError
        Naming every path that is in the way.
    """
    taken = [str(path) for path in paths if path.exists()]
    if taken and not overwrite:
        raise OutputError(
            f"exists already: {', '.join(taken)}; use --force to overwrite, or --out "
            "for another folder"
        )
    for folder in {path.parent for path in paths}:
        nearest = next(p for p in (folder, *folder.absolute().parents) if p.exists())
        if not nearest.is_dir():
            raise OutputError(f"{nearest} is not a folder: choose another with --out")
        if not os.access(nearest, os.W_OK):
            raise OutputError(f"{nearest} cannot be written to: choose another folder")


def write_files(contents: Mapping[Path, bytes]) -> None:
    """Write all files under temporary names, then put them all in place."""
    waiting: list[tuple[Path, Path]] = []
    try:
        for path, content in contents.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
            waiting.append((Path(name), path))
            _fill(handle, content)
        for temporary, path in waiting:
            temporary.chmod(_usual_mode())
            temporary.replace(path)
    except OSError as error:
        raise OutputError(f"cannot write: {error}") from error
    finally:
        for temporary, _ in waiting:
            temporary.unlink(missing_ok=True)


def _usual_mode() -> int:
    """Mode of a new file under the user's umask, which can only be read by setting."""
    umask = os.umask(0o077)
    os.umask(umask)
    return 0o666 & ~umask


def _fill(handle: int, content: bytes) -> None:
    with os.fdopen(handle, "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
