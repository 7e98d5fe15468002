"""Names of what add-ons offer: the only place where the core knows of them.

A folder of `netdesign/addons` may be missing. What asks for it then ends with one
sentence; everything else works.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from netdesign.outcome import AddonError
from netdesign.words.message import say

# Places below netdesign.addons: MODULE:NAME.
COMMANDS = {
    "bench": "evidence.command:bench",
    "paper": "evidence.command:paper",
    "snowpack": "winter.command:snowpack",
    "terrain": "terrain.command:terrain",
    "validate": "evidence.command:validate",
    "verify": "evidence.command:verify",
    "winter": "winter.command:winter",
}


# Settings of a method of solve from what a scene file says.
METHODS = {
    "transient": "history.settings:build_transient",
    "staggered": "history.settings:build_staggered",
}
# Readers of sheets of the workbook, and those on which the record of a row hangs.
SHEETS = {
    "Monitoring": "winter.monitoring_sheet:read_monitoring",
    "Winter": "winter.winter_sheet:read_winter",
    "Uncertainty": "reliability.uncertainty_sheet:read_uncertain",
}
OF_ROWS = ("Uncertainty",)
# Function that makes a record of a row, by the field that has it.
ROW_RECORDS = {"reliability": "reliability.row_reliability:record_reliability"}
# Of a study whose rows have that field: its annex, and its lines on a terminal.
ANNEXES = {"reliability": "reliability.section:show_reliability"}
LINES = {"reliability": "reliability.section:list_reliability"}


def is_there(place: str) -> bool:
    """True where the installation has the add-on of a place."""
    package = f"{__package__}.addons"
    module = place.partition(":")[0]
    # of a folder that is gone, its parents are asked first
    parents = (package, f"{package}.{module.partition('.')[0]}", f"{package}.{module}")
    return all(find_spec(parent) is not None for parent in parents)


def load(what: str, place: str) -> Any:
    """Value of an add-on, imported when it is asked for.

    Parameters
    ----------
    what : str
        Name that was asked for, as the user knows it.
    place : str
        Of `COMMANDS` or another table here.

    Raises
    ------
    AddonError
        If the installation lacks the add-on.
    """
    module, _, name = place.partition(":")
    if not is_there(place):
        addon = module.partition(".")[0]
        raise AddonError(say("program.no_addon", what=what, addon=addon))
    return getattr(import_module(f"{__package__}.addons.{module}"), name)


def load_for_rows(
    table: Mapping[str, str], rows: Iterable[object]
) -> list[Callable[..., Any]]:
    """Functions of a table here for the records that some net rows have.

    Raises
    ------
    AddonError
        If the installation lacks the add-on of a record.
    """
    known = tuple(rows)
    return [
        load(name, place)
        for name, place in table.items()
        if any(getattr(row, name) for row in known)
    ]
