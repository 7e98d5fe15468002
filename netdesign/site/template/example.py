"""Reads the lines of the example site, and writes the workbook of these."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path

from netdesign.edge.input_files import find_resource
from netdesign.edge.output import write_files
from netdesign.site.template.office_workbook import render_input
from netdesign.words.catalogue import Language

INPUT_EXAMPLE_FILE = "example_input.toml"


def load_input_example() -> dict[str, Sequence[Mapping[str, object]]]:
    """Lines of the example site, by table and key of `site/columns/office.toml`."""
    file = find_resource("templates") / INPUT_EXAMPLE_FILE
    tables = tomllib.loads(file.read_text(encoding="utf-8"))
    project = tables.pop("project")
    return {
        "project": [project],
        **{
            name: [
                dict(zip(table["columns"], line, strict=False))
                for line in table["lines"]
            ]
            for name, table in tables.items()
        },
    }


def write_site_workbook(
    path: str | Path,
    *,
    example: bool = False,
    overwrite: bool = False,
    language: Language = "en",
    more: Sequence[str] = (),
) -> None:
    """Write an input workbook to fill in, or the built-in example site.

    Parameters
    ----------
    path : str or Path
        The xlsx file to write.
    example : bool
        Fill in the example site.
    overwrite : bool
        Replace a file that exists.
    language : str
        Of sheets, headings, words and notes: ``en``, ``fr`` or ``de``. The importer
        reads all three.
    more : sequence of str
        Further sheets: ``snow``, ``tests``, ``parts``, ``declared``, or of an add-on.

    Raises
    ------
    OutputError
        If the file exists and may not be replaced, or cannot be written.
    """
    tables = load_input_example() if example else {}
    content = render_input(tables, language, more)
    write_files({Path(path): content}, overwrite=overwrite)
