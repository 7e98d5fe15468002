"""The largest values of unknown functions over a box: mathematics only."""
