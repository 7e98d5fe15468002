"""A site as a folder of csv files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path


def write_csv_folder(
    path: Path, sheets: Mapping[str, Sequence[Sequence[object] | str]]
) -> Path:
    """Write each sheet to a file of its name; a line may be text as typed."""
    path.mkdir(exist_ok=True)
    for name, rows in sheets.items():
        lines = [
            row
            if isinstance(row, str)
            else ";".join("" if cell is None else str(cell) for cell in row)
            for row in rows
        ]
        (path / f"{name}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path
