"""Compares the outputs that ``compare_pythons`` made; exit code 1 if they differ.

Processes: all bytes. Pythons: all words and whole numbers, and all other numbers
rounded to six digits; what is smaller than a billionth is a residual, and counts as 0.
"""

import hashlib
import json
import sys
from pathlib import Path

DIGITS, NOTHING = 6, 1e-9


def read(folder):
    """Bytes of the outputs."""
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def flatten(value, place=""):
    """Every number and word of a document, by its place, numbers rounded."""
    if isinstance(value, dict | list):
        pairs = value.items() if isinstance(value, dict) else enumerate(value)
        found = {}
        for key, one in pairs:
            found |= flatten(one, f"{place}/{key}")
        return found
    return {place: show(value) if isinstance(value, float) else value}


def show(value):
    return "0" if abs(value) < NOTHING else f"{value:.{DIGITS}g}"


def load(folder):
    study = json.loads((folder / "out-1" / "study.json").read_text(encoding="utf-8"))
    study["provenance"].pop("libraries")
    study.pop("digest", None)  # of every digit
    return flatten(study)


def main():
    folders = [Path(one) for one in sys.argv[1:]]
    differs = False
    for folder in folders:
        one, two = read(folder / "out-1"), read(folder / "out-2")
        other = [name for name in one | two if one.get(name) != two.get(name)]
        print(
            f"{folder.name}: 1 and 2 processes: {len(one)} files, {len(other)} differ"
        )
        differs |= bool(other)
    first = load(folders[0])
    for folder in folders:
        again = load(folder)
        other = [name for name in first | again if first.get(name) != again.get(name)]
        text = json.dumps(again, sort_keys=True)
        digest = hashlib.sha256(text.encode()).hexdigest()
        print(f"{folder.name}: {len(again)} values, {len(other)} differ, {digest[:16]}")
        for name in other[:10]:
            print(f"  {name}: {first.get(name)} -> {again.get(name)}")
        differs |= bool(other)
    sys.exit(1 if differs else 0)


if __name__ == "__main__":
    main()
