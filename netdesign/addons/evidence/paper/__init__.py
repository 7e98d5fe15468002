"""The source paper's study: its runs, and what they say of its statements."""
