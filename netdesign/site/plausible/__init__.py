"""Numbers that can hardly be meant: a slip of the pen becomes a question."""
