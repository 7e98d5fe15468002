"""A study of the program's own contradicts nothing, whatever its site."""

import random

import pytest

from netdesign.study.document import read_document, write_document
from netdesign.study.rejudge.study import rejudge
from tests.study.knowing_less.drawn_site import (
    draw_lines,
    empty,
    give_strength,
)
from tests.study.knowing_less.test_knowing_less import draw_sets, judge_lines

# Sites of which a sound study was refused once, or none could be made.
FOUND = (4, 15, 20, 38, 45, 47, 107, 136)


def draw_sites(seed):
    """A site, with nets below the snow, with empty cells, with other numbers."""
    lines = draw_lines(seed, is_placed=True, is_tested=bool(seed % 2))
    give_strength(random.Random(f"ground {seed}"), lines)
    draw = random.Random(f"x {seed}")
    yield lines
    low = [
        {**one, "net_height": round(one["net_height"] * draw.uniform(0.5, 0.99), 2)}
        for one in lines["Nets"]
    ]
    yield {**lines, "Nets": low}
    for cells in draw_sets(draw, lines, 4):
        yield empty(lines, cells)
    yield {**lines, "Nets": [scale(draw, one) for one in low]}


def scale(draw, line):
    """Some of the numbers of a line, smaller or larger."""
    return {
        key: value * draw.uniform(0.4, 2.0)
        if isinstance(value, float) and draw.random() < 0.15
        else value
        for key, value in line.items()
    }


def list_contradictions(path, lines):
    """What judging again finds in a study just made; None of a refused site."""
    judged = judge_lines(path, lines)
    if judged is None:
        return None
    study, site, standard = judged
    return rejudge(read_document(write_document(study)), standard, site)


@pytest.mark.parametrize(
    "seed",
    [
        pytest.param(seed, marks=() if seed in FOUND[::3] else pytest.mark.long)
        for seed in sorted({*FOUND, *range(500, 515)})
    ],
)
def test_a_study_just_made_is_judged_as_it_was(tmp_path, seed):
    found = [list_contradictions(tmp_path / "s.xlsx", one) for one in draw_sites(seed)]
    assert any(one is not None for one in found)
    assert not any(found), found
