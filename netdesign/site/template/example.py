"""Lines of the example of the input workbook."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence

from netdesign.edge.given_files import find_resource

WITH_EXAMPLE = ("tests", "parts", "declared")  # sheets that it needs
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
                dict(zip(one["columns"], line, strict=False)) for line in one["lines"]
            ]
            for name, one in tables.items()
        },
    }
