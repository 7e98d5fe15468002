"""Histories: snow that settles and a net that stretches, followed in time."""
