"""Cases of the verification: what each is compared with stands in ``cases.toml``."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.resources import files
from typing import Literal, NamedTuple, get_args

import numpy as np

Kind = Literal[
    "closed form", "manufactured", "invariant", "limit", "cross model", "published"
]
# Origin of an expected value: computed here, by another code, read, recalled.
Mark = Literal["here", "code", "read", "recalled"]
MARKS: tuple[Mark, ...] = get_args(Mark)


@dataclass(frozen=True, slots=True, kw_only=True)
class VerificationCase:
    """Result of one comparison.

    Attributes
    ----------
    id : str
        Short name.
    kind : str
        What the truth is.
    reference : str
        Where the expected value comes from: a text ``reference`` of this key.
    mark : str
        Origin of the expected value.
    expected, got : float
        In the same unit; nan until known.
    error : float
        |got - expected| over |expected|; absolute where 0 is expected.
    tolerance : float
        Largest error that passes.
    order : float or None
        Observed order of convergence.
    least_order : float or None
        Smallest order that passes.
    """

    id: str
    kind: Kind
    reference: str
    mark: Mark
    expected: float = math.nan
    got: float = math.nan
    tolerance: float = math.nan
    order: float | None = None
    least_order: float | None = None

    @property
    def error(self) -> float:
        """Relative error; absolute where 0 is expected."""
        difference = abs(self.got - self.expected)
        return difference / abs(self.expected) if self.expected else difference

    @property
    def passes(self) -> bool:
        """Error and order are as demanded; NaN never passes."""
        if not self.error <= self.tolerance:
            return False
        if self.least_order is None:
            return True
        return self.order is not None and self.order >= self.least_order


class Found(NamedTuple):
    """Value of a case beside what is expected, where that is computed, too."""

    got: float
    expected: float
    order: float | None = None


@lru_cache(maxsize=1)
def load_cases() -> Mapping[str, VerificationCase]:
    """All cases by their ids, in the order of the table; nothing is computed yet."""
    text = files(__package__).joinpath("cases.toml").read_text(encoding="utf-8")
    return {
        name: VerificationCase(id=name, **{**truth, **own})
        for truth in tomllib.loads(text)["truth"]
        for name, own in truth.pop("cases").items()
    }


def judge(results: Mapping[str, float | Found]) -> list[VerificationCase]:
    """Cases of the table with what was found; a bare number is what was got."""
    cases = load_cases()
    return [
        replace(cases[name], **result._asdict())
        if isinstance(result, Found)
        else replace(cases[name], got=float(result))
        for name, result in results.items()
    ]


def observe_order(sizes: Sequence[float], errors: Sequence[float]) -> float:
    """Slope of log(error) over log(size) between the two finest; sizes descend."""
    ratio = math.log(errors[-2] / errors[-1])
    return ratio / math.log(sizes[-2] / sizes[-1])


def largest_difference(first: object, second: object) -> float:
    """Largest absolute difference of two arrays."""
    return float(np.abs(np.asarray(first) - np.asarray(second)).max())
