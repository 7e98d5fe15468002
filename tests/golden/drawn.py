"""Forty drawn sites, and their studies as they were once: regression, not truth."""

import json
import lzma
import tempfile
from pathlib import Path

from netdesign.checks import load_standard
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.site.reader import read_site
from netdesign.study.document import write_document
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun
from tests.golden.compare import read_gone, tell_differences
from tests.golden.places import state_places, state_verdicts
from tests.grid import solve_site
from tests.make import write_site

HERE = Path(__file__).parent
SEEDS = range(9000, 9040)
RUN = CheckRun(settings=SolverSettings(accuracy=0.05, levels=MESH_LEVELS[:2]))
PROFILES = ("nf-p-95-304-style", "swiss-guideline-2007", "eurocode", "onr-24805-style")


def judge_seed(lines, seed):
    """Document of a drawn site's study."""
    with tempfile.TemporaryDirectory() as folder:
        site = read_drawn(Path(folder) / "site.xlsx", lines[str(seed)])
    (document,) = solve_and_judge(site, [PROFILES[seed % len(PROFILES)]])
    return document


def read_drawn(path, drawn):
    """Site of tables as they were drawn, and of what their unit cells measure."""
    measures = {(table, key): said for table, key, said in drawn["measures"]}
    return read_site(write_site(path, drawn["tables"], measures=measures))


def solve_and_judge(site, profiles):
    """Documents of a site's studies, solved once."""
    solved = solve_site(site, RUN)
    for profile in profiles:
        study = judge_site(site, solved, load_standard(profile), RUN)
        yield json.loads(write_document(study))


def compare_drawn():
    """G1: forty drawn sites, every number by its place."""
    stored = load("lines"), load("numbers"), load("verdicts")
    return [f"{seed} {line}" for seed in SEEDS for line in compare_seed(seed, *stored)]


def compare_seed(seed, lines, numbers, verdicts):
    """Lines that tell every difference of a drawn site's study."""
    document = judge_seed(lines, seed)
    told = tell_differences(verdicts[str(seed)], state_verdicts(document))
    return told + tell_differences(
        numbers[str(seed)], state_places(document), gone=read_gone()
    )


def store_drawn():
    """Store what the drawn sites give today; it is read first."""
    lines = load("lines")
    documents = {str(seed): judge_seed(lines, seed) for seed in SEEDS}
    store("numbers", {seed: state_places(one) for seed, one in documents.items()})
    store("verdicts", {seed: state_verdicts(one) for seed, one in documents.items()})


def load(name):
    """Record that is stored beside this module."""
    return json.loads(lzma.decompress((HERE / f"{name}.json.xz").read_bytes()))


def store(name, record):
    text = json.dumps(record, separators=(",", ":")).encode()
    (HERE / f"{name}.json.xz").write_bytes(lzma.compress(text, preset=9))
