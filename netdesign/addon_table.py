"""Names of what add-ons offer: the only place where the core knows of them.

A folder of `netdesign/addons` may be missing. Whoever asks for something of it is told
so in one sentence; everything else goes on.
"""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from netdesign.outcome import AddonError
from netdesign.words.message import say

# Places below netdesign.addons: MODULE:NAME.
COMMANDS = {
    "terrain": "terrain.command:terrain",
}


def is_there(place: str) -> bool:
    """True where the installation has the add-on of a place."""
    package = f"{__package__}.addons"
    module = place.partition(":")[0]
    # of a folder that is gone, its parents are asked first
    parents = (package, f"{package}.{module.partition('.')[0]}", f"{package}.{module}")
    return all(find_spec(one) is not None for one in parents)


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
