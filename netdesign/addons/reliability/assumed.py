"""Distributions that are assumed where nobody gives any: ``assumed.toml``."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files

from netdesign.addons.reliability.limit_state import DistributionKind
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class Assumed:
    """One assumed distribution.

    Attributes
    ----------
    distribution : str
        Its kind.
    variation : float
        Coefficient of variation [-].
    source : str
        Key of the text that says where it is from.
    period : float or None
        Return period of the value of the workbook [a].
    mean_ratio : float or None
        Mean over the characteristic value [-].
    """

    distribution: DistributionKind
    variation: float
    source: str
    period: float | None = None
    mean_ratio: float | None = None

    @property
    def told(self) -> Message:
        """Its source in words."""
        return say(f"source.{self.source}")


@lru_cache(maxsize=1)
def load_assumed() -> Mapping[str, Assumed]:
    """Assumed distributions by the names of their variables."""
    text = files(__package__).joinpath("assumed.toml").read_text(encoding="utf-8")
    return {name: Assumed(**entry) for name, entry in tomllib.loads(text).items()}
