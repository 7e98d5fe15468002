"""Report as a document of a word processor."""
