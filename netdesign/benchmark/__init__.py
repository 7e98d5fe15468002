"""Run time against error, and what the envelope costs."""
