"""A winter on a net: forces of one row through a season, day after day at rest."""
