"""Additions of add-ons to the reports of a study."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from netdesign import addon_table
from netdesign.report.blocks import Part
from netdesign.report.words import Words
from netdesign.study.records import Study


@dataclass(frozen=True, slots=True, kw_only=True)
class Addition:
    """Blocks and lines that an add-on has for a study with records of it.

    Attributes
    ----------
    annex : str
        Anchor of its annex.
    show : callable
        The annex, of page and document.
    list_lines : callable
        Lines for a terminal.
    """

    annex: str
    show: Callable[[Study, Words], Iterator[Part]]
    list_lines: Callable[[Study, Words], Iterator[str]]


def list_additions(study: Study) -> list[Addition]:
    """Additions of each add-on whose records the study has.

    Raises
    ------
    AddonError
        If the installation lacks it.
    """
    return [
        addon_table.load(name, place)
        for name, place in addon_table.SHOWN.items()
        if any(getattr(row, name) for row in study.rows)
    ]
