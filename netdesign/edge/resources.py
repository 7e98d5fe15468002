"""Finds ``standards/`` and ``templates/`` in a wheel or beside a checkout."""

from __future__ import annotations

from pathlib import Path

from netdesign.errors import NetDesignError
from netdesign.words.message import say

_PACKAGE = Path(__file__).resolve().parent.parent


def find_resource(name: str, package: Path = _PACKAGE) -> Path:
    """Folder ``name`` of the installed package or of the checkout around it.

    A wheel carries the two folders as ``netdesign/_data/<name>``; a checkout
    and an editable install have them beside the package.
    """
    for candidate in (package / "_data" / name, package.parent / name):
        if candidate.is_dir():
            return candidate
    raise NetDesignError(say("program.folder_missing", name=name))
