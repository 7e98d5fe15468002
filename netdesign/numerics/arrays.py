"""Names of the array types, for all rooms that compute with them."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
Signs = NDArray[np.int8]  # 1, 0 or -1
# One number, or an array of them: what a formula takes that stands once for both.
Number = TypeVar("Number", float, Floats)
