"""Array types by name, and sums of values by place, for all rooms that compute."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
Signs = NDArray[np.int8]  # 1, 0 or -1
# One number, or an array of them: what a formula takes that stands once for both.
Number = TypeVar("Number", float, Floats)


def freeze(array: NDArray[Any]) -> NDArray[Any]:
    """The array itself, which nobody can change any more: it is kept for many.

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
