"""``python -m tests.golden``: what must stay equal, one part after another."""

import sys

from tests.golden.drawn import SEEDS, compare_seed, load

SHOWN = 40


def compare_drawn():
    """G1: forty drawn sites, every number by its place."""
    stored = load("lines"), load("numbers"), load("verdicts")
    return [f"{seed} {line}" for seed in SEEDS for line in compare_seed(seed, *stored)]


PARTS = (compare_drawn,)


def main():
    is_equal = True
    for part in PARTS:
        write(part.__doc__)
        told = part()
        for line in told[:SHOWN]:
            write(f"   {line}")
        write(f"   {len(told)} differences" if told else "   equal")
        is_equal = is_equal and not told
    return 0 if is_equal else 1


def write(line):
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
