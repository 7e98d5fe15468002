"""Arguments that the texts of the program ask for."""

import string


def list_gaps(text: str) -> frozenset[str]:
    """Names of the arguments that a text asks for."""
    parts = string.Formatter().parse(text)
    return frozenset(name for _, name, _, _ in parts if name)
