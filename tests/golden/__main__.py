"""``python -m tests.golden``: what must stay equal, one part after another.

Where formulas change, ``--write`` stores all anew once what differs was read; the
changelog says which verdicts turned. It computes with the instructions that every
processor has: with others a sum ends in another digit, and a search takes another case.
"""

import os
import sys

from tests.golden.drawn import compare_drawn, store_drawn
from tests.golden.example import compare_recalculated, compare_texts, store_texts
from tests.golden.lists import compare_lists, store_lists

SHOWN = 400
EVERYWHERE = {
    "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL AVX512_SPR",
    "OPENBLAS_CORETYPE": "Nehalem",
}
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
    if EVERYWHERE.items() - os.environ.items():
        command = (sys.executable, "-m", "tests.golden", *sys.argv[1:])
        os.execve(sys.executable, command, os.environ | EVERYWHERE)
    if "--write" in sys.argv:
        store_drawn()
        store_lists()
        store_texts()
    else:
        sys.exit(not all([compare(part) for part in PARTS]))
