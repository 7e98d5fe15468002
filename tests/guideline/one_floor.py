"""Floor of a net on its own layout."""

from netdesign.guideline.floor import find_floors
from netdesign.study.guideline_load import find_row_floors


def find_floor(model, ranges, altitude):
    (floor,) = find_floors(model, ranges, altitude, (ranges.net.layout,))
    return floor


def find_row_floor(row, ranges, standard):
    return find_row_floors(row, ranges, standard, (row.layout,))[row.layout]
