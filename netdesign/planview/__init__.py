"""Snow around the end of a row, seen from above: an end effect of the program's own."""
