"""Names of the array types, for all rooms that compute with them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
Signs = NDArray[np.int8]  # 1, 0 or -1
