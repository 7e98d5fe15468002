"""Snow around the end of a row, seen from above: an end effect of the program's own."""

from netdesign.numerics.scipy_start import importing_scipy

with importing_scipy():
    import scipy.special  # noqa: F401 - first of all that import it here
