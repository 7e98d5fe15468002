"""Reported quantities, of `quantities.toml`: the only place for unit and decimals.

A force has three significant digits, a utilisation two decimals (three where two would
read 1.00), a direction whole degrees. All digits are in the JSON and in the workbook.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from types import MappingProxyType

from netdesign.words.catalogue import FORCE_ENDS, count_force_decimals
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class Form:
    """Name and form of one quantity in every output.

    Attributes
    ----------
    key : str
        Name of the field in the JSON documents, unit included.
    symbol : str
        As in the theory pages.
    unit : str
        As printed; "" for a pure number.
    decimals : int or None
        Digits after the point. None: as typed or chosen, without more
        (a density of 366.8 kg/m3 is not rounded away).
    most : int
        Digits after the point at most where ``decimals`` is None: a search reaches
        values with all digits of a float.
    is_force : bool
        Written with three significant digits.
    near_one : bool
        Written with one decimal more where it would read 1 without.
    scientific : bool
        Written with an exponent.
    """

    key: str
    symbol: str = ""
    unit: str = ""
    decimals: int | None = None
    most: int = 4
    is_force: bool = False
    near_one: bool = False
    scientific: bool = False

    def count_decimals(self, value: float) -> int | None:
        """Number of decimals of a finite value; None: as given.

        Examples
        --------
        >>> [QUANTITIES["demand_kN"].count_decimals(x) for x in (9.994, 9.996, 441.4)]
        [2, 1, 0]
        >>> [QUANTITIES["utilisation"].count_decimals(x) for x in (0.994, 0.996, 1.01)]
        [2, 3, 2]
        """
        if self.decimals is None:
            return None
        if self.is_force:
            return count_force_decimals(value)
        return self.decimals + (self.near_one and abs(value - 1.0) < _NEAR_ONE)

    @property
    def number_format(self) -> str:
        """Number format of a workbook's cells, which shows the same digits."""
        if self.decimals is None:
            return "General"
        fewest, one_more, two_more = (
            f"0.{'0' * (self.decimals + more)}".rstrip(".") for more in range(3)
        )
        if self.near_one:
            below, above = 1.0 - _NEAR_ONE, 1.0 + _NEAR_ONE
            return f"[<={below:g}]{fewest};[<{above:g}]{one_more};{fewest}"
        if self.is_force:
            tens, ones = FORCE_ENDS
            return f"[>={tens:g}]{fewest};[>={ones:g}]{one_more};{two_more}"
        return f"{fewest}E+00" if self.scientific else fewest

    @property
    def label(self) -> Message:
        """A few words for a table heading."""
        return say(f"label.{self.key}")


_NEAR_ONE = 0.005


def _load() -> dict[str, Form]:
    file = files("netdesign") / "quantities.toml"
    tables = tomllib.loads(file.read_text(encoding="utf-8"))
    return {key: Form(key=key, **table) for key, table in tables.items()}


QUANTITIES: Mapping[str, Form] = MappingProxyType(_load())
