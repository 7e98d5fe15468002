"""Checks the anchors of snow nets by a coupled snowpack-net calculation."""

import os
from importlib.metadata import version

# The linear problems are small: threads of the BLAS make them 3 to 10 times slower
# (measured). Works if NumPy is not loaded yet; a value that is set already is kept.
for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

__version__ = version("netdesign")
