"""Two versions in turns: their runs, what a failure becomes, ratios, the table."""

import itertools
import re
import sys
from pathlib import Path

import pytest

from netdesign.addons.evidence.benchmark import versions
from netdesign.addons.evidence.benchmark.versions import (
    CHANGED,
    Size,
    compare_versions,
    count_runs,
    list_figures,
    write_sites,
)

THIS, OTHER = Path(sys.executable), Path("other-python")
SIZE = Size(repeats=3, scenes=("paper-0",), rows=1)


@pytest.fixture(scope="module")
def compared():
    """Runs as asked for, and what was told as they ended."""
    order, done, others = [], [], itertools.cycle((3.0, 5.0, 4.0))

    def measure(python, figure, folder):
        order.append((python, figure, folder))
        if python == OTHER and figure.timed[0][0] == "solve":
            return "of its own (3)"
        taken = 2.0 if python == THIS else next(others)
        return {"cpu_s": taken, "wall_s": 2.0 * taken}

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(versions, "time_figure", measure)
        patch.setattr(versions, "read_version", lambda python: f"of {python.name}")
        compare_versions(OTHER, SIZE, done.append)
    return order, done


def test_versions_take_turns_and_the_other_begins_every_second_repeat(compared):
    runs, done = compared
    figures = list_figures(SIZE, Path())
    in_turns = [THIS, OTHER, OTHER, THIS, THIS, OTHER]
    assert [python for python, _, _ in runs] == in_turns * len(figures)
    assert len(done) == len(runs) == count_runs(SIZE)


def test_a_changed_site_differs_in_one_cell(tmp_path):
    write_sites(tmp_path, 9)
    site = {path.name: path.read_text() for path in (tmp_path / "site").iterdir()}
    for name, (sheet, _, text) in CHANGED.items():
        changed = {path.name: path.read_text() for path in (tmp_path / name).iterdir()}
        (other,) = (one for one in site if site[one] != changed[one])
        assert other == f"{sheet}.csv"
        cells = (re.split(r"[,\n]", one[other]) for one in (site, changed))
        (different,) = ((a, b) for a, b in zip(*cells, strict=True) if a != b)
        assert different[1] == text
