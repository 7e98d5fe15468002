"""A site of seven rows with numbers worked out by hand, in a workbook of sheet Nets."""

import tomllib
from pathlib import Path

from netdesign.site.template.workbook import render_workbook

_FILE = Path(__file__).with_name("old_example.toml")


def load_example():
    """Lines by sheet, as new each time."""
    return tomllib.loads(_FILE.read_text(encoding="utf-8"))


def write_old_example(path, language="en", lines=None):
    """Workbook of these lines, or of the seven rows."""
    path.write_bytes(render_workbook(lines or load_example(), language))
