"""The report of a study as blocks: its sections, in the order in which they stand."""
