"""Numbers as a report prints them, written by other means than the program's."""


def write_force(force):
    """Force in kN or kN/m with three significant digits, below 1000."""
    return f"{force:#.3g}".rstrip(".")
