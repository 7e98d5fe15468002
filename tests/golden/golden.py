"""Every number and word of the studies of forty drawn sites, as they were once.

Regression, not truth: whoever changes a number says why, and writes the file again
(``python -m tests.golden.golden``), then in the records of today (`former`).
"""

import json
import lzma
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from netdesign.checks import load_standard
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.site.reader import read_site
from netdesign.solving.runner import Runner
from netdesign.study.cases import solve_site
from netdesign.study.check_run import CheckRun
from netdesign.study.document import write_document
from netdesign.study.judge import judge_site
from tests.golden.former import state_document
from tests.site_lines import write_lines
from tests.study.knowing_less.drawn_site import draw_lines

STORED = Path(__file__).with_name("numbers.json.xz")
SEEDS = range(9000, 9040)
RUN = CheckRun(settings=SolverSettings(accuracy=0.05, levels=MESH_LEVELS[:2]))
PROFILES = ("nf-p-95-304-style", "swiss-guideline-2007", "eurocode", "onr-24805-style")
FOLLOWED = (9003, 9010)  # in time: the steady state with its history
DIGITS = 11
LONG = 12  # numbers of a list, beyond which their count and sums stand for them
# What follows from the program, the file and the machine, not from the site.
LEFT_OUT = ("provenance", "digest", "schema")


def judge_seed(seed):
    """Numbers and words of a drawn site's study, by their place."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "site.xlsx"
        write_lines(path, draw_lines(seed))
        site = read_site(path)
    standard = load_standard(PROFILES[seed % len(PROFILES)])
    run = replace(RUN, method="transient") if seed in FOLLOWED else RUN
    study = judge_site(site, solve_site(site, run, Runner()), standard, run)
    document = state_document(json.loads(write_document(study)))
    return flatten({k: v for k, v in document.items() if k not in LEFT_OUT})


def flatten(value, place=""):
    """Leaves of a document by place; words of messages are left to other tests."""
    if isinstance(value, dict):
        if value.keys() == {"key", "arguments"}:
            return {place: value["key"]}
        parts = value.items()
    elif isinstance(value, list):
        parts = enumerate(sum_up(value))
    else:
        return {place: round_off(value)}
    found = {}
    for key, part in parts:
        found |= flatten(part, f"{place}/{key}")
    return found


def sum_up(values):
    """List as it is; of a long one of numbers, or of points, its count and sums."""
    flat = np.ravel(values) if is_numeric(values) else values
    if len(flat) <= LONG or flat is values:
        return values
    weights = np.linspace(1.0, 2.0, len(flat))
    return [len(flat), float(np.abs(flat).sum()), float(weights @ flat)]


def is_numeric(values):
    try:
        return np.asarray(values).dtype.kind == "f"
    except ValueError:  # of unlike lengths
        return False


def round_off(value):
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value


def load_stored():
    return json.loads(lzma.decompress(STORED.read_bytes()))


def main():
    found = {str(seed): judge_seed(seed) for seed in SEEDS}
    text = json.dumps(found, separators=(",", ":")).encode()
    STORED.write_bytes(lzma.compress(text, preset=9))


if __name__ == "__main__":
    main()
