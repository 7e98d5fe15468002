"""Snow around the end of a row, seen from above: verification of the end effect."""
