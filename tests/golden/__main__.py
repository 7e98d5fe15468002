"""``python -m tests.golden``: what must stay equal, one part after another.

Where formulas change, ``--write`` stores all anew once what differs was read; the
changelog says which verdicts turned.
"""

import sys

from tests.golden.drawn import compare_drawn, store_drawn
from tests.golden.example import compare_recalculated, compare_texts, store_texts
from tests.golden.lists import compare_lists, store_lists

SHOWN = 400
PARTS = (compare_drawn, compare_texts, compare_lists, compare_recalculated)


def compare(part):
    """Print what a part tells; whether nothing differs that must not."""
    write(part.__doc__)
    told = part()
    for line in told[:SHOWN]:
        write(f"   {line}")
    write(f"   {len(told)} lines" if told else "   equal")
    return not told or part is compare_texts


def write(line):
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    if "--write" in sys.argv:
        store_drawn()
        store_lists()
        store_texts()
    else:
        sys.exit(not all([compare(part) for part in PARTS]))
