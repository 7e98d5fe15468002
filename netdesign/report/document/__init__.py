"""Report as a document of a word processor, in a company's own template."""
