"""Contents of a report, independent of its medium."""
