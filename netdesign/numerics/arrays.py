"""Names of array types, and elementary functions of one number or of an array.

So a formula stands once. A number stays a number and is as fast as with ``math``; an
array gives an array.
"""

from __future__ import annotations

import math
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from netdesign.outcome import require_positive, require_within

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
Signs = NDArray[np.int8]  # 1, 0 or -1
# One number, or an array of them: what a formula takes that stands once for both.
Number = TypeVar("Number", float, Floats)


def freeze(array: NDArray[Any]) -> NDArray[Any]:
    """The array itself, made read-only: many callers keep it.

    Parameters
    ----------
    array : ndarray, any shape
        Any unit.

    Returns
    -------
    ndarray, of that shape
        In that unit.
    """
    array.setflags(write=False)
    return array


def gather(places: Ints, values: Floats, size: int) -> Floats:
    """Sums of the values that go to each place.

    Parameters
    ----------
    places : ndarray of int, any shape
        Where each value goes.
    values : ndarray
        Of that shape, any unit.
    size : int
        Number of places.

    Returns
    -------
    ndarray, shape (size,)
        In that unit.
    """
    sums = np.bincount(places.ravel(), values.ravel(), minlength=size)
    return np.asarray(sums, dtype=np.float64)


Truth = bool | Mask


def find_tangent(angle: Number) -> Number:
    """Tangent of an angle [rad]."""
    return np.tan(angle) if isinstance(angle, np.ndarray) else math.tan(angle)


def find_sine(angle: Number) -> Number:
    """Sine of an angle [rad]."""
    return np.sin(angle) if isinstance(angle, np.ndarray) else math.sin(angle)


def find_cosine(angle: Number) -> Number:
    """Cosine of an angle [rad]."""
    return np.cos(angle) if isinstance(angle, np.ndarray) else math.cos(angle)


def find_root(value: Number) -> Number:
    """Square root."""
    return np.sqrt(value) if isinstance(value, np.ndarray) else math.sqrt(value)


def find_cube_root(value: Number) -> Number:
    """Cube root."""
    return np.cbrt(value) if isinstance(value, np.ndarray) else math.cbrt(value)


def measure_length(x: Number, y: Number) -> Number:
    """Length of a vector."""
    return np.hypot(x, y) if isinstance(x, np.ndarray) else math.hypot(x, y)


def measure_turn(x: Number, y: Number) -> Number:
    """Angle of a vector from the first axis, -pi to pi [rad]."""
    return np.arctan2(y, x) if isinstance(x, np.ndarray) else math.atan2(y, x)


def take_larger(a: Number, b: Number | float) -> Number:
    """Larger of two numbers, or of two arrays element by element.

    Parameters
    ----------
    a, b : float or ndarray
        In any unit, alike in both.
    """
    return np.maximum(a, b) if isinstance(a, np.ndarray) else max(a, b)


def take_smaller(a: Number, b: Number | float) -> Number:
    """Smaller of two numbers, or of two arrays element by element.

    Parameters
    ----------
    a, b : float or ndarray
        In any unit, alike in both.
    """
    return np.minimum(a, b) if isinstance(a, np.ndarray) else min(a, b)


def choose(condition: Truth, then: Number, other: Number) -> Number:
    """``then`` where the condition holds, else ``other``; both are computed."""
    if isinstance(condition, np.ndarray):
        return cast(Number, np.where(condition, then, other))
    return then if condition else other


def find_none(first: Truth, *others: Truth) -> Truth:
    """Truth that none of the conditions holds."""
    for condition in others:
        first = first | condition
    return ~first if isinstance(first, np.ndarray) else not first


def as_mask(condition: Truth) -> Mask:
    """Condition of many as what it is, an array of any shape."""
    return np.asarray(condition)


def require_all_within(
    name: str, value: float | Number, low: float, high: float, unit: str = ""
) -> None:
    """Refuse what `require_within` refuses, of any number of an array.

    Parameters
    ----------
    name : str
        In the refusal.
    value : float or ndarray
        One number or many, in ``unit``.
    low, high : float
        Accepted ends, in ``unit``.
    unit : str
        In the refusal.

    Raises
    ------
    ModelError
        If any number is outside.
    """
    if isinstance(value, np.ndarray):
        for end in (value.min(), value.max()):
            require_within(name, float(end), low, high, unit)
    else:
        require_within(name, value, low, high, unit)


def require_all_positive(name: str, value: float | Number, unit: str = "") -> None:
    """Refuse what `require_positive` refuses, of any number of an array.

    Parameters
    ----------
    name : str
        In the refusal.
    value : float or ndarray
        One number or many, in ``unit``.
    unit : str
        In the refusal.

    Raises
    ------
    ModelError
        If any number is not finite and above zero.
    """
    if isinstance(value, np.ndarray):
        for end in (value.min(), value.max()):
            require_positive(name, float(end), unit)
    else:
        require_positive(name, value, unit)
